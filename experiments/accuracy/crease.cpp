// Problem crease: a strip is folded by a clamp, let go, and opens as far as the friction of its fabric lets
// it.
#include <algorithm>
#include <cmath>

#include "experiments/accuracy/accuracy.h"
#include "experiments/specimens/clamped_mesh.h"
#include "sim/scene/scene_reader.h"

namespace hysteron::experiments {
namespace {

constexpr double kLength = 0.06, kWidth = 0.02, kClamp = 0.01;  // strip and its clamp [m]
constexpr double kFold = 150;                                   // angle by which the clamp folds [degree]
constexpr double kFolded = 0.3, kReleased = 0.4,
                 kSampling = 1.0 / 30;  // end of the fold, release, sampling interval [s]
constexpr double kFrame = 1.0 / 60;     // [s]

Scene crease(const MethodSetting& setting) {
  Scene scene = with(setting, {});
  scene.cloth.shape = ClothOutline::strip;
  scene.cloth.length = kLength;
  scene.cloth.width = kWidth;
  scene.seconds = 0.8;
  scene.air_drag = 0.3;
  Pin folding = held_between(kLength - kClamp, 1);
  folding.until = kReleased;
  folding.motion.axis = {0, 1, 0};
  folding.motion.center = {kLength / 2, 0, 0};
  folding.motion.keys = {{0, {0, 0, 0}, 0}, {kFolded, {0, 0, 0}, -kFold}, {kReleased, {0, 0, 0}, -kFold}};
  scene.pin = {held_between(-1, kClamp), folding};
  return scene;
}

// Returns the angle between the two ends of the strip seen from the side [degree]: 180 when flat.
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

// Adds the chapter's method as printed at 1/60 s, and with the moment's energy-consistent force at 1/60 s and
// at 1/`parts` of it, where the printed force takes too many substeps.  Their references have the method's
// law and element.
void add_chapter_method(const MethodSetting& base, int parts, std::vector<MethodSetting>& list) {
  Scene method;
  apply_scene_file(method, "chapter-method");
  const auto add = [&](ForceConvention force, double step) {
    list.push_back(varied(base, "method", [&](MethodSetting& s) {
      s.law = method.law;
      s.element = method.element;
      s.force = force;
      s.integrator = method.integrator;
      s.implicit_every = method.implicit_every;
      s.step = step;
    }));
  };
  add(method.force, kFrame);
  add(ForceConvention::energy, kFrame);
  add(ForceConvention::energy, kFrame / parts);
}

void vary_steps(const MethodSetting& base, bool quick, std::vector<MethodSetting>& list) {
  const int most = quick ? 2 : 16;
  const auto add = [&](Integrator integrator, ImplicitEvery implicit_every, double step, double tolerance) {
    list.push_back(varied(base, tolerance > 0 ? "tolerance" : "step", [&](MethodSetting& s) {
      s.integrator = integrator, s.implicit_every = implicit_every, s.step = step, s.tolerance = tolerance;
    }));
  };
  using enum Integrator;
  for (Integrator which : {bdf2, implicit})
    for (int parts = 1; parts <= most; parts *= 2) add(which, ImplicitEvery::substep, kFrame / parts, 0);
  for (int parts = 1; parts <= most; parts *= quick ? 2 : 4) {
    add(semi_implicit, ImplicitEvery::step, kFrame / parts,
        0);  // uses the order of stages of the chapter's splitting
    add(semi_implicit, ImplicitEvery::substep, kFrame / (parts * 64), 0);
  }
  add_chapter_method(base, most, list);
  if (quick) return;
  for (double tolerance : {1e-4, 1e-5, 1e-6}) add(bdf2, ImplicitEvery::substep, kFrame, tolerance);
}

}  // namespace

Problem crease_problem(const Effort& effort) {
  Problem problem{"crease",
                  "A crease, folded and let go: motion through reversals",
                  "position error (root mean square) over the length",
                  "bdf2 with 1/64 of 1/60 s on the same mesh",
                  {},
                  {}};
  ask_for_motion({crease, kLength, kSampling, kFrame / (effort.quick ? 16 : 64), opening_angle}, problem);
  MethodSetting base;
  base.mesh = MeshFamily::random;
  base.law = "prandtl";
  base.device = effort.device;
  base.integrator = Integrator::bdf2;
  base.step = kFrame / 2;
  base.triangles = effort.quick ? 60 : 600;
  vary_steps(base, effort.quick, problem.settings);
  if (effort.quick) return problem;
  for (int triangles : {36, 150}) {
    MethodSetting smaller = base;
    smaller.triangles = triangles;
    vary_steps(smaller, false, problem.settings);
  }
  return problem;
}

}  // namespace hysteron::experiments
