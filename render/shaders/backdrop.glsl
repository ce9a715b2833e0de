// A pale backdrop with a gentle gradient upward, in the middle of the white page.
uniform vec3 backdrop_top, backdrop_bottom;
#include "fade.glsl"

vec3 backdrop() {
  float height = (gl_FragCoord.y + origin.y) / picture_size.y;
  return mix(vec3(1), mix(backdrop_bottom, backdrop_top, smoothstep(0.05, 1.0, height)), fade());
}
