#include "disc.glsl"
// Ambient light from the upper hemisphere, tested in a few directions (one tile of the sky map each).
const int kSkyLights = 24;
const int kSkyColumns = 6;
#ifdef GROUND
const int kSkyTaps = 6;
#else
const int kSkyTaps = 2;
#endif
uniform sampler2DShadow sky_map;
uniform mat4 sky_matrix[kSkyLights];
uniform vec3 sky_direction[kSkyLights];
uniform float sky_texel;  // size of a texel in the world [m]
uniform float sky_blur;   // radius of a lookup in texels
uniform float sky_lift;   // of the point above its surface in texels: more than the blur sees of the surface itself

float sky_open(int k, vec3 point) {
  vec3 p = (sky_matrix[k] * vec4(point, 1)).xyz * 0.5 + 0.5;
  vec2 tiles = vec2(kSkyColumns, kSkyLights / kSkyColumns);
  vec2 texel = tiles / vec2(textureSize(sky_map, 0));
  vec2 corner = vec2(k % kSkyColumns, k / kSkyColumns);
  // Bilinear lookups on a disc; clamped so that they stay in this direction's tile, whose border is empty: a disc
  // beside the tile is open.
  vec2 beside = abs(p.xy - 0.5) - 0.5 - sky_blur * texel;
  int taps = max(beside.x, beside.y) > 0.0 ? 0 : kSkyTaps;
  float open = taps > 0 ? 0.0 : float(kSkyTaps);
  vec2 spoke = vec2(0.6, 0.8) * sky_blur * texel;
  for (int i = 0; i < taps; ++i) {
    vec2 inside = clamp(p.xy + sqrt((float(i) + 0.5) / float(kSkyTaps)) * spoke, texel, 1.0 - texel);
    open += texture(sky_map, vec3((corner + inside) / tiles, min(p.z, 1.0)));
    spoke = kGoldenTurn * spoke;
  }
  return open / float(kSkyTaps);
}

// Shares of the sky's light (x) and of the floor's (z) that reach the side the normal points to; y, w: the other side.
// 1 = all that this side could see without obstruction.  What a side sees of the floor it sees like the sky in the
// direction mirrored at the horizon; a side that looks down, where no such direction is tested, like the point's average.
vec4 light_seen(vec3 point, vec3 normal) {
  vec4 seen = vec4(0), tested = vec4(0), possible = vec4(1e-6);
  float open_sum = 0.0;
  for (int k = 0; k < kSkyLights; ++k) {
    vec3 direction = sky_direction[k];
    float facing = dot(normal, direction);
    // Looked up beside the surface, on the side that faces this direction: the sheet must not hide the sky from itself.
    float open = sky_open(k, point + sign(facing) * sky_lift * sky_texel * normal);
    float floor_facing = dot(normal, vec3(direction.xy, -direction.z));
    vec4 weight = max(vec4(facing, -facing, floor_facing, -floor_facing), 0.0);
    vec4 told = weight * vec4(1, 1, step(0.0, facing), step(0.0, -facing));
    seen += told * open;
    tested += told;
    possible += weight;
    open_sum += open;
  }
  return (seen + (possible - tested) * open_sum / float(kSkyLights)) / possible;
}
