// Light of sky and floor at every vertex of the cloth, captured by transform feedback once a picture.
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;

#include "sky.glsl"

out vec4 vertex_sky;

void main() { vertex_sky = light_seen(position, normal); }
