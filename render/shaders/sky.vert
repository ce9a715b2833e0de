// Light of sky and floor at every vertex, captured by transform feedback once a picture.  CLOTH: it lies where it is,
// else a body is placed.
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;

#include "sky.glsl"

out vec4 vertex_sky;

#ifdef CLOTH
void main() { vertex_sky = light_seen(position, normal); }
#else
uniform mat4 model;
uniform vec3 keep;    // share of a body that is drawn along its axes
uniform float inset;  // along its normals

void main() {
  vec3 world = (model * vec4(keep * position - inset * normal, 1)).xyz;
  vertex_sky = light_seen(world, normalize(mat3(model) * normal));
}
#endif
