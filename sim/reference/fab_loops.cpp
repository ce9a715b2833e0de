#include "sim/reference/fab_loops.h"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>

#include "sim/base/error.h"
#include "sim/reference/tester_table.h"

namespace hysteron {

namespace {

constexpr double kShortest = 1e-3, kLongest = 1;  // a strip is neither shorter nor longer [m]
constexpr double kMaxStretch = 3;                 // over the gauge
constexpr int kFewestRows = 4;                    // per branch
constexpr double kRipple = 0.05;  // over a branch's way, by which the clamps may come back: they turn late
constexpr double kGap = 0.3;  // over a branch's way, between its first row and the last of the branch before
constexpr double kWorkOfNoise = 0.05;  // share of force range times way: noise may give back this work
constexpr const char* kWithinDrift =
    ", by no more than they drift, or than another cycle contradicts: their sign is doubtful";
constexpr double kFallOfFriction = 0.2;  // over force range and way: friction alone has no slope

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
          !(d > 0 && d < kMaxStretch * loops_.gauge) || (loops_.bends() && d >= loops_.gauge))
        refuse(fmt::format("clamps at {:g} m do not fit a gauge of {:g} m", d, loops_.gauge), line(b, i));
    order(b);
    if (b > 0 && std::abs(distance.front() - loops_.branches[b - 1].distance.back()) > kGap * clamp_travel(b))
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

  // Warns of doubtful forces in a cycle, whose noise is given [N]; "" where there are none.
  std::string forces(int cycle, double noise) const {
    const BranchForces force = branch_forces(loops_);
    const double range = force_range(force, cycle);
    const std::string first = line(2 * static_cast<std::size_t>(cycle), 0);
    if (!(range > 0))
      refuse(fmt::format("the force is {:g} N in all rows of cycle {}, and must vary",
                         force[2 * cycle][0] * loops_.width, cycle + 1),
             first);
    const double longest = std::max(clamp_travel(2 * cycle), clamp_travel(2 * cycle + 1));
    const double area = loop_area(loops_, force, cycle) / (range * longest);
    const double rise = slope(force, cycle) * longest / range;
    const double unsure = drift(force, cycle) / range + noise / loops_.width / range;
    // Weight makes a strip that bends up push less as it goes on.
    if (rise < -kFallOfFriction && (!loops_.bends_up() || area < -kWorkOfNoise)) {
      const std::string falls = fmt::format("in cycle {} forces fall as the clamps part", cycle + 1);
      if (-rise > unsure && !rises_elsewhere(force, cycle))
        refuse(falls + ", and must rise, tension being positive: turn the sign of the forces", first);
      return falls + kWithinDrift;
    }
    if (area >= -kWorkOfNoise) return "";
    const std::string gives =
        fmt::format("over cycle {} the strip gives back more work than it takes", cycle + 1);
    if (-area > unsure / 2)
      refuse(gives + ": its rows run backwards in time, or the sign of the forces is turned", first);
    return gives + kWithinDrift;
  }

 private:
  [[noreturn]] void refuse(const std::string& what, const std::string& line = "") const {
    throw Error::invalid_input(file_ + line + ": " + loops_.name() + ": " + what).with_experiment(reader_);
  }

  // Returns the line of a row that was read there: ":17".
  std::string line(std::size_t b, std::size_t row) const {
    const std::vector<int>& lines = loops_.branches[b].lines;
    return lines.empty() ? "" : ":" + std::to_string(lines[row]);
  }

  // Returns 1 where the clamps part on this branch, -1 where they approach.
  int sense(std::size_t b) const { return (b % 2 == 0) == loops_.bends() ? -1 : 1; }

  // Returns how far the clamps travel on a branch [m].
  double clamp_travel(std::size_t b) const {
    const auto [low, high] =
        std::minmax_element(loops_.branches[b].distance.begin(), loops_.branches[b].distance.end());
    return *high - *low;
  }

  // Returns the first row at which the clamps, going by this sense, have come back by more than a ripple, or
  // the number of rows if there is none.
  std::size_t comes_back(std::size_t b, int sense) const {
    const std::vector<double>& distance = loops_.branches[b].distance;
    double farthest = -INFINITY;
    for (std::size_t i = 0; i < distance.size(); ++i) {
      farthest = std::max(farthest, sense * distance[i]);
      if (farthest - sense * distance[i] > kRipple * clamp_travel(b)) return i;
    }
    return distance.size();
  }

  void order(std::size_t b) const {
    if (!(clamp_travel(b) > 0)) refuse(fmt::format("the clamps do not move on branch {}", b));
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

  // Returns the difference of the force from the cycle's beginning to its end [N/m], due to the instrument's
  // drift and to friction.
  static double drift(const BranchForces& force, int cycle) {
    return std::abs(force[2 * cycle + 1].back() - force[2 * cycle].front());
  }

  // Does the force rise in another cycle? A tester's sign is the same for the whole record.
  bool rises_elsewhere(const BranchForces& force, int cycle) const {
    for (int other = 0; other < loops_.cycles(); ++other) {
      const double range = force_range(force, other);
      if (other != cycle && range > 0 &&
          slope(force, other) * clamp_travel(2 * other) > kFallOfFriction * range)
        return true;
    }
    return false;
  }

  // Returns the slope of the straight line of force against distance through the cycle [N/m^2].
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

void check_clamp_path(const FabLoops& loops, const std::string& file, const std::string& reader) {
  const Checks checks(loops, file, reader);
  checks.names();
  checks.lengths();
  for (std::size_t b = 0; b < loops.branches.size(); ++b) checks.branch(b);
  if (loops.branches.size() % 2 != 0)
    throw Error::invalid_input(file + ": " + loops.name() + ": every cycle has a branch out and one back")
        .with_experiment(reader);
  checks.start();
}

namespace {

namespace fs = std::filesystem;

constexpr double kGramForce = 9.80665e-3;  // [N], by definition
constexpr double kCentimetre = 1e-2;       // [m]

struct UnitNames {
  const char *flag, *length, *force;  // value of --units; endings of columns
  double metre, newton;
};
constexpr UnitNames kSi = {"si", "_m", "_N", 1, 1};
constexpr UnitNames kFab = {"fab", "_cm", "_gf", kCentimetre, kGramForce};

struct Columns {
  std::size_t direction, test, branch, distance, force, gauge, width;
};

// Returns "clamp_distance_m" for "Clamp distance [m]" and "Clamp_distance_m": names are compared in small
// letters, units as they are.
std::string fab_column(const std::string& field) {
  std::string name = quantity_in(field), unit = unit_in(field);
  std::replace(name.begin(), name.end(), ' ', '_');
  if (!unit.empty()) return name + "_" + unit;
  const std::size_t ending = field.rfind('_');
  if (ending == field.npos || name.size() != field.size()) return name;
  return name.substr(0, ending) + field.substr(ending);
}

// Returns "m" for "clamp_distance_m"; none unless the column is of that quantity.
std::optional<std::string> column_unit(const std::string& column, const std::string& quantity) {
  if (!column.starts_with(quantity)) return std::nullopt;
  const std::string ending = column.substr(quantity.size());
  if (ending.empty()) return "";
  return ending.front() == '_' ? std::optional(ending.substr(1)) : std::nullopt;
}

std::string unit_sentence(const UnitNames& units) {
  return std::string("--units ") + units.flag + " reads " + (units.length + 1) + " and " + (units.force + 1);
}

// Finds the column of a length or a force; if it is there in other units, the error names them.
std::size_t column_index(const Table& table, const std::string& quantity, const char* ending) {
  for (const std::string& column : table.head) {
    const std::optional<std::string> unit = column_unit(column, quantity);
    if (!unit || *unit == ending + 1) continue;
    const auto has_units = [&](const UnitNames& units) {
      return *unit == units.length + 1 || *unit == units.force + 1;
    };
    const std::string read = unit_sentence(kSi) + ", " + unit_sentence(kFab);
    std::string what = " is in " + *unit;
    if (unit->empty())
      what = " names no unit: it must be " + quantity + ending;
    else if (!has_units(kSi) && !has_units(kFab))
      what += ": convert its numbers";
    else
      what += std::string(": give --units ") + (has_units(kSi) ? kSi : kFab).flag + ", which reads it";
    throw Error::invalid_input(table.file + ": " + quantity + what + " (" + read + ")")
        .with_experiment(table.reader);
  }
  return table.at(quantity + ending);
}

void check_columns_once(const Table& table, const UnitNames& unit) {
  const std::string length = unit.length, force = unit.force;
  for (const std::string& wanted :
       {std::string("direction"), std::string("test"), std::string("branch"), "clamp_distance" + length,
        "force" + force, "gauge_length" + length, "width" + length})
    if (std::count(table.head.begin(), table.head.end(), wanted) > 1)
      throw Error::invalid_input(table.file + ": column '" + wanted + "' stands twice")
          .with_experiment(table.reader);
}

Columns loop_columns(const Table& table, const UnitNames& unit) {
  check_columns_once(table, unit);
  const auto in = [&](const std::string& quantity, const char* ending) {
    return column_index(table, quantity, ending);
  };
  return {table.at("direction"),   table.at("test"),
          table.at("branch"),      in("clamp_distance", unit.length),
          in("force", unit.force), in("gauge_length", unit.length),
          in("width", unit.length)};
}

FabLoops& loops_entry(std::vector<FabLoops>& all, const std::string& direction, const std::string& test) {
  for (FabLoops& loops : all)
    if (loops.direction == direction && loops.test == test) return loops;
  all.push_back({direction, test, 0, 0, {}});
  return all.back();
}

double mean_force(const BranchForces& force, int cycle) {
  double sum = 0;
  std::size_t count = 0;
  for (int b = 2 * cycle; b <= 2 * cycle + 1; ++b) {
    for (const double f : force[b]) sum += f;
    count += force[b].size();
  }
  return sum / static_cast<double>(count);
}

std::pair<double, double> extremes(const BranchForces& force, int cycle) {
  const auto [low, high] = std::minmax_element(force[2 * cycle].begin(), force[2 * cycle].end());
  const auto [low_back, high_back] =
      std::minmax_element(force[2 * cycle + 1].begin(), force[2 * cycle + 1].end());
  return {std::min(*low, *low_back), std::max(*high, *high_back)};
}

}  // namespace

namespace {

// Checks the requested cycles of a test that is asked for; of other tests it checks whether the clamps' way
// can be followed at all.
void check_loops(FabLoops& loops, const FabRequest& request, const std::string& file,
                 const std::string& reader) {
  if (request.asks_for && !request.asks_for(loops)) {
    try {
      check_clamp_path(loops, file, reader);
    } catch (const Error& error) {
      loops.is_usable = false;
      loops.warnings.push_back(std::string("not predicted: ") + error.what());
    }
    return;
  }
  check_clamp_path(loops, file, reader);
  const Checks checks(loops, file, reader);
  for (int cycle = 0; cycle < loops.cycles(); ++cycle) {
    const std::vector<int>& cycles = request.cycles;
    if (!cycles.empty() && std::find(cycles.begin(), cycles.end(), cycle + 1) == cycles.end()) continue;
    const std::string warning = checks.forces(cycle, request.noise);
    if (!warning.empty()) loops.warnings.push_back(loops.name() + ": " + warning);
  }
}

}  // namespace

std::vector<FabLoops> read_fab(const fs::path& file, TesterUnits units, const std::string& reader,
                               const FabRequest& request) {
  const UnitNames& unit = units == TesterUnits::si ? kSi : kFab;
  const std::string distance = "clamp_distance";
  Table table = read_tester_table(
      file, [&](const std::string& field) { return column_unit(fab_column(field), distance).has_value(); },
      "a column " + distance + unit.length, reader);
  for (std::string& column : table.head) column = fab_column(column);
  const Columns c = loop_columns(table, unit);
  std::vector<FabLoops> all;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const auto number = [&](std::size_t column) { return table.finite(row, column); };
    const auto& words = table.rows[row];
    if (words[c.direction].empty() || words[c.test].empty())
      throw Error::invalid_input(table.file + ":" + std::to_string(table.lines[row]) +
                                 " names no direction or no test")
          .with_experiment(reader);
    FabLoops& loops = loops_entry(all, words[c.direction], words[c.test]);
    const double branch = number(c.branch);
    const std::size_t next = loops.branches.size();
    if (branch == static_cast<double>(next)) loops.branches.emplace_back();
    if (loops.branches.empty() || branch + 1 != static_cast<double>(loops.branches.size()))
      throw table.refusal(row, "branch " + words[c.branch] + " must be " +
                                   (next > 0 ? std::to_string(next - 1) + " or " : "") +
                                   std::to_string(next) +
                                   ": the rows of a test stand in the order of its branches, 0, 1, 2 ...");
    const auto same = [&](double& of_test, std::size_t column) {
      const double here = unit.metre * number(column);
      if (of_test != 0 && here != of_test)
        throw table.refusal(row, table.head[column] + " = " + words[column] +
                                     " differs from that of the rows before, and one test has one strip");
      of_test = here;
    };
    same(loops.gauge, c.gauge);
    same(loops.width, c.width);
    loops.branches.back().lines.push_back(table.lines[row]);
    loops.branches.back().distance.push_back(unit.metre * number(c.distance));
    loops.branches.back().force.push_back(unit.newton * number(c.force) / loops.width);
  }
  for (FabLoops& loops : all) check_loops(loops, request, table.file, reader);
  return all;
}

const FabLoops& find_loops(const std::vector<FabLoops>& all, const std::string& direction,
                           const std::string& test) {
  std::string there;
  for (const FabLoops& loops : all) {
    if (loops.direction == direction && loops.test == test) return loops;
    there += (there.empty() ? "" : ", ") + loops.name();
  }
  throw Error::invalid_input("the data have no " + direction + " " + test + "; they have " + there)
      .with_key("fab.test", test);
}

BranchForces branch_forces(const FabLoops& loops) {
  BranchForces forces;
  for (const FabBranch& branch : loops.branches) forces.push_back(branch.force);
  return forces;
}

double loop_area(const FabLoops& loops, const BranchForces& force, int cycle) {
  const double zero = mean_force(force, cycle);
  double work = 0;
  for (int b = 2 * cycle; b <= 2 * cycle + 1; ++b)
    for (std::size_t i = 1; i < force[b].size(); ++i)
      work += ((force[b][i - 1] + force[b][i]) / 2 - zero) *
              (loops.branches[b].distance[i] - loops.branches[b].distance[i - 1]);
  return work;
}

double force_range(const BranchForces& force, int cycle) {
  const auto [low, high] = extremes(force, cycle);
  return high - low;
}

double peak_force(const FabLoops& loops, const BranchForces& force, int cycle) {
  const auto [low, high] = extremes(force, cycle);
  return loops.bends() ? -low : high;
}

}  // namespace hysteron
