// The ground is the backdrop's paper: only the shadow on it is drawn, so that no horizon shows.
in vec2 place;
uniform sampler2D ground_light;
out vec4 color;

#include "backdrop.glsl"
#include "ground_place.glsl"
#include "shadow_layer.glsl"  // LAYER: there is no backdrop

void main() {
  float near = 1.0 - smoothstep(0.6, 1.0, length(place));
  vec3 hidden = max(1.0 - texture(ground_light, 0.5 * texture_of(place) + 0.5).rgb, 0.0);
  vec3 light = 1.0 - kShadowDepth * fade() * near * hidden;
#ifdef LAYER
  color = shadow_layer(light);
#else
  color = vec4(backdrop() * light, 1);
#endif
}
