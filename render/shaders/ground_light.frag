// Light on the ground relative to open ground, into a texture that lies on it: shadows on the ground are soft, so a
// coarse texture holds them, and many lookups a texel cost little.
uniform mat4 model;
uniform vec2 texture_size;
uniform sampler2D ground_sky;
uniform sampler2D key_depth;  // the key map's depths themselves
out vec4 color;

#include "ground_place.glsl"
#include "light.glsl"

const float kLightSize = 0.06;  // half width of the key light over its distance
const int kSearchTaps = 32;
const int kSoftTaps = 64;

// Half width of the shadow's edge [map units], from the mean depth of what lies between ground and light (Fernando
// 2005, percentage-closer soft shadows); 0 where nothing does.
float penumbra(vec3 p, float texels) {
  float sum = 0.0, count = 0.0;
  vec2 spoke = vec2(0.06, 0);
  for (int i = 0; i < kSearchTaps; ++i) {
    float depth = texture(key_depth, p.xy + sqrt((float(i) + 0.5) / float(kSearchTaps)) * spoke).r;
    float hides = depth < p.z - 0.002 ? 1.0 : 0.0;
    sum += hides * (p.z - depth);
    count += hides;
    spoke = kGoldenTurn * spoke;
  }
  return count > 0.0 ? max(kLightSize * sum / count, 2.0 / texels) : 0.0;
}

float soft_key(vec3 point) {
  vec3 p = (key_matrix * vec4(point, 1)).xyz * 0.5 + 0.5;
  vec2 off = abs(p.xy - 0.5);
  float reach = max(off.x, off.y) < 0.56 ? penumbra(p, float(textureSize(key_depth, 0).x)) : 0.0;
  int taps = reach > 0.0 ? kSoftTaps : 0;
  float lit = 0.0;
  vec2 spoke = vec2(reach, 0);
  for (int i = 0; i < taps; ++i) {
    lit += texture(key_map, vec3(p.xy + sqrt((float(i) + 0.5) / float(kSoftTaps)) * spoke, min(p.z - 0.001, 1.0)));
    spoke = kGoldenTurn * spoke;
  }
  return taps > 0 ? lit / float(taps) : 1.0;
}

void main() {
  vec2 t = gl_FragCoord.xy / texture_size;
  vec3 world = (model * vec4(place_of(2.0 * t - 1.0), 0, 1)).xyz;
  float seen = texture(ground_sky, t).r;
  float facing = max(to_light.z, 0.0);
  vec3 up = vec3(0, 0, 1);
  vec3 open = key_light() * facing + room * kSkyLight;
  vec3 light = key_light() * facing * soft_key(world) + room_light(up, seen, 0.0);
  color = vec4(light / open, 1);
}
