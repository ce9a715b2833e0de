// The ground of a figure is the page: white but for the shadow on it, which fades toward the picture's border.
in vec3 place;
uniform vec3 open_ground;  // light where nothing is hidden
uniform vec2 picture_size, origin;
uniform float alone;  // 1: no backdrop, the shadow is a layer of its own
out vec4 color;

#include "figure_light.glsl"
#include "shadow_layer.glsl"

const float kDepth = 0.62;  // of shadows over those of a white table: the cloth must stay darker than its shadow
const float kFade = 0.14;   // of the picture's sides, along which shadows fade

float fade() {
  vec2 p = (gl_FragCoord.xy + origin) / picture_size;
  vec2 inside = smoothstep(0.0, kFade, min(p, 1.0 - p));
  return inside.x * inside.y;
}

void main() {
  vec3 up = vec3(0, 0, 1), hidden = vec3(0);
  for (int k = 0; k < kKeys + kSkies; ++k) {
    float facing = light_direction[k].z;
    if (facing > 0.0) hidden += (1.0 - open_to(k, place, up, facing)) * facing * light_weight[k];
  }
  vec3 light = max(1.0 - kDepth * fade() * hidden / open_ground, 0.0);
  color = alone > 0.5 ? shadow_layer(light) : vec4(light, 1);
}
