// Problem swing: a strip held out straight is let go and swings through its first quarter second, a motion
// that is smooth in time.
#include "experiments/accuracy/accuracy.h"
#include "experiments/specimens/clamped_mesh.h"

namespace hysteron::experiments {
namespace {

constexpr double kLength = 0.06, kWidth = 0.02, kClamp = 0.01;  // [m]
constexpr double kSampling = 1.0 / 60;                          // [s]

Scene swing_scene(const MethodSetting& setting) {
  Scene scene = with(setting, {});
  scene.cloth.shape = ClothOutline::strip;
  scene.cloth.length = kLength;
  scene.cloth.width = kWidth;
  scene.seconds = 0.25;
  scene.solver_tolerance = 1e-8;
  scene.newton_residual = 1e-9;
  // The damping kills the waves that the release excites within the shortest of the steps compared.
  scene.fabric.damping = 2e-3;
  scene.pin = {held_between(-1, kClamp)};
  return scene;
}

double tip_height(const Cloth& cloth, const std::vector<Eigen::Vector3d>& x) {
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (cloth.mesh.rest[i].x() > kLength * (1 - 1e-9)) sum += x[i].z(), ++count;
  return sum / count;
}

}  // namespace

Problem swing_problem(const Effort& effort) {
  Problem problem{"swing",
                  "A strip let go: smooth motion",
                  "position error (root mean square) over the length",
                  "bdf2 with 1/15360 s on the same mesh",
                  {},
                  {}};
  ask_for_motion({swing_scene, kLength, kSampling, 1.0 / (effort.quick ? 7680 : 15360), tip_height}, problem);
  MethodSetting base;
  base.device = effort.device;
  base.integrator = Integrator::bdf2;
  base.triangles = 96;
  base.step = 1.0 / 240;
  const auto add = [&](Integrator integrator, int rate) {
    problem.settings.push_back(
        varied(base, "step", [&](MethodSetting& s) { s.integrator = integrator, s.step = 1.0 / rate; }));
  };
  for (Integrator integrator : {Integrator::bdf2, Integrator::implicit})
    for (int rate = 60; rate <= (effort.quick ? 960 : 3840); rate *= 2) add(integrator, rate);
  // These are the longest steps at which explicit bending is stable.
  for (int rate = 30720; rate <= (effort.quick ? 61440 : 245760); rate *= 2)
    add(Integrator::semi_implicit, rate);
  return problem;
}

}  // namespace hysteron::experiments
