// Cloth of a figure, lit from both sides.  FIELD: colours show a value; WIREFRAME: the mesh's edges are drawn over it.
in Surface {
#include "surface.glsl"
};
uniform vec3 front_albedo, back_albedo;
uniform float sheen;
uniform sampler2D color_map;
uniform vec2 value_range;
out vec4 color;

#include "eye.glsl"
#include "figure_light.glsl"
#include "rounded.glsl"
#include "grid.glsl"
#include "weave.glsl"
#include "threads.glsl"
#include "tone.glsl"
#ifdef WIREFRAME
#include "wireframe.glsl"
#endif

const float kThrough = 0.10;      // share of light that a sheet passes on to its other side
const float kNeighbours = 1.1;    // light that cloth around throws back, over its albedo; the sky's: 1

// Fibres that stand off a surface (Estevez and Kulla 2017, Eq. 2, roughness 0.4; visibility of Neubelt and Pettineo 2013), halved.
float sheen_of(vec3 normal, vec3 view, vec3 direction, float facing) {
  vec3 middle = normalize(view + direction);
  float sine = sqrt(max(1.0 - pow(dot(normal, middle), 2.0), 0.0));
  float across = max(dot(normal, view), 0.0);
  return 1.2 * pow(sine, 2.5) * facing / (4.0 * (facing + across - facing * across) + 1e-3);
}

struct Light {
  vec3 reflected, through, sheen;  // the first two over the cloth's albedo
  vec3 hidden;                     // what cloth hides
};

Light light_at(vec3 point, vec3 normal, vec3 fine, vec3 view) {
  float below = below_round(point, normal);
  Light light = Light(vec3(0), vec3(0), vec3(0), vec3(0));
  for (int k = 0; k < kLights; ++k) {
    vec3 direction = light_direction[k];
    float facing = dot(normal, direction), near_side = sign(facing);
    float open = open_to(k, point + near_side * max(near_side * below, 0.0) * normal, near_side * normal, facing);
    vec3 arriving = open * light_weight[k];
    float lit = max(dot(fine, direction), 0.0) * step(0.0, facing);
    if (k < kKeys) {
      light.sheen += arriving * sheen_of(normal, view, direction, max(facing, 0.0));
    } else {
      light.hidden += (1.0 - open) * light_weight[k] * max(facing, 0.0);
    }
    light.reflected += arriving * lit;
    light.through += arriving * max(-facing, 0.0);
  }
  return light;
}

void main() {
  vec3 view = toward_eye(world);
  vec3 normal = normalize(world_normal);
  if (!gl_FrontFacing) normal = -normal;
  Weave weave = weave_at(thread, true);
  vec3 fine = with_threads(normal, weave.tilt);
  Light light = light_at(world, normal, fine, view);

#ifdef FIELD
  float t = clamp((field - value_range.x) / (value_range.y - value_range.x), 0.0, 1.0);
  vec3 shown = texture(color_map, vec2((t * 255.0 + 0.5) / 256.0, 0.5)).rgb;
  // Colours stay within a Delta E of 5 of the colour bar's: the light only models the shape.
  color = vec4(shown * mix(0.88, 1.0, min(exposure * dot(light.reflected, vec3(0.3333)), 1.0)), 1);
#else
  vec3 albedo = (gl_FrontFacing ? front_albedo : back_albedo) * weave.shade;
  albedo = mix(albedo, vec3(0.03, 0.035, 0.05), 0.85 * printed(thread));
  float grazing = pow(1.0 - max(dot(normal, view), 0.0), 3.0);
  vec3 base = albedo * ((1.0 - kThrough) * light.reflected + kThrough * light.through + kNeighbours * albedo * light.hidden);
  color = vec4(toned(exposure * (base * (1.0 - sheen * grazing) + sheen * light.sheen)), 1);
#endif
#ifdef WIREFRAME
  color.rgb = mix(color.rgb, vec3(0.02, 0.03, 0.05), 0.85 * edge_coverage());
#endif
}
