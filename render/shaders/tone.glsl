// Keeps colours as they are up to 0.8 and bends what is brighter below white, where it also loses its colour: Khronos
// PBR Neutral (Khronos Group 2024), without its toe, which takes off the 4 % that smooth bodies reflect.
vec3 toned(vec3 light) {
  const float kStart = 0.8;
  const float kDesaturation = 0.15;
  float peak = max(light.r, max(light.g, light.b));
  if (peak < kStart) return light;
  float room = 1.0 - kStart, bent = 1.0 - room * room / (peak + room - kStart);
  return mix(vec3(bent), light * (bent / peak), 1.0 / (kDesaturation * (peak - bent) + 1.0));
}
