#include "srgb.glsl"

// The layer, multiplied by its alpha, that leaves of white paper what this light does where viewers blend it, which
// they do in encoded values.
vec4 shadow_layer(vec3 light) {
  vec3 left = srgb_of_linear(light);
  float alpha = 1.0 - min(left.r, min(left.g, left.b));
  vec3 tint = alpha > 0.0 ? (left - (1.0 - alpha)) / alpha : vec3(0);
  tint *= smoothstep(0.02, 0.2, alpha);  // rounding gives faint shadows any hue
  return vec4(alpha * linear_of_srgb(tint), alpha);
}
