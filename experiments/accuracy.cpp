// Error against run time of the integrators, on a crease: a strip is folded by a clamp, let go, and opens as
// far as the friction of its fabric lets it.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>

#include "experiments/csv.h"
#include "experiments/experiments.h"
#include "experiments/report.h"
#include "experiments/run.h"
#include "render/plot.h"
#include "sim/error.h"
#include "sim/scene/cloth.h"
#include "sim/solve/simulation.h"

namespace hysteron::experiments {
namespace {

constexpr double kLength = 0.06, kWidth = 0.02, kClamp = 0.01;          // of the strip [m]
constexpr double kFold = 150;                                           // [degree]
constexpr double kFolded = 0.3, kReleased = 0.4, kSampling = 1.0 / 30;  // [s]
constexpr double kFrame = 1.0 / 60;                                     // [s]

struct AccuracyChoice {
  double reference_parts = 64;  // parts of 1/60 s in the reference's steps
  bool sizes = false;
};
using A = AccuracyChoice;
// clang-format off
const KeyRow<A> kRows[] = {
    {"reference-parts", at<&A::reference_parts>, "", between(2, 4096), "", "the reference is bdf2 with steps of 1/60 s divided by this"},
    {"sizes", at<&A::sizes>, "", any(), "", "over mesh size as well: where implicit steps become cheaper at equal error"},
};
// clang-format on

// An integrator with its steps.
struct Method {
  std::string label, integrator, implicit_every;
  double step, tolerance = 0;
};

struct Outcome {
  Method method;
  int triangles = 0;
  double position_error = 0;  // root mean square over vertices and times, over the strip's length
  double angle_error = 0;     // of the opening angle at the end [degree]
  double angle = 0;           // [degree]
  long steps = 0;             // substeps or parts, each with its own forces
  double seconds = 0;         // of computing
  std::string failed;
};

Setup defaults() {
  Setup setup;
  Scene& scene = setup.scene = default_scene();
  scene.cloth.shape = "strip";
  scene.cloth.length = kLength;
  scene.cloth.width = kWidth;
  scene.mesh = "random";
  scene.triangles = 600;
  scene.seconds = 0.8;
  scene.air_drag = 0.3;
  scene.device = "cpu";
  return setup;
}

void add_clamps(Scene& scene) {
  Pin fixed, folding;
  fixed.low = {-1, -1, -1};
  fixed.high = {kClamp, 1, 1};
  folding.low = {kLength - kClamp, -1, -1};
  folding.high = {1, 1, 1};
  folding.until = kReleased;
  folding.motion.axis = {0, 1, 0};
  folding.motion.center = {kLength / 2, 0, 0};
  folding.motion.keys = {{0, {0, 0, 0}, 0}, {kFolded, {0, 0, 0}, -kFold}, {kReleased, {0, 0, 0}, -kFold}};
  scene.pin = {fixed, folding};
}

// Angle between the two ends of the strip seen from the side: 180 degrees when flat.
double opening_angle(const Cloth& cloth, const std::vector<Eigen::Vector3d>& x) {
  const auto direction = [&](double from, double to) {
    Eigen::Vector3d near = Eigen::Vector3d::Zero(), far = near;
    int near_count = 0, far_count = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      const double s = cloth.mesh.rest[i].x();
      if (std::abs(s - from) < kClamp / 4) near += x[i], ++near_count;
      if (std::abs(s - to) < kClamp / 4) far += x[i], ++far_count;
    }
    return Eigen::Vector3d((far / far_count - near / near_count).normalized());
  };
  const double cosine = direction(kClamp, 0).dot(direction(kLength - kClamp, kLength));
  return std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / 3.14159265358979323846;
}

using Trajectory = std::vector<std::vector<Eigen::Vector3d>>;  // positions at each sampled time

Trajectory simulated(const Scene& scene, const Cloth& cloth, Outcome& outcome) {
  Trajectory trajectory;
  const auto simulation = make_simulation(scene, cloth);
  const int stride = static_cast<int>(std::lround(kSampling / scene.step));
  const long samples = std::lround(scene.seconds / kSampling);
  const auto start = std::chrono::steady_clock::now();
  for (long k = 0; k < samples; ++k) {
    simulation->advance(stride);
    trajectory.push_back(simulation->positions());
  }
  outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const long parts = simulation->parts_taken();
  outcome.steps = parts > 0 ? parts : simulation->steps() * simulation->limits().substeps;
  outcome.angle = opening_angle(cloth, trajectory.back());
  return trajectory;
}

Scene with(const Method& method, Scene scene) {
  scene.integrator = method.integrator;
  scene.implicit_every = method.implicit_every;
  scene.step = method.step;
  scene.tolerance = method.tolerance;
  scene.substeps = 0;
  return scene;
}

double distance(const Trajectory& a, const Trajectory& b) {
  double sum = 0, count = 0;
  for (std::size_t k = 0; k < a.size(); ++k)
    for (std::size_t i = 0; i < a[k].size(); ++i) {
      sum += (a[k][i] - b[k][i]).squaredNorm();
      ++count;
    }
  return std::sqrt(sum / count) / kLength;
}

std::vector<Method> methods(bool quick) {
  std::vector<Method> list;
  const int most = quick ? 2 : 16;
  for (int parts = 1; parts <= most; parts *= quick ? 2 : 4)
    list.push_back({"chapter", "semi-implicit", "step", kFrame / parts});
  for (int parts = 1; parts <= most; parts *= quick ? 2 : 4)
    list.push_back({"semi-implicit", "semi-implicit", "substep", kFrame / (parts * 64)});
  for (const char* name : {"implicit", "bdf2"})
    for (int parts = 1; parts <= most; parts *= 2) list.push_back({name, name, "substep", kFrame / parts});
  if (!quick)
    for (double tolerance : {1e-4, 1e-5, 1e-6})
      list.push_back({"bdf2, tolerance", "bdf2", "substep", kFrame, tolerance});
  return list;
}

std::vector<Outcome> compare(const Scene& scene, const AccuracyChoice& choice, bool quick, Run& run) {
  const Cloth cloth = make_cloth(scene);
  Outcome reference;
  const Method tiny{"reference", "bdf2", "substep", kFrame / choice.reference_parts};
  const Trajectory exact = simulated(with(tiny, scene), cloth, reference);
  std::vector<Outcome> results;
  for (const Method& method : methods(quick)) {
    Outcome outcome;
    outcome.method = method;
    outcome.triangles = cloth.mesh.faces();
    try {
      outcome.position_error = distance(simulated(with(method, scene), cloth, outcome), exact);
      outcome.angle_error = outcome.angle - reference.angle;
    } catch (const Error& error) {
      if (error.exit_code() == 1) throw;
      outcome.failed = error.what();
      outcome.position_error = outcome.angle_error = std::numeric_limits<double>::quiet_NaN();
    }
    char line[160];
    std::snprintf(line, sizeof line, "%6d %-16s %10.3g s %8ld steps %9.3f s  error %9.2e  angle %7.2f",
                  outcome.triangles, method.label.c_str(), method.step, outcome.steps, outcome.seconds,
                  outcome.position_error, outcome.angle);
    run.progress(line);
    results.push_back(outcome);
  }
  return results;
}

void write_table(Run& run, const std::vector<Outcome>& outcomes) {
  std::ofstream csv(run.path("table.csv"));
  csv << "method,triangles,step [s],tolerance [m],steps,computing [s],position error,angle [degree],angle "
         "error "
         "[degree],failed\n";
  for (const Outcome& o : outcomes)
    csv << '"' << o.method.label << "\"," << o.triangles << ',' << o.method.step << ',' << o.method.tolerance
        << ',' << o.steps << ',' << o.seconds << ',' << o.position_error << ',' << o.angle << ','
        << o.angle_error << ",\"" << o.failed << "\"\n";
}

void print(const std::vector<Outcome>& outcomes) {
  std::printf("%-16s %9s %9s %9s %9s %11s %10s %10s\n", "method", "triangles", "step [s]", "tol. [m]",
              "steps", "error [%L]", "angle [deg]", "time [s]");
  for (const Outcome& o : outcomes)
    std::printf("%-16s %9d %9.2g %9.1g %9ld %11.4f %10.2f %10.3f%s\n", o.method.label.c_str(), o.triangles,
                o.method.step, o.method.tolerance, o.steps, 100 * o.position_error, o.angle, o.seconds,
                o.failed.empty() ? "" : ("  " + o.failed).c_str());
}

void draw(Run& run, const std::vector<Outcome>& outcomes) {
  render::Plot plot{
      "Crease: error against computing time", {"computing [s]", true}, {"position error over length", true}};
  for (const Outcome& o : outcomes) {
    const std::string label = o.method.label + ", " + std::to_string(o.triangles);
    if (plot.series.empty() || plot.series.back().label != label) {
      plot.series.push_back({label, {}, {}, render::Series::Style::line_and_points});
    }
    if (!o.failed.empty()) continue;
    plot.series.back().x.push_back(o.seconds);
    plot.series.back().y.push_back(o.position_error);
  }
  std::erase_if(plot.series, [](const render::Series& s) { return s.x.empty(); });
  run.plot("plot_error_against_time", [&](const auto& base) { render::write_plot(base, plot); });
}

}  // namespace

std::vector<KeyDescription> accuracy_keys() {
  A choice;
  return descriptions(bind(kRows, choice));
}

int accuracy(const CommandLine& line) {
  A choice;
  Setup setup = set_up(line, defaults(), bind(kRows, choice));
  if (setup.options.quick) {
    setup.scene.triangles = std::min(setup.scene.triangles, 150);
    choice.reference_parts = std::min(choice.reference_parts, 16.0);
  }
  add_clamps(setup.scene);
  Run run(line, setup);
  std::vector<int> sizes = {setup.scene.triangles};
  if (choice.sizes) sizes = {setup.scene.triangles / 4, setup.scene.triangles, 4 * setup.scene.triangles};
  std::vector<Outcome> outcomes;
  for (int triangles : sizes) {
    setup.scene.triangles = triangles;
    for (const Outcome& o : compare(setup.scene, choice, setup.options.quick, run)) outcomes.push_back(o);
  }
  write_table(run, outcomes);
  if (!setup.options.no_images) draw(run, outcomes);
  run.path("report.html");
  run.finish();
  write_report(run.folder());
  if (!setup.options.json) print(outcomes);
  return 0;
}

}  // namespace hysteron::experiments
