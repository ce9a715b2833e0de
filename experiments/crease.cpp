// Crease recovery (ISO 2313, AATCC 66): a specimen is folded, loaded, let go, and opens again.
#include <cmath>
#include <cstdio>
#include <numbers>

#include "experiments/creased.h"
#include "experiments/session.h"

namespace hysteron::experiments {
namespace {

using C = CreaseChoice;
// clang-format off
const KeyRow<C> kRows[] = {
    {"crease.force", at<&C::force>, "N", positive(), "", "of the plate"},
    {"crease.hold", at<&C::hold>, "s", positive(), "", "time under the whole load"},
    {"crease.recovery", at<&C::recovery>, "s", positive(), "", "time to recover"},
};
// clang-format on

Setup defaults() {
  Setup setup;
  Scene& scene = setup.scene = default_scene();
  scene.integrator = "implicit";
  scene.step = 1.0 / 240;
  scene.self_contact = true;
  scene.cloth.length = 0.04;
  scene.cloth.width = 0.015;
  scene.triangles = 1600;
  scene.gravity.setZero();
  scene.air_drag = 1;
  scene.newton_velocity = 1e-6;
  scene.contact_stiffness = 1e9;  // plates: 10 N sink 7 % of a thickness into them
  setup.options.fps = 60;
  setup.options.camera_direction = {0.25, -1.0, 0.2};
  setup.options.camera_fov = 22;
  return setup;
}

// Angle by which the specimen would stay bent if each element were let go by itself: the law's own closed
// form of it where it has one, else the root of its moment [degree].
double angle_of_law(Session& session) {
  Simulation& simulation = session.simulation();
  const ClothMesh& mesh = session.cloth().mesh;
  const int d = simulation.dimension();
  const std::vector<double> residual = simulation.residual_curvature();
  double sum = 0;
  if (d == 3)
    for (int f = 0; f < mesh.faces(); ++f) sum += mesh.face_area[f] * residual[3 * f];
  return std::abs(sum) / session.scene().cloth.width * 180 / std::numbers::pi;
}

struct Seen {
  double opening = 0, force = 0, largest_force = 0, bent = 0;
};

}  // namespace

std::vector<KeyDescription> crease_keys() {
  C choice;
  return descriptions(bind(kRows, choice));
}

int crease(const CommandLine& line) {
  C choice;
  Setup setup = set_up(line, defaults(), bind(kRows, choice));
  if (setup.options.quick) setup.scene.triangles = std::min(setup.scene.triangles, 500);
  const double plate = loaded_plate(setup.scene, choice);
  const Crease crease = creased(setup.scene, choice, plate);
  setup.scene = crease.scene;
  Session session(line, setup, crease.cloth);
  if (session.only_explain()) return 0;
  Seen seen;
  const float length = static_cast<float>(setup.scene.cloth.length),
              width = static_cast<float>(setup.scene.cloth.width);
  Question question;
  question.bounds = {{-0.05f * length, 0, 0}, {length, width, 0.5f * length}};
  question.floor = 0.0f;
  question.columns = {"opening [degree]", "plate_force [N]"};
  question.measure = [&](const Moment& m) -> std::vector<double> {
    seen.opening = crease.opening(m.x);
    seen.force = m.time < crease.times.folded ? 0 : crease.plate_force(m.x, m.time);
    if (m.time < crease.times.released + setup.scene.step / 2) {
      seen.largest_force = std::max(seen.largest_force, seen.force);
      seen.bent = angle_of_law(session);
    }
    return {seen.opening, seen.force};
  };
  question.progress = [&](const Moment& m) {
    char text[100];
    std::snprintf(text, sizeof text, "t = %.3f s  opening %.1f degree, plate %.2f N", m.time, seen.opening,
                  seen.force);
    return std::string(text);
  };
  session.simulate(question);
  Run& run = session.run();
  run.metric("recovery_angle_deg", seen.opening);
  run.metric("law_residual_angle_deg", seen.bent);
  run.metric("plate_force_N", seen.largest_force);
  run.metric("plate_height_m", plate);
  session.finish("Crease: " + setup.scene.fabric.name + ", law " + setup.scene.law);
  return 0;
}

}  // namespace hysteron::experiments
