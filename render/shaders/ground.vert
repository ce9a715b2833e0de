// The patch of ground that the light texture covers.
layout(location = 0) in vec3 position;
uniform mat4 model, view_projection;
out vec2 place;  // -1 to 1

void main() {
  place = position.xy;
  gl_Position = view_projection * (model * vec4(position, 1));
}
