// The patch of ground that the light texture covers.
layout(location = 0) in vec3 position;
uniform mat4 model, view_projection;
#ifdef FIGURE
out vec3 place;  // [m]
#else
out vec2 place;  // -1 to 1
#endif

void main() {
  vec4 world = model * vec4(position, 1);
#ifdef FIGURE
  place = world.xyz;
#else
  place = position.xy;
#endif
  gl_Position = view_projection * world;
}
