#include "sim/contact/compression.h"

namespace hysteron {

double barrier_stiffness(double thickness) {
  const double range = (1 - kHardest) * thickness, gap = range - kCompressed * thickness;
  return -kTestPressure / barrier(1.0, gap, range).slope;
}

ObstacleShell<double> obstacle_shell(const Scene& scene) {
  ObstacleShell<double> shell{scene.fabric.thickness, 1,
                              scene.finds_equilibrium() ? kCrushed * scene.fabric.thickness : 0, 0};
  shell.k = scene.contact_stiffness > 0 ? scene.contact_stiffness / shell.stiffest()
                                        : barrier_stiffness(scene.fabric.thickness);
  if (shell.last > 0) shell.yield = distance_under(shell, kYieldPressure);
  return shell;
}

double distance_under(const ObstacleShell<double>& shell, double pressure) {
  const Barrier<double> surface = shell.at(0);
  if (-surface.slope < pressure) return -(pressure + surface.slope) / surface.stiffness;  // inside the solid
  double low = 0, high = shell.thickness;
  constexpr double kWithin = 1e-12;  // over the thickness
  while (high - low > kWithin * shell.thickness) {
    const double middle = (low + high) / 2;
    (-shell.at(middle).slope > pressure ? low : high) = middle;
  }
  return high;
}

}  // namespace hysteron
