// A studio: a large soft key light, a bright room around, a pale floor that throws light back, a weak fill.
#include "key_shadow.glsl"
#include "eye.glsl"
uniform vec3 to_light;
uniform float room;  // brightness of the room and its floor; 1: the studio's

const vec3 kKeyLight = vec3(1.25, 1.22, 1.18);
const vec3 kSkyLight = vec3(0.295, 0.305, 0.325);
const vec3 kFloorLight = vec3(0.22, 0.216, 0.21);

// Brighter where the room is darker.
vec3 key_light() { return kKeyLight * (1.9 - 0.9 * room); }

// Soft light from the room and the floor on a surface that sees these shares of them.
vec3 room_light(vec3 normal, float sky_share, float floor_share) {
  float up = 0.5 + 0.5 * normal.z;
  return room * (kSkyLight * up * sky_share + kFloorLight * (1.0 - up) * floor_share);
}
