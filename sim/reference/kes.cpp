#include "sim/reference/kes.h"

#include <cmath>
#include <limits>

#include "sim/base/error.h"
#include "sim/base/number_in.h"
#include "sim/bending/laws/recovery.h"

namespace hysteron {
namespace {

using Family = MinorLoop::Family;

constexpr double kAmplitudes[] = {0.1, 0.25, 0.45, 0.65, 0.85};  // over the full amplitude
constexpr double kPartialReversals[] = {0.5, 0.1, -0.3, -0.7};   // over the full amplitude
constexpr double kAreaRounding = 1e-9;  // over amplitude times moment: rounding of a closed sum

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// Rows and moments of one leg, on which the curvature is monotone.
struct Leg {
  const LawRow* row;
  const double* moment;
  std::size_t count;

  double moment_at(double curvature) const {
    for (std::size_t i = 1; i < count; ++i) {
      const double a = row[i - 1].curvature, b = row[i].curvature;
      if (a != b && (curvature - a) * (curvature - b) <= 0)
        return moment[i - 1] + (moment[i] - moment[i - 1]) * (curvature - a) / (b - a);
    }
    return kNaN;
  }
  // Returns the curvature at which the moment, positive at first, has fallen to zero [1/m].
  double root() const {
    for (std::size_t i = 0; i < count; ++i) {
      if (moment[i] > 0) continue;
      if (i == 0) return row[0].curvature;
      const double fraction = moment[i - 1] / (moment[i - 1] - moment[i]);
      return row[i - 1].curvature + fraction * (row[i].curvature - row[i - 1].curvature);
    }
    return kNaN;
  }
  double work() const {  // int M dK [J/m^2]
    double sum = 0;
    for (std::size_t i = 1; i < count; ++i)
      sum += (moment[i - 1] + moment[i]) / 2 * (row[i].curvature - row[i - 1].curvature);
    return sum;
  }
};

Leg leg(const KesWalk& walk, const std::vector<double>& moment, std::size_t index) {
  const std::size_t first = walk.start[index], last = walk.start[index + 1];
  return {&walk.rows[first], &moment[first], last - first + 1};
}

std::vector<double> cycled(double amplitude, int cycles) {
  std::vector<double> turns = {amplitude};
  for (int i = 0; i < cycles; ++i) turns.insert(turns.end(), {-amplitude, amplitude});
  return turns;
}

// Returns the area that the moments enclose from the amplitude to its opposite and back [J/m^2].
double area_of_cycle(int cycle, const KesWalk& walk, const std::vector<double>& moment) {
  const Leg down = leg(walk, moment, 1 + 2 * cycle), back = leg(walk, moment, 2 + 2 * cycle);
  const double area = down.work() + back.work();
  const double rounding = kAreaRounding * std::abs(down.moment[0] * down.row[0].curvature);
  return std::abs(area) > rounding ? area : 0;
}

// Counts recovery cases; `moment` where a leg ends is that before the command.
void count_cases(const VirginCurve& curve, const KesWalk& walk, const std::vector<double>& moment,
                 std::array<int, 3>& cases) {
  for (std::size_t i = 1; i + 1 < walk.start.size(); ++i) {
    std::size_t turn = walk.start[i];
    if (turn > 0 && walk.rows[turn].curvature == walk.rows[turn - 1].curvature) --turn;
    ++cases[static_cast<int>(recovery_case(curve, moment[turn])) - 1];
  }
}

// Cuts out the rows from the `first` leg on.
MinorLoop cut_out(Family family, double reversal, const KesWalk& walk, const std::vector<double>& moment,
                  std::size_t first) {
  MinorLoop loop{family, reversal, {}, {}};
  for (std::size_t i = walk.start[first]; i < walk.rows.size(); ++i) {
    loop.curvature.push_back(walk.rows[i].curvature);
    loop.moment.push_back(moment[i]);
  }
  return loop;
}

void test_minor_loop(const LawRequest& request, const KesProtocol& p, Family family, double reversal,
                     KesTest& test) {
  const bool amplitude = family == Family::amplitude;
  const KesWalk walk = walk_to(
      amplitude ? cycled(reversal, p.cycles) : std::vector<double>{p.amplitude, reversal, p.amplitude}, p);
  const std::vector<double> moment = run_law(request, walk.rows).moment;
  count_cases(request.curve, walk, moment, test.recovery_cases);
  const std::size_t legs = walk.start.size() - 1;
  test.minor_loops.push_back(cut_out(family, reversal, walk, moment, legs - 2));
}

constexpr int kFineSteps = 1000;  // steps to the amplitude: the sum over their chords is exact to 1e-4

// Reads the loop on the same way, with each step divided so that a thousand or more lead to the amplitude.
KesReading read_between_steps(const LawRequest& request, KesProtocol p) {
  p.steps *= (kFineSteps + p.steps - 1) / p.steps;
  const KesWalk walk = walk_to(cycled(p.amplitude, p.cycles), p);
  return read_loop(p, walk, run_law(request, walk.rows).moment);
}

void read_coarse_steps(const LawRequest& request, const KesProtocol& p, KesTest& test) {
  const KesReading fine = read_between_steps(request, p);
  if (!takes_time(request))
    test.reading = fine;
  else if (fine.loop_area > 0)
    test.area_error = test.reading.loop_area / fine.loop_area - 1;
}

std::string per_metre(double curvature) { return number_text(curvature, 6, "1/m"); }

}  // namespace

void check_protocol(const KesProtocol& p) {
  if (!(p.slope_from >= 0 && p.slope_from < p.slope_to && p.slope_to <= p.amplitude)) {
    throw Error::invalid_input("slope-from = " + per_metre(p.slope_from) +
                               ", slope-to = " + per_metre(p.slope_to) +
                               " must be 0 <= slope-from < slope-to <= amplitude = " + per_metre(p.amplitude))
        .with_key("slope-from", number_text(p.slope_from, 6))
        .with_experiment("kes");
  }
  if (!(p.width_at > 0 && p.width_at < p.amplitude)) {
    throw Error::invalid_input("width-at = " + per_metre(p.width_at) +
                               " must be > 0 and < amplitude = " + per_metre(p.amplitude))
        .with_key("width-at", number_text(p.width_at, 6))
        .with_experiment("kes");
  }
}

KesPair kes_pair(const VirginCurve& curve, const KesProtocol& p) {
  if (curve.parts.stops.empty()) return {curve.b2, 2 * curve.friction_moment()};
  return kes_pair(curve.b2, curve.parts.stops, p);
}

KesWalk walk_to(const std::vector<double>& turns, const KesProtocol& p) {
  const double step = p.amplitude / p.steps;
  KesWalk walk{{LawRow{0, 0, false}}, {0}};
  double from = 0;
  for (double turn : turns) {
    const int count = std::max(1, static_cast<int>(std::lround(std::abs(turn - from) / step)));
    const double seconds = std::abs(turn - from) / count / p.rate;
    for (int i = 1; i <= count; ++i)
      walk.rows.push_back({i == count ? turn : from + (turn - from) * i / count, seconds, false});
    if (std::abs(turn) >= p.amplitude) walk.rows.push_back({turn, 0, true});
    walk.start.push_back(walk.rows.size() - 1);
    from = turn;
  }
  return walk;
}

KesReading read_loop(const KesProtocol& p, const KesWalk& walk, const std::vector<double>& moment) {
  const Leg up = leg(walk, moment, 0), down = leg(walk, moment, 1), back = leg(walk, moment, 2);
  const auto slope = [&](const Leg& loading, double side) {
    return side * (loading.moment_at(side * p.slope_to) - loading.moment_at(side * p.slope_from)) /
           (p.slope_to - p.slope_from);
  };
  KesReading reading;
  reading.rigidity = (slope(up, 1) + slope(down, -1)) / 2;
  reading.loop_width = (up.moment_at(p.width_at) - down.moment_at(p.width_at) + back.moment_at(-p.width_at) -
                        down.moment_at(-p.width_at)) /
                       2;
  reading.face = {slope(up, 1), up.moment_at(p.width_at) - down.moment_at(p.width_at)};
  reading.back = {slope(down, -1), back.moment_at(-p.width_at) - down.moment_at(-p.width_at)};
  reading.residual = down.root();
  reading.loop_area = area_of_cycle(p.cycles - 1, walk, moment);
  const double before = p.cycles > 1 ? area_of_cycle(p.cycles - 2, walk, moment) : kNaN;
  reading.area_change = before == 0 ? 0 : reading.loop_area / before - 1;
  return reading;
}

KesTest test_in_kes(const LawRequest& request, const KesProtocol& protocol) {
  check_protocol(protocol);
  KesTest test;
  test.walk = walk_to(cycled(protocol.amplitude, protocol.cycles), protocol);
  test.moment = run_law(request, test.walk.rows).moment;
  test.reading = read_loop(protocol, test.walk, test.moment);
  if (protocol.steps < kFineSteps) read_coarse_steps(request, protocol, test);
  count_cases(request.curve, test.walk, test.moment, test.recovery_cases);

  const LawParams law = choose_law(request.name, request.curve, request.parameters, LawUse::alone);
  test.reading.residual_by_formula =
      has_residual_formula(law)
          ? residual_by_formula(law, protocol.amplitude, test.moment[test.walk.start[1] - 1])
          : kNaN;
  if (!protocol.minor_loops) return test;
  for (double a : kAmplitudes)
    test_minor_loop(request, protocol, Family::amplitude, a * protocol.amplitude, test);
  for (double k : kPartialReversals)
    test_minor_loop(request, protocol, Family::partial_reversal, k * protocol.amplitude, test);
  return test;
}

}  // namespace hysteron
