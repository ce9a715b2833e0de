#include "disc.glsl"
// A studio: a large soft key light, a bright room around, a pale floor that throws light back, a weak fill.
uniform vec3 eye;
uniform vec3 view_forward;  // used instead of the eye where the camera is orthographic
uniform float orthographic;
uniform vec3 to_light;
uniform float room;  // brightness of the room and its floor; 1: the studio's
uniform sampler2DShadow key_map;
uniform mat4 key_matrix;
uniform float key_texel;  // size of a texel in the world [m]

const vec3 kKeyLight = vec3(0.88, 0.85, 0.81);
const vec3 kSkyLight = vec3(0.30, 0.315, 0.34);
const vec3 kFloorLight = vec3(0.16, 0.156, 0.148);
const float kBlur = 4.5;    // radius of the key shadow's edge in texels
const int kKeyTaps = 16;
const int kRimTaps = 4;

// Brighter where the room is darker.
vec3 key_light() { return kKeyLight * (1.9 - 0.9 * room); }

vec3 toward_eye(vec3 point) { return orthographic > 0.5 ? -view_forward : normalize(eye - point); }

// Share of the key light that reaches a point, tested beside the surface on the side that faces the light: a thin
// sheet must neither shade itself nor let its shadow float.
float key_reaching(vec3 point, vec3 normal) {
  float side = sign(dot(normal, to_light));
  vec3 p = (key_matrix * vec4(point + side * 2.0 * key_texel * normal, 1)).xyz * 0.5 + 0.5;
  float reach = kBlur / float(textureSize(key_map, 0).x);
  // Depth rises across the blurred disc on tilted surfaces.
  float depth = min(p.z - 0.0006 * reach, 1.0);
  // Most pixels lie outside the map or wholly in light or shadow: five taps around the rim tell, and a software
  // renderer, which pays for every tap, skips the rest.
  vec2 off = abs(p.xy - 0.5);
  int taps = max(off.x, off.y) < 0.5 ? kRimTaps : 0;
  float lit = 0.0;
  vec2 spoke = vec2(reach, 0);
  for (int i = 0; i < taps; ++i) {
    // From the rim inward.
    float radius = sqrt(1.0 - (float(i) + 0.5) / float(kKeyTaps));
    lit += texture(key_map, vec3(p.xy + radius * spoke, depth));
    spoke = kGoldenTurn * spoke;
    if (i == kRimTaps - 1 && lit > 0.001 && lit < float(kRimTaps) - 0.001) taps = kKeyTaps;
  }
  return taps > 0 ? lit / float(taps) : 1.0;
}

// Soft light from the room and the floor on a surface that sees these shares of them.
vec3 room_light(vec3 normal, float sky_share, float floor_share) {
  float up = 0.5 + 0.5 * normal.z;
  return room * (kSkyLight * up * sky_share + kFloorLight * (1.0 - up) * floor_share);
}
