// Every lit surface.
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 pattern;
layout(location = 3) in float value;
layout(location = 4) in vec4 vertex_sky;  // what is seen of sky and floor
uniform mat4 model, view_projection;
uniform vec3 keep;    // share of a body that is drawn along its axes
uniform float inset;  // along its normals

uniform float side;   // of a sheet that is drawn: 1 its front, -1 its back, 0 its middle

invariant gl_Position;  // the same in every program: the cloth is drawn again to count what is seen of it
out Surface {
#include "surface.glsl"
};
#include "thickness.glsl"

void main() {
  world_normal = mat3(model) * normal;
  world = (model * vec4(keep * position - inset * normal, 1)).xyz;
  world += side * half_thickness(world) * world_normal;
#ifdef FIGURE
  vec3 n = normalize(world_normal);
  facing_planes = dot(n, world) * n;
  planes_square = n * n;
  planes_mixed = n.xxy * n.yzz;
#endif
  thread = pattern;
  field = value;
  sky = vertex_sky;
  gl_Position = view_projection * vec4(world, 1);
}
