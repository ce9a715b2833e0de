// Rigidities that vary along a specimen, and its curl: what real specimens have and an even disc does not.
#include <cmath>

#include "experiments/drape/apparatus.h"
#include "sim/bending/curvature_operator.h"
#include "tests/experiments/program.h"

namespace hysteron::experiments {
namespace {

ClothMesh disc(int triangles) {
  Scene scene = default_scene();
  scene.cloth.shape = ClothOutline::disc;
  scene.cloth.radius = 0.15;
  scene.triangles = triangles;
  return make_cloth(scene).mesh;
}

// Means over seeds; of one disc of 15 cm a field over 1 cm has some hundred independent places.
TEST(UnevenSpecimen, HasTheMeanDeviationAndLengthAskedFor) {
  const DrapeParams choice = [] {
    DrapeParams wanted;
    wanted.uneven = 0.1;
    wanted.uneven_length = 0.01;
    return wanted;
  }();
  ClothMesh mesh = disc(2000);
  double mean = 0, square = 0, near = 0;
  int pairs = 0, count = 0;
  for (unsigned seed = 1; seed <= 10; ++seed) {
    make_uneven(mesh, choice, seed);
    for (int f = 0; f < mesh.faces(); ++f) {
      mean += mesh.bending_factor[f];
      square += std::pow(mesh.bending_factor[f] - 1, 2);
      ++count;
    }
    for (int e = 0; e < mesh.interior_edges; ++e) {
      const double a = mesh.bending_factor[mesh.edge[e].face0], b = mesh.bending_factor[mesh.edge[e].face1];
      near += std::pow(a - b, 2);
      ++pairs;
    }
  }
  EXPECT_NEAR(mean / count, 1, 0.01);
  EXPECT_NEAR(std::sqrt(square / count), choice.uneven, 0.1 * choice.uneven);
  // Middles of neighbours are some 5 mm apart: 2 s^2 (1 - exp(-d^2/(2 l^2))).
  const double side = std::sqrt(4 / std::sqrt(3.) * 3.14159 * 0.15 * 0.15 / 2000),
               apart = side / std::sqrt(3.);
  const double expected = 2 * std::pow(choice.uneven, 2) * -std::expm1(-apart * apart / 2e-4);
  EXPECT_NEAR(near / pairs / expected, 1, 0.15);
}

// Each element's moments are times its factor: the operator's areas are.
TEST(UnevenSpecimen, BendsByItsFactors) {
  ClothMesh mesh = disc(200);
  const std::vector<char> held(mesh.vertices());
  for (const BendingElement element : {BendingElement::shape, BendingElement::hinge}) {
    mesh.bending_factor.clear();
    const CurvatureOperator even = make_curvature_operator(element, mesh, held);
    mesh.bending_factor.assign(mesh.faces(), 1.25);
    const CurvatureOperator stiff = make_curvature_operator(element, mesh, held);
    for (int i = 0; i < even.elements(); ++i) EXPECT_DOUBLE_EQ(stiff.area[i], 1.25 * even.area[i]);
    EXPECT_EQ(stiff.coefficient, even.coefficient);
  }
}

// The rest shape is a cylinder of that curvature: a flat specimen is bent by as much against it.
TEST(UnevenSpecimen, IsAtRestAsCurled) {
  DrapeParams choice;
  choice.curl = 2;
  ClothMesh mesh = disc(2000);
  const std::vector<Eigen::Vector3d> flat = mesh.rest;
  make_uneven(mesh, choice, 1);
  EXPECT_TRUE(mesh.bending_factor.empty());
  const CurvatureOperator op = make_shape_operator(mesh, std::vector<char>(mesh.vertices()));
  const std::vector<double> angle = hinge_angles(mesh, flat);
  double mean = 0, area = 0;
  for (int i = 0; i < op.elements(); ++i) {
    double along = 0;
    for (int j = op.hinge.start[i]; j < op.hinge.start[i + 1]; ++j)
      along += op.coefficient[3 * j] * (angle[op.hinge.item[j]] - op.rest_angle[op.hinge.item[j]]);
    mean += op.area[i] * along;
    area += op.area[i];
  }
  EXPECT_NEAR(mean / area, -choice.curl, 0.02 * choice.curl);
}

}  // namespace
}  // namespace hysteron::experiments
