#include "sim/identification/published.h"

#include <cmath>

#include "sim/base/csv.h"
#include "sim/base/error.h"
#include "sim/base/number_in.h"
#include "sim/bending/laws/friction_shape.h"
#include "sim/identification/least_squares.h"
#include "sim/identification/series.h"
#include "sim/scene/fabric_reader.h"
#include "sim/scene/key_table.h"

namespace hysteron {
namespace {

constexpr const char* kB1 = "b1 [N m]";
constexpr const char* kC1 = "c1 [N m2]";
constexpr KesWindow kWindow;                           // of KES-FB2's straight line
constexpr double kLargestHbOverB = 1000;               // [1/m]: residual curvature M0/b2 of a radius of 1 mm
constexpr double kSmallestK0 = 0.1, kLargestK0 = 1e5;  // [1/m]: bends of a radius of 10 m and of 10 um
constexpr int kDrawn = 41;  // number of points of a curve that illustrates the numbers

double square(double x) { return x * x; }

void check_c1(double c1, const std::string& where) {
  if (c1 < 0) return;
  throw Error::invalid_input(
      where + " = " + number_text(c1) +
      " N m^2 must be < 0: with c1 >= 0 the fabric stiffens as it bends, and k0 = (b2 - b1)/(2 "
      "c1), where friction saturates and stiffness has fallen to b2 <= b1, does not exist")
      .with_key(where, number_text(c1));
}

Measured mean_measured(const std::vector<double>& values) {
  const auto n = static_cast<double>(values.size());
  double mean = 0, scatter = 0;
  for (double value : values) mean += value / n;
  for (double value : values) scatter += square(value - mean);
  return {mean, n > 1 ? std::sqrt(scatter / (n - 1) / n) : kNone};
}

// Are the three numbers fixed by these observations, if known to kBestAccuracy? The rows are relative changes
// of the observations (zeros: none), the columns logarithms of b1, b2, k0.
void set_determined(const Eigen::Matrix3d& derivatives, Identification& result) {
  const Eigen::Vector3d errors =
      covariance(derivatives, Eigen::Vector3d::Zero()).with_floor.diagonal().cwiseSqrt();
  result.b1.determined = is_determined(errors[0]);
  result.b2.determined = is_determined(errors[1]);
  result.k0.determined = is_determined(errors[2]);
}

// Makes an estimate of a number from the command line, or the mean of a file of specimens.
Estimate given(const Measured& number, const std::string& source) {
  return {number.value, number.standard_error, true, source + ", given to the fit", "given"};
}

void say_no_errors(Identification& result) {
  if (std::isfinite(result.b1.standard_error) || std::isfinite(result.b2.standard_error)) return;
  result.statements.emplace_back(
      "the numbers come without errors, so that their standard errors are not known");
}

void say_friction(Identification& result) {
  result.statements.push_back(
      "a loading curve shows no friction: that the fabric comes back by another curve, 2HB = (b1 - b2) k0 "
      "apart, is the law's reading of its bend and not seen in the data");
}

}  // namespace

VirginNumbers read_virgin(const std::filesystem::path& file, const std::string& reader) {
  const Table table = read_csv(file, {kB1, kC1}, {}, reader);
  const std::vector<double> b1 = table.numbers(kB1), c1 = table.numbers(kC1);
  for (std::size_t i = 0; i < c1.size(); ++i) {
    try {
      check_c1(c1[i], "c1");
      check_rigidity(b1[i], "b1");
    } catch (const Error& error) {
      throw table.refusal(i, error.what());
    }
  }
  return {mean_measured(b1), mean_measured(c1)};
}

Identification identify_virgin(const VirginNumbers& numbers, const Assumptions& assumptions) {
  check_rigidity(numbers.b1.value, "virgin.b1");
  check_c1(numbers.c1.value, "virgin.c1");
  const double b1 = numbers.b1.value, c1 = numbers.c1.value, b2 = assumptions.ratio * b1;
  const double k0 = (b2 - b1) / (2 * c1);
  if (!(k0 >= kSmallestK0 && k0 <= kLargestK0))
    throw Error::invalid_input("virgin.c1 = " + number_text(c1) + " N m^2 makes k0 = (b2 - b1)/(2 c1) = " +
                               number_text(k0, 4) + " 1/m, must be in [" + number_text(kSmallestK0) + ", " +
                               number_text(kLargestK0) + "] 1/m; 1 gf cm^3/cm is 9.80665e-07 N m^2")
        .with_key("virgin.c1", number_text(c1));
  Identification result;
  result.law = "prandtl";
  result.b1 = given(numbers.b1, "virgin curve M = b1 K + c1 K^2");
  result.b2 = {b2, kNone, false, assumptions.ratio_source(), "assumed"};
  result.k0 = {
      k0, kNone, false,
      "k0 = (b2 - b1)/(2 c1) with c1 = " + number_text(c1) + " N m^2 and b2 " + assumptions.ratio_source(),
      "assumed"};
  // The last row follows from ln c1 = ln(b1 - b2) - ln k0 - ln 2.
  Eigen::Matrix3d derivatives;
  derivatives << 1, 0, 0, b1 / (b1 - b2), -b2 / (b1 - b2), -1, 0, 0, 0;
  set_determined(derivatives, result);
  std::vector<LawRow> rows;
  for (int i = 0; i < kDrawn; ++i) {
    const double k = result.k0.value * i / (kDrawn - 1);
    result.curvature.push_back(k);
    result.moment.push_back(b1 * k + c1 * k * k);
    rows.push_back({k});
  }
  result.model = run_law({result.law, result.curve(), {}}, rows).moment;
  result.further.emplace_back("c1_N_m2", c1);
  result.statements.push_back(
      "b1 and c1 fix the start of the virgin curve and leave open where it ends: any b2 "
      "below b1 goes with a k0 = (b2 - b1)/(2 c1) up to " +
      number_text(-b1 / (2 * c1), 4) + " 1/m; " + assumptions.ratio_source());
  say_friction(result);
  say_no_errors(result);
  return result;
}

namespace {

void check_kes(const KesNumbers& numbers) {
  const double b = numbers.b.value, hb = numbers.two_hb.value / 2;
  if (!(b > 0)) {
    throw Error::invalid_input("kes.b = " + number_text(b) +
                               " N m must be > 0: a fabric that does not resist bending has no slope")
        .with_key("kes.b", number_text(b));
  }
  check_rigidity(b, "kes.b");
  if (!(hb >= 0)) {
    throw Error::invalid_input("kes.2hb = " + number_text(2 * hb) +
                               " N must be >= 0: a loop that gives work back has no width")
        .with_key("kes.2hb", number_text(2 * hb));
  }
  if (hb / b > kLargestHbOverB) {
    throw Error::invalid_input(
        "kes.2hb = " + number_text(2 * hb) + " N must be at most " + number_text(2 * kLargestHbOverB * b, 4) +
        " N: HB/B = " + number_text(hb / b, 4) +
        " 1/m would leave folds of a radius below a millimetre; KES prints gf cm/cm, which is "
        "0.00980665 N, and times 0.00980665 it is " +
        number_text(2 * hb * kGramForceCentimetrePerCentimetre, 4) + " N")
        .with_key("kes.2hb", number_text(2 * hb));
  }
}

// Draws both branches of the loop in the window, as the two numbers define them: M = B K +- HB, up and down.
void draw_kes(const KesNumbers& numbers, Identification& result) {
  for (int i = 0; i < 2 * kDrawn; ++i) {
    const bool back = i >= kDrawn;
    const int at = back ? 2 * kDrawn - 1 - i : i;
    const double k = kWindow.slope_from + (kWindow.slope_to - kWindow.slope_from) * at / (kDrawn - 1);
    result.curvature.push_back(k);
    result.moment.push_back(numbers.b.value * k + (back ? -1 : 1) * numbers.two_hb.value / 2);
  }
}

// Computes the law's moments there: up from rest, on to the end of the test, and back.
void follow_kes(Identification& result) {
  std::vector<LawRow> rows;
  for (double k : result.curvature) {
    if (static_cast<int>(rows.size()) == kDrawn) rows.push_back({kWindow.amplitude});
    rows.push_back({k});
  }
  result.model = run_law({result.law, result.curve(), {}}, rows).moment;
  result.model.erase(result.model.begin() + kDrawn);
}

double stiffness_error(const KesNumbers& numbers, double k0) {
  const double from_b = numbers.b.standard_error, from_hb = numbers.two_hb.standard_error / k0;
  const double from_k0 = std::isfinite(numbers.k0.standard_error)
                             ? numbers.two_hb.value / square(k0) * numbers.k0.standard_error
                             : 0;
  return std::sqrt(square(from_b) + square(from_hb) + square(from_k0));
}

}  // namespace

Identification identify_kes(const KesNumbers& numbers, const Assumptions& assumptions) {
  check_kes(numbers);
  const bool known = numbers.k0.given();
  const double b = numbers.b.value, k0 = known ? numbers.k0.value : assumptions.k0;
  const double b1 = b + numbers.two_hb.value / k0;
  if (b1 > kGreatestRigidity)
    throw Error::invalid_input("k0 = " + number_text(k0) +
                               " 1/m makes b1 = B + 2HB/k0 = " + number_text(b1, 4) +
                               " N m, must be <= " + number_text(kGreatestRigidity) + " N m, as fabrics are")
        .with_key(known ? "kes.k0" : "assume.k0", number_text(k0));
  Identification result;
  result.law = "prandtl";
  result.b2 = given(numbers.b, "B of KES-FB2");
  result.k0 = known ? given(numbers.k0, "k0 with B and 2HB") : assumptions.assumed_k0();
  result.b1 = {b1, known ? stiffness_error(numbers, k0) : kNone, known,
               "b1 = B + 2HB/k0, so that the friction moment (b1 - b2) k0/2 is HB; k0 " + result.k0.source,
               known ? "derived" : "assumed"};
  // The rows are B = b2, then 2HB = (b1 - b2) k0 as a share of B k0, because it may be zero, and k0.
  Eigen::Matrix3d derivatives;
  derivatives << 0, 1, 0, b1 / b, -1, (b1 - b) / b, 0, 0, known ? 1 : 0;
  set_determined(derivatives, result);
  draw_kes(numbers, result);
  follow_kes(result);
  if (!known) {
    result.statements.push_back(
        "B and 2HB fix b2 and the friction moment HB and leave open how fast friction saturates: any k0 up "
        "to about 50/m goes with b1 = B + 2HB/k0; " +
        assumptions.k0_source());
  } else if (k0 > kWindow.slope_from) {
    result.statements.push_back(
        "k0 = " + number_text(k0) +
        "/m lies in the window of KES-FB2, whose branches are then no straight lines: "
        "the law's B and 2HB differ from those given (see the residuals)");
  }
  say_no_errors(result);
  return result;
}

std::string woven_ratio_warning(double ratio, const std::string& unit, const std::string& below, double low,
                                double high) {
  if (ratio >= low && ratio <= high) return "";
  return "is " + number_text(ratio, 3) + " " + unit + " of " + below + ", and woven cloth has " +
         number_text(low) + " to " + number_text(high) + ": is one of them in another unit?";
}

std::string kes_warning(const KesNumbers& numbers) {
  const double width = numbers.two_hb.value;
  if (width == 0) return "";  // the user asked for an elastic fabric
  const std::string text =
      woven_ratio_warning(width / numbers.b.value, "1/m", "kes.b", kLeastWidthOverB, kMostWidthOverB);
  return text.empty() ? "" : "kes.2hb " + text;
}

}  // namespace hysteron
