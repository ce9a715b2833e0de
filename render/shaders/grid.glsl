// A grid printed on cloth: lines of 0.7 mm, each pixel's share of them.
uniform float grid;  // between lines [m]; 0 = none

float printed(vec2 coordinates) {
  vec2 across = max(fwidth(coordinates), 1e-9);
  if (grid <= 0.0 || max(across.x, across.y) <= 1e-9) return 0.0;
  vec2 off = abs(coordinates - grid * round(coordinates / grid));
  vec2 covered = clamp((0.35e-3 - off) / across + 0.5, 0.0, 1.0) * min(0.7e-3 / across, 1.0);
  return max(covered.x, covered.y);
}
