#include "sim/reference/fab_checks.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "sim/base/error.h"

namespace hysteron {
namespace {

constexpr double kShortest = 1e-3, kLongest = 1;  // [m] no such strip is shorter or longer
constexpr double kMostStretch = 3;                // of the gauge
constexpr int kFewestRows = 4;                    // of a branch
constexpr double kRipple = 0.05;  // of a branch's way that the clamps may come back: they turn late
constexpr double kGap = 0.3;      // of a branch's way between its first row and the last of the branch before
constexpr double kWorkOfNoise = 0.05;    // of force range times way, that noise around no loop may give back
constexpr double kFallOfFriction = 0.2;  // of the force range over the way: friction alone makes it flat

class Checks {
 public:
  Checks(const FabLoops& loops, const std::string& file, const std::string& reader)
      : loops_(loops), file_(file), reader_(reader) {}

  void names() const {
    const std::string known[] = {"L", "W", "B", "warp", "weft", "bias"};
    if (std::find(std::begin(known), std::end(known), loops_.direction) == std::end(known))
      refuse("a direction is L (warp), W (weft) or B (bias)");
    if (std::string("UDS").find(loops_.test.front()) == std::string::npos)
      refuse("a test is U.., D.. or S..");
  }

  void lengths() const {
    for (const double length : {loops_.gauge, loops_.width})
      if (!(length >= kShortest && length <= kLongest))
        refuse(fmt::format("a length of {:g} m is not one of a strip, {:g} to {:g} m: other units than said?",
                           length, kShortest, kLongest));
  }

  void branch(std::size_t b) const {
    const std::vector<double>& distance = loops_.branches[b].distance;
    if (distance.size() < kFewestRows) refuse("a branch has fewer than 4 rows");
    for (std::size_t i = 0; i < distance.size(); ++i)
      if (const double d = distance[i];
          !(d > 0 && d < kMostStretch * loops_.gauge) || (loops_.bends() && d >= loops_.gauge))
        refuse(fmt::format("clamps at {:g} m do not fit a gauge of {:g} m", d, loops_.gauge), line(b, i));
    order(b);
    if (b > 0 && std::abs(distance.front() - loops_.branches[b - 1].distance.back()) > kGap * way(b))
      refuse(fmt::format("branch {} begins at {:g} m, far from where the one before it ends, {:g} m", b,
                         distance.front(), loops_.branches[b - 1].distance.back()),
             line(b, 0));
  }

  void start() const {
    const double distance = loops_.branches[0].distance.front();
    if (std::abs(distance - loops_.gauge) > kLargestStart * loops_.gauge)
      refuse(fmt::format("the clamps begin {:g} m apart, must be within {:g} % of the gauge, {:g} m",
                         distance, 100 * kLargestStart, loops_.gauge));
  }

  void forces(int cycle) const {
    const BranchForces force = forces_of(loops_);
    const double range = force_range(force, cycle);
    const std::string first = line(2 * static_cast<std::size_t>(cycle), 0);
    if (!(range > 0))
      refuse(fmt::format("the force is {:g} N in all rows of cycle {}, and must vary",
                         force[2 * cycle][0] * loops_.width, cycle + 1),
             first);
    const double longest = std::max(way(2 * cycle), way(2 * cycle + 1));
    const double area = loop_area(loops_, force, cycle) / (range * longest);
    const double rise = slope(force, cycle) * longest / range;
    // Weight makes a strip that bends up push less as it goes on.
    const bool falls = rise < -kFallOfFriction && (!loops_.bends_up() || area < -kWorkOfNoise);
    if (falls)
      refuse(fmt::format("in cycle {} forces fall as the clamps part, and must rise, tension being positive: "
                         "turn the sign of the forces",
                         cycle + 1),
             first);
    if (area < -kWorkOfNoise)
      refuse(fmt::format("over cycle {} the strip gives back more work than it takes: its rows run backwards "
                         "in time, or the sign of the forces is turned",
                         cycle + 1),
             first);
  }

 private:
  [[noreturn]] void refuse(const std::string& what, const std::string& line = "") const {
    throw Error::request(file_ + line + ": " + loops_.name() + ": " + what).in(reader_);
  }

  // ":17" of a row that was read there.
  std::string line(std::size_t b, std::size_t row) const {
    const std::vector<int>& lines = loops_.branches[b].lines;
    return lines.empty() ? "" : ":" + std::to_string(lines[row]);
  }

  // 1 where the clamps part on this branch, -1 where they approach.
  int sense(std::size_t b) const { return (b % 2 == 0) == loops_.bends() ? -1 : 1; }

  // [m]
  double way(std::size_t b) const {
    const auto [low, high] =
        std::minmax_element(loops_.branches[b].distance.begin(), loops_.branches[b].distance.end());
    return *high - *low;
  }

  // The first row at which the clamps, going by this sense, have come back by more than a ripple; none: the
  // number of rows.
  std::size_t comes_back(std::size_t b, int sense) const {
    const std::vector<double>& distance = loops_.branches[b].distance;
    double farthest = -INFINITY;
    for (std::size_t i = 0; i < distance.size(); ++i) {
      farthest = std::max(farthest, sense * distance[i]);
      if (farthest - sense * distance[i] > kRipple * way(b)) return i;
    }
    return distance.size();
  }

  void order(std::size_t b) const {
    if (!(way(b) > 0)) refuse(fmt::format("the clamps do not move on branch {}", b));
    const std::vector<double>& distance = loops_.branches[b].distance;
    const std::size_t row = comes_back(b, sense(b));
    if (row == distance.size()) return;
    const std::string must = sense(b) > 0 ? "part the clamps" : "bring the clamps together";
    if (comes_back(b, -sense(b)) == distance.size())
      refuse(
          fmt::format("branch {} goes the wrong way: it must {} (branches 0, 2, ... go out, 1, 3, ... back)",
                      b, must),
          line(b, row));
    refuse(
        fmt::format("clamps at {:g} m lie back by more than {:g} % of the way of branch {}, which must {}: "
                    "rows must stand in the order in which they were measured",
                    distance[row], 100 * kRipple, b, must),
        line(b, row));
  }

  // Of the straight line of force against distance through the cycle [N/m^2].
  double slope(const BranchForces& force, int cycle) const {
    double n = 0, d = 0, f = 0, dd = 0, df = 0;
    for (int b = 2 * cycle; b <= 2 * cycle + 1; ++b)
      for (std::size_t i = 0; i < force[b].size(); ++i) {
        const double x = loops_.branches[b].distance[i] - loops_.gauge, y = force[b][i];
        n += 1, d += x, f += y, dd += x * x, df += x * y;
      }
    return (df - d * f / n) / (dd - d * d / n);
  }

  const FabLoops& loops_;
  std::string file_, reader_;
};

}  // namespace

void check_fab_way(const FabLoops& loops, const std::string& file, const std::string& reader) {
  const Checks checks(loops, file, reader);
  checks.names();
  checks.lengths();
  for (std::size_t b = 0; b < loops.branches.size(); ++b) checks.branch(b);
  if (loops.branches.size() % 2 != 0)
    throw Error::request(file + ": " + loops.name() + ": every cycle has a branch out and one back")
        .in(reader);
  checks.start();
}

void check_fab_forces(const FabLoops& loops, const std::string& file, const std::string& reader) {
  const Checks checks(loops, file, reader);
  for (int cycle = 0; cycle < loops.cycles(); ++cycle) checks.forces(cycle);
}

}  // namespace hysteron
