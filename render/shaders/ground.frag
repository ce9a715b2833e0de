// The ground is the backdrop's paper: only the shadow on it is drawn, so that no horizon shows.
in vec2 place;
uniform sampler2D ground_light;
out vec4 color;

#include "backdrop.glsl"

void main() {
  float near = 1.0 - smoothstep(0.6, 1.0, length(place));
  vec3 light = texture(ground_light, 0.5 * place + 0.5).rgb;
  color = vec4(backdrop() * mix(vec3(1), light, near), 1);
}
