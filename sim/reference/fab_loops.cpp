#include "sim/reference/fab_loops.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>

#include "sim/base/error.h"
#include "sim/reference/fab_checks.h"
#include "sim/reference/tester_table.h"

namespace hysteron {
namespace {

namespace fs = std::filesystem;

constexpr double kGramForce = 9.80665e-3;  // [N], by definition
constexpr double kCentimetre = 1e-2;       // [m]

struct UnitNames {
  const char *flag, *length, *force;  // of --units; endings of columns
  double metre, newton;
};
constexpr UnitNames kSi = {"si", "_m", "_N", 1, 1};
constexpr UnitNames kFab = {"fab", "_cm", "_gf", kCentimetre, kGramForce};

struct Columns {
  std::size_t direction, test, branch, distance, force, gauge, width;
};

// "m" of "clamp_distance_m"; none unless the column is of that quantity.
std::optional<std::string> unit_of(const std::string& column, const std::string& quantity) {
  if (!column.starts_with(quantity)) return std::nullopt;
  const std::string ending = column.substr(quantity.size());
  if (ending.empty()) return "";
  return ending.front() == '_' ? std::optional(ending.substr(1)) : std::nullopt;
}

std::string said_of(const UnitNames& units) {
  return std::string("--units ") + units.flag + " reads " + (units.length + 1) + " and " + (units.force + 1);
}

std::size_t column_of(const TextTable& table, const std::string& name, const fs::path& file,
                      const std::string& reader) {
  const auto found = std::find(table.head.begin(), table.head.end(), name);
  if (found != table.head.end()) return static_cast<std::size_t>(found - table.head.begin());
  throw Error::request(file.filename().string() + " has no column " + name).in(reader);
}

// A length or a force; where it is there in other units, these are named.
std::size_t column_of(const TextTable& table, const std::string& quantity, const char* ending,
                      const fs::path& file, const std::string& reader) {
  for (const std::string& column : table.head) {
    const std::optional<std::string> unit = unit_of(column, quantity);
    if (!unit || *unit == ending + 1) continue;
    const auto is_of = [&](const UnitNames& units) {
      return *unit == units.length + 1 || *unit == units.force + 1;
    };
    const std::string read = said_of(kSi) + ", " + said_of(kFab);
    const std::string what = file.filename().string() + ": " + quantity;
    if (unit->empty())
      throw Error::request(what + " names no unit: it must be " + quantity + ending + " (" + read + ")")
          .in(reader);
    if (!is_of(kSi) && !is_of(kFab))
      throw Error::request(what + " is in " + *unit + ": convert its numbers (" + read + ")").in(reader);
    throw Error::request(what + " is in " + *unit + ": give --units " + (is_of(kSi) ? kSi : kFab).flag +
                         ", which reads it (" + read + ")")
        .in(reader);
  }
  return column_of(table, quantity + ending, file, reader);
}

Columns columns_of(const TextTable& table, const UnitNames& unit, const fs::path& file,
                   const std::string& reader) {
  const auto at = [&](const std::string& name) { return column_of(table, name, file, reader); };
  const auto in = [&](const std::string& quantity, const char* ending) {
    return column_of(table, quantity, ending, file, reader);
  };
  return {at("direction"),
          at("test"),
          at("branch"),
          in("clamp_distance", unit.length),
          in("force", unit.force),
          in("gauge_length", unit.length),
          in("width", unit.length)};
}

FabLoops& loops_of(std::vector<FabLoops>& all, const std::string& direction, const std::string& test) {
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

std::vector<FabLoops> read_fab(const fs::path& file, TesterUnits units, const std::string& reader) {
  const UnitNames& unit = units == TesterUnits::si ? kSi : kFab;
  const std::string distance = "clamp_distance";
  const TextTable table = read_tester_table(
      file, [&](const std::string& field) { return unit_of(field, distance).has_value(); },
      "a column " + distance + unit.length, reader);
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
    const std::size_t next = loops.branches.size();
    if (branch == static_cast<double>(next)) loops.branches.emplace_back();
    if (loops.branches.empty() || branch + 1 != static_cast<double>(loops.branches.size()))
      throw Error::request(where + ": branch " + words[c.branch] + " must be " +
                           (next > 0 ? std::to_string(next - 1) + " or " : "") + std::to_string(next) +
                           ": the rows of a test stand in the order of its branches, 0, 1, 2 ...")
          .in(reader);
    const auto same = [&](double& of_test, std::size_t column) {
      const double here = unit.metre * number(column);
      if (of_test != 0 && here != of_test)
        throw Error::request(where + ": " + table.head[column] + " = " + words[column] +
                             " differs from that of the rows before, and one test has one strip")
            .in(reader);
      of_test = here;
    };
    same(loops.gauge, c.gauge);
    same(loops.width, c.width);
    loops.branches.back().lines.push_back(table.lines[row]);
    loops.branches.back().distance.push_back(unit.metre * number(c.distance));
    loops.branches.back().force.push_back(unit.newton * number(c.force) / loops.width);
  }
  for (const FabLoops& loops : all) {
    check_fab_way(loops, file.filename().string(), reader);
    check_fab_forces(loops, file.filename().string(), reader);
  }
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
