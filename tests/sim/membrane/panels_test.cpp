// The membrane of panels that are sewn together.
#include "sim/membrane/membrane.h"

#include <gtest/gtest.h>

#include "tests/sim/mesh/panel_tube.h"

namespace hysteron {
namespace {

using Eigen::Vector3d;
using test::PanelTube;

constexpr MembraneStiffness<double> kFabric{1000, 300, 50, 60};  // [N/m]

// Returns the energy of the panels where they are sewn [J].
double seam_energy(const PanelTube& panels) {
  const ClothMesh mesh = panels.mesh();
  const auto rest = membrane_rest(mesh);
  double sum = 0;
  for (int f = 0; f < mesh.faces(); ++f) {
    const auto& t = mesh.face[f];
    const auto strain = green_strain(deformation(rest[f], mesh.rest[t[0]], mesh.rest[t[1]], mesh.rest[t[2]]));
    sum += rest[f].area * membrane_energy(kFabric, strain);
  }
  return sum;
}

TEST(SewnMembrane, StoresNothingWherePanelsAreFoldedAndSewnButNotStretched) {
  for (const auto& second : {PanelTube::moved, PanelTube::turned, PanelTube::mirrored})
    EXPECT_EQ(seam_energy({.second = second}), 0);
}

// One panel along warp, the other along weft where its texture is turned: W = C E^2/2, E = (1.1^2 - 1)/2.
TEST(SewnMembrane, ResistsByTheWarpAndWeftOfEachPanel) {
  const auto longer = [](const Vector3d& x) { return Vector3d(1.1 * x.x(), x.y(), x.z()); };
  const double strain = (1.1 * 1.1 - 1) / 2, of_one = PanelTube::area() / 2 * strain * strain / 2;
  EXPECT_NEAR(seam_energy({.second = PanelTube::moved, .worn = longer}), 2 * kFabric.warp * of_one, 1e-12);
  EXPECT_NEAR(seam_energy({.second = PanelTube::turned, .worn = longer}),
              (kFabric.warp + kFabric.weft) * of_one, 1e-12);
}

}  // namespace
}  // namespace hysteron
