// Friction from the amplitudes of a free vibration: closed laws of decay, and numbers that come back.
#include "sim/identification/decay_friction.h"
#include "sim/identification/form_comparison.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/sim/base/folder.h"
#include "tests/sim/base/refusal.h"

namespace hysteron {
namespace {

using test::says;
// The strip of cotton has 8 cm, and its half periods take 0.15 s.
DecayQuestion question() { return {0.08, 0.1238, 1.16e-5, 2e-4}; }

DecaySeries turns(int count) {
  DecaySeries series;
  for (int i = 0; i < count; ++i) series.time.push_back(0.15 * i);
  series.amplitude.assign(count, 0.02);
  return series;
}

std::vector<double> falls(const std::vector<double>& amplitude) {
  std::vector<double> all;
  for (std::size_t i = 1; i < amplitude.size(); ++i) all.push_back(amplitude[i - 1] - amplitude[i]);
  return all;
}

// dA/dt is constant where all friction has saturated, and nothing is lost where none has slipped.
TEST(DecayFriction, OfSaturatedFrictionFallsAlongALine) {
  const std::vector<double> fall = falls(decay_by(turns(8), question(), {{1e-5}, {5}}, 0.02));
  for (const double one : fall) EXPECT_NEAR(one / fall[0], 1, 1e-3);
  for (const double one : falls(decay_by(turns(8), question(), {{1e3}, {1e-6}}, 0.02))) EXPECT_EQ(one, 0);
}

// dA/dn = -c A^2 where friction is a parabola that has not saturated.
TEST(DecayFriction, OfAParabolaFallsHyperbolically) {
  const Spectrum stops = even_friction(400).stops(Eigen::VectorXd::Zero(1), 2e-3);
  const std::vector<double> a = decay_by(turns(12), question(), stops, 0.02);
  const double rate = (1 / a[11] - 1 / a[0]) / 11;
  for (int i = 0; i < 12; ++i) EXPECT_NEAR(1 / a[i], 1 / a[0] + rate * i, 0.02 / a[0]) << i;
}

TEST(DecayFriction, ComesBackFromNoisyAmplitudesAndExcludesLateSaturation) {
  const Spectrum stops = friction_from_kes({1.16e-5, 4e-4}, {12, 1.6}).stops;
  DecaySeries series = turns(30);
  series.amplitude = decay_by(series, question(), stops, 0.03);
  std::mt19937 random(2);
  std::normal_distribution<double> noise(0, 1e-4);
  for (double& a : series.amplitude) a = std::max(1e-5, a + noise(random));
  DecayQuestion shaped = question();
  shaped.form = shaped_friction();
  const FabBending found = identify_decay(series, shaped);
  EXPECT_TRUE(found.converged);
  EXPECT_TRUE(found.is_shaped());
  EXPECT_LT(found.residual_rms, 1);
  // Along the moments that the strip has bent to, which is what an amplitude tells.
  const Spectrum sought{found.law.thresholds, found.law.stiffnesses};
  for (const double curvature : {5.0, 10.0, 20.0})
    EXPECT_NEAR(sought.loop_area(curvature) / stops.loop_area(curvature), 1, 0.15) << curvature;
  const std::vector<FabForm> forms = even_forms(series, question());
  EXPECT_GT(compare_forms(forms.back(), found, {}).misfit, 10) << forms.back().name;
}

// Each amplitude has noise of 2 %.
TEST(DecayFriction, ReturnsK0AndHBWithinATenthFromAmplitudesWithNoise) {
  constexpr double kTenth = 0.1, kK0 = 8, kHB = 6e-4;
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0, 0.02);
  DecaySeries series = turns(30);
  series.amplitude = decay_by(series, question(), parabola_stops(2 * kHB / kK0, kK0), 0.035);
  for (double& a : series.amplitude) a *= 1 + noise(random);
  const FabBending found = identify_decay(series, question());
  EXPECT_TRUE(found.converged);
  EXPECT_TRUE(found.is_parabola());
  EXPECT_TRUE(found.undetermined().empty());
  EXPECT_NEAR(saturation_curvature(found.form) / kK0, 1, kTenth);
  EXPECT_NEAR(found.law.friction() / kHB, 1, kTenth);
  EXPECT_GT(found.form_errors[1], 0);
  EXPECT_GT(found.friction_error, 0);
}

// Friction that is far from saturating loses in each half period the cube of its curvature times HB/k0^2: as
// k0 is doubled beyond the reach, HB is fourfold, and the fit as good.
TEST(DecayFriction, FindsTheMomentOfFrictionThatSaturatesFarBeyondReach) {
  constexpr double kCubic = 0.3;  // of the fourfold
  DecaySeries series = turns(14);
  series.amplitude = decay_by(series, question(), parabola_stops(2 * 3.4e-4 / 2.7, 2.7), 0.02);
  DecayQuestion rough = question();
  rough.noise = 2e-3;
  const std::vector<FabForm> forms = even_forms(series, rough);
  const auto form = [&](const std::string& name) {
    const auto found = std::ranges::find(forms, name, &FabForm::name);
    EXPECT_NE(found, forms.end()) << name;
    return found->found;
  };
  const FabBending at_25 = form("k0 = 25/m"), at_50 = form("k0 = 50/m");
  EXPECT_NEAR(at_50.law.friction() / at_25.law.friction() / 4, 1, kCubic);
  EXPECT_NEAR(at_50.residual_rms / at_25.residual_rms, 1, kCubic);
}

// `swing --triangles 300 --fabric cotton-broad`, k0 = 8/m: the first fifteen amplitudes [mm], rounded, and
// their times.  The strip's first swings have angles of 28 degrees and lose a third, which the energy balance
// of small ones misses.
TEST(DecayFriction, ReturnsK0AndHBWithinATenthFromASimulatedStrip) {
  constexpr double kTenth = 0.1, kK0 = 8, kB = 1.1571847e-5, kHB = 52.535 * kB;
  const DecaySeries series{{0.4320, 0.6154, 0.7791, 0.9208, 1.0590, 1.1960, 1.3317, 1.4661, 1.5994, 1.7326,
                            1.8657, 1.9984, 2.1305, 2.2621, 2.3936},
                           {0.03847, 0.02378, 0.01422, 0.00958, 0.00787, 0.00694, 0.00627, 0.00573, 0.00528,
                            0.00491, 0.00460, 0.00433, 0.00409, 0.00388, 0.00369}};
  const FabBending found = identify_decay(series, {0.08, 0.1238, kB, 2e-4});
  EXPECT_NEAR(saturation_curvature(found.form) / kK0, 1, kTenth);
  EXPECT_NEAR(found.law.friction() / kHB, 1, kTenth);
  EXPECT_EQ(pace_warning(series, {0.08, 0.1238, kB, 2e-4}, found), "");

  DecaySeries one_side;  // every second turn, which makes HB 45 % smaller
  for (std::size_t i = 0; i < series.time.size(); i += 2) {
    one_side.time.push_back(series.time[i]);
    one_side.amplitude.push_back(series.amplitude[i]);
  }
  const DecayQuestion question{0.08, 0.1238, kB, 2e-4};
  EXPECT_TRUE(says(pace_warning(one_side, question, identify_decay(one_side, question)),
                   "is there an amplitude of every turn, on both sides"));
}

// A strip that swings through four fifths of its length loses otherwise than its mode: HB comes out a fifth
// low.
TEST(DecayFriction, IsOfAmplitudesUpToHalfOfTheLength) {
  DecaySeries series = turns(10);
  series.amplitude = {0.066, 0.041, 0.039, 0.036, 0.033, 0.030, 0.027, 0.024, 0.021, 0.018};
  const DecaySeries small = without_large_amplitudes(series, 0.08);
  ASSERT_EQ(small.time.size(), 8u);
  EXPECT_EQ(small.time.front(), series.time[2]);
  EXPECT_EQ(small.amplitude.front(), 0.039);
  EXPECT_TRUE(says(large_amplitudes_warning(series, 0.08), "2 of 10 amplitudes"));
  EXPECT_EQ(large_amplitudes_warning(small, 0.08), "");
  EXPECT_EQ(without_large_amplitudes(series, 0.05).time.size(), 10u) << "three are left of ten";
  EXPECT_TRUE(says(large_amplitudes_warning(series, 0.05), "a fifth low"));
}

TEST(DecayFriction, IsRefusedOfSeriesThatCannotBeOne) {
  const test::Folder folder;
  const auto reason = [&](const std::string& rows) {
    const std::string file = folder.write("decay.csv", "time [s],amplitude [m]\n" + rows);
    return test::refusal([&] { read_decay(file, "fit"); });
  };
  EXPECT_TRUE(says(reason("0,1\n1,0.9\n"), "at least 6"));
  EXPECT_TRUE(says(reason("0,1\n1,0.9\n2,0.8\n2,0.7\n3,0.6\n4,0.5\n"), "time must rise"));
  EXPECT_TRUE(says(reason("0,1\n1,0.9\n2,0.8\n3,0\n4,0.6\n5,0.5\n"), "amplitude must be > 0"));
}

// 5 cm in millimetres, 10 cm from peak to peak, both on 8 cm, and rows that run backwards.
// First modes of a cantilever and of a hanging chain, 3.516/L^2 sqrt(B/sigma) and 1.2024 sqrt(g/L), together.
TEST(DecayFriction, IsDoubtedWhereTheTimesAreNotThoseOfSuchAStrip) {
  DecayQuestion question;
  question.length = 0.08, question.density = 0.12, question.rigidity = 1.2e-5;
  const double omega = std::hypot(3.516 / 0.0064 * 0.01, 1.2024 * std::sqrt(9.81 / 0.08));
  DecaySeries series;
  for (int i = 0; i < 8; ++i)
    series.time.push_back(M_PI / omega * i), series.amplitude.push_back(0.02 - 0.001 * i);
  EXPECT_TRUE(decay_warnings(series, question).empty());
  DecaySeries stuck = series;  // friction with HB/B = 35/m and a knee at 8/m that never slips
  const double stiff =
      std::hypot(std::sqrt(1 + 2 * 35. / 8) * 3.516 / 0.0064 * 0.01, 1.2024 * std::sqrt(9.81 / 0.08));
  for (double& time : stuck.time) time *= omega / stiff;
  EXPECT_TRUE(decay_warnings(stuck, question).empty());
  for (const double factor : {1e3, 2.0, 1e-3}) {  // milliseconds, every second turn, a wrong unit
    DecaySeries other = series;
    for (double& time : other.time) time *= factor;
    ASSERT_EQ(decay_warnings(other, question).size(), 1u) << factor;
    EXPECT_TRUE(says(decay_warnings(other, question)[0], "are the times in seconds")) << factor;
  }
  series.time.erase(series.time.begin() + 3), series.amplitude.pop_back();
  ASSERT_EQ(decay_warnings(series, question).size(), 1u);
  EXPECT_TRUE(says(decay_warnings(series, question)[0], "is an amplitude missing?"));
}

TEST(DecayFriction, IsRefusedOfAmplitudesThatNoSuchStripHas) {
  const auto reason = [](double scale, bool backwards) {
    DecaySeries series = turns(12);
    for (int i = 0; i < 12; ++i) series.amplitude[i] = scale * 0.05 * std::exp(-0.08 * (backwards ? -i : i));
    return test::refusal([&] { check_decay(series, question(), "decay.csv"); });
  };
  EXPECT_EQ(reason(1, false), test::kAccepted);
  EXPECT_TRUE(says(reason(1000, false), "decay.csv: amplitude = 50 m must be < decay.length = 0.08 m"));
  EXPECT_TRUE(says(reason(1000, false), "millimetres given as metres? Then it is 0.05 m"));
  EXPECT_TRUE(says(reason(2, false), "from peak to peak? An amplitude is half of that, 0.05 m"));
  EXPECT_TRUE(says(reason(0.2, true), "amplitudes rise from 0.01 m"));
}

}  // namespace
}  // namespace hysteron
