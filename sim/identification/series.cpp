#include "sim/identification/series.h"

#include <algorithm>
#include <cmath>

#include "sim/base/csv.h"
#include "sim/base/error.h"
#include "sim/base/number_in.h"
#include "sim/base/plain_text.h"
#include "sim/base/rising_time.h"
#include "sim/identification/identification.h"
#include "sim/reference/tester_table.h"
#include "sim/scene/fabric_reader.h"
#include "sim/scene/key_table.h"

namespace hysteron {
namespace {

struct CurveUnits {
  const char *flag, *curvature, *moment;  // value of --units; units of the columns
  double per_metre, newton;               // one unit of each in 1/m and in N
};
constexpr CurveUnits kSi = {"si", "1/m", "N", 1, 1};
constexpr CurveUnits kKes = {"kes", "1/cm", "gf cm/cm", 100, kGramForceCentimetrePerCentimetre};

// A loop may give back this work, as a share of curvature range times moment range, before its rows must run
// backwards: noise around a curve without a loop does.
constexpr double kWorkOfNoise = 0.05;

double value_range(const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return *high - *low;
}

double largest_magnitude(const std::vector<double>& values) {
  double largest = 0;
  for (double value : values) largest = std::max(largest, std::abs(value));
  return largest;
}

// Returns the rows where the curvature turns by more than `noise`, with the first and the last row.
std::vector<int> turning_rows(const std::vector<double>& k, double noise) {
  std::vector<int> turns = {0};
  int extreme = 0, direction = 0;
  for (int i = 1; i < static_cast<int>(k.size()); ++i) {
    const double increment = k[i] - k[extreme];
    if (direction * increment > 0 || (direction == 0 && std::abs(increment) > noise)) {
      direction = increment > 0 ? 1 : -1;
      extreme = i;
    } else if (direction * increment < -noise) {
      turns.push_back(extreme);
      direction = -direction;
      extreme = i;
    }
  }
  turns.push_back(static_cast<int>(k.size()) - 1);
  return turns;
}

// Replaces values by the nearest monotone sequence by pooling adjacent violators (Ayer et al. 1955), in
// place.
void make_monotone(double* values, int count, double direction) {
  struct Pool {
    double mean;
    int size;
  };
  std::vector<Pool> pools;
  for (int i = 0; i < count; ++i) {
    pools.push_back({values[i], 1});
    while (pools.size() > 1 && direction * (pools[pools.size() - 2].mean - pools.back().mean) > 0) {
      const Pool last = pools.back();
      pools.pop_back();
      Pool& pool = pools.back();
      pool.mean = (pool.mean * pool.size + last.mean * last.size) / (pool.size + last.size);
      pool.size += last.size;
    }
  }
  for (const Pool& pool : pools) {
    for (int i = 0; i < pool.size; ++i) *values++ = pool.mean;
  }
}

// Returns the slope of the straight line through all rows [N m].
double overall_slope(const MomentSeries& series) {
  double k = 0, m = 0, kk = 0, km = 0;
  const double n = series.rows();
  for (int i = 0; i < series.rows(); ++i) {
    k += series.curvature[i] / n;
    m += series.moment[i] / n;
  }
  for (int i = 0; i < series.rows(); ++i) {
    kk += (series.curvature[i] - k) * (series.curvature[i] - k);
    km += (series.curvature[i] - k) * (series.moment[i] - m);
  }
  return km / kk;
}

// Returns the work of bending along the rows, as a share of curvature range times moment range.
double relative_work(const MomentSeries& series) {
  double work = 0;
  for (int i = 1; i < series.rows(); ++i) {
    work += (series.moment[i] + series.moment[i - 1]) / 2 * (series.drive[i] - series.drive[i - 1]);
  }
  return work / (value_range(series.drive) * value_range(series.moment));
}

// Rows are out of order if a way from one turn to the next has fewer rows on the average: shuffled rows have
// 1.5.
constexpr double kFewestRowsOfAWay = 2;

void check_order(const MomentSeries& series) {
  if (series.rows() >= kFewestRowsOfAWay * (series.reversals + 1)) return;
  throw Error::invalid_input(series.name + ": the curvature turns " + std::to_string(series.reversals) +
                             " times in " + std::to_string(series.rows()) +
                             " rows, which must stand in the order in which they were measured");
}

void check_magnitudes(const MomentSeries& series) {
  const double slope = overall_slope(series);
  if (!(slope > 0)) {
    throw Error::invalid_input(series.name + ": moments fall with curvature (slope " + number_text(slope, 4) +
                               " N m), and must rise: turn the sign of one of the columns");
  }
  check_rigidity(slope, "the slope of " + series.name);
  if (series.reversals > 0 && relative_work(series) < -kWorkOfNoise) {
    throw Error::invalid_input(series.name +
                               ": along its rows the fabric gives back more work than it takes; the "
                               "rows run backwards in time");
  }
}

// A measured curve as a table, in the order of its rows.
class CurveFile {
 public:
  CurveFile(const std::filesystem::path& file, const CurveUnits& units, const std::string& reader)
      : name_(file.filename().string()),
        units_(units),
        reader_(reader),
        table_(read_tester_table(
            file, [](const std::string& field) { return quantity_in(field) == "curvature"; },
            std::string("a column curvature [") + units.curvature + "]", reader)) {}

  MomentSeries series(double ripple) const {
    const int curvature = required("curvature"), moment = required("moment"), time = column("time");
    check_units(unit_in(table_.head[curvature]), unit_in(table_.head[moment]));
    MomentSeries series;
    series.name = name_;
    series.curvature = numbers(curvature, units_.per_metre);
    series.moment = numbers(moment, units_.newton);
    if (time >= 0) series.seconds = steps(time);
    prepare(series, ripple);
    return series;
  }

 private:
  Error refusal(const std::string& what) const {
    return Error::invalid_input(name_ + ": " + what).with_experiment(reader_);
  }

  // Returns -1 where no column has that quantity.
  int column(const std::string& quantity) const {
    int found = -1;
    for (int i = 0; i < static_cast<int>(table_.head.size()); ++i) {
      if (quantity_in(table_.head[i]) != quantity) continue;
      if (found >= 0) throw refusal("column '" + quantity + "' stands twice");
      found = i;
    }
    return found;
  }

  int required(const std::string& quantity) const {
    const int found = column(quantity);
    if (found < 0) throw refusal("column '" + quantity + "' is missing");
    return found;
  }

  void check_units(const std::string& curvature, const std::string& moment) const {
    const auto are = [&](const CurveUnits& units) {
      return curvature == plain_unit(units.curvature) && moment == plain_unit(units.moment);
    };
    if (are(units_)) return;
    const auto said = [](const CurveUnits& units) {
      return std::string("--units ") + units.flag + " reads " + units.curvature + " and " + units.moment;
    };
    for (const CurveUnits& other : {kSi, kKes})
      if (are(other))
        throw refusal("curvature is in " + curvature + " and moment in " + moment + ": give --units " +
                      other.flag + ", which reads these (" + said(units_) + ")");
    const bool first = curvature != plain_unit(units_.curvature);
    const std::string quantity = first ? "curvature" : "moment", unit = first ? curvature : moment;
    const std::string must = first ? units_.curvature : units_.moment;
    throw refusal(quantity + (unit.empty() ? " names no unit" : " is in " + unit) + " and must be in " +
                  must + ", '" + quantity + " [" + must + "]' (" + said(kSi) + ", " + said(kKes) +
                  "): convert numbers of other units, not their name");
  }

  std::vector<double> numbers(int column, double unit) const {
    std::vector<double> values = table_.numbers(static_cast<std::size_t>(column));
    for (double& value : values) value *= unit;
    return values;
  }

  // Returns the steps from the row before.
  std::vector<double> steps(int column) const {
    if (const std::string unit = unit_in(table_.head[column]); unit != "s")
      throw refusal("time " + (unit.empty() ? "names no unit" : "is in " + unit) +
                    " and must be in s, 'time [s]'");
    const std::vector<double> time = numbers(column, 1);
    check_time_rises(table_, time);
    std::vector<double> seconds(time.size(), 0);
    for (std::size_t i = 1; i < time.size(); ++i) seconds[i] = time[i] - time[i - 1];
    return seconds;
  }

  std::string name_;
  CurveUnits units_;
  std::string reader_;
  Table table_;
};

}  // namespace

double MomentSeries::largest_curvature() const { return largest_magnitude(drive); }
double MomentSeries::largest_moment() const { return largest_magnitude(moment); }

void check_rigidity(double value, const std::string& what) {
  if (value >= kMinRigidity && value <= kGreatestRigidity) return;
  const bool large = value > kGreatestRigidity;
  const double factor = kGramForceSquareCentimetrePerCentimetre;
  throw Error::invalid_input(
      what + " = " + number_text(value, 4) + " N m must be in [" + number_text(kMinRigidity) + ", " +
      number_text(kGreatestRigidity) + "] N m, as fabrics are; " +
      (large ? "KES prints gf cm^2/cm, which is 9.80665e-05 N m (moments in gf cm/cm: 0.00980665 N, "
               "curvatures in 1/cm: 100/m), and times 9.80665e-05 it is "
             : "converted from gf cm^2/cm twice? Divided by 9.80665e-05 it is ") +
      number_text(large ? value * factor : value / factor, 4) + " N m");
}

void prepare(MomentSeries& series, double ripple) {
  if (series.rows() < kFewestRows) {
    throw Error::invalid_input(series.name + ": " + std::to_string(series.rows()) + " rows, at least " +
                               std::to_string(kFewestRows) + " are needed");
  }
  const double range = value_range(series.curvature);
  if (!(range > 0)) {
    throw Error::invalid_input(series.name + ": the curvature is " + number_text(series.curvature.front()) +
                               " 1/m in all rows, and must vary");
  }
  if (!(value_range(series.moment) > 0)) {
    throw Error::invalid_input(series.name + ": the moment is " + number_text(series.moment.front()) +
                               " N in all rows, and must vary");
  }
  const std::vector<int> turns = turning_rows(series.curvature, ripple * range);
  series.turns.assign(turns.begin() + 1, turns.end() - 1);
  series.reversals = static_cast<int>(series.turns.size());
  series.drive = series.curvature;
  for (std::size_t i = 1; i < turns.size(); ++i) {
    const int first = turns[i - 1], last = turns[i];
    const double increment = series.curvature[last] - series.curvature[first];
    make_monotone(&series.drive[first], last - first + 1, increment >= 0 ? 1 : -1);
  }
  check_order(series);
  check_magnitudes(series);
}

MomentSeries read_series(const std::filesystem::path& file, double ripple, const std::string& reader) {
  return CurveFile(file, kSi, reader).series(ripple);
}

MomentSeries read_kes_series(const std::filesystem::path& file, double ripple, const std::string& reader) {
  return CurveFile(file, kKes, reader).series(ripple);
}

std::vector<LawRow> law_rows(const MomentSeries& series, bool cycling) {
  std::vector<LawRow> rows;
  for (int pass = cycling ? 0 : 1; pass < 2; ++pass) {
    for (int i = 0; i < series.rows(); ++i) {
      rows.push_back({series.drive[i], series.seconds.empty() ? 1 : series.seconds[i]});
    }
  }
  return rows;
}

}  // namespace hysteron
