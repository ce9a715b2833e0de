// Errors of motions: positions at sampled times are compared with a run on the same mesh with very small
// steps.
#include <cmath>
#include <exception>
#include <map>
#include <memory>
#include <tuple>

#include "experiments/accuracy/accuracy.h"
#include "sim/base/error.h"

namespace hysteron::experiments {
namespace {

using Trajectory = std::vector<std::vector<Eigen::Vector3d>>;  // positions at each sampled time [m]

// Runs the scene and keeps the positions every `sampling` [s], a multiple of the scene's step.
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

// Returns the root mean square distance over vertices and times, over `length` [m].
double distance(const Trajectory& a, const Trajectory& b, double length) {
  double sum = 0, count = 0;
  for (std::size_t k = 0; k < a.size(); ++k)
    for (std::size_t i = 0; i < a[k].size(); ++i) {
      sum += (a[k][i] - b[k][i]).squaredNorm();
      ++count;
    }
  return std::sqrt(sum / count) / length;
}

struct Reference {
  Trajectory trajectory;
  double uncertainty = 0;
  std::exception_ptr failure{};
};

Trajectory reference_run(const MotionQuestion& question, const MethodSetting& setting, double step) {
  MethodSetting tiny = setting;
  tiny.integrator = Integrator::bdf2;
  tiny.implicit_every = ImplicitEvery::substep;
  tiny.force = ForceConvention::energy;  // the printed force has no potential
  tiny.step = step;
  tiny.tolerance = 0;
  tiny.precision = Precision::fp64;
  Found ignored;
  const Scene scene = question.scene(tiny);
  return simulated(scene, make_cloth(scene), question.sampling, ignored);
}

// The reference runs, one for each mesh, size and law.
class References {
 public:
  explicit References(const MotionQuestion& question) : question_(question) {}

  // Returns the reference, computed at the first request; what its runs throw is thrown then and at every
  // later request.
  const Reference& of(const MethodSetting& setting) {
    const auto [at, is_new] = known_.try_emplace(setting_key(setting));
    Reference& found = at->second;
    if (is_new) try {
        found.trajectory = reference_run(question_, setting, question_.reference_step);
        // The uncertainty is a third of the change by the last halving of the steps, as at second order.
        const Trajectory coarse = reference_run(question_, setting, 2 * question_.reference_step);
        found.uncertainty = distance(found.trajectory, coarse, question_.length) / 3;
      } catch (const Error&) {
        found.failure = std::current_exception();
      }
    if (found.failure) std::rethrow_exception(found.failure);
    return found;
  }

 private:
  using Key = std::tuple<std::string, std::string, int, std::string>;
  static Key setting_key(const MethodSetting& setting) {
    return {enum_name(setting.mesh), enum_name(setting.element), setting.triangles, setting.law};
  }

  MotionQuestion question_;
  std::map<Key, Reference> known_;
};

}  // namespace

void ask_for_motion(const MotionQuestion& question, Problem& problem) {
  problem.reference_per_mesh = true;
  const auto references = std::make_shared<References>(question);
  problem.solve = [question, references](const MethodSetting& setting) {
    const Reference& exact = references->of(setting);
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
