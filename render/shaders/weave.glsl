// Weaves from warp and weft coordinates, for the eye only.  Each octave of detail fades out before a pixel
// covers more than a thread of it, so that nothing shimmers, and changes no mean, so that cloth is as bright from afar.
uniform vec2 thread_spacing;  // along the warp, of weft threads, and across it, of warp threads [m]; 0 = no threads
uniform int weave_kind;       // 0 plain, 1 twill, 2 satin, 3 knit
uniform float shown;          // size at which the picture is shown over the size that it is drawn at
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

const float kUneven = 0.05;       // of single threads
const float kMeanLoop = 0.6291;   // over a loop, below
const float kMeanCrown = 0.5556;  // (2 / pi) (0.65 + 0.35 * 2 / pi)

// A thread's profile repeats with every thread: gone when a pixel covers half of it.
float resolved(float footprint) { return 1.0 - smoothstep(0.2, 0.5, footprint); }
float visible(float footprint) { return 1.0 - smoothstep(0.3, 0.75, footprint); }

// Threads before the weave repeats, and whether the warp lies on top there.
int repeat_of_weave() { return weave_kind == 1 ? 4 : weave_kind == 2 ? 5 : 2; }
bool is_warp_on_top(vec2 cell) {
  float n = float(repeat_of_weave()), step = weave_kind == 2 ? 2.0 : 1.0;
  return mod(cell.x + step * cell.y, n) < (weave_kind == 0 ? 0.5 : n - 1.5);
}

// Threads over and under each other.
void add_threads(vec2 p, vec2 across, inout Weave weave) {
  float near = resolved(max(across.x, across.y)) * weave_strength;
  vec2 cell = floor(p), f = p - cell - 0.5;
  bool warp = is_warp_on_top(cell);
  vec2 g = warp ? f : f.yx;                             // x along the upper thread, y across it
  vec2 slope = vec2(-1.1 * sin(3.14159265 * g.x), -2.2 * g.y);
  weave.tilt = near * 0.45 * (warp ? slope : slope.yx) * vec2(-1);
  float crown = cos(3.14159265 * g.y) * (0.65 + 0.35 * cos(3.14159265 * g.x));
  weave.shade += near * 0.45 * (crown - kMeanCrown);
  // The threads that seldom show are seen further away than single threads, as lines.
  float n = float(repeat_of_weave()), lines = weave_kind == 0 ? 0.0 : resolved(max(across.x, across.y) / (0.5 * n));
  weave.shade += 0.3 * lines * weave_strength * (warp ? 1.0 / n : 1.0 / n - 1.0);
}

// Loops: two legs of each lean together, wale beside wale.
void add_loops(vec2 p, vec2 across, inout Weave weave) {
  float near = resolved(max(across.x, across.y)) * weave_strength;
  vec2 f = p - floor(p) - 0.5;
  float off = clamp((abs(f.y) - 0.25 - 0.12 * f.x) / 0.25, -1.0, 1.0);
  weave.tilt = near * vec2(0, 0.9 * off * sign(f.y));
  weave.shade += near * 0.5 * (cos(1.5707963 * off) - kMeanLoop);
}

Weave weave_at(vec2 coordinates, bool needed) {
  Weave result = Weave(1.0, vec2(0));
  vec2 p = coordinates / max(thread_spacing, vec2(1e-6));
  vec2 across = fwidth(p) / shown;
  if (thread_spacing.x <= 0.0) return result;
  if (weave_kind == 3)
    add_loops(p, across, result);
  else
    add_threads(p, across, result);

  // Uneven yarn: single threads, then bundles of three and nine.  The finest are skipped, not faded to nothing, where
  // a pixel covers more of them: noise is what a software renderer spends most on here.
  float thinnest = min(across.x, across.y);
  int first = !needed ? 3 : thinnest < 0.75 ? 0 : thinnest < 2.25 ? 1 : thinnest < 6.75 ? 2 : 3;
  float scale = pow(3.0, float(first)), strength = kUneven * pow(0.5, float(first)) * weave_strength;
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
