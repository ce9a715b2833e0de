// The ground is the backdrop's paper: only the shadow on it is drawn, so that no horizon shows.
in vec2 place;
uniform sampler2D ground_light;
uniform float alone;  // 1: no backdrop, the shadow is a layer of its own
out vec4 color;

#include "backdrop.glsl"
#include "ground_place.glsl"
#include "srgb.glsl"

// The layer, multiplied by its alpha, that leaves of white paper what this light does where viewers blend it, which
// they do in encoded values.
vec4 layer(vec3 light) {
  vec3 left = srgb_of_linear(light);
  float alpha = 1.0 - min(left.r, min(left.g, left.b));
  vec3 tint = alpha > 0.0 ? (left - (1.0 - alpha)) / alpha : vec3(0);
  tint *= smoothstep(0.02, 0.2, alpha);  // rounding gives faint shadows any hue
  return vec4(alpha * linear_of_srgb(tint), alpha);
}

void main() {
  float near = 1.0 - smoothstep(0.6, 1.0, length(place));
  vec3 light = mix(vec3(1), min(texture(ground_light, 0.5 * texture_of(place) + 0.5).rgb, vec3(1)), near);
  color = alone > 0.5 ? layer(light) : vec4(backdrop() * light, 1);
}
