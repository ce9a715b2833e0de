// The edge of a sheet: each side of its boundary becomes a strip from the back to the front, that faces outward.
layout(lines) in;
layout(triangle_strip, max_vertices = 4) out;
uniform mat4 view_projection;

in Surface {
#include "surface.glsl"
} end[];

invariant gl_Position;
out Surface {
#include "surface.glsl"
};
#include "thickness.glsl"

void main() {
  vec3 along = end[1].world - end[0].world;
  for (int corner = 0; corner < 4; ++corner) {
    int i = corner % 2;
    vec3 up = end[i].world_normal;
    world_normal = normalize(cross(along, up));
    world = end[i].world + (corner < 2 ? -1.0 : 1.0) * half_thickness(end[i].world) * up;
#ifdef FIGURE
    vec3 n = world_normal;
    facing_planes = dot(n, world) * n;
    planes_square = n * n;
    planes_mixed = n.xxy * n.yzz;
#endif
    thread = end[i].thread;
    field = end[i].field;
    vec4 seen = end[i].sky;
    sky = 0.5 * (seen + seen.yxwz);
    gl_Position = view_projection * vec4(world, 1);
    EmitVertex();
  }
  EndPrimitive();
}
