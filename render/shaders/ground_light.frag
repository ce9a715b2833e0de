// Light on the ground relative to open ground, into a texture that lies on it: shadows on the ground are soft, so a
// coarse texture holds them, and many lookups a texel cost little.
uniform mat4 model;
uniform vec2 texture_size;
uniform sampler2D ground_sky;
out vec4 color;

#include "ground_place.glsl"
#include "light.glsl"

void main() {
  vec2 t = gl_FragCoord.xy / texture_size;
  vec3 world = (model * vec4(place_of(2.0 * t - 1.0), 0, 1)).xyz;
  float seen = texture(ground_sky, t).r;
  float facing = max(to_light.z, 0.0);
  vec3 up = vec3(0, 0, 1);
  vec3 open = key_light() * facing + room * kSkyLight;
  vec3 light = key_light() * facing * key_reaching(world, up, to_light, true) + room_light(up, seen, 0.0);
  color = vec4(light / open, 1);
}
