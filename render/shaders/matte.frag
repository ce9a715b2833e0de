// Obstacles: plain matte bodies that leave the eye to the cloth.
in Surface {
#include "surface.glsl"
};
uniform vec3 albedo;
out vec4 color;

#include "light.glsl"
#include "needed.glsl"

void main() {
  vec3 outward = normalize(world_normal);
  vec3 normal = gl_FrontFacing ? outward : -outward;  // of a body that is not closed
  vec2 seen = gl_FrontFacing ? sky.xz : sky.yw;
  float facing = max(dot(normal, to_light), 0.0);
  vec3 light = room_light(normal, seen.x, seen.y);
  light += key_light() * facing * key_reaching(world, normal, to_light, facing > 0.0 && is_needed());
  color = vec4(albedo * light, 1);
}
