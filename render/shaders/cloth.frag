// Cloth, lit from both sides.  FIELD: colours show a value; WIREFRAME: the mesh's edges are drawn over it.
in Surface {
#include "surface.glsl"
};
uniform vec3 front_albedo, back_albedo;
uniform float sheen;  // fibres that stand off catch light at grazing angles
uniform sampler2D color_map;
uniform vec2 value_range;
out vec4 color;

#include "light.glsl"
#include "needed.glsl"
#include "grid.glsl"
#include "weave.glsl"
#include "threads.glsl"
#include "tone.glsl"

const float kThrough = 0.16;  // share of the key light that a sheet passes on to its other side

#ifdef WIREFRAME
#include "wireframe.glsl"
#endif

void main() {
  vec3 outward = normalize(world_normal);
  vec3 normal = gl_FrontFacing ? outward : -outward;
  vec2 seen = gl_FrontFacing ? sky.xz : sky.yw;
  bool needed = is_needed();
  Weave weave = weave_at(thread, needed);
  vec3 fine = with_threads(normal, weave.tilt);

  float facing = dot(normal, to_light);
  float reaching = key_reaching(world, normal, to_light, needed);
  float direct = max(dot(fine, to_light), 0.0) * smoothstep(0.0, 0.12, facing);
  float through = kThrough * max(-facing, 0.0);
  vec3 light = room_light(fine, seen.x, seen.y) + key_light() * reaching * (direct + through);
  vec3 view = toward_eye(world);
  float fill = 0.07 * room * max(dot(fine, view), 0.0) * (0.15 + 0.85 * seen.x);

#ifdef FIELD
  float t = clamp((field - value_range.x) / (value_range.y - value_range.x), 0.0, 1.0);
  vec3 shown = texture(color_map, vec2((t * 255.0 + 0.5) / 256.0, 0.5)).rgb;
  // Colours stay within a Delta E of 5 of the colour bar's: the light only models the shape.
  float brightness = dot(light + fill, vec3(0.3333));
  color = vec4(shown * mix(0.88, 1.0, min(brightness, 1.0)), 1);
#else
  vec3 albedo = (gl_FrontFacing ? front_albedo : back_albedo) * weave.shade;
  albedo = mix(albedo, vec3(0.03, 0.035, 0.05), 0.85 * printed(thread));
  float grazing = pow(1.0 - max(dot(normal, view), 0.15), 4.0);
  vec3 fuzz = sheen * grazing * light;
  color = vec4(toned(albedo * (light + fill) + fuzz), 1);
#endif
#ifdef WIREFRAME
  color.rgb = mix(color.rgb, vec3(0.02, 0.03, 0.05), 0.85 * edge_coverage());
#endif
}
