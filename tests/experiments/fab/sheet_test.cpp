// The bending test of FAB testers on a mesh of triangles against the elastica, in closed form and with
// friction.
#include "experiments/fab/sheet.h"

#include <gtest/gtest.h>

#include <cmath>

#include "experiments/fab/sheet_output.h"
#include "sim/bending/curvature_operator.h"
#include "sim/identification/fab_fabric.h"

namespace hysteron::experiments {
namespace {

constexpr double kGauge = 0.021, kRigidity = 4e-6;  // [m], [N m]

// Weightless, elastic, and hardly extensible: a strain of 3e-6 at the load of Euler.
Fabric elastic() {
  Fabric fabric;
  fabric.b1 = fabric.b2 = kRigidity;
  fabric.warp = fabric.weft = 1e5;
  return fabric;
}

Fabric with_friction() {
  Fabric fabric = elastic();
  fabric.b1 = 3 * kRigidity;
  fabric.k0 = 60;
  return fabric;
}

// Two rows of squares, whose sides are the gauge over `columns`.
SheetShape narrow(int columns) { return {"aligned", 4 * columns, 2 * kGauge / columns}; }

FabLoops loops(const std::string& test, std::vector<double> compressions, double slack = 1.5e-3,
               int steps = 8) {
  FabLoops made = made_up_loops(test, kGauge, slack, compressions, steps);
  made.direction = "L";
  return made;
}

enum class Weight { none, own };

SheetRun tested(const FabLoops& loops, const Fabric& fabric, const SheetShape& shape,
                Weight weight = Weight::none) {
  FabSheet sheet = fab_sheet(loops, fabric, shape);
  if (weight == Weight::none) sheet.scene.gravity.setZero();
  return test_sheet(sheet, loops);
}

FabRun elastica(const FabLoops& loops, const Fabric& fabric, Weight weight = Weight::none) {
  FabStrip strip = fab_fabric(fabric).strip(loops.direction);
  if (weight == Weight::none) strip.density = 0;
  return run_fab(loops, strip);
}

// Clamped elastica of modulus k: P = 16 K^2 B/L^2 at the distance L (2 E/K - 1) (Love 1927, section 263; a
// quarter of it is a cantilever).
double compression_of(double k) { return kGauge * 2 * (1 - std::comp_ellint_2(k) / std::comp_ellint_1(k)); }
double push_of(double k) { return 16 * std::pow(std::comp_ellint_1(k), 2) * kRigidity / (kGauge * kGauge); }
double euler() { return push_of(0); }

double push_error(double k, int columns) {
  return -tested(loops("D1", {compression_of(k)}), elastic(), narrow(columns)).force[0].back() / push_of(k) -
         1;
}

// Columns of width d are a chain of links with hinges of B/d, which buckles at (sin(pi d/L)/(pi d/L))^2 of
// the load of Euler (1744).  A compression of k^2 adds k^2/2.
TEST(FabSheet, BeginsAtTheLoadOfEulerLessWhatItsColumnsTake) {
  constexpr double kModulus = 0.05, kHigherOrder = 1e-4;
  const FabLoops little = loops("D1", {1.1 * compression_of(kModulus)}, compression_of(kModulus));
  for (const int columns : {12, 24}) {
    const double x = M_PI / columns, chain = std::pow(std::sin(x) / x, 2);
    const double push = -tested(little, elastic(), narrow(columns)).force[0].front();
    EXPECT_NEAR(push / euler(), chain * push_of(kModulus) / euler(), kHigherOrder) << columns;
    EXPECT_GT(1 - chain, 10 * kHigherOrder);
  }
}

TEST(FabSheet, PushesAsTheClampedElasticaToSecondOrderInItsColumns) {
  const double coarse = push_error(0.5, 12), fine = push_error(0.5, 24);
  EXPECT_NEAR(std::log2(coarse / fine), 2, 0.2);
  EXPECT_LT(std::abs(fine), 0.01);
}

// What the elastica leaves out.  A strip compressed by e = P/Y buckles at P (1 - e) = that of Euler, its
// curvature counted along the cloth at rest; at the same distance of the clamps it is compressed less, by e,
// which takes e/2.
TEST(FabSheet, ThatIsCompressedPushesMoreByHalfItsStrain) {
  constexpr double kStiffness = 100, kHigherOrder = 0.1;  // Y [N/m]; relative, of the difference
  const FabLoops little = loops("D1", {0.03 * kGauge}, 0.02 * kGauge);
  Fabric soft = elastic();
  soft.warp = kStiffness;
  const double stiff = tested(little, elastic(), narrow(12)).force[0].front();
  const double more = tested(little, soft, narrow(12)).force[0].front() / stiff - 1;
  EXPECT_NEAR(more / (-stiff / kStiffness / 2), 1, kHigherOrder);
}

TEST(FabSheet, EnclosesNoLoopWithoutFriction) {
  constexpr double kNewton = 1e-5;  // relative: what Newton's method leaves of the clamps' forces
  const FabLoops cycle = loops("D1", {5e-3});
  const SheetRun run = tested(cycle, elastic(), narrow(12));
  EXPECT_NEAR(loop_area(cycle, run.force, 0), 0, kNewton * peak_force(cycle, run.force, 0) * 3.5e-3);
  EXPECT_EQ(run.dissipated, 0);
}

TEST(FabSheet, EnclosesTheLoopsOfTheElastica) {
  constexpr int kColumns = 16;
  const double error = std::pow(2 * M_PI / kColumns, 2) / 12;  // relative, of a chain of so many links
  const FabLoops cycles = loops("D1", {4e-3, 7e-3});
  const SheetRun run = tested(cycles, with_friction(), narrow(kColumns));
  const FabRun expected = elastica(cycles, with_friction());
  for (const int cycle : {0, 1}) {
    const double area = loop_area(cycles, expected.force, cycle);
    EXPECT_GT(area, 0);
    EXPECT_NEAR(loop_area(cycles, run.force, cycle) / area, 1, error) << cycle;
    EXPECT_NEAR(force_range(run.force, cycle) / force_range(expected.force, cycle), 1, error) << cycle;
  }
  EXPECT_NEAR(run.dissipated / expected.dissipated, 1, error);
}

TEST(FabSheet, WithoutWeightBendsUpAsItBendsDown) {
  constexpr double kNewton = 1e-5;
  const SheetRun up = tested(loops("U1", {5e-3}), with_friction(), narrow(12));
  const SheetRun down = tested(loops("D1", {5e-3}), with_friction(), narrow(12));
  for (std::size_t b = 0; b < up.force.size(); ++b)
    for (std::size_t i = 0; i < up.force[b].size(); ++i)
      EXPECT_NEAR(up.force[b][i] / down.force[b][i], 1, kNewton);
  for (std::size_t i = 0; i < up.shapes[1].size(); ++i)
    EXPECT_LT((up.shapes[1][i] - down.shapes[1][i]).norm(), kNewton * kGauge);
}

// A bend down helps to close the clamps by its weight, a bend up resists.
TEST(FabSheet, CarriesItsWeightAsTheElasticaDoes) {
  Fabric heavy = elastic();
  heavy.density = 0.5;
  constexpr double kColumns = 0.05;  // relative, of a difference of two forces
  const FabLoops up = loops("U1", {5e-3}), down = loops("D1", {5e-3});
  const SheetRun rises = tested(up, heavy, narrow(16), Weight::own),
                 hangs = tested(down, heavy, narrow(16), Weight::own);
  const FabRun thin_up = elastica(up, heavy, Weight::own), thin_down = elastica(down, heavy, Weight::own);
  const double difference = thin_up.force[0].back() - thin_down.force[0].back();
  EXPECT_LT(difference, 0);
  EXPECT_NEAR((rises.force[0].back() - hangs.force[0].back()) / difference, 1, kColumns);
}

TEST(FabSheet, CutAlongWeftPushesByTheRigidityOfWeft) {
  constexpr double kStretch = 1e-4;  // relative: a stiffer strip pushes, and shortens, more
  Fabric fabric = elastic();
  fabric.weft_bending = 0.6, fabric.bias_bending = 0.8;
  FabLoops along = loops("D1", {5e-3});
  const double warp = tested(along, fabric, narrow(12)).force[0].back();
  along.direction = "W";
  EXPECT_NEAR(tested(along, fabric, narrow(12)).force[0].back() / warp, 0.6, kStretch);
}

// A clamp that goes on outwards before it comes back, as a tester's does: its turn decides where friction
// slides next.
TEST(FabSheetRepeats, WithEverySecondRowStillTurnWhereTheClampsTurn) {
  constexpr double kNewton = 1e-5;  // relative, of forces
  FabLoops twice = loops("D1", {4e-3, 5e-3});
  double& turn = twice.branches[2].distance[1];
  turn = twice.branches[2].distance[0] + 2e-4;
  const SheetRepeats repeats = repeated(twice, with_friction(), narrow(16));
  const std::vector<double>& kept = repeats.every_other.branches[2].distance;
  EXPECT_LT(kept.size(), twice.branches[2].distance.size());
  EXPECT_EQ(kept[1], turn);
  EXPECT_EQ(kept[2], twice.branches[2].distance[2]);
  EXPECT_NEAR(repeats.far_apart.force[2][2] / repeats.coarse.force[2][2], 1, kNewton);
}

// Free edges let it twist as it bends, which the clamps hinder.
TEST(FabSheet, CutOnTheBiasPushesLessThanACylinderAndMoreThanAFreeStrip) {
  Fabric fabric = elastic();
  fabric.weft_bending = 0.6, fabric.bias_bending = 1.2;
  FabLoops along = loops("D1", {5e-3});
  const double warp = tested(along, fabric, narrow(12)).force[0].back();
  along.direction = "B";
  const double ratio = tested(along, fabric, narrow(12)).force[0].back() / warp;
  EXPECT_LT(ratio, fabric.bias_bending);
  EXPECT_GT(ratio, strip_rigidity(fabric.weft_bending, fabric.bias_bending, M_PI / 4));
}

}  // namespace
}  // namespace hysteron::experiments
