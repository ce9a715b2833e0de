#include "sim/reference/fab_loops.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "sim/base/error.h"
#include "sim/reference/tester_table.h"

namespace hysteron {
namespace {

namespace fs = std::filesystem;

constexpr double kGramForce = 9.80665e-3;         // [N], by definition
constexpr double kCentimetre = 1e-2;              // [m]
constexpr double kShortest = 1e-3, kLongest = 1;  // [m] no such strip is shorter or longer
constexpr int kFewestRows = 4;                    // of a branch

struct UnitNames {
  const char *length, *force;
  double metre, newton;
};

UnitNames names_of(TesterUnits units) {
  if (units == TesterUnits::si) return {"_m", "_N", 1, 1};
  return {"_cm", "_gf", kCentimetre, kGramForce};
}

struct Columns {
  std::size_t direction, test, branch, distance, force, gauge, width;
};

std::size_t column_of(const TextTable& table, const std::string& name, const fs::path& file,
                      const std::string& reader) {
  const auto found = std::find(table.head.begin(), table.head.end(), name);
  if (found == table.head.end())
    throw Error::request(file.filename().string() + " has no column " + name +
                         " (--units si: _m and _N, --units fab: _cm and _gf)")
        .in(reader);
  return static_cast<std::size_t>(found - table.head.begin());
}

Columns columns_of(const TextTable& table, const UnitNames& unit, const fs::path& file,
                   const std::string& reader) {
  const auto at = [&](const std::string& name) { return column_of(table, name, file, reader); };
  return {at("direction"),
          at("test"),
          at("branch"),
          at(std::string("clamp_distance") + unit.length),
          at(std::string("force") + unit.force),
          at(std::string("gauge_length") + unit.length),
          at(std::string("width") + unit.length)};
}

FabLoops& loops_of(std::vector<FabLoops>& all, const std::string& direction, const std::string& test) {
  for (FabLoops& loops : all)
    if (loops.direction == direction && loops.test == test) return loops;
  all.push_back({direction, test, 0, 0, {}});
  return all.back();
}

void check(const FabLoops& loops, const std::string& where, const std::string& reader) {
  const auto refuse = [&](const std::string& what) {
    throw Error::request(where + ": " + loops.name() + ": " + what).in(reader);
  };
  if (std::string("UDS").find(loops.test.front()) == std::string::npos) refuse("a test is U.., D.. or S..");
  if (loops.branches.size() % 2 != 0) refuse("every cycle has a branch out and one back");
  for (const double length : {loops.gauge, loops.width})
    if (!(length >= kShortest && length <= kLongest))
      refuse("a length of " + std::to_string(length) + " m is not one of a strip, " +
             std::to_string(kShortest) + " to " + std::to_string(kLongest) + " m: other units than said?");
  for (const FabBranch& branch : loops.branches) {
    if (branch.force.size() < kFewestRows) refuse("a branch has fewer than 4 rows");
    for (const double distance : branch.distance)
      if (!(distance > 0 && distance < 3 * loops.gauge) || (loops.bends() && distance >= loops.gauge))
        refuse("clamps at " + std::to_string(distance) + " m do not fit a gauge of " +
               std::to_string(loops.gauge) + " m");
  }
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

std::vector<FabLoops> read_fab(const fs::path& file, TesterUnits units, const std::string& reader) {
  const UnitNames unit = names_of(units);
  const TextTable table = read_tester_table(file, std::string("clamp_distance") + unit.length, reader);
  const Columns c = columns_of(table, unit, file, reader);
  std::vector<FabLoops> all;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const auto number = [&](std::size_t column) { return number_of(table, row, column, file, reader); };
    const auto& words = table.rows[row];
    const std::string where = file.filename().string() + ":" + std::to_string(table.lines[row]);
    if (words[c.direction].empty() || words[c.test].empty())
      throw Error::request(where + " names no direction or no test").in(reader);
    FabLoops& loops = loops_of(all, words[c.direction], words[c.test]);
    const double branch = number(c.branch);
    if (branch == static_cast<double>(loops.branches.size())) loops.branches.emplace_back();
    if (loops.branches.empty() || branch + 1 != static_cast<double>(loops.branches.size()))
      throw Error::request(where + ": branch " + words[c.branch] + " does not follow branch " +
                           std::to_string(loops.branches.size()) + " - 1")
          .in(reader);
    loops.gauge = unit.metre * number(c.gauge);
    loops.width = unit.metre * number(c.width);
    loops.branches.back().distance.push_back(unit.metre * number(c.distance));
    loops.branches.back().force.push_back(unit.newton * number(c.force) / loops.width);
  }
  for (const FabLoops& loops : all) check(loops, file.filename().string(), reader);
  return all;
}

const FabLoops& find_loops(const std::vector<FabLoops>& all, const std::string& direction,
                           const std::string& test) {
  std::string there;
  for (const FabLoops& loops : all) {
    if (loops.direction == direction && loops.test == test) return loops;
    there += (there.empty() ? "" : ", ") + loops.name();
  }
  throw Error::request("the data have no " + direction + " " + test + "; they have " + there)
      .of("fab.test", test);
}

BranchForces forces_of(const FabLoops& loops) {
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
