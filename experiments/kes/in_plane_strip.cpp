#include "experiments/kes/in_plane_strip.h"

#include <chrono>

#include "experiments/specimens/clamped_mesh.h"
#include "sim/scene/cloth.h"
#include "sim/time/simulation.h"

namespace hysteron::experiments {
namespace {

using Clock = std::chrono::steady_clock;

// Where the moving clamp goes, over the gauge: apart and along itself.
struct ClampPlace {
  double apart, along;
};

Scene strip_scene(const Fabric& fabric, Along along, const InPlaneSpecimen& specimen,
                  const std::vector<ClampPlace>& places) {
  Scene scene;
  scene.fabric = fabric;
  scene.fabric.damping = 0;
  scene.cloth.shape = "strip";
  scene.cloth.length = kInPlaneGauge;
  scene.cloth.width = kInPlaneWidth;
  scene.cloth.warp_angle = along == Along::warp ? 0 : 90;
  scene.mesh = specimen.mesh;
  scene.triangles = specimen.triangles;
  scene.integrator = Integrator::quasi_static;
  scene.gravity.setZero();
  scene.step = 1;
  scene.seconds = static_cast<double>(places.size());
  scene.device = DeviceChoice::cpu;
  scene.threads = 1;
  scene.pin = {held_between(-1, 0), held_between(kInPlaneGauge, 1)};
  std::vector<Keyframe>& keys = scene.pin[1].motion.keys = {{}};
  for (const ClampPlace& place : places)
    keys.push_back(
        {keys.back().time + scene.step, {kInPlaneGauge * place.apart, kInPlaneGauge * place.along, 0}});
  return scene;
}

// Of the moving clamp at each place, per width: apart and along itself [N/m].
struct ClampForces {
  std::vector<ClampPlace> force;
  int triangles = 0;
  double seconds = 0;
};

ClampForces forces_at(const Fabric& fabric, Along along, const InPlaneSpecimen& specimen,
                      const std::vector<ClampPlace>& places) {
  const Scene scene = strip_scene(fabric, along, specimen, places);
  const Cloth cloth = make_cloth(scene);
  const auto simulation = make_simulation(scene, cloth);
  ClampForces result;
  result.triangles = cloth.mesh.faces();
  const auto start = Clock::now();
  for (std::size_t i = 0; i < places.size(); ++i) {
    simulation->advance(1);
    const std::vector<Eigen::Vector3d> force = simulation->handle_forces();
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const int vertex : cloth.pin_vertices[1]) sum += force[vertex];
    result.force.push_back({sum.x() / kInPlaneWidth, sum.y() / kInPlaneWidth});
  }
  result.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return result;
}

}  // namespace

InPlaneCloth<ShearTest> shear_cloth(const Fabric& fabric, Along along, const InPlaneSpecimen& specimen,
                                    InPlaneProtocol protocol) {
  protocol.steps = specimen.steps;
  const ShearTest law = test_shear(in_plane_law(fabric, along), protocol);
  std::vector<ClampPlace> places;
  for (std::size_t i = 0; i < law.force.size(); ++i)
    places.push_back({law.walk.stretch[i] - 1, law.walk.shear.rows[i].curvature});
  const ClampForces forces = forces_at(fabric, along, specimen, places);
  InPlaneCloth<ShearTest> cloth{{{}, law.walk, {}}, 0, forces.triangles, forces.seconds};
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto [tension, force] = forces.force[i];
    cloth.test.force.push_back(force - tension * places[i].along / law.walk.stretch[i]);
    cloth.tension += tension / static_cast<double>(places.size());
  }
  cloth.test.reading = read_shear(protocol, law.walk.shear, cloth.test.force);
  return cloth;
}

InPlaneCloth<TensionTest> stretch_cloth(const Fabric& fabric, Along along, const InPlaneSpecimen& specimen,
                                        InPlaneProtocol protocol) {
  protocol.steps = specimen.steps;
  const TensionTest law = test_tension(in_plane_law(fabric, along), protocol);
  std::vector<ClampPlace> places;
  for (std::size_t i = 1; i < law.extension.size(); ++i) places.push_back({law.extension[i], 0});
  const ClampForces forces = forces_at(fabric, along, specimen, places);
  InPlaneCloth<TensionTest> cloth{{{}, law.extension, {0}, law.turn}, 0, forces.triangles, forces.seconds};
  for (const ClampPlace& of : forces.force) cloth.test.force.push_back(of.apart);
  cloth.test.reading = read_tension(cloth.test.extension, cloth.test.force, law.turn);
  return cloth;
}

}  // namespace hysteron::experiments
