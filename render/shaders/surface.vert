// Every lit surface.  SKY_GIVEN: what is seen of sky and floor is an attribute, else it is looked up here.
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 pattern;
layout(location = 3) in float value;
#ifdef SKY_GIVEN
layout(location = 4) in vec4 vertex_sky;
#else
#include "sky.glsl"
#endif
uniform mat4 model, view_projection;
uniform float inset;

out vec3 world;
out vec3 world_normal;
out vec2 thread;     // warp and weft coordinates [m]
out float field;     // what the colour map shows
out vec4 sky;        // shares of the sky seen from the front and the back side, and of the floor

void main() {
  world_normal = mat3(model) * normal;
  world = (model * vec4(position, 1)).xyz - inset * world_normal;
  thread = pattern;
  field = value;
#ifdef SKY_GIVEN
  sky = vertex_sky;
#else
  sky = light_seen(world, world_normal);
#endif
  gl_Position = view_projection * vec4(world, 1);
}
