#include "disc.glsl"
// Ambient light from the upper hemisphere, tested in a few directions (one tile of the sky map each).
const int kSkyLights = 8;
const int kSkyColumns = 4;
#ifdef GROUND
const int kSkyTaps = 8;
#else
const int kSkyTaps = 4;
#endif
uniform sampler2DShadow sky_map;
uniform mat4 sky_matrix[kSkyLights];
uniform vec3 sky_direction[kSkyLights];
uniform float sky_texel;  // size of a texel in the world [m]
uniform float sky_blur;   // radius of a lookup in texels

float sky_open(int k, vec3 point) {
  vec3 p = (sky_matrix[k] * vec4(point, 1)).xyz * 0.5 + 0.5;
  vec2 tiles = vec2(kSkyColumns, kSkyLights / kSkyColumns);
  vec2 texel = tiles / vec2(textureSize(sky_map, 0));
  vec2 corner = vec2(k % kSkyColumns, k / kSkyColumns);
  // Bilinear lookups on a disc; clamped so that they stay in this direction's tile, whose border is empty.
  float open = 0.0;
  vec2 spoke = vec2(0.6, 0.8) * sky_blur * texel;
  for (int i = 0; i < kSkyTaps; ++i) {
    vec2 inside = clamp(p.xy + sqrt((float(i) + 0.5) / float(kSkyTaps)) * spoke, texel, 1.0 - texel);
    open += texture(sky_map, vec3((corner + inside) / tiles, min(p.z, 1.0)));
    spoke = kGoldenTurn * spoke;
  }
  return open / float(kSkyTaps);
}

// x: share of the sky's light that reaches the side the normal points to, y: the other side, z: the point, whichever
// way it faces.  1 = all that this side could see without obstruction.
vec3 sky_seen(vec3 point, vec3 normal) {
  vec3 seen = vec3(0), possible = vec3(1e-6);
  for (int k = 0; k < kSkyLights; ++k) {
    float facing = dot(normal, sky_direction[k]);
    // Looked up beside the surface, on the side that faces this direction: the sheet must not hide the sky from itself.
    float open = sky_open(k, point + sign(facing) * 1.6 * sky_texel * normal);
    vec3 weight = vec3(max(facing, 0.0), max(-facing, 0.0), 1.0);
    seen += weight * open;
    possible += weight;
  }
  return seen / possible;
}
