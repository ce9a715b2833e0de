#include "experiments/accuracy/motion.h"

#include <cmath>
#include <map>
#include <memory>
#include <tuple>

#include "sim/time/together.h"

namespace hysteron::experiments {

Trajectory simulated(const Scene& scene, const Cloth& cloth, double sampling, Found& found) {
  Trajectory trajectory;
  const auto simulation = make_simulation(scene, cloth);
  const int stride = static_cast<int>(std::lround(sampling / scene.step));
  const long samples = std::lround(scene.seconds / sampling);
  const auto start = std::chrono::steady_clock::now();
  for (long k = 0; k < samples; ++k) {
    simulation->advance(stride);
    trajectory.push_back(simulation->positions());
  }
  note_cost(*simulation, scene, start, found);
  found.triangles = cloth.mesh.faces();
  return trajectory;
}

double distance(const Trajectory& a, const Trajectory& b, double length) {
  double sum = 0, count = 0;
  for (std::size_t k = 0; k < a.size(); ++k)
    for (std::size_t i = 0; i < a[k].size(); ++i) {
      sum += (a[k][i] - b[k][i]).squaredNorm();
      ++count;
    }
  return std::sqrt(sum / count) / length;
}

namespace {

struct Reference {
  Trajectory trajectory;
  double uncertainty = 0;
};

Trajectory reference_run(const MotionQuestion& question, const Setting& setting, double step) {
  Setting tiny = setting;
  tiny.integrator = question.reference.integrator;
  tiny.implicit_every = ImplicitEvery::substep;
  tiny.step = step;
  tiny.tolerance = 0;
  tiny.precision = Precision::fp64;
  Found ignored;
  const Scene scene = question.scene(tiny);
  return simulated(scene, make_cloth(scene), question.sampling, ignored);
}

// Its own error is a third of what the last halving of its steps has changed, at second order.  The times of
// both runs are no result, so that they may share a GPU.
Reference reference_of(const MotionQuestion& question, const Setting& setting) {
  const double step = question.reference.step;
  Trajectory run[2];
  run_together(setting.device == DeviceChoice::cuda, 2, 1,
               [&](int i) { run[i] = reference_run(question, setting, (1 + i) * step); });
  return {run[0], distance(run[0], run[1], question.length) / 3};
}

}  // namespace

std::function<Found(const Setting&)> solve_motion(const MotionQuestion& question) {
  using Mesh = std::tuple<std::string, std::string, int, std::string>;
  const auto references = std::make_shared<std::map<Mesh, Reference>>();
  return [question, references](const Setting& setting) {
    const auto [at, is_new] =
        references->try_emplace({setting.mesh, name_of(setting.element), setting.triangles, setting.law});
    if (is_new) at->second = reference_of(question, setting);
    const Reference& exact = at->second;
    Found found;
    const Scene scene = question.scene(setting);
    const Cloth cloth = make_cloth(scene);
    const Trajectory trajectory = simulated(scene, cloth, question.sampling, found);
    found.error = distance(trajectory, exact.trajectory, question.length);
    found.uncertainty = exact.uncertainty;
    found.value = question.value(cloth, trajectory.back());
    found.reference = question.value(cloth, exact.trajectory.back());
    return found;
  };
}

}  // namespace hysteron::experiments
