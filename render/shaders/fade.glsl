// Pictures end in the white page: what lies behind the cloth fades along their sides.
uniform vec2 picture_size;
uniform vec2 origin;  // of the part that is drawn, in the picture

const float kFade = 0.14;  // of the picture's sides

float fade() {
  vec2 p = (gl_FragCoord.xy + origin) / picture_size, pixel = 1.0 / picture_size;
  vec2 inside = smoothstep(pixel, pixel + kFade, min(p, 1.0 - p));
  return inside.x * inside.y;
}

const float kShadowDepth = 0.62;  // of shadows over those of a white table: cloth must stay darker than its shadow
