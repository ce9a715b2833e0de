// Intervals of `fit --fab` hold the truth as often as they say: fabrics are drawn over density, gauge,
// rigidity and friction, tested with noise, and fitted in a form of friction.  ctest fits a few of them in
// the form that they have.  This fits 100 in two forms, which takes half an hour, and writes coverage.csv
// there:
//
//   HYSTERON_FAB_FITS=100 HYSTERON_FAB_COVERAGE=FOLDER build/test_identification --gtest_filter=FabCoverage.*
//
// Other forms of friction, by which `fit --fab` widens its errors and which take most of the time, are fitted
// where the form alone misses the truth (errors only grow by them); with HYSTERON_FAB_OTHERS=1 everywhere.
// HYSTERON_FAB_FIRST is the first seed, 1 unless it is given.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <mutex>
#include <random>
#include <thread>

#include "sim/base/csv.h"
#include "sim/base/parallel.h"
#include "sim/identification/fab_bending.h"
#include "sim/identification/form_comparison.h"
#include "tests/sim/base/refusal.h"

namespace hysteron {
namespace {

constexpr int kFewFits = 6;
// Strips of short gauges are simulated fastest: ctest tests no others [m].
constexpr double kShortestGauge = 0.015, kLongestGauge = 0.05, kLongestOfFew = 0.02;
constexpr double kStripWidth = 0.04, kForceNoise = 7.5e-4;  // [m], [N] of the whole strip
// Distances are relative to the gauge, as the tester's 1.5 mm and 3.8, 6.3, 8.8 mm on 21 mm.
constexpr double kSlack = 0.07;
const std::vector<double> kCompressions = {0.18, 0.30, 0.42};
constexpr int kBranchRows = 15;
constexpr int kSimulationFails = 3;    // exit code of a strip for which no equilibrium is found
constexpr double kAlmostNever = 1e-3;  // a chance so small is taken for none

struct DrawnFabric {
  double density, gauge, b2, friction, k0;  // [kg/m^2], [m], [N m], [N], [1/m]
};

// The numbers of one seed are the same on every machine.
DrawnFabric drawn_fabric(unsigned seed, double longest_gauge) {
  std::mt19937 random(seed);
  const auto between = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(random()) + 0.5) / 4294967296.0;
  };
  const double density = between(0.08, 0.4), gauge = between(kShortestGauge, longest_gauge);
  const double b2 = std::exp(between(std::log(2e-6), std::log(2e-5)));
  const double friction = b2 * between(15, 55), k0 = std::exp(between(std::log(5), std::log(100)));
  return {density, gauge, b2, friction, k0};
}

FabLoops noisy_loops(const DrawnFabric& fabric, unsigned seed) {
  std::vector<double> compressions;
  for (const double share : kCompressions) compressions.push_back(share * fabric.gauge);
  FabLoops loops = made_up_loops("D1", fabric.gauge, kSlack * fabric.gauge, compressions, kBranchRows);
  loops.direction = "L";
  loops.width = kStripWidth;
  const Spectrum stops = parabola_stops(2 * fabric.friction / fabric.k0, fabric.k0);
  const StopsLaw law{fabric.b2, stops.thresholds, stops.stiffnesses};
  const BranchForces force = run_fab(loops, {law, law, fabric.density}).force;
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0, kForceNoise / kStripWidth);
  for (std::size_t b = 0; b < force.size(); ++b)
    for (std::size_t i = 0; i < force[b].size(); ++i)
      loops.branches[b].force[i] = force[b][i] + normal(random);
  return loops;
}

// Returns what other forms find in the same loops, as `fit --fab` compares them.
std::vector<FabForm> other_forms(const FabLoops& loops, double density) {
  FabBendingQuestion question;
  question.density = density;
  std::vector<FabForm> forms = even_forms({loops}, question);
  forms.push_back({"one stop", identify_one_stop({loops}, question)});
  forms.push_back({"stops", identify_fab_bending({loops}, question)});
  return forms;
}

// This struct compares a fit of a drawn fabric with the truth.
struct DrawnFit {
  unsigned seed;
  std::string form;
  DrawnFabric truth;
  FabBending alone, widened;  // errors of the form alone; and with what other forms find, as `fit --fab` says
  bool is_widened = false;

  // Returns the distance of numbers from the truth over their errors, of logarithms.
  static double distance(double value, double truth, double error) {
    return std::log(value / truth) / (error / value);
  }
  double of_b2(const FabBending& found) const {
    return distance(found.law.spring, truth.b2, found.spring_error);
  }
  double of_friction(const FabBending& found) const {
    return distance(found.law.friction(), truth.friction, found.friction_error);
  }
  bool misses(const FabBending& found) const {
    return !(std::abs(of_b2(found)) <= kNormal95 && std::abs(of_friction(found)) <= kNormal95);
  }
};

// Whose errors hold what other forms find.
enum class Widening { none, of_misses, of_all };

struct TestedForm {
  std::string name;
  FrictionForm form;
};

std::vector<DrawnFit> fits_of(unsigned seed, const std::vector<TestedForm>& forms, Widening widening) {
  const DrawnFabric truth = drawn_fabric(seed, widening == Widening::none ? kLongestOfFew : kLongestGauge);
  const FabLoops loops = noisy_loops(truth, seed);
  std::vector<DrawnFit> fits;
  bool one_misses = false;
  for (const auto& [name, form] : forms) {
    FabBendingQuestion question;
    question.density = truth.density;
    question.form = form;
    const FabBending alone = identify_fab_bending({loops}, question);
    fits.push_back({seed, name, truth, alone, alone});
    one_misses = one_misses || fits.back().misses(alone);
  }
  if (widening == Widening::none || (widening == Widening::of_misses && !one_misses)) return fits;
  const std::vector<FabForm> others = other_forms(loops, truth.density);
  for (DrawnFit& fit : fits) {
    widen_errors(fit.widened, others);
    fit.is_widened = true;
  }
  return fits;
}

void write_coverage(const std::filesystem::path& csv, std::vector<DrawnFit> fits) {
  Table table(
      "seed,form,density [kg/m^2],gauge [m],k0 [1/m],b2 [N m],HB [N],found b2 [N m],error of the form "
      "alone [N m],error [N m],found HB [N],error of the form alone [N],error [N],b2 distance over error,HB "
      "distance over error,rms over noise,widened");
  std::stable_sort(fits.begin(), fits.end(), [](const auto& a, const auto& b) { return a.seed < b.seed; });
  for (const DrawnFit& fit : fits) {
    const FabBending &alone = fit.alone, &found = fit.widened;
    table.row({fit.seed, fit.form, fit.truth.density, fit.truth.gauge, fit.truth.k0, fit.truth.b2,
               fit.truth.friction, found.law.spring, alone.spring_error, found.spring_error,
               found.law.friction(), alone.friction_error, found.friction_error, fit.of_b2(found),
               fit.of_friction(found), found.residual_rms, fit.is_widened ? 1 : 0});
  }
  table.write(csv);
}

int misses(const std::vector<double>& distances) {
  return static_cast<int>(std::count_if(distances.begin(), distances.end(),
                                        [](double z) { return !(std::abs(z) <= kNormal95); }));
}

double median_magnitude(std::vector<double> values) {
  for (double& value : values) value = std::abs(value);
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

// The most of so many fits that may miss an interval of 95 %: more have a chance below kAlmostNever.
int most_misses(int fits) {
  double chance = std::pow(0.95, fits), beyond = 1 - chance;
  int count = 0;
  for (; beyond > kAlmostNever; ++count) {
    chance *= 0.05 / 0.95 * (fits - count) / (count + 1);
    beyond -= chance;
  }
  return count;
}

void expect_coverage(const std::string& name, const std::vector<double>& distances) {
  const int fits = static_cast<int>(distances.size()), missed = misses(distances);
  fmt::print("{}: {} of {} within 1.96 standard errors, median distance {:.2f} (0.67 of a normal one)\n",
             name, fits - missed, fits, median_magnitude(distances));
  EXPECT_LE(missed, most_misses(fits)) << name;
}

void expect_coverage(const std::string& form, const std::vector<DrawnFit>& fits) {
  std::vector<double> b2, friction, b2_alone, friction_alone;
  for (const DrawnFit& fit : fits) {
    if (fit.form != form) continue;
    b2.push_back(fit.of_b2(fit.widened));
    friction.push_back(fit.of_friction(fit.widened));
    b2_alone.push_back(fit.of_b2(fit.alone));
    friction_alone.push_back(fit.of_friction(fit.alone));
  }
  expect_coverage(form + ", b2", b2);
  expect_coverage(form + ", HB", friction);
  fmt::print("{}, errors of the form alone: b2 {} and HB {} missed, median distances {:.2f} and {:.2f}\n",
             form, misses(b2_alone), misses(friction_alone), median_magnitude(b2_alone),
             median_magnitude(friction_alone));
}

TEST(FabCoverage, OfDrawnFabricsIsThatOfTheirIntervals) {
  const char *many = std::getenv("HYSTERON_FAB_FITS"), *folder = std::getenv("HYSTERON_FAB_COVERAGE");
  const char* first = std::getenv("HYSTERON_FAB_FIRST");
  const int count = many ? std::max(1, std::atoi(many)) : kFewFits, first_seed = first ? std::atoi(first) : 1;
  const Widening widening = !many                                ? Widening::none
                            : std::getenv("HYSTERON_FAB_OTHERS") ? Widening::of_all
                                                                 : Widening::of_misses;
  std::vector<TestedForm> forms = {{"chapter's", parabola_friction()}};
  if (many) {
    forms.push_back({"shaped", shaped_friction()});
  } else {
    forms[0].form.starts = {};  // they cost three quarters of the time
  }
  std::vector<DrawnFit> fits;
  std::mutex collecting;
  in_parallel(count, many ? static_cast<int>(std::max(1U, std::thread::hardware_concurrency())) : 1,
              [&](std::size_t i) {
                const unsigned seed = static_cast<unsigned>(i) + static_cast<unsigned>(first_seed);
                std::vector<DrawnFit> found;
                const std::string refusal =
                    test::refusal([&] { found = fits_of(seed, forms, widening); }, kSimulationFails);
                const std::lock_guard lock(collecting);
                if (found.empty()) fmt::print("seed {} is not fitted: {}\n", seed, refusal);
                fits.insert(fits.end(), found.begin(), found.end());
                if (folder) write_coverage(std::filesystem::path(folder) / "coverage.csv", fits);
              });
  for (const TestedForm& form : forms) expect_coverage(form.name, fits);
}

}  // namespace
}  // namespace hysteron
