// A strip clamped level at one end sags under its own weight, which grows slowly: how far, beside the
// elastica with the same law; and the bending length of ASTM D1388, half the overhang whose end hangs 41.5
// degrees below the clamp.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "experiments/elastica.h"
#include "experiments/session.h"
#include "sim/error.h"
#include "sim/scene/cloth.h"

namespace hysteron::experiments {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180;
constexpr double kSlope = 41.5 * kDegree;  // of the chord, ASTM D1388 and ISO 9073-7

struct CantileverChoice {
  double gamma = 0;
};
using C = CantileverChoice;
// clang-format off
const KeyRow<C> kRows[] = {
    {"gamma", at<&C::gamma>, "", at_least(0), "", "weight over stiffness, density g L^3/b2: sets the density, and law = linear unless named; 0: the fabric's own"},
};
// clang-format on

Setup defaults() {
  Setup setup;
  Scene& scene = setup.scene = default_scene();
  scene.integrator = "quasi-static";
  scene.cloth.shape = "strip";
  scene.cloth.length = 0.1;
  scene.cloth.width = 0.025;  // as cut for ASTM D1388
  scene.mesh = "unionjack";
  scene.triangles = 2048;  // 64 cells along
  scene.seconds = scene.ramp = 1;
  scene.step = 0.05;
  scene.device = "cpu";
  setup.options.fps = 20;
  setup.options.camera_direction = {0.35, -1.0, 0.3};
  setup.options.camera_fov = 24;
  return setup;
}

bool names_law(const CommandLine& line) {
  return std::any_of(line.flags.begin(), line.flags.end(), [](const Flag& f) { return f.path == "law"; });
}

double weight_of(const Scene& scene) { return scene.fabric.density * scene.gravity.norm(); }

HeavyStrip elastica_of(const Scene& scene) {
  HeavyStrip strip;
  strip.law = {scene.law, scene.fabric.virgin_curve(), scene.param};
  strip.weight = weight_of(scene);
  strip.length = scene.cloth.length;
  return strip;
}

// Middle of the free end against the clamp's edge: forward, down [m].
Eigen::Vector2d free_end(const Cloth& cloth, const Scene& scene, double overhang,
                         const std::vector<Eigen::Vector3d>& x) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  int count = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (cloth.mesh.rest[i].x() > scene.cloth.length * (1 - 1e-9)) sum += x[i] - cloth.start[i], ++count;
  return {overhang + sum.x() / count, -sum.z() / count};
}

// Lengthens the strip by half of the one column of cells that is clamped and gives the clamp its direction:
// the curvature at its inner edge stands for half a cell on either side, so that the strip bends from its
// middle on.
void add_clamp(Scene& scene, double overhang) {
  constexpr int kTries = 8;
  scene.cloth.length = overhang;
  for (int i = 0; i < kTries; ++i) {
    double column = scene.cloth.length;
    for (const auto& x : make_cloth(scene).mesh.rest)
      if (x.x() > 1e-9 * overhang) column = std::min(column, x.x());
    Pin clamp;
    clamp.low = {-1, -1, -1};
    clamp.high = {column * (1 + 1e-6), 1, 1};
    scene.pin = {clamp};
    const double miss = (scene.cloth.length - column / 2) / overhang - 1;
    if (std::abs(miss) < 1e-9) return;
    scene.cloth.length = overhang * scene.cloth.length / (scene.cloth.length - column / 2);
  }
  throw Error::request("cantilever: mesh = " + scene.mesh +
                       " has no columns of cells to clamp; take aligned, flipped or unionjack");
}

// Slope of the chord of a strip with this overhang under its whole weight.
double slope_of_elastica(Scene scene, double overhang) {
  scene.cloth.length = overhang;
  HeavyStrip strip = elastica_of(scene);
  strip.segments = 150;
  return sagging_strips(strip, {1}, 20).back().chord_angle();
}

double slope_of_cloth(Scene scene, double overhang) {
  add_clamp(scene, overhang);
  const Cloth cloth = make_cloth(scene);
  const auto simulation = make_simulation(scene, cloth);
  simulation->advance(static_cast<int>(std::lround(scene.seconds / scene.step)));
  const Eigen::Vector2d end = free_end(cloth, scene, overhang, simulation->positions());
  return std::atan2(end.y(), end.x());
}

// Overhang at which `slope` reaches 41.5 degrees, by the secant method from `first`; slopes grow with it.
template <class Slope>
double critical_overhang(double first, double precision, const Slope& slope) {
  double a = first, fa = slope(a) - kSlope, b = a * (1 - fa / 2), fb = slope(b) - kSlope;
  for (int i = 0; i < 20 && std::abs(b - a) > precision * b; ++i) {
    const double next = std::clamp(b - fb * (b - a) / (fb - fa), b / 2, 2 * b);
    a = b, fa = fb;
    b = next, fb = slope(b) - kSlope;
  }
  return b;
}

void plot(Session& session) {
  const auto csv = session.run().path("metrics.csv");
  render::Plot drop{"Drop of the free end, " + session.scene().fabric.name + ", law " + session.scene().law,
                    {"share of the weight"},
                    {"drop over length"}};
  drop.series = {render::series_from_csv(csv, "load", "elastica", "elastica"),
                 render::series_from_csv(csv, "load", "drop", "cloth")};
  drop.series[1].style = render::Series::Style::points;
  session.plot("plot_drop", drop);
}

}  // namespace

std::vector<KeyDescription> cantilever_keys() {
  C choice;
  return descriptions(bind(kRows, choice));
}

int cantilever(const CommandLine& line) {
  C choice;
  Setup setup = set_up(line, defaults(), bind(kRows, choice));
  Scene& scene = setup.scene;
  if (setup.options.quick) scene.triangles = std::min(scene.triangles, 512);
  if (choice.gamma > 0) {
    if (!names_law(line)) scene.law = "linear";
    scene.fabric.density =
        choice.gamma * scene.fabric.b2 / (scene.gravity.norm() * std::pow(scene.cloth.length, 3));
  }
  const double length = scene.cloth.length;  // that hangs over
  const HeavyStrip strip = elastica_of(scene);
  add_clamp(scene, length);
  Session session(line, setup);
  if (session.only_explain()) return 0;

  const auto load_at = [&](double time) { return std::min(1.0, time / scene.ramp); };
  std::vector<double> loads;
  for (int k = 1; k <= std::lround(scene.seconds * setup.options.fps); ++k)
    loads.push_back(load_at(k / setup.options.fps));
  const std::vector<SaggingStrip> reference = sagging_strips(strip, loads);
  const auto elastica_drop = [&](double load) {
    for (const SaggingStrip& s : reference)
      if (std::abs(s.load - load) < 1e-6) return s.drop() / length;
    return 0.0;
  };
  double drop = 0;
  Question question;
  const float l = static_cast<float>(length), width = static_cast<float>(scene.cloth.width);
  question.bounds = {{0, 0, -l}, {1.05f * l, width, 0.1f * l}};
  question.columns = {"load [1]", "drop [1]", "elastica [1]"};
  question.measure = [&](const Moment& m) -> std::vector<double> {
    const double load = load_at(m.time);
    drop = free_end(session.cloth(), scene, length, m.x).y() / length;
    return {load, drop, elastica_drop(load)};
  };
  question.progress = [&](const Moment& m) {
    char text[100];
    std::snprintf(text, sizeof text, "load %.2f  drop %.4f of the length, elastica %.4f", load_at(m.time),
                  drop, elastica_drop(load_at(m.time)));
    return std::string(text);
  };
  session.simulate(question);

  Run& run = session.run();
  run.metric("tip_drop_over_length", drop);
  run.metric("elastica_drop_over_length", elastica_drop(1));
  run.metric("error_percent", 100 * (drop / elastica_drop(1) - 1));
  const double expected = critical_overhang(2 * std::cbrt(scene.fabric.b2 / weight_of(scene)), 1e-6,
                                            [&](double o) { return slope_of_elastica(scene, o); });
  const double found = critical_overhang(expected, 1e-4, [&](double o) { return slope_of_cloth(scene, o); });
  run.metric("bending_length_m", found / 2);
  run.metric("elastica_bending_length_m", expected / 2);
  if (session.pictures()) plot(session);
  session.finish("Cantilever: " + scene.fabric.name + ", law " + scene.law);
  return 0;
}

}  // namespace hysteron::experiments
