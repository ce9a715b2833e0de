#include "sim/identification/kes_sheet.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "sim/base/csv.h"
#include "sim/base/error.h"
#include "sim/base/plain_text.h"
#include "sim/base/units.h"
#include "sim/reference/kes_in_plane.h"
#include "sim/scene/key_table.h"
#include "sim/scene/toml_file.h"

namespace hysteron {
namespace {

// A row of the sheet: its unit as KES-F prints it, what that is in SI, and between which printed numbers
// clothing has it (Kawabata 1980; the six denims of Kumari & Khurana 2016 and the four shipped pairs lie well
// within).  Beyond a half and twice of these a number is another unit's.
struct Quantity {
  const char *name, *unit, *si, *meaning;
  double low, high;
  bool has_directions;
};
constexpr Quantity kQuantities[] = {
    {"LT", "1", "", "linearity of tension", 0.3, 1.3, true},
    {"WT", "gf cm/cm^2", "J/m2", "work of tension up to 500 gf/cm", 0.5, 80, true},
    {"RT", "%", "", "resilience of tension", 15, 100, true},
    {"EMT", "%", "", "extension at 500 gf/cm", 0.5, 80, true},
    {"B", "gf cm^2/cm", "N m", "bending rigidity", 0.004, 2, true},
    {"2HB", "gf cm/cm", "N", "width of the loop of bending at 1/cm", 0.002, 2, true},
    {"G", "gf/(cm degree)", "N/m", "shear rigidity", 0.15, 8, true},
    {"2HG", "gf/cm", "N/m", "width of the loop of shear at 0.5 degree", 0.1, 15, true},
    {"2HG5", "gf/cm", "N/m", "width of the loop of shear at 5 degrees", 0.1, 20, true},
    {"LC", "1", "", "linearity of compression", 0.1, 1.1, false},
    {"WC", "gf cm/cm^2", "J/m2", "work of compression up to 50 gf/cm^2", 0.01, 4, false},
    {"RC", "%", "", "resilience of compression", 15, 100, false},
    {"MIU", "1", "", "mean coefficient of friction", 0.06, 0.7, true},
    {"MMD", "1", "", "mean deviation of MIU", 0.002, 0.2, true},
    {"SMD", "um", "m", "roughness", 0.5, 40, true},
    {"T0", "mm", "m", "thickness at 0.5 gf/cm^2", 0.08, 8, false},
    {"TM", "mm", "m", "thickness at 50 gf/cm^2", 0.05, 6, false},
    {"W", "mg/cm^2", "kg/m^2", "weight", 2, 120, false},
};
constexpr double kBeyond = 2;

constexpr double kLargestTension = InPlaneProtocol().largest;  // [N/m]
constexpr double kLargestPressure = 50 * 98.0665;              // [Pa]
constexpr double kPrinted = 0.1;  // numbers of two digits contradict each other beyond
const char* const kColumns[] = {"warp", "weft", "mean"};

const Quantity* quantity_named(const std::string& name) {
  const auto lower = [](const std::string& text) {
    std::string result;
    for (const char c : text)
      if (c != ' ') result += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return result;
  };
  for (const Quantity& quantity : kQuantities)
    if (lower(quantity.name) == lower(name)) return &quantity;
  return nullptr;
}

std::vector<std::string> quantity_names() {
  std::vector<std::string> names;
  for (const Quantity& quantity : kQuantities) names.emplace_back(quantity.name);
  return names;
}

Error refusal(const std::string& what, const std::string& place) {
  return Error::invalid_input("fit --kes-sheet: " + what + " (" + place + ")").with_key("kes-sheet", "");
}

const Quantity& known_quantity(const std::string& name, const std::string& place) {
  if (name.empty())
    throw refusal(
        "the row names no quantity; a cell that was merged over several rows has to be filled in each",
        place);
  if (const Quantity* found = quantity_named(name)) return *found;
  const std::string nearest = nearest_name(name, quantity_names());
  throw refusal("unknown quantity " + name + (nearest.empty() ? "" : ", did you mean " + nearest + "?") +
                    "; there are " + join(quantity_names(), ", "),
                place);
}

double unit_of(const Quantity& quantity, const std::string& unit, const std::string& place) {
  // Ratios that are printed in percent, and numbers without a unit.
  const std::string given = plain_unit(unit.empty() ? quantity.unit : unit);
  if (const auto factor = factor_to(quantity.si, given)) return *factor;
  const std::string others = known_units(quantity.si);
  throw refusal(std::string(quantity.name) + " has unit \"" + unit + "\" and must have \"" + quantity.unit +
                    "\"" + (others.empty() ? "" : " or one of " + others),
                place);
}

// A number that clothing does not have, with the unit in which it would.
void check_size(const Quantity& quantity, double si, const std::string& shown, const std::string& place) {
  const double printed = *factor_to(quantity.si, quantity.unit);
  const auto fits = [&](double value) {
    return value >= quantity.low * printed / kBeyond && value <= quantity.high * printed * kBeyond;
  };
  if (fits(si)) return;
  std::string hint;
  for (const double slip :
       {98.0665, 1 / 98.0665, 9.80665, 1 / 9.80665, 10.0, 0.1, 100.0, 0.01, 1000.0, 0.001})
    if (hint.empty() && fits(si * slip))
      hint = "; " + number_text(slip, 3) + " times as much would be one: is it in another unit?";
  throw refusal(std::string(quantity.name) + " = " + shown + " is no fabric's: between " +
                    number_text(quantity.low) + " and " + number_text(quantity.high) + " " + quantity.unit +
                    " are usual" + hint,
                place);
}

void add(KesSheet& sheet, const Quantity& quantity, SheetRow row) {
  if (sheet.has(quantity.name))
    throw refusal(std::string(quantity.name) + " stands twice, also in " + sheet.row[quantity.name].place,
                  row.place);
  sheet.row[quantity.name] = std::move(row);
}

// ---- CSV ----

std::string lower_trimmed(const std::string& text) {
  std::string result(trimmed(text));
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

std::optional<std::size_t> column_named(const Table& table, std::initializer_list<const char*> names) {
  for (std::size_t c = 0; c < table.head.size(); ++c)
    for (const char* name : names)
      if (lower_trimmed(table.head[c]) == name) return c;
  return std::nullopt;
}

struct CsvColumns {
  std::size_t quantity;
  std::optional<std::size_t> unit, value[3];
};

CsvColumns csv_columns(const Table& table, const std::string& file) {
  const auto quantity = column_named(table, {"quantity", "property", "parameter", "symbol"});
  CsvColumns columns{quantity.value_or(0),
                     column_named(table, {"unit", "units"}),
                     {column_named(table, {"warp", "wp"}), column_named(table, {"weft", "wf", "filling"}),
                      column_named(table, {"mean", "value", "average"})}};
  if (!quantity || !(columns.value[0] || columns.value[2]))
    throw refusal("the first line must name the columns quantity, unit, warp, weft, mean; it has " +
                      join(table.head, ", "),
                  file + ":1");
  return columns;
}

SheetRow row_of_csv(const Table& table, std::size_t i, const CsvColumns& columns, const Quantity& quantity,
                    const std::string& place) {
  SheetRow row;
  row.place = place;
  if (columns.unit) row.unit = std::string(trimmed(table.rows[i][*columns.unit]));
  const double factor = unit_of(quantity, row.unit, place);
  for (int c = 0; c < 3; ++c) {
    if (!columns.value[c] || trimmed(table.rows[i][*columns.value[c]]).empty()) continue;
    row.value[c] = factor * table.finite(i, *columns.value[c]);
    check_size(quantity, row.value[c],
               std::string(trimmed(table.rows[i][*columns.value[c]])) + " " + row.unit,
               place + ", column " + kColumns[c]);
  }
  return row;
}

void read_csv_sheet(const std::filesystem::path& file, KesSheet& sheet) {
  Table table = read_table(file);
  table.reader = "fit --kes-sheet";
  const std::string name = file.filename().string();
  const CsvColumns columns = csv_columns(table, name);
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const std::string place = name + ":" + std::to_string(table.lines[i]),
                      named(trimmed(table.rows[i][columns.quantity]));
    if (lower_trimmed(named) == "name") {
      for (const auto& c : columns.value)
        if (c && !trimmed(table.rows[i][*c]).empty()) sheet.name = std::string(trimmed(table.rows[i][*c]));
      continue;
    }
    const Quantity& quantity = known_quantity(named, place);
    SheetRow row = row_of_csv(table, i, columns, quantity, place);
    if (std::any_of(std::begin(row.value), std::end(row.value), [](double x) { return x == x; }))
      add(sheet, quantity, std::move(row));  // a row that was not filled in says nothing
  }
}

// ---- TOML ----

double toml_number(const ValueTree& node, const std::string& place) {
  const auto* integer = std::get_if<std::int64_t>(&node.value);
  const auto* real = std::get_if<double>(&node.value);
  if (node.kind != ValueTree::Kind::value || (!integer && !real))
    throw refusal(node.key + " must be a number", place);
  return integer ? static_cast<double>(*integer) : *real;
}

void read_toml_sheet(const std::filesystem::path& file, KesSheet& sheet) {
  const ValueTree root = read_toml(file.string());
  for (const ValueTree& node : root.children) {
    const std::string place = file.filename().string() + ":" + std::to_string(node.line);
    if (node.key == "name") {
      if (const auto* name = std::get_if<std::string>(&node.value)) sheet.name = *name;
      continue;
    }
    const Quantity& quantity = known_quantity(node.key, place);
    SheetRow row;
    row.place = place;
    if (const ValueTree* unit = node.find("unit"))
      if (const auto* text = std::get_if<std::string>(&unit->value)) row.unit = *text;
    const double factor = unit_of(quantity, row.unit, place);
    const auto take = [&](int column, const ValueTree& from) {
      const double printed = toml_number(from, place);
      row.value[column] = factor * printed;
      check_size(quantity, row.value[column], number_text(printed) + " " + row.unit,
                 place + ", " + kColumns[column]);
    };
    if (node.kind == ValueTree::Kind::value) take(2, node);
    for (const ValueTree& child : node.children) {
      if (child.key == "unit") continue;
      const auto column = std::find(std::begin(kColumns), std::end(kColumns), child.key);
      if (column == std::end(kColumns))
        throw refusal(node.key + " has warp, weft, mean and unit, no " + child.key, place);
      take(static_cast<int>(column - std::begin(kColumns)), child);
    }
    add(sheet, quantity, std::move(row));
  }
}

// ---- what contradicts itself ----

struct Doubts {
  const KesSheet& sheet;
  std::vector<std::string> found = {};

  void say(const std::string& quantity, const std::string& what) {
    found.push_back(quantity + " (" + sheet.row.at(quantity).place + ") " + what);
  }

  void of_blanks() {
    for (const Quantity& quantity : kQuantities) {
      if (!quantity.has_directions || !sheet.has(quantity.name)) continue;
      const SheetRow& row = sheet.row.at(quantity.name);
      const bool warp = row.has(SheetColumn::warp), weft = row.has(SheetColumn::weft);
      if (warp != weft && !row.has(SheetColumn::mean))
        say(quantity.name, std::string("has no number in the column ") + (warp ? "weft" : "warp") +
                               "; that of " + (warp ? "warp" : "weft") + " is taken for both");
    }
  }

  void of_means() {
    for (const auto& [quantity, row] : sheet.row) {
      if (!row.has(SheetColumn::mean) || !row.has(SheetColumn::warp) || !row.has(SheetColumn::weft)) continue;
      const double mean = (row.value[0] + row.value[1]) / 2;
      if (std::abs(row.value[2] / mean - 1) > kPrinted)
        say(quantity,
            "has a mean that is " + number_text(row.value[2] / mean, 3) + " times that of its warp and weft");
    }
  }

  // Of one test: WT = LT T EMT/2 with T = 500 gf/cm.
  double work_over_its_parts(SheetColumn of_work, SheetColumn of_parts) const {
    return sheet.along("WT", of_work) /
           (sheet.along("LT", of_parts) * kLargestTension * sheet.along("EMT", of_parts) / 2);
  }
  void of_tension() {
    if (!sheet.has("WT") || !sheet.has("LT") || !sheet.has("EMT")) return;
    for (const SheetColumn column : {SheetColumn::warp, SheetColumn::weft}) {
      const SheetColumn other = column == SheetColumn::warp ? SheetColumn::weft : SheetColumn::warp;
      const double own = work_over_its_parts(column, column), exchanged = work_over_its_parts(column, other);
      if (!(std::abs(own - 1) > kPrinted)) continue;
      const std::string along = kColumns[static_cast<int>(column)];
      if (std::abs(exchanged - 1) < kPrinted)
        say("WT", "along " + along +
                      " is LT times 500 gf/cm times EMT/2 of the other direction: warp and weft are "
                      "exchanged in one of these rows");
      else
        say("WT",
            "along " + along + " is " + number_text(own, 3) +
                " times LT times 500 gf/cm times EMT/2, which it should be: one of the three is in another "
                "unit, or of another load");
    }
  }
  void of_compression() {
    if (!sheet.has("WC") || !sheet.has("LC") || !sheet.has("T0") || !sheet.has("TM")) return;
    const double way = sheet.mean("T0") - sheet.mean("TM");
    const double ratio = sheet.mean("WC") / (sheet.mean("LC") * kLargestPressure * way / 2);
    constexpr double kOfThickness = 0.3;  // differences of thicknesses are printed to few digits
    if (!(std::abs(ratio - 1) < kOfThickness))
      say("WC",
          "is " + number_text(ratio, 3) + " times LC times 50 gf/cm^2 times (T0 - TM)/2, which it should be");
  }
  // Over what woven cloth has; [low, high] in the unit that is said.
  void of_ratio(const char* above, const char* below, double unit, const char* text, double low,
                double high) {
    if (!sheet.has(above) || !sheet.has(below)) return;
    for (const SheetColumn column : {SheetColumn::warp, SheetColumn::weft}) {
      const double ratio = sheet.along(above, column) / sheet.along(below, column) / unit;
      if (ratio >= low && ratio <= high) continue;
      say(above, std::string("along ") + kColumns[static_cast<int>(column)] + " is " + number_text(ratio, 3) +
                     " " + text + " of " + below + ", and woven cloth has " + number_text(low) + " to " +
                     number_text(high) + ": is one of them in another unit?");
    }
  }
  // Friction of one k0 for both would saturate in the tester's window along one of them.
  void of_directions() {
    constexpr double kFarApart = 25;
    const double ratio = sheet.along("2HB", SheetColumn::weft) / sheet.along("2HB", SheetColumn::warp);
    if (ratio > kFarApart || ratio < 1 / kFarApart)
      say("2HB", "along weft is " + number_text(ratio, 3) +
                     " times that along warp: is one of them in another unit? This model cannot return both");
  }
  void of_weight() {
    if (!sheet.has("W") || !sheet.has("T0")) return;
    const double bulk = sheet.mean("W") / sheet.mean("T0");
    if (bulk < 40 || bulk > 1300)
      say("W", "over T0 makes " + number_text(bulk, 3) + " kg/m^3, and fabrics have 40 to 1300");
  }
};

void check_sheet(KesSheet& sheet, const std::string& file) {
  for (const char* needed : {"B", "2HB"})
    if (!sheet.has(needed))
      throw refusal(
          std::string("the sheet has no row ") + needed + ", which KES-FB2 prints: bending is not known",
          file);
  if (sheet.has("T0") && sheet.has("TM") && sheet.mean("T0") < sheet.mean("TM"))
    throw refusal("T0 must be >= TM: cloth is thinner under 50 gf/cm^2 than under 0.5",
                  sheet.row["T0"].place);
  Doubts doubts{sheet};
  doubts.of_blanks();
  doubts.of_means();
  doubts.of_tension();
  doubts.of_compression();
  doubts.of_ratio("2HB", "B", 1, "1/m", 16, 300);
  doubts.of_ratio("2HG", "G", kDegree, "degree", 0.3, 8);
  doubts.of_ratio("2HG5", "2HG", 1, "times", 0.8, 5);
  doubts.of_directions();
  doubts.of_weight();
  sheet.warnings = std::move(doubts.found);
}

}  // namespace

bool SheetRow::has(SheetColumn column) const { return std::isfinite(value[static_cast<int>(column)]); }

double SheetRow::along(SheetColumn column) const {
  if (has(column)) return value[static_cast<int>(column)];
  if (has(SheetColumn::mean)) return value[2];
  return has(SheetColumn::warp) ? value[0] : value[1];
}

double SheetRow::mean() const {
  if (has(SheetColumn::mean)) return value[2];
  return (along(SheetColumn::warp) + along(SheetColumn::weft)) / 2;
}

double KesSheet::along(const std::string& quantity, SheetColumn column) const {
  const auto found = row.find(quantity);
  return found == row.end() ? kNone : found->second.along(column);
}

double KesSheet::mean(const std::string& quantity) const {
  const auto found = row.find(quantity);
  return found == row.end() ? kNone : found->second.mean();
}

KesSheet read_kes_sheet(const std::filesystem::path& file) {
  KesSheet sheet;
  if (lower_trimmed(file.extension().string()) == ".toml")
    read_toml_sheet(file, sheet);
  else
    read_csv_sheet(file, sheet);
  if (sheet.name.empty()) sheet.name = file.stem().string();
  check_sheet(sheet, file.filename().string());
  return sheet;
}

std::string kes_sheet_template() {
  std::string text =
      "# The sheet of a KES-F laboratory.  Fill in warp and weft, or the mean alone; leave blank what was "
      "not\n"
      "# measured (B and 2HB have to be there).  Another unit may stand in place of the printed one, SI as "
      "well.\n"
      "quantity,unit,warp,weft,mean\n";
  for (const Quantity& quantity : kQuantities)
    text += "# " + std::string(quantity.meaning) + ": " + number_text(quantity.low) + " to " +
            number_text(quantity.high) + " are usual\n" + quantity.name + "," + quantity.unit + ",,,\n";
  return text;
}

}  // namespace hysteron
