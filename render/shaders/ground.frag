// The ground is the backdrop's paper: only the shadow on it is drawn, so that no horizon shows.
in vec3 world;
in vec3 sky;
uniform vec3 shadow_center;
uniform float shadow_radius;  // beyond it nothing casts [m]
out vec4 color;

#include "backdrop.glsl"
#include "light.glsl"

void main() {
  float distance = length(world.xy - shadow_center.xy) / shadow_radius;
  float near = 1.0 - smoothstep(0.55, 1.0, distance);
  float facing = max(to_light.z, 0.0);
  vec3 up = vec3(0, 0, 1);
  float reaching = key_reaching(world, up, near > 0.0 ? kKeyTaps : 0);
  vec3 open = kKeyLight * facing + kSkyLight;
  vec3 light = kKeyLight * facing * reaching + room_light(up, sky.x, sky.z);
  color = vec4(backdrop() * mix(vec3(1), light / open, near), 1);
}
