// Every lit surface: cloth, obstacles, ground.
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 pattern;
layout(location = 3) in float value;
uniform mat4 model, view_projection;
uniform float inset;

#include "sky.glsl"

out vec3 world;
out vec3 world_normal;
out vec2 thread;     // warp and weft coordinates [m]
out float field;     // what the colour map shows
out vec3 sky;        // share of the sky seen from the front side, from the back side, and from the point itself

void main() {
  world_normal = mat3(model) * normal;
  world = (model * vec4(position, 1)).xyz - inset * world_normal;
  thread = pattern;
  field = value;
  sky = sky_seen(world, world_normal);
  gl_Position = view_projection * vec4(world, 1);
}
