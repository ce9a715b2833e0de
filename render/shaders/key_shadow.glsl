// Shadows of the key light, a disc far away: percentage-closer soft shadows (Fernando 2005).  What hides the light at
// distance d along its rays is smeared over a disc of radius kKeySize d, so an edge is sharp where cloth touches and
// wide below a high fold.  Lengths are in map units: the map's side is 1, and its depth spans the same length.
#include "disc.glsl"
uniform sampler2DShadow key_map;
uniform sampler2D key_depth;  // the same map, the depths themselves
uniform mat4 key_matrix;
uniform float key_texel;  // size of a texel in the world [m]

const float kSharpest = 1.5;     // least radius of a lookup [texels]: what the map resolves
const float kCasters = 0.48;     // they lie within this circle about the map's middle
const float kSearchMargin = 1.3;  // blockers are looked for beyond the light's rim, else edges would begin with a step
const float kSteepest = 5.0;     // the key light fades out on surfaces steeper than this to it
#ifdef GROUND
const float kKeySize = 0.15;  // radius of the light over its distance: 8.5 degrees, for shadows that leave the eye to the cloth
const int kSearchTaps = 48;
const float kSureLookups = 6.0;  // fewer that find something: the shadow fades, else its edge would show them
const float kTapsPerTexel = 4.0;
const float kMostTaps = 48.0;
#else
const float kKeySize = 0.06;  // 3.4 degrees
const int kSearchTaps = 22;
const float kSureLookups = 1.0;
const float kTapsPerTexel = 3.0;
const float kMostTaps = 32.0;
#endif
const int kRimTaps = 8;

// How much nearer to the light than a point what hides it must be at a distance `off` across the rays: more than the
// surface itself rises there.
float rise(float slope, float off, float texel) { return slope * (off + texel); }

// Mean distance along the rays of what may hide the light from p, and how many lookups found it.  The search runs outward, each
// ring a share wider; beyond the least radius only what stands in the cone from p to the light counts.
vec2 blockers(vec3 p, float slope, float texel, int taps) {
  float sum = 0.0, count = 0.0;
  float least = kSharpest * texel, most = max(kSearchMargin * kKeySize * p.z, 2.0 * least);
  mat2 turn = kGoldenTurn * pow(most / least, 1.0 / float(kSearchTaps - 1));
  vec2 spoke = vec2(0.8, 0.6) * least;
  for (int i = 0; i < taps; ++i) {
    float off = length(spoke), distance = p.z - texture(key_depth, p.xy + spoke).r;
    float needed = off < kSharpest * 1.6 * texel ? rise(slope, off, texel) : off / (kSearchMargin * kKeySize);
    float hides = distance > needed ? 1.0 : 0.0;
    sum += hides * distance;
    count += hides;
    spoke = turn * spoke;
  }
  return vec2(sum / max(count, 1.0), count);
}

// Share of a disc of lookups that the light reaches.  Most discs lie wholly in light or shadow: those around the rim
// tell, and a software renderer, which pays for every lookup, skips the rest.
float lit_share(vec3 p, float radius, float slope, float texel) {
  int taps = int(clamp(kTapsPerTexel * radius / texel, 12.0, kMostTaps)), asked = taps;
  float lit = 0.0;
  vec2 spoke = vec2(1, 0);
  for (int i = 0; i < asked; ++i) {
    // From the rim inward.
    float off = radius * sqrt(1.0 - (float(i) + 0.5) / float(taps));
    lit += texture(key_map, vec3(p.xy + off * spoke, min(p.z - rise(slope, off, texel), 1.0)));
    spoke = kGoldenTurn * spoke;
    if (i == kRimTaps - 1 && (lit < 0.001 || lit > float(kRimTaps) - 0.001)) asked = kRimTaps;
  }
  return lit / float(asked);
}

// Share of the key light that reaches a point, tested beside the surface on the side that faces the light: a thin
// sheet must neither shade itself nor let its shadow float.  Where it is not needed, lookups are left out.
float key_reaching(vec3 point, vec3 normal, vec3 to_light, bool needed) {
  float facing = dot(normal, to_light);
  float texel = 1.0 / float(textureSize(key_map, 0).x);
  vec3 p = (key_matrix * vec4(point + sign(facing) * key_texel * normal, 1)).xyz * 0.5 + 0.5;
  vec2 from_middle = p.xy - 0.5;
  if (length(from_middle) > kCasters + kSearchMargin * kKeySize * p.z + 3.0 * texel) needed = false;
  float slope = min(sqrt(1.0 - min(facing * facing, 1.0)) / max(abs(facing), 1e-3), kSteepest) + 0.1;
  // Where no pixel needs it, this loop ends at once; what follows a return would not, in a software renderer.
  vec2 found = blockers(p, slope, texel, needed ? kSearchTaps : 0);
  if (found.y == 0.0) return 1.0;
  float lit = lit_share(p, max(kKeySize * found.x, kSharpest * texel), slope, texel);
  return mix(1.0, lit, min(found.y / kSureLookups, 1.0));
}
