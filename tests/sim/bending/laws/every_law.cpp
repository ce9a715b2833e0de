#include "tests/sim/bending/laws/every_law.h"

#include "sim/base/error.h"
#include "sim/bending/laws/law_commands.h"
#include "sim/bending/laws/law_potential.h"
#include "sim/bending/laws/law_visit.h"
#include "tests/examples/law/exponential.h"

namespace hysteron::testing {
namespace {

using ExampleLaws = LawList<ExponentialLaw>;  // a law that no program ships

// A fabric may have these parts beyond three numbers, on their scale, so that extreme fabrics have them as
// well.
enum Part { kStops = 1, kManyStops = 2, kWeft = 4, kBranches = 8, kSet = 16, kFaces = 32 };

Spectrum stop_spectrum(const VirginCurve& curve, int count) {
  const double scale = curve.k0 > 0 ? curve.k0 : 1;
  Spectrum stops;
  for (int j = 0; j < count; ++j) {
    stops.thresholds.push_back(scale * 1.7 * (j + 0.3) * (j + 1) / (count * count));  // beyond k0 as well
    stops.stiffnesses.push_back((curve.b1 - curve.b2) * (1.5 - 1.0 * j / count) / count);
  }
  return stops;
}

// The set yields at 1.2 k0, and branches have a third and a half of the friction's stiffness.
BendingParts sample_parts(int which, const VirginCurve& curve) {
  BendingParts parts;
  const double g = curve.b1 - curve.b2;
  if (which & (kStops | kManyStops)) parts.stops = stop_spectrum(curve, which & kManyStops ? 12 : 5);
  if (which & kWeft) {
    parts.weft_stops = parts.stops;
    for (double& r : parts.weft_stops.thresholds) r *= 0.6;
    for (double& p : parts.weft_stops.stiffnesses) p *= 1.3;
  }
  if ((which & kBranches) && g > 0) parts.branches = {{0.2, 5}, {g / 3, g / 2}};
  if (which & kSet) parts.set = {1.2 * curve.k0, curve.b2 / 2};
  if (which & kFaces) {
    const double most = 2 * 0.9 * curve.b2 * kMostFaceWidth;  // of the difference between both HB
    parts.faces = {1.4, curve.friction_moment() * 0.3 > most ? 1 : 0.7};
  }
  return parts;
}

std::vector<LawEntry> laws_and_examples() {
  std::vector<LawEntry> laws = law_catalogue();
  for (const LawEntry& law : law_entries(ExampleLaws{})) laws.push_back(law);
  return laws;
}

const LawEntry& law_or_example(const std::string& name) {
  static const std::vector<LawEntry> laws = laws_and_examples();
  for (const LawEntry& law : laws)
    if (law.name == name) return law;
  throw Error::invalid_input("no law or example of a law is called " + name);
}

template <class T>
inline constexpr bool kRunsAlongFourDirections = false;
template <class Law>
inline constexpr bool kRunsAlongFourDirections<FourDirections<Law>> = true;
template <class Real, int N>
inline constexpr bool kRunsAlongFourDirections<WithFaces<Real, 3, N>> = true;  // the excess of one face

template <class Law>
class AnyLawOf : public AnyLaw {
 public:
  static constexpr int D = Law::kDimension;
  using Real = typename Law::Scalar;

  explicit AnyLawOf(const Law& law) : AnyLaw(D), cloth_(law) {}

  void set_seconds(double seconds) override { set_step_time(cloth_.law, Real(seconds)); }
  Step to(const Vec<double, 3>& k) override { return full_step(cloth_.to(taken(k))); }
  Step step(const Vec<double, 3>& k) const override {
    return full_step(called_step(cloth_.law, taken(k), cloth_.history));
  }
  Tangent<double, 3> tangent(const Vec<double, 3>& k) const override {
    return full_tangent(called_tangent(cloth_.law, taken(k), cloth_.history));
  }
  Tangent<double, 3> convex_tangent(const Vec<double, 3>& k) const override {
    return full_tangent(hysteron::convex_tangent(cloth_.law, taken(k), cloth_.history));
  }
  double potential(const Vec<double, 3>& k) const override {
    return static_cast<double>(step_potential(cloth_.law, taken(k), cloth_.history));
  }
  Vec<double, 3> residual() const override { return full_vector(cloth_.law.residual(cloth_.history)); }
  double largest_stiffness() const override { return static_cast<double>(cloth_.law.largest_stiffness()); }
  bool runs_along_four_directions() const override { return kRunsAlongFourDirections<Law>; }

 private:
  static Vec<Real, D> taken(const Vec<double, 3>& k) { return k.head<D>().template cast<Real>(); }
  static Vec<double, 3> full_vector(const Vec<Real, D>& v) {
    Vec<double, 3> full = Vec<double, 3>::Zero();
    full.head<D>() = v.template cast<double>();
    return full;
  }
  static Tangent<double, 3> full_tangent(const Tangent<Real, D>& t) {
    Tangent<double, 3> full = Tangent<double, 3>::Zero();
    full.topLeftCorner<D, D>() = t.template cast<double>();
    return full;
  }
  static Step full_step(const LawStep<Real, D, Law::kHistory>& s) {
    return {full_vector(s.moment), static_cast<double>(s.stored), static_cast<double>(s.dissipated)};
  }

  Driven<Law> cloth_;
};

// The sizes of the memory of `prandtl` that law_cases() choose: each is a type of its own to compile.
struct TestedMemory {
  using Stops = Sizes<8>;
  using Depths = Sizes<4, 8, 16>;
  using Fatigued = FatiguedClothMemory;
  using Faced = Sizes<kFewStops>;
};

template <class Real, int D>
std::unique_ptr<AnyLaw> make_any_law(const LawParams& choice) {
  std::unique_ptr<AnyLaw> made;
  const auto make = [&]<class Law>(const Law& law) { made = std::make_unique<AnyLawOf<Law>>(law); };
  const bool found = visit_groups<Real, D, TestedMemory>(LawGroups{}, choice, make) ||
                     visit_group<ExampleLaws, Real, D, TestedMemory>(choice, make);
  if (!found) throw Error::invalid_input("no law is made for " + choice.name);
  return made;
}

}  // namespace

// Fatigue here is strong: half of the friction moment is gone after a few full cycles of cotton broad.
std::vector<LawCase> law_cases() {
  std::vector<LawCase> cases;
  for (const LawEntry& law : laws_and_examples()) cases.push_back({law.name, law.name, {}});
  cases.push_back({"exponential-soft", "exponential", {{"softness", "0.2"}}});
  cases.push_back({"wong-reversible", "wong", {{"recovery", "reversible"}}});
  cases.push_back({"prandtl-stack", "prandtl", {{"memory", "stack"}, {"stack", "16"}}});
  cases.push_back({"obrien-bounded", "obrien", {{"max-set", "20"}}});
  cases.push_back({"narain-bounded", "narain", {{"max-set", "20"}, {"weakening", "2"}}});
  cases.push_back({"kim-bounded", "kim", {{"max-set", "20"}, {"tau", "0.1"}}});
  for (const char* law : {"bilinear", "wong", "prandtl"})
    cases.push_back({std::string(law) + "-fatigue", law, {{"fatigue.dc", "0.5"}, {"fatigue.m-inf", "1e-4"}}});
  const auto measured = [&](const char* name, const char* law, int parts) {
    cases.push_back({name, law, {}});
    cases.back().parts = parts;
  };
  measured("prandtl-spectrum", "prandtl", kStops);
  measured("prandtl-spectrum-of-many", "prandtl", kManyStops);
  measured("prandtl-two-spectra", "prandtl", kStops | kWeft);
  measured("prandtl-set", "prandtl", kSet);
  measured("linear-faces", "linear", kFaces);
  measured("prandtl-faces", "prandtl", kFaces);
  measured("prandtl-spectrum-faces", "prandtl", kStops | kFaces);
  measured("chapman-branches", "chapman", kBranches);
  measured("chapman-spectrum-branches-set", "chapman", kStops | kBranches | kSet);
  measured("chapman-two-spectra-branches-set", "chapman", kStops | kWeft | kBranches | kSet);
  for (LawCase& c : cases) {
    c.passive = c.law != "wong";
    c.timed = c.law == "terzopoulos" || c.law == "kim" || c.law == "gong" || c.parts & kBranches;
    c.slips_on_ellipsoids = c.parts & kWeft;
  }
  return cases;
}

std::unique_ptr<AnyLaw> any_law(const LawCase& c, As as, double seconds, const VirginCurve& curve) {
  VirginCurve fabric = curve;
  fabric.parts = sample_parts(c.parts, curve);
  const LawParams choice = choose_law(law_or_example(c.law), fabric, c.parameters);
  auto law = as == As::kScalar   ? make_any_law<double, 1>(choice)
             : as == As::kTensor ? make_any_law<double, 3>(choice)
                                 : make_any_law<float, 3>(choice);
  law->set_seconds(seconds);
  return law;
}

}  // namespace hysteron::testing
