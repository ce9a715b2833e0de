out vec4 color;
void main() { color = vec4(0.2, 0.5, 0.8, 1); }
