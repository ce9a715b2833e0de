// Depth as seen from a light.
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
uniform mat4 light, model;
uniform float inset;

void main() { gl_Position = light * (model * vec4(position - inset * normal, 1)); }
