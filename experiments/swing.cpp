// A strip clamped at one end, held out straight and let go: it swings under gravity and comes to rest.  What
// stops it, friction in bending, viscosity or the integrator, is told apart by the ledger.
#include <cmath>
#include <cstdio>

#include "experiments/session.h"

namespace hysteron::experiments {
namespace {

constexpr double kClamp = 0.01;  // clamped length [m]

Setup defaults() {
  Setup setup;
  Scene& scene = setup.scene = default_scene();
  // 0.4 % of the length in `hysteron accuracy`, problem swing: the cheapest within 1 %.
  scene.integrator = "bdf2";
  scene.cloth.shape = "strip";
  scene.cloth.length = 0.09;
  scene.cloth.width = 0.03;
  scene.mesh = "unionjack";
  scene.triangles = 1000;
  scene.seconds = 2;
  scene.step = 1.0 / 240;
  scene.fabric.damping = 1e-5;
  setup.options.fps = 60;
  setup.options.camera_direction = {0.25, -1.0, 0.25};
  setup.options.camera_fov = 24;
  return setup;
}

// Turning points of a series that are further apart than `least`.
int turns(const std::vector<double>& x, double least) {
  int count = 0;
  double extreme = x.front();
  int direction = 0;
  for (double value : x) {
    if (direction >= 0 && value > extreme) extreme = value, direction = 1;
    if (direction <= 0 && value < extreme) extreme = value, direction = -1;
    if (std::abs(value - extreme) > least) {
      ++count;
      direction = value > extreme ? 1 : -1;
      extreme = value;
    }
  }
  return count;
}

void plot(Session& session) {
  const auto csv = session.run().path("metrics.csv");
  const std::string what = session.scene().fabric.name + ", law " + session.scene().law;
  render::Plot tip{"Height of the free end, " + what, {"time [s]"}, {"height over the clamp [cm]"}};
  tip.series = {render::series_from_csv(csv, "time", "tip_height", "tip")};
  for (double& z : tip.series[0].y) z *= 100;
  session.plot("plot_tip", tip);
  render::Plot energy{"Where the energy went, " + what, {"time [s]"}, {"energy [J]"}};
  for (const char* term : {"kinetic", "bending", "bending_friction", "viscous", "integrator_inertia"})
    energy.series.push_back(render::series_from_csv(csv, "time", term, term));
  session.plot("plot_energy", energy);
}

}  // namespace

int swing(const CommandLine& line) {
  Setup setup = set_up(line, defaults());
  if (setup.options.quick) {
    setup.scene.triangles = std::min(setup.scene.triangles, 300);
    setup.scene.seconds = std::min(setup.scene.seconds, 0.4);
    setup.options.fps = std::min(setup.options.fps, 20.0);
  }
  const float length = static_cast<float>(setup.scene.cloth.length),
              width = static_cast<float>(setup.scene.cloth.width);
  if (setup.scene.pin.empty()) {
    Pin clamp;
    clamp.low = {-1, -1, -1};
    clamp.high = {kClamp, 1, 1};
    setup.scene.pin.push_back(clamp);
  }
  Session session(line, setup);
  if (session.only_explain()) return 0;

  int tip = 0;
  const auto& rest = session.cloth().mesh.rest;
  for (std::size_t i = 0; i < rest.size(); ++i)
    if (rest[i].x() - std::abs(rest[i].y() - width / 2) > rest[tip].x() - std::abs(rest[tip].y() - width / 2))
      tip = static_cast<int>(i);
  std::vector<double> swing;
  Question question;
  const float low = -length;
  question.bounds = {{-0.7f * length, 0, low}, {length, width, 0.15f * length}};
  question.columns = {"tip_x [m]", "tip_height [m]"};
  question.measure = [&](const Moment& m) -> std::vector<double> {
    swing.push_back(m.x[tip].x());
    return {m.x[tip].x(), m.x[tip].z() - m.x[0].z()};
  };
  question.progress = [&](const Moment& m) {
    char text[100];
    std::snprintf(text, sizeof text, "t = %.3f s  tip at %.4f, %.4f m", m.time, m.x[tip].x(), m.x[tip].z());
    return std::string(text);
  };
  session.simulate(question);
  const Ledger ledger = session.simulation().ledger();
  Run& run = session.run();
  run.metric("turns", turns(swing, 0.01 * setup.scene.cloth.length));
  run.metric("bending_friction_J", ledger.bending_friction);
  run.metric("viscous_J", ledger.viscous);
  run.metric("integrator_J", ledger.integrator());
  if (session.pictures()) plot(session);
  session.finish("Swing: " + setup.scene.fabric.name + ", law " + setup.scene.law);
  return 0;
}

}  // namespace hysteron::experiments
