// The ground's textures are finer in their middle, where things stand: texture coordinate t from -1 to 1 to place on the
// patch from -1 to 1, one axis at a time, and back.
const float kMiddle = 0.35;  // slope in the middle

vec2 place_of(vec2 t) { return t * (kMiddle + (1.0 - kMiddle) * abs(t)); }

vec2 texture_of(vec2 place) {
  vec2 root = sqrt(kMiddle * kMiddle + 4.0 * (1.0 - kMiddle) * abs(place));
  return sign(place) * (root - kMiddle) / (2.0 * (1.0 - kMiddle));
}
