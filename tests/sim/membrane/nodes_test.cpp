// Strains averaged at nodes.
#include <gtest/gtest.h>

#include <numbers>
#include <numeric>
#include <random>

#include "tests/sim/linear/dense.h"
#include "tests/sim/membrane/sheet.h"
#include "tests/sim/mesh/panel_tube.h"

namespace hysteron {
namespace {

using Eigen::Matrix2d;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using test::PanelTube;
using test::Sheet;
using Positions = Sheet::Positions;

constexpr double kNodeRounding = 1e-12;  // of sums of some hundred terms, relative

Fabric stiff_fabric() {
  Fabric fabric;
  fabric.warp = 5e4;
  fabric.weft = 8e3;
  fabric.coupling = 3e3;
  fabric.shear = 60;
  fabric.damping = 0;
  return fabric;
}

ClothMesh random_square(int triangles = 120) {
  return make_rectangle(0.1, 0.1, triangles, MeshFamily::random, 3);
}

Positions mapped(const ClothMesh& mesh, const Matrix2d& m) {
  Positions x;
  for (const Vector3d& p : mesh.rest) {
    const Vector2d q = m * p.head<2>();
    x.emplace_back(q.x(), 0.6 * q.y(), 0.8 * q.y());
  }
  return x;
}

std::vector<char> on_boundary(const ClothMesh& mesh) {
  std::vector<char> is(mesh.vertices(), 0);
  for (std::size_t e = mesh.interior_edges; e < mesh.edge.size(); ++e)
    is[mesh.edge[e].p2] = is[mesh.edge[e].p3] = 1;
  return is;
}

TEST(MembraneNodes, AreTheVerticesOfClothWithoutSeams) {
  const ClothMesh mesh = random_square();
  const MembraneNodes nodes = membrane_nodes(mesh);
  ASSERT_EQ(nodes.count(), mesh.vertices());
  for (int v = 0; v < mesh.vertices(); ++v) EXPECT_NEAR(nodes.area[v], mesh.vertex_area[v], kNodeRounding);
  for (int f = 0; f < mesh.faces(); ++f) EXPECT_EQ(nodes.of_face[f], mesh.face[f]);
}

// Vertices of both seams have one in each panel.
TEST(MembraneNodes, OfPanelsEndAtTheirSeams) {
  const ClothMesh mesh = PanelTube{.second = PanelTube::moved}.mesh();
  const MembraneNodes nodes = membrane_nodes(mesh);
  EXPECT_EQ(nodes.count(), mesh.vertices() + 2 * (PanelTube::kAlong + 1));
  EXPECT_NEAR(std::accumulate(nodes.area.begin(), nodes.area.end(), 0.0), PanelTube::area(), kNodeRounding);
}

TEST(MembraneNodes, OfTrianglesThatTouchAtAVertexAreTwo) {
  ClothMesh mesh;
  mesh.rest = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}};
  mesh.face = {{0, 1, 2}, {0, 3, 4}};
  build_topology(mesh, "two triangles");
  EXPECT_EQ(membrane_nodes(mesh).count(), 6);
}

TEST(MembraneSplit, IsOfTwoPositiveParts) {
  std::mt19937 generator(4);
  std::uniform_real_distribution<double> decades(2, 6), fraction(-0.999, 0.999);
  for (int trial = 0; trial < 1000; ++trial) {
    Fabric fabric;
    fabric.warp = std::pow(10, decades(generator));
    fabric.weft = std::pow(10, decades(generator));
    fabric.coupling = fraction(generator) * std::sqrt(fabric.warp * fabric.weft);
    const MembraneSplit split = split_membrane(fabric, MembraneElement::nodal);
    EXPECT_EQ(split.averages, std::max(fabric.warp, fabric.weft) > 1000);
    const auto &a = split.faces, &b = split.nodes;
    EXPECT_NEAR(a.warp + b.warp, fabric.warp, kNodeRounding * fabric.warp);
    EXPECT_NEAR(a.weft + b.weft, fabric.weft, kNodeRounding * fabric.weft);
    EXPECT_NEAR(a.coupling + b.coupling, fabric.coupling, kNodeRounding * std::abs(fabric.coupling));
    EXPECT_EQ(a.shear, fabric.shear);
    EXPECT_EQ(b.shear, 0);
    for (const auto& part : {a, b})
      EXPECT_GE(part.warp * part.weft * (1 + kNodeRounding), part.coupling * part.coupling);
    if (split.averages) {
      EXPECT_LE(std::max(a.warp, a.weft), 1000 * (1 + kNodeRounding));
    }
  }
}

TEST(NodalMembrane, PaysNothingUpToAKilonewtonAMetre) {
  Fabric fabric = stiff_fabric();
  fabric.warp = 1000;
  fabric.weft = 900;
  fabric.coupling = 100;
  const ClothMesh mesh = random_square();
  Sheet nodal(mesh, fabric), constant(mesh, fabric, MembraneElement::constant);
  EXPECT_EQ(nodal.membrane.bytes(), constant.membrane.bytes());
  EXPECT_EQ(nodal.rows.col(), constant.rows.col());
}

// Patch test: what deforms alike everywhere is in balance inside, with the energy of its strain.
TEST(NodalMembrane, PassesThePatchTest) {
  const ClothMesh mesh = random_square();
  Sheet sheet(mesh, stiff_fabric());
  const Matrix2d m = (Matrix2d() << 1.03, 0.2, -0.1, 0.98).finished();
  sheet.try_at(mapped(mesh, m));
  const Matrix2d c = m.transpose() * m;
  const Vector3d strain((c(0, 0) - 1) / 2, (c(1, 1) - 1) / 2, c(0, 1));
  const MembraneStiffness<double> of{sheet.fabric.warp, sheet.fabric.weft, sheet.fabric.coupling,
                                     sheet.fabric.shear};
  const double area = std::accumulate(mesh.face_area.begin(), mesh.face_area.end(), 0.0);
  EXPECT_NEAR(sheet.energy(), area * membrane_energy(of, strain), kNodeRounding * sheet.energy());
  const Positions f = sheet.forces();
  const std::vector<char> boundary = on_boundary(mesh);
  double inside = 0, outside = 0;
  for (int i = 0; i < mesh.vertices(); ++i)
    (boundary[i] ? outside : inside) = std::max(boundary[i] ? outside : inside, f[i].norm());
  EXPECT_GT(outside, 0.1);
  EXPECT_LT(inside, kNodeRounding * outside);
}

// Returns the in-plane energy of a sheet that lies on a cylinder whose axis is at 30 degrees to the warp,
// after its vertices have slid there to rest: it is zero if triangles do not lock, since a cylinder is
// developable. Gauss-Newton steps are taken in the coordinates along the axis and round the cylinder.
double energy_on_a_cylinder(Sheet& sheet, double curvature) {
  const Matrix2d turned = Eigen::Rotation2Dd(-30 * std::numbers::pi / 180).toRotationMatrix();
  const int n = sheet.mesh.vertices();
  Eigen::VectorXd q(2 * n);
  for (int i = 0; i < n; ++i) q.segment<2>(2 * i) = turned * sheet.mesh.rest[i].head<2>();
  for (int step = 0;; ++step) {
    Positions x;
    MatrixXd slides = MatrixXd::Zero(3 * n, 2 * n);
    for (int i = 0; i < n; ++i) {
      const double round = q[2 * i + 1] * curvature;
      x.emplace_back(q[2 * i], std::sin(round) / curvature, (1 - std::cos(round)) / curvature);
      slides(3 * i, 2 * i) = 1;
      slides.block<3, 1>(3 * i, 2 * i + 1) = Vector3d(0, std::cos(round), std::sin(round));
    }
    sheet.try_at(x);
    if (step == 20) return sheet.energy();
    const MatrixXd stiffness = slides.transpose() * sheet.matrix() * slides;
    Eigen::VectorXd force(3 * n);
    for (int i = 0; i < n; ++i) force.segment<3>(3 * i) = sheet.forces()[i];
    q += test::solution(stiffness + MatrixXd::Identity(2 * n, 2 * n), slides.transpose() * force);
  }
}

TEST(NodalMembrane, StoresLittleOfWhatTrianglesStoreOnACylinderAt30Degrees) {
  Fabric fabric = stiff_fabric();
  fabric.warp = fabric.weft = 1e5;
  fabric.coupling = 0;
  const double curvature = 20,
               bending = 1.16e-5 * curvature * curvature / 2 * 0.01;  // [J] of cotton broad's B
  Sheet triangles(random_square(400), fabric, MembraneElement::constant), nodes(random_square(400), fabric);
  const double locked = energy_on_a_cylinder(triangles, curvature),
               free = energy_on_a_cylinder(nodes, curvature);
  EXPECT_GT(locked, bending / 4);
  EXPECT_LT(free, locked / 10);
}

TEST(NodalMembrane, LetsNoTriangleStretchFreely) {
  const ClothMesh mesh = random_square(40);
  Sheet sheet(mesh, stiff_fabric());
  sheet.try_at(mesh.rest);
  const MatrixXd all = sheet.matrix();
  const int n = mesh.vertices();
  MatrixXd plane(2 * n, 2 * n);
  for (int i = 0; i < 2 * n; ++i)
    for (int j = 0; j < 2 * n; ++j) plane(i, j) = all(3 * (i / 2) + i % 2, 3 * (j / 2) + j % 2);
  EXPECT_LT((all - all.transpose()).norm(), kNodeRounding * all.norm());
  const Eigen::VectorXd values = test::eigenvalues(plane);
  EXPECT_NEAR(values[2], 0, kNodeRounding * values[2 * n - 1]);
  EXPECT_GT(values[3], 0.1 * stiff_fabric().shear);
}

TEST(NodalMembrane, HasTheSpectralRadiusOfItsMatrix) {
  const ClothMesh mesh = random_square(40);
  Fabric fabric = stiff_fabric();
  fabric.in_plane.warp = {{0.01}, {4000}};
  Sheet sheet(mesh, fabric);
  sheet.membrane.start_friction(mesh.rest.data());
  sheet.try_at(mesh.rest);
  const int n = mesh.vertices();
  const std::vector<double> mass(n, 2.0);
  const std::vector<char> held(n, 0);
  const double largest = test::eigenvalues(sheet.matrix())[3 * n - 1] / 2;
  const double radius = membrane_spectral_radius(mesh, fabric, MembraneElement::nodal, mass, held);
  constexpr double kPowerIteration = 0.05;
  EXPECT_NEAR(radius, largest, kPowerIteration * largest);
  EXPECT_LT(radius, membrane_spectral_radius(mesh, fabric, MembraneElement::constant, mass, held));
}

// Threads that are pulled to and fro lose what their stops lose, wherever the mesh takes their strain.
TEST(NodalMembrane, LosesInACycleWhatOneElementOfItsStopsLoses) {
  Fabric fabric = stiff_fabric();
  fabric.in_plane = {{{0.002, 0.01}, {900, 300}}, {{0.004}, {500}}, {{0.02}, {40}}};
  const ClothMesh mesh = random_square();
  const auto loss = [&](const ClothMesh& of) {
    Sheet sheet(of, fabric);
    sheet.membrane.start_friction(of.rest.data());
    for (int step = 0; step <= 200; ++step) {
      const double s = 0.03 * std::sin(step * 2 * M_PI / 100);
      const Positions x = mapped(of, (Matrix2d() << 1 + s, 2 * s, 0, 1 - s / 2).finished());
      sheet.try_at(x);
      sheet.membrane.commit_friction(x.data());
    }
    const double area = std::accumulate(of.face_area.begin(), of.face_area.end(), 0.0);
    return sheet.membrane.friction_loss() / area;
  };
  ClothMesh one;
  one.rest = {{0, 0, 0}, {0.11, 0.02, 0}, {0.03, 0.09, 0}};
  one.face = {{0, 1, 2}};
  build_topology(one, "one triangle");
  EXPECT_GT(loss(one), 0);
  EXPECT_NEAR(loss(mesh), loss(one), 1e-10 * loss(one));
}

}  // namespace
}  // namespace hysteron
