// Depth as seen from a light.
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
uniform mat4 light, model;
uniform vec3 keep;    // share of a body that is drawn along its axes
uniform float inset;  // along its normals

void main() { gl_Position = light * (model * vec4(keep * position - inset * normal, 1)); }
