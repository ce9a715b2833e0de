// Cloth, lit from both sides.  FIELD: colours show a value; WIREFRAME: the mesh's edges are drawn over it.
in vec3 world;
in vec3 world_normal;
in vec2 thread;
in float field;
in vec4 sky;
uniform vec3 front_albedo, back_albedo;
uniform sampler2D color_map;
uniform vec2 value_range;
out vec4 color;

#include "light.glsl"
#include "weave.glsl"

const float kThrough = 0.16;  // share of the key light that a sheet passes on to its other side
const float kSheen = 0.10;    // fibres that stand off catch light at grazing angles

#ifdef WIREFRAME
uniform samplerBuffer position;
uniform isamplerBuffer corner_index;

vec3 vertex(int corner) {
  int v = 3 * texelFetch(corner_index, 3 * gl_PrimitiveID + corner).r;
  return vec3(texelFetch(position, v).r, texelFetch(position, v + 1).r, texelFetch(position, v + 2).r);
}

float distance_to_line(vec3 p, vec3 a, vec3 b) { return length(cross(p - a, b - a)) / length(b - a); }

// Coverage of the nearest edge by a line 1.1 pixels wide; thinner where edges are closer than a few pixels.
float edge_coverage() {
  vec3 a = vertex(0), b = vertex(1), c = vertex(2);
  float nearest = min(distance_to_line(world, a, b), min(distance_to_line(world, b, c), distance_to_line(world, c, a)));
  float pixel = max(length(dFdx(world)), length(dFdy(world)));
  float height = length(cross(b - a, c - a)) / max(length(b - a), max(length(c - b), length(a - c)));
  float strength = clamp(height / (4.0 * pixel), 0.25, 1.0);
  return strength * (1.0 - smoothstep(0.25, 1.05, nearest / pixel));
}
#endif

// The normal with the threads' relief.  Not of unit length: what is linear in it keeps its mean over many threads.
vec3 with_threads(vec3 normal, vec2 tilt) {
  // Warp and weft directions on the surface, from how the coordinates change across the screen.
  vec3 px = dFdx(world), py = dFdy(world);
  vec2 tx = dFdx(thread), ty = dFdy(thread);
  float turn = tx.x * ty.y - ty.x * tx.y;
  vec3 warp = (px * ty.y - py * tx.y) * sign(turn), weft = (py * tx.x - px * ty.x) * sign(turn);
  float size = max(length(warp), length(weft));
  return size > 0.0 ? normal - (tilt.x * warp + tilt.y * weft) / size : normal;
}

void main() {
  vec3 outward = normalize(world_normal);
  vec3 normal = gl_FrontFacing ? outward : -outward;
  vec2 seen = gl_FrontFacing ? sky.xz : sky.yw;
  Weave weave = weave_at(thread);
  vec3 fine = with_threads(normal, weave.tilt);

  float facing = dot(normal, to_light);
  float reaching = key_reaching(world, normal, to_light);
  float direct = max(dot(fine, to_light), 0.0) * smoothstep(0.0, 0.12, facing);
  float through = kThrough * max(-facing, 0.0);
  vec3 light = room_light(fine, seen.x, seen.y) + key_light() * reaching * (direct + through);
  vec3 view = toward_eye(world);
  float fill = 0.07 * room * max(dot(fine, view), 0.0) * (0.15 + 0.85 * seen.x);

#ifdef FIELD
  float t = clamp((field - value_range.x) / (value_range.y - value_range.x), 0.0, 1.0);
  vec3 shown = texture(color_map, vec2((t * 255.0 + 0.5) / 256.0, 0.5)).rgb;
  // Colours must stay readable against the colour bar: the light only models the shape.
  float brightness = dot(light + fill, vec3(0.3333));
  color = vec4(shown * mix(0.42, 1.0, min(brightness, 1.0)), 1);
#else
  vec3 albedo = (gl_FrontFacing ? front_albedo : back_albedo) * weave.shade;
  float grazing = pow(1.0 - max(dot(normal, view), 0.0), 4.0);
  vec3 sheen = kSheen * grazing * light;
  color = vec4(albedo * (light + fill) + sheen, 1);
#endif
#ifdef WIREFRAME
  color.rgb = mix(color.rgb, vec3(0.02, 0.03, 0.05), 0.85 * edge_coverage());
#endif
}
