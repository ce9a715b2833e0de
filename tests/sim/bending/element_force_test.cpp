// Bending forces of a whole cloth: derived from energy, free of resultants; and the chapter's printed ones.
#include <gtest/gtest.h>

#include <random>

#include "sim/bending/bending.h"
#include "sim/bending/laws/spectrum_stops.h"
#include "sim/scene/scene.h"
#include "tests/sim/bending/laws/law_fixtures.h"

namespace hysteron {
namespace {

using Eigen::Vector3d;
using Positions = std::vector<Vector3d>;

constexpr MeshFamily kForceFamilies[] = {MeshFamily::aligned, MeshFamily::unionjack, MeshFamily::equilateral,
                                         MeshFamily::random};
// Sums of some hundred forces, each rounded.
constexpr double kForceRounding = 1e-12;
constexpr double kForceOrderSlack = 0.1;

// Bending of virgin cloth bent to `position` in one step.
struct Bent {
  Cpu cpu{1};
  Bending<double, Cpu> bending;
  Bent(const ClothMesh& mesh, const std::string& element, const std::string& law, const Positions& position,
       ForceConvention convention = ForceConvention::energy, const LawParameters& parameters = {})
      : bending(make(mesh, element, law, convention, parameters)) {
    const Positions rest(position.size(), Vector3d::Zero());
    bending.commit(position.data(), rest.data(), 0);
  }
  Bending<double, Cpu> make(const ClothMesh& mesh, const std::string& element, const std::string& law,
                            ForceConvention convention, const LawParameters& parameters) {
    const CurvatureOperator op = make_curvature_operator(value_named<BendingElement>(element), mesh,
                                                         std::vector<char>(mesh.vertices()));
    return {cpu,
            mesh,
            op,
            make_law_loop<double>(cpu, choose_law(law, testing::kCotton, parameters), op.dimension,
                                  op.elements()),
            convention,
            0};
  }
  // Work spent on bending the virgin cloth to here in one step, the incremental potential [J].
  double potential() { return bending.stored_energy() + bending.dissipated_energy(); }
  Positions forces(const ClothMesh& mesh) const {
    Positions result;
    for (int i = 0; i < mesh.vertices(); ++i) result.push_back(bending.forces().at(i));
    return result;
  }
};

ClothMesh small_cloth(MeshFamily family) { return make_rectangle(0.1, 0.08, 60, family, 5); }

Positions crumpled(const ClothMesh& mesh, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> shift(-1, 1);
  constexpr double kCrumple = 6e-3;  // [m], half an edge: angles of order one, no triangle collapses
  Positions x = mesh.rest;
  for (Vector3d& p : x) {
    p.z() += 0.03 * std::sin(40 * p.x() + 25 * p.y());
    for (int k = 0; k < 3; ++k) p[k] += kCrumple / 2 * shift(generator);
  }
  return x;
}

Vector3d total(const Positions& f) {
  Vector3d sum = Vector3d::Zero();
  for (const Vector3d& fi : f) sum += fi;
  return sum;
}
Vector3d torque(const Positions& x, const Positions& f) {
  Vector3d sum = Vector3d::Zero();
  for (std::size_t i = 0; i < x.size(); ++i) sum += x[i].cross(f[i]);
  return sum;
}
double size(const Positions& f) {
  double sum = 0;
  for (const Vector3d& fi : f) sum += fi.norm();
  return sum;
}

struct Case {
  MeshFamily family;
  std::string element, law;
};
std::vector<Case> cases() {
  std::vector<Case> all;
  for (MeshFamily family : kForceFamilies)
    for (const char* element : {"hinge", "shape"})
      for (const char* law : {"linear", "pabst", "prandtl", "wong"}) all.push_back({family, element, law});
  return all;
}

class CrumpledCloth : public ::testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Cases, CrumpledCloth, ::testing::ValuesIn(cases()), [](const auto& c) {
  return enum_name(c.param.family) + "_" + c.param.element + "_" + c.param.law;
});

TEST_P(CrumpledCloth, KeepsMomentumAndAngularMomentum) {
  const ClothMesh mesh = small_cloth(GetParam().family);
  const Positions x = crumpled(mesh, 8);
  const Positions f = Bent(mesh, GetParam().element, GetParam().law, x).forces(mesh);
  ASSERT_GT(size(f), 0.01);  // [N]
  EXPECT_LT(total(f).norm(), kForceRounding * size(f));
  EXPECT_LT(torque(x, f).norm(), kForceRounding * size(f) * 0.1);  // levers are as long as the cloth, 0.1 m
}

TEST_P(CrumpledCloth, PullsWithMinusTheGradientOfItsIncrementalPotential) {
  const auto& [family, element, law] = GetParam();
  const ClothMesh mesh = small_cloth(family);
  const Positions x = crumpled(mesh, 9);
  const Positions f = Bent(mesh, element, law, x).forces(mesh);
  ASSERT_GT(size(f), 0.01);
  // One random direction checks the whole gradient, at the cost of four evaluations.
  std::mt19937 generator(10);
  std::normal_distribution<double> normal;
  Positions along = x;
  double exact = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    along[i] = Vector3d(normal(generator), normal(generator), normal(generator));
    exact -= f[i].dot(along[i]);
  }
  ASSERT_NE(exact, 0);
  const auto error = [&, &element = element, &law = law](double h) {
    Positions plus = x, minus = x;
    for (std::size_t i = 0; i < x.size(); ++i) {
      plus[i] += h * along[i];
      minus[i] -= h * along[i];
    }
    const double rise =
        Bent(mesh, element, law, plus).potential() - Bent(mesh, element, law, minus).potential();
    return std::abs(rise / (2 * h) - exact);
  };
  if (law == "linear") {
    constexpr double kStep = 4e-6;  // [m], a two-thousandth of an edge
    EXPECT_NEAR(std::log2(error(kStep) / error(kStep / 2)), 2, kForceOrderSlack);
  } else {  // kinks at stops' limits lower the order
    constexpr double kNear = 1e-6, kClose = 1e-4;
    EXPECT_LT(error(kNear), kClose * std::abs(exact));
  }
}

TEST_P(CrumpledCloth, FeelsTheSameForcesAfterARigidMotion) {
  const auto& [family, element, law] = GetParam();
  const ClothMesh mesh = small_cloth(family);
  const Positions x = crumpled(mesh, 11);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(2, Vector3d(3, -1, 2).normalized()).toRotationMatrix();
  Positions moved;
  for (const Vector3d& p : x) moved.push_back(turn * p + Vector3d(0.2, -0.1, 0.4));
  const Positions f = Bent(mesh, element, law, x).forces(mesh),
                  g = Bent(mesh, element, law, moved).forces(mesh);
  constexpr double kLever = 1e3;  // rounding of positions of 0.5 m against edges of some mm
  for (std::size_t i = 0; i < f.size(); ++i)
    EXPECT_LT((turn * f[i] - g[i]).norm(), kLever * kForceRounding * size(f) / static_cast<double>(f.size()));
}

// The chapter's printed force on one hinge.
struct OneHinge {
  ClothMesh mesh;
  Positions bent;
  // Positions of the corners along the edge in its lengths, heights in its lengths, opened by `theta`.
  OneHinge(double t0, double t1, double h0, double h1, double theta) {
    constexpr double kEdge = 0.02;  // [m]
    const double c = std::cos(theta / 2), s = std::sin(theta / 2);
    mesh.rest = {{-h0, t0, 0}, {h1, t1, 0}, {0, 0, 0}, {0, 1, 0}};
    bent = {{-h0 * c, t0, h0 * s}, {h1 * c, t1, h1 * s}, {0, 0, 0}, {0, 1, 0}};
    for (Vector3d& x : mesh.rest) x *= kEdge;
    for (Vector3d& x : bent) x *= kEdge;
    mesh.face = {{2, 3, 0}, {3, 2, 1}};
    build_topology(mesh, "one hinge");
  }
  Positions forces(ForceConvention convention) const {
    return Bent(mesh, "hinge", "linear", bent, convention).forces(mesh);
  }
  double edge() const { return (bent[3] - bent[2]).norm(); }
  // Torque of all four printed forces over that of the wing's pull about the edge, |f0| h0.
  double torque_defect() const {
    const Positions f = forces(ForceConvention::chapter);
    const double lever = (bent[0] - bent[2]).cross(bent[3] - bent[2]).norm() / edge();
    return torque(bent, f).norm() / (f[0].norm() * lever);
  }
};

TEST(ChapterForce, OnTheWingsIsTheEnergyConsistentOneOverTwiceTheEdge) {
  const OneHinge hinge(0.3, 0.8, 0.6, 1.1, 0.7);
  const Positions ours = hinge.forces(ForceConvention::energy),
                  printed = hinge.forces(ForceConvention::chapter);
  for (int i = 0; i < 2; ++i) {
    ASSERT_GT(ours[i].norm(), 0);
    EXPECT_LT((printed[i] - ours[i] / (2 * hinge.edge())).norm(), kForceRounding * printed[i].norm()) << i;
  }
  EXPECT_LT(total(printed).norm(), kForceRounding * size(printed));
}

TEST(ChapterForce, KeepsAngularMomentumOnASymmetricHinge) {
  for (const double theta : {-2.0, 0.5, 2.5})
    EXPECT_LT(OneHinge(0.5, 0.5, 0.8, 0.8, theta).torque_defect(), kForceRounding);
}

// Its forces on the edge share one t between both wings, which is the finding that made the energy-consistent
// force the default.
TEST(ChapterForce, BreaksAngularMomentumOnASkewHinge) {
  constexpr double kNoticeable = 0.2;
  double worst = 0;
  for (const double t0 : {0.1, 0.3, 0.5, 0.7})
    for (const double t1 : {0.3, 0.5, 0.7, 0.9})
      for (const double ratio : {0.5, 1.0, 2.0}) {
        const OneHinge hinge(t0, t1, 0.6, 0.6 * ratio, 0.8);
        EXPECT_LT(torque(hinge.bent, hinge.forces(ForceConvention::energy)).norm(), kForceRounding);
        worst = std::max(worst, hinge.torque_defect());
      }
  EXPECT_GT(worst, kNoticeable);
}

// The energy of a linear law is that of the turn from rest, squared.
TEST(ImplicitBending, FollowsAHingeBeyondHalfATurnInOneStep) {
  const auto turned = [](double halves) { return OneHinge(0.5, 0.5, 0.8, 0.8, halves * M_PI); };
  const OneHinge flat = turned(0);
  Bent bent(flat.mesh, "hinge", "linear", flat.bent);
  bent.bending.begin_step(StepFormula::statics(1));
  const auto energy_at = [&](double halves) {
    bent.bending.evaluate(turned(halves).bent.data());
    return bent.bending.energies()[0];
  };
  const double of_half = energy_at(0.5) / (0.5 * 0.5);
  for (const double halves : {0.9, 1.2, 1.9, 2.4}) {
    EXPECT_NEAR(energy_at(halves), of_half * halves * halves, kForceRounding * of_half) << halves;
    bent.bending.linearise();
  }
  EXPECT_NEAR(energy_at(1.6), of_half * 1.6 * 1.6, kForceRounding * of_half) << "a trial on the way back";
  bent.bending.accept();
  bent.bending.begin_step(StepFormula::statics(1));
  EXPECT_NEAR(energy_at(1.5), of_half * 1.5 * 1.5, kForceRounding * of_half) << "the next step";
}

// From the step's start alone 1.2 half turns one way are 0.8 the other way.
TEST(ImplicitBending, TakesTheShorterWayToWhereAStepBegins) {
  const OneHinge flat(0.5, 0.5, 0.8, 0.8, 0);
  Bent bent(flat.mesh, "hinge", "linear", flat.bent);
  bent.bending.begin_step(StepFormula::statics(1));
  const auto energy_at = [&](double halves) {
    bent.bending.evaluate(OneHinge(0.5, 0.5, 0.8, 0.8, halves * M_PI).bent.data());
    return bent.bending.energies()[0];
  };
  EXPECT_NEAR(energy_at(1.2), energy_at(-0.8), kForceRounding * energy_at(-0.8));
}

// Returns the spectrum on the bias of a fabric with these stops, behind the metric Q = (1, 0.6, 0.6):
// stiffnesses (p + p')/4 + 0.3 sqrt(p p'/0.6), squares of friction moments (f^2 + f'^2)/4 + 0.3 f
// f'/sqrt(0.6).
Spectrum on_the_bias(const Spectrum& warp, const Spectrum& weft) {
  Spectrum bias;
  for (std::size_t j = 0; j < warp.size(); ++j) {
    const double p = warp.stiffnesses[j], other = weft.stiffnesses[j];
    const double f = p * warp.thresholds[j], slides = other * weft.thresholds[j];
    const double stiff = (p + other) / 4 + 0.3 * std::sqrt(p * other / 0.6);
    const double moment = std::sqrt((f * f + slides * slides) / 4 + 0.3 * f * slides / std::sqrt(0.6));
    bias.stiffnesses.push_back(stiff);
    bias.thresholds.push_back(moment / stiff);
  }
  return bias;
}

// Rows of hinges across a strip whose chords, each of length d, turn by K d.
Positions rolled(const ClothMesh& mesh, double curvature, double d) {
  Positions x = mesh.rest;
  for (Vector3d& p : x) {
    const long column = std::lround(p.x() / d);
    p.x() = p.z() = 0;
    for (long i = 0; i < column; ++i) {
      p.x() += d * std::cos(curvature * d * static_cast<double>(i));
      p.z() += d * std::sin(curvature * d * static_cast<double>(i));
    }
  }
  return x;
}

// Hinges are cut along warp, bias and weft.
TEST(HingesOfAFabric, FollowTheClosedLoopsOfTheStopsAcrossTheirEdges) {
  constexpr double kSpacing = 5e-3, kFar = 90;  // [m], [1/m]
  const Spectrum warp = {{4, 15, 60}, {9e-6, 5e-6, 8e-7}}, weft = {{10, 40, 80}, {4e-6, 6e-6, 2e-6}};
  Fabric fabric;
  fabric.weft_bending = 0.6, fabric.bias_bending = 0.7;
  fabric.bending.stops = warp, fabric.bending.weft_stops = weft;
  const std::tuple<double, double, Spectrum> cuts[] = {
      {0, 1, warp}, {std::atan(1.0), 0.7, on_the_bias(warp, weft)}, {2 * std::atan(1.0), 0.6, weft}};
  for (const auto& [angle, q, stops] : cuts) {
    ClothMesh mesh = make_grid(10 * kSpacing, 0.01, 10, 2, MeshFamily::aligned, 0);
    mesh.warp_axis = {std::cos(angle), std::sin(angle), 0};
    CurvatureOperator op = make_hinge_operator(mesh);
    stiffen(op, mesh, fabric.weft_bending, fabric.bias_bending);
    set_directions(op, mesh, fabric.weft_bending, fabric.bias_bending);
    Cpu cpu(1);
    Bending<double, Cpu> bending(
        cpu, mesh, op,
        make_law_loop<double>(cpu, choose_law("prandtl", fabric.virgin_curve(), {}), 1, op.elements()),
        ForceConvention::energy, 0);
    testing::Driven law(SpectrumStops<double, 1, 8>::make(q * fabric.b2, stops, {}));
    const Positions still(mesh.vertices(), Vector3d::Zero());
    double before = 0, area = 0;
    for (double turn : {60.0, -60.0, 30.0, -10.0, kFar, -kFar, kFar}) {
      before = turn == -kFar ? bending.dissipated_energy() : before;
      bending.commit(rolled(mesh, turn, kSpacing).data(), still.data(), 0);
      const double moment = law.moment(turn);
      const std::vector<double> found = bending.moment(), curvature = bending.curvature();
      area = 0;
      for (int e = 0; e < mesh.interior_edges; ++e) {
        const Vector3d along = mesh.rest[mesh.edge[e].p3] - mesh.rest[mesh.edge[e].p2];
        const bool across = std::abs(along.x()) < kForceRounding;
        area += across ? op.area[e] : 0;
        const double side = std::copysign(1, curvature[e] * turn);
        EXPECT_NEAR(found[e] * side, across ? moment : 0, kForceRounding * fabric.b1 * kFar)
            << angle << " " << e;
      }
    }
    const double lost = area * stops.loop_area(kFar);
    EXPECT_NEAR(bending.dissipated_energy() - before, lost, kForceRounding * lost) << angle;
  }
}

}  // namespace
}  // namespace hysteron
