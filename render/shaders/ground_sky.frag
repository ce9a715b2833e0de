// Share of the sky that points on the ground see, into a texture.
uniform mat4 model;
uniform vec2 texture_size;
out vec4 color;

#include "ground_place.glsl"
#include "sky.glsl"

void main() {
  vec2 place = place_of(2.0 * gl_FragCoord.xy / texture_size - 1.0);
  vec3 world = (model * vec4(place, 0, 1)).xyz;
  color = vec4(light_seen(world, vec3(0, 0, 1)).x);
}
