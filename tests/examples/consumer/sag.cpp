// This program of one's own simulates by the library: a square held along one edge sags.
#include <algorithm>
#include <cstdio>

#include "sim/scene/scene_reader.h"
#include "sim/time/simulation.h"

int main() {
  using namespace hysteron;
  Scene scene = default_scene("cotton-broad");
  scene.cloth.length = scene.cloth.width = 0.1;
  scene.triangles = 50;
  scene.pin.resize(1);
  scene.pin[0].low = {-1, -1, -1};
  scene.pin[0].high = {0, 1, 1};
  check_scene(scene);
  const Cloth cloth = make_cloth(scene);
  const auto simulation = make_simulation(scene, cloth);
  simulation->advance(3);
  double lowest = 0;
  for (const Eigen::Vector3d& x : simulation->positions()) lowest = std::min(lowest, x.z());
  const double fallen = scene.gravity.z() * simulation->time() * simulation->time() / 2;
  std::printf("lowest vertex at %.4f m, in free fall %.4f m\n", lowest, fallen);
  return lowest < 0 && lowest > 2 * fallen ? 0 : 1;
}
