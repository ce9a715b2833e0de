// Obstacles of a figure: plain matte bodies that leave the eye to the cloth.
in Surface {
#include "surface.glsl"
};
uniform vec3 albedo;
out vec4 color;

#include "figure_light.glsl"
#include "rounded.glsl"
#include "tone.glsl"

void main() {
  vec3 outward = normalize(world_normal), light = vec3(0);
  vec3 normal = gl_FrontFacing ? outward : -outward;  // of a body that is not closed
  vec3 point = world + max(below_round(world, normal), 0.0) * normal;
  for (int k = 0; k < kLights; ++k) {
    float facing = dot(normal, light_direction[k]);
    if (facing > 0.0) light += open_to(k, point, normal, facing) * facing * light_weight[k];
  }
  color = vec4(toned(exposure * albedo * light), 1);
}
