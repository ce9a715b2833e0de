// Plain weave from warp and weft coordinates, for the eye only.  Each octave of detail fades out before a pixel
// covers more than a thread of it, so that nothing shimmers, and changes no mean, so that cloth is as bright from afar.
uniform float thread_spacing;  // [m]; 0 = no threads
uniform float weave_strength;

struct Weave {
  float shade;   // factor of the albedo
  vec2 tilt;     // of the normal along warp and weft; its mean is zero
};

// Integer mixing with the constants of MurmurHash3's finaliser (Appleby, public domain): the same on every driver.
float noise_at(ivec2 cell) {
  uint h = uint(cell.x) * 0x9e3779b9u + uint(cell.y) * 0x7f4a7c15u;
  h ^= h >> 16;
  h *= 0x85ebca6bu;
  h ^= h >> 13;
  h *= 0xc2b2ae35u;
  h ^= h >> 16;
  return float(h >> 8) / 8388607.5 - 1.0;
}

// Unevenness of threads that run along x: quick across, slow along.
float streaks(vec2 p, int salt) {
  vec2 cell = floor(p), f = p - cell;
  f = f * f * (3.0 - 2.0 * f);
  ivec2 c = ivec2(cell) + ivec2(salt * 7919, 0);
  return mix(mix(noise_at(c), noise_at(c + ivec2(1, 0)), f.x), mix(noise_at(c + ivec2(0, 1)), noise_at(c + ivec2(1, 1)), f.x),
             f.y);
}

const float kMeanCrown = 0.5556;  // (2 / pi) (0.65 + 0.35 * 2 / pi)

// A thread's profile repeats with every thread: gone when a pixel covers half of it.
float resolved(float footprint) { return 1.0 - smoothstep(0.2, 0.5, footprint); }
float visible(float footprint) { return 1.0 - smoothstep(0.3, 0.75, footprint); }

Weave weave_at(vec2 coordinates) {
  Weave result = Weave(1.0, vec2(0));
  vec2 p = coordinates / max(thread_spacing, 1e-6);
  vec2 across = fwidth(p);
  if (thread_spacing <= 0.0) return result;

  // Threads, alternately over and under.
  float near = resolved(max(across.x, across.y)) * weave_strength;
  vec2 cell = floor(p), f = p - cell - 0.5;
  bool warp_on_top = mod(cell.x + cell.y, 2.0) < 0.5;
  vec2 g = warp_on_top ? f : f.yx;                      // x along the upper thread, y across it
  vec2 slope = vec2(-1.1 * sin(3.14159265 * g.x), -2.2 * g.y);
  result.tilt = near * 0.45 * (warp_on_top ? slope : slope.yx) * vec2(-1);
  float crown = cos(3.14159265 * g.y) * (0.65 + 0.35 * cos(3.14159265 * g.x));
  result.shade += near * 0.45 * (crown - kMeanCrown);

  // Uneven yarn: single threads, then bundles of three and nine.  The finest are skipped, not faded to nothing, where
  // a pixel covers more of them: noise is what a software renderer spends most on here.
  float thinnest = min(across.x, across.y);
  int first = thinnest < 0.75 ? 0 : thinnest < 2.25 ? 1 : thinnest < 6.75 ? 2 : 3;
  float scale = pow(3.0, float(first)), strength = 0.065 * pow(0.5, float(first)) * weave_strength;
  for (int octave = first; octave < 3; ++octave) {
    vec2 q = p / scale, w = across / scale;
    float warp = visible(w.y) * streaks(vec2(q.x / 24.0, q.y), octave);
    float weft = visible(w.x) * streaks(vec2(q.y / 24.0, q.x), octave + 3);
    result.shade *= 1.0 + strength * (warp + weft);
    scale *= 3.0;
    strength *= 0.5;
  }
  return result;
}
