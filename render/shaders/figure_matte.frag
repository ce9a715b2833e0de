// Obstacles of a figure: plain matte bodies that leave the eye to the cloth.
in Surface {
#include "surface.glsl"
};
uniform vec3 albedo;
out vec4 color;

#include "figure_light.glsl"
#include "tone.glsl"

void main() {
  vec3 normal = normalize(world_normal), light = vec3(0);
  for (int k = 0; k < kLights; ++k) {
    float facing = dot(normal, light_direction[k]);
    if (facing > 0.0) light += open_to(k, world, normal, facing) * facing * light_weight[k];
  }
  color = vec4(toned(kExposure * albedo * light), 1);
}
