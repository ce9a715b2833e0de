#include "experiments/kes/strip.h"

#include <array>
#include <cmath>

#include "experiments/kes/output.h"
#include "experiments/specimens/cantilever_strip.h"
#include "experiments/workbench/pages/closing_summary.h"
#include "sim/base/error.h"
#include "tests/experiments/folder.h"

namespace hysteron::experiments {
namespace {

constexpr double kAgreement = 0.01;  // relative: what law and strip may differ by
// Relative, of a uniform bend on squares: what Newton's method leaves, 1e-6 of the clamps' forces, which are
// moments over the spacing.
constexpr double kExact = 1e-4;

// At 2 per cm a column of 1 mm bends by 0.2, where the element errs by 0.4 %.
const KesProtocol kProtocol = [] {
  KesProtocol p;
  p.amplitude = 200;
  p.cycles = 1;
  p.minor_loops = false;
  return p;
}();

StripShape small(const std::string& mesh) {
  StripShape shape;
  shape.mesh = mesh;
  shape.triangles = 150;
  shape.steps = 16;
  return shape;
}

StripTest tested(const StripShape& shape, const LawRequest& law, const Fabric& fabric = {}) {
  return test_strip(clamped_strip(shape, law, fabric, kProtocol), law, kProtocol);
}

// Returns rigidity, width and area of the strip's loop over those of the law's.
std::array<double, 3> over_law(const StripTest& strip) {
  const KesReading &found = strip.reading, &law = strip.law_reading;
  return {found.rigidity / law.rigidity, found.loop_width / law.loop_width, found.loop_area / law.loop_area};
}

// The hinge is 1.3 % too soft on squares, whatever the fabric (docs/accuracy.md).
double agreement(BendingElement element) {
  return kAgreement + (element == BendingElement::hinge ? 0.013 : 0);
}

LawRequest cotton(const std::string& law) { return {law, Fabric{}.virgin_curve(), {}}; }

TEST(Strip, ShowsAWrongRigidity) {
  for (const double wrong : {0.95, 1.05}) {
    Fabric fabric;
    fabric.b1 *= wrong, fabric.b2 *= wrong;
    for (const double ratio : over_law(tested(small("aligned"), cotton("prandtl"), fabric)))
      EXPECT_GT(std::abs(ratio - 1), 2 * kAgreement);
  }
}

// Strips cut along warp, bias and weft of a fabric measured so: along a direction of rigidity q the law has q
// times its rigidities and bends 1/sqrt(q) times as far before friction slides.
TEST(StripOfAFabric, FollowsTheLawOfItsDirection) {
  constexpr double kWeft = 0.6, kBias = 0.7;
  Fabric fabric;
  fabric.weft_bending = kWeft, fabric.bias_bending = kBias;
  StripShape shape = small("random");
  for (const auto& [angle, q] : {std::pair{0.0, 1.0}, {45.0, kBias}, {90.0, kWeft}}) {
    shape.warp_angle = angle;
    const LawRequest along{"prandtl", {q * fabric.b1, q * fabric.b2, fabric.k0 / std::sqrt(q)}, {}};
    const ClampedStrip strip = clamped_strip(shape, cotton("prandtl"), fabric, kProtocol);
    for (const double ratio : over_law(test_strip(strip, along, kProtocol)))
      EXPECT_NEAR(ratio, 1, kAgreement) << angle;
  }
}

// The tester reads B and 2HB of either direction, entered apart: rigidities of ratio q, friction moments of
// ratio f, under every law with three numbers and on both elements.
class LawOfThreeNumbers : public testing::TestWithParam<std::tuple<std::string, BendingElement>> {};

TEST_P(LawOfThreeNumbers, HasRigidityAndFrictionAlongWeftOfTheirOwn) {
  constexpr double kQ = 0.6, kF = 1.3;
  const auto& [law, element] = GetParam();
  Fabric fabric;
  fabric.weft_bending = kQ, fabric.bias_bending = 0.85, fabric.weft_friction = kF;
  StripShape shape = small("aligned");
  shape.element = element;
  for (const auto& [angle, q, f] : {std::tuple{0.0, 1.0, 1.0}, {90.0, kQ, kF}}) {
    shape.warp_angle = angle;
    const double stiffness = f * f * (fabric.b1 - fabric.b2);
    const LawRequest along{law, {q * fabric.b2 + stiffness, q * fabric.b2, fabric.k0 / f}, {}};
    const StripTest strip = test_strip(
        clamped_strip(shape, {law, fabric.virgin_curve(), {}}, fabric, kProtocol), along, kProtocol);
    const auto [rigidity, width, area] = over_law(strip);
    const double near = agreement(element);
    EXPECT_NEAR(rigidity, 1, near) << angle;
    EXPECT_NEAR(width, 1, near) << angle;
    EXPECT_NEAR(area, 1, 2 * near) << angle;
  }
}

// Returns the rigidity of a strip cut along weft over that of the law along weft.
double rigidity_along_weft(const Fabric& fabric, const std::string& law) {
  StripShape shape = small("aligned");
  shape.warp_angle = 90;
  Scene scene;
  scene.fabric = fabric, scene.cloth.warp_angle = 90, scene.law = law;
  const StripTest strip =
      test_strip(clamped_strip(shape, {law, fabric.virgin_curve(), {}}, fabric, kProtocol),
                 {law, curve_along(scene), {}}, kProtocol);
  return std::get<0>(over_law(strip));
}

// Four directions have 0.9995 of the law's elasticity, which much friction along weft would multiply.
TEST(StripOfAFabric, HasItsRigidityAlongWeftBesideMuchFrictionInFourDirections) {
  Fabric fabric;
  fabric.weft_bending = 0.2, fabric.bias_bending = 0.6, fabric.weft_friction = 3;
  EXPECT_NEAR(rigidity_along_weft(fabric, "wong"), 1, kAgreement);
}

// On the side of the positive curvatures the strip has B and 2HB of the face, on the other those of the back;
// along weft with other ratios of rigidity and friction.
TEST(StripOfAFabric, BendsToItsFaceAndToItsBackAsTheLawDoes) {
  Fabric fabric;
  const double friction = 2 * fabric.virgin_curve().friction_moment();
  fabric.k0 = 8,
  fabric.b1 = fabric.b2 + friction / fabric.k0;  // through before the tester reads, along weft as well
  fabric.weft_bending = 0.7, fabric.bias_bending = 0.85, fabric.weft_friction = 0.75;
  fabric.bending.faces = {1.4, 0.7};
  for (const BendingElement element : {BendingElement::shape, BendingElement::hinge}) {
    StripShape shape = small("aligned");
    shape.element = element;
    for (const Along along : {Along::warp, Along::weft}) {
      shape.warp_angle = along == Along::weft ? 90 : 0;
      const LawRequest law{"prandtl", curve_along(fabric, along), {}};
      const StripTest strip = test_strip(clamped_strip(shape, law, fabric, kProtocol), law, kProtocol);
      const double near = agreement(element);
      const bool weft = along == Along::weft;
      const double b = (weft ? 0.7 : 1) * fabric.b2, width = (weft ? 0.75 : 1) * friction;
      EXPECT_NEAR(strip.reading.face.rigidity / b, 1, near) << enum_name(element) << weft;
      EXPECT_NEAR(strip.reading.back.rigidity / (1.4 * b), 1, near) << enum_name(element) << weft;
      EXPECT_NEAR(strip.reading.face.loop_width / width, 1, near) << enum_name(element) << weft;
      EXPECT_NEAR(strip.reading.back.loop_width / (0.7 * width), 1, near) << enum_name(element) << weft;
    }
  }
}

// Branches are of the friction's directions, as stops are: the law along weft has what the strip has.
TEST(StripOfAFabric, HasItsBranchesAlongWeftAsTheLawHas) {
  Fabric fabric;
  fabric.weft_bending = 0.4, fabric.bias_bending = 0.7, fabric.weft_friction = 0.7;
  fabric.bending.branches = {{1e-6, 1e6}, {4e-6, 5e-6}};  // all of one relaxes at once, nothing of the other
  EXPECT_NEAR(rigidity_along_weft(fabric, "chapman"), 1, kAgreement);
}

INSTANTIATE_TEST_SUITE_P(KesStrip, LawOfThreeNumbers,
                         testing::Combine(testing::Values("wong", "prandtl", "bilinear", "dahl", "chapman"),
                                          testing::Values(BendingElement::shape, BendingElement::hinge)),
                         [](const auto& test) {
                           return std::get<0>(test.param) + "_" + enum_name(std::get<1>(test.param));
                         });

// Laws of scalar form run along four directions of the fabric: 0.4 % along and across them, 6 % in the worst
// case.
TEST(StripOfAFabric, FollowsALawOfFourDirectionsWithinSixPercentWhateverItsWarp) {
  StripShape shape = small("aligned");
  for (const double angle : {0.0, 11.25, 22.5, 45.0}) {
    shape.warp_angle = angle;
    const auto [rigidity, width, area] = over_law(tested(shape, cotton("wong")));
    EXPECT_NEAR(rigidity, 1, 0.06) << angle;
    EXPECT_NEAR(area, 1, 0.06) << angle;
  }
}

class AnyMesh : public testing::TestWithParam<std::string> {};

TEST_P(AnyMesh, GivesTheLawsRigidityWidthAndArea) {
  const StripTest strip = tested(small(GetParam()), cotton("prandtl"));
  for (const double ratio : over_law(strip)) EXPECT_NEAR(ratio, 1, kAgreement);
  EXPECT_LT(largest_difference(strip), kAgreement);
  EXPECT_EQ(strip.retried_steps, 0);
}

TEST_P(AnyMesh, BendsAsTheClampsSayWhereNoClampTouchesIt) {
  const StripTest strip = tested(small(GetParam()), cotton("pabst"));
  const KesWalk walk = strip_walk(kProtocol, small(GetParam()).steps);
  ASSERT_EQ(strip.free_curvature.size(), walk.rows.size());
  for (std::size_t turn : walk.start) {
    const double curvature = walk.rows[turn].curvature;
    EXPECT_NEAR(strip.free_curvature[turn], curvature, kAgreement * std::abs(curvature));
  }
}

std::string mesh_name(const testing::TestParamInfo<std::string>& test) {
  std::string name = test.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}
INSTANTIATE_TEST_SUITE_P(KesStrip, AnyMesh, testing::ValuesIn(every_name<MeshFamily>()), mesh_name);

class RadialLaw : public testing::TestWithParam<std::string> {};

TEST_P(RadialLaw, IsReadOffARandomMesh) {
  const StripTest strip = tested(small("random"), cotton(GetParam()));
  EXPECT_LT(largest_difference(strip), kAgreement);
  EXPECT_GT(strip.moment[strip_walk(kProtocol, small("random").steps).start[1]], 0);
}

INSTANTIATE_TEST_SUITE_P(KesStrip, RadialLaw,
                         testing::Values("linear", "bilinear", "prandtl", "pabst", "dahl", "obrien"));

// M = b2 K, in sign as well: a bend towards the cloth's front is positive and is held by a positive moment.
TEST(KesStrip, OfALinearLawOnSquaresTakesTheMomentOfItsRigidity) {
  const LawRequest law = cotton("linear");
  const StripTest strip = tested(small("aligned"), law);
  const KesWalk walk = strip_walk(kProtocol, small("aligned").steps);
  const double tolerance = kExact * law.curve.b2 * kProtocol.amplitude;
  for (std::size_t i = 0; i < walk.rows.size(); ++i)
    EXPECT_NEAR(strip.moment[i], law.curve.b2 * walk.rows[i].curvature, tolerance);
  EXPECT_LT(strip.largest_force, tolerance / kGauge);
}

// The work that the clamps do in a cycle is what friction takes: 4 M0 (A - 2 K0/3), all strip over.
TEST(KesStrip, DissipatesTheClosedForm) {
  const LawRequest law = cotton("prandtl");
  StripShape shape = small("aligned");
  shape.steps = 40;
  const double area = 4 * law.curve.friction_moment() * (kProtocol.amplitude - 2 * law.curve.k0 / 3);
  EXPECT_NEAR(tested(shape, law).reading.loop_area, area, kAgreement * area);
}

// The chapter's element takes part of the twist for bending: on rows of equilateral triangles it is no plate.
TEST(KesStrip, OfHingesOnEquilateralTrianglesIsNotTheLaw) {
  StripShape shape = small("equilateral");
  shape.element = BendingElement::hinge;
  EXPECT_GT(largest_difference(tested(shape, cotton("prandtl"))), kAgreement);
}

TEST(KesStripWalk, IsEvenPassesNoZeroAndReachesEveryTurn) {
  KesProtocol p = kProtocol;
  p.cycles = 2;
  const KesWalk walk = strip_walk(p, 10);
  const double step = 2 * p.amplitude / 19;
  ASSERT_EQ(walk.start.size(), 6u);
  EXPECT_EQ(walk.rows.size(), 1u + 10 + 4 * 19);
  for (std::size_t i = 1; i < walk.rows.size(); ++i) {
    EXPECT_GT(std::abs(walk.rows[i].curvature), 0.4 * step);
    EXPECT_NEAR(std::abs(walk.rows[i].curvature - walk.rows[i - 1].curvature), i == 1 ? step / 2 : step,
                1e-9 * step);
    EXPECT_DOUBLE_EQ(walk.rows[i].seconds, step / p.rate);
  }
  for (std::size_t turn = 1; turn < walk.start.size(); ++turn)
    EXPECT_DOUBLE_EQ(walk.rows[walk.start[turn]].curvature, turn % 2 ? p.amplitude : -p.amplitude);
}

TEST(KesStrip, ThatCannotBeTestedIsRefusedInASentence) {
  StripShape odd = small("brick");
  KesProtocol round = kProtocol;
  round.amplitude = 700;
  const Fabric fabric;
  EXPECT_THROW(clamped_strip(odd, cotton("prandtl"), fabric, kProtocol), Error);
  EXPECT_THROW(clamped_strip(small("aligned"), cotton("prandtl"), fabric, round), Error);
  const LawRequest edited = cotton("grinspun-edit");
  EXPECT_TRUE(
      says(test::refusal([&] { clamped_strip(small("aligned"), edited, fabric, kProtocol); }), "--on law"));
}

TEST(KesStripCommand, PutsTheStripBesideTheLaw) {
  const Folder folder;
  ASSERT_EQ(run_into(folder.path(), "kes",
                     {{"on", "strip"}, {"mesh", "random"}, {"triangles", 100}, {"quick", true}}),
            0);
  const Json metrics = metrics_of(folder.path());
  for (const char* key :
       {"B_N_m", "strip_B_N_m", "strip_2HB_N", "strip_solve_s", "strip_loop_area_difference_percent"})
    EXPECT_TRUE(metrics[key].is_number()) << key;
  const std::string summary = closing_summary(folder.path());
  EXPECT_TRUE(says(summary, "strip's B over the law's"));
  EXPECT_TRUE(fs::exists(folder.path() / "strip.csv"));
}

}  // namespace
}  // namespace hysteron::experiments
