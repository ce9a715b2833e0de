#include "backdrop.glsl"
out vec4 color;

void main() { color = vec4(backdrop(), 1); }
