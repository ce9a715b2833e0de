// The light of one pass of a figure: few directions of the key light, the sky and the floor, each with a depth map.
const int kKeys = 4;
const int kSkies = 6;
const int kLights = 12;  // then the floor
uniform sampler2DShadow key_map, room_map;
uniform mat4 light_matrix[kLights];
uniform vec3 light_direction[kLights];
uniform vec3 light_weight[kLights];  // light on a surface that faces the direction
uniform float light_texel[kLights];  // size of a map's texel [m]

const vec2 kKeyTiles = vec2(2, 2);
const vec2 kRoomTiles = vec2(4, 2);
uniform float exposure;  // makes open ground under the studio's light as bright as its colour

// Of a tile, the share that a point is looked up in: tiles do not run into each other, their borders are empty.
vec3 in_tile(vec3 p, int tile, vec2 tiles) {
  vec2 inside = clamp(p.xy, 0.004, 0.996);
  return vec3((vec2(tile % int(tiles.x), tile / int(tiles.x)) + inside) / tiles, min(p.z, 1.0));
}

// Share of a direction's light that reaches a point beside a surface: lifted by what the surface itself rises within a
// lookup.  `normal` is on the side that faces the direction.
float open_to(int k, vec3 point, vec3 normal, float facing) {
  float rise = light_texel[k] * (0.4 + 1.5 * sqrt(max(1.0 - facing * facing, 0.0)));
  vec3 p = (light_matrix[k] * vec4(point + rise * normal, 1)).xyz * 0.5 + 0.5;
  return k < kKeys ? texture(key_map, in_tile(p, k, kKeyTiles))
                   : texture(room_map, in_tile(p, k - kKeys, kRoomTiles));
}
