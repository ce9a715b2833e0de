// The ground of a figure is the page: white but for the shadow on it, which fades toward the picture's border.
in vec3 place;
uniform vec3 open_ground;  // light where nothing is hidden
out vec4 color;

#include "figure_light.glsl"
#include "shadow_layer.glsl"  // LAYER: there is no backdrop
#include "fade.glsl"

void main() {
  vec3 up = vec3(0, 0, 1), hidden = vec3(0);
  for (int k = 0; k < kKeys + kSkies; ++k) {
    float facing = light_direction[k].z;
    if (facing > 0.0) hidden += (1.0 - open_to(k, place, up, facing)) * facing * light_weight[k];
  }
  vec3 light = max(1.0 - kShadowDepth * fade() * hidden / open_ground, 0.0);
#ifdef LAYER
  color = shadow_layer(light);
#else
  color = vec4(light, 1);
#endif
}
