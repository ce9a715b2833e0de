#include "sim/identification/laboratory_sheet.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numeric>
#include <optional>

#include "sim/base/csv.h"
#include "sim/base/plain_text.h"
#include "sim/base/units.h"
#include "sim/scene/key_table.h"
#include "sim/scene/toml_file.h"

namespace hysteron {
namespace {

constexpr double kBeyondUsual = 2;

std::string lower_trimmed(const std::string& text) {
  std::string result(trimmed(text));
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

class SheetReader {
 public:
  SheetReader(const std::filesystem::path& file, const std::string& reader,
              std::span<const SheetQuantity> quantities)
      : file_(file), reader_(reader), quantities_(quantities) {}

  LaboratorySheet read() {
    if (lower_trimmed(file_.extension().string()) == ".toml")
      read_toml_rows();
    else
      read_csv_rows();
    if (sheet_.name.empty()) sheet_.name = file_.stem().string();
    for (auto& [name, row] : sheet_.row) {
      average(row);
      complete(name, row);
    }
    warn_of_directions();
    warn_of_blanks();
    warn_of_means();
    return std::move(sheet_);
  }

 private:
  Error refusal(const std::string& what, const std::string& place) const {
    return sheet_refusal(reader_, what, place);
  }

  const SheetQuantity* quantity_named(const std::string& name) const {
    const auto plain = [](std::string text) {
      std::erase(text, ' ');
      return lower_trimmed(text);
    };
    for (const SheetQuantity& quantity : quantities_)
      if (plain(quantity.name) == plain(name)) return &quantity;
    return nullptr;
  }

  const SheetQuantity& known_quantity(const std::string& name, const std::string& place) const {
    if (name.empty())
      throw refusal(
          "the row names no quantity; a cell that was merged over several rows has to be filled in each",
          place);
    if (const SheetQuantity* found = quantity_named(name)) return *found;
    std::vector<std::string> names;
    for (const SheetQuantity& quantity : quantities_) names.emplace_back(quantity.name);
    const std::string nearest = nearest_name(name, names);
    throw refusal("unknown quantity " + name + (nearest.empty() ? "" : ", did you mean " + nearest + "?") +
                      "; there are " + join(names, ", "),
                  place);
  }

  double unit_of(const SheetQuantity& quantity, const std::string& unit, const std::string& place) const {
    const std::string given = plain_unit(unit.empty() ? quantity.unit : unit);
    if (const auto factor = factor_to(quantity.si, given)) return *factor;
    const std::string others = known_units(quantity.si);
    throw refusal(std::string(quantity.name) + " has unit \"" + unit + "\" and must have \"" + quantity.unit +
                      "\"" + (others.empty() ? "" : " or one of " + others),
                  place);
  }

  // Refuses a number that clothing does not have, with the unit in which it would.
  void check_size(const SheetQuantity& quantity, double si, const std::string& shown,
                  const std::string& place) const {
    const double printed = *factor_to(quantity.si, quantity.unit);
    const auto fits = [&](double value) {
      return value >= quantity.low * printed / kBeyondUsual &&
             value <= quantity.high * printed * kBeyondUsual;
    };
    if (fits(si)) return;
    // The likeliest slip leads nearest to the middle of the usual range.
    const double middle = std::sqrt(quantity.low * quantity.high) * printed;
    double likely = 0;
    for (const double slip :
         {10.0, 0.1, 100.0, 0.01, 1000.0, 0.001, 98.0665, 1 / 98.0665, 9.80665, 1 / 9.80665})
      if (fits(si * slip) &&
          (likely == 0 || std::abs(std::log(si * slip / middle)) < std::abs(std::log(si * likely / middle))))
        likely = slip;
    const std::string hint =
        likely == 0 ? ""
                    : "; " + number_text(likely, 4) + " times as much would be one: is it in another unit?";
    throw refusal(std::string(quantity.name) + " = " + shown + " is no fabric's: between " +
                      number_text(quantity.low) + " and " + number_text(quantity.high) + " " + quantity.unit +
                      " are usual" + hint,
                  place);
  }

  void take(SheetRow& row, int column, const SheetQuantity& quantity, double si, const std::string& shown) {
    check_size(quantity, si, shown + " " + row.unit,
               row.place + ", column " + column_name(static_cast<SheetColumn>(column)));
    row.value[column] = si;
  }

  void add(const SheetQuantity& quantity, SheetRow row) {
    if (sheet_.has(quantity.name) && !quantity.may_repeat)
      throw refusal(std::string(quantity.name) + " stands twice, also in " + sheet_.row[quantity.name].place,
                    row.place);
    SheetRow& whole = sheet_.row.try_emplace(quantity.name, row).first->second;
    for (int c = 0; c < 3; ++c)
      if (std::isfinite(row.value[c])) whole.repeats[c].push_back(row.value[c]);
  }

  static void average(SheetRow& row) {
    for (int c = 0; c < 3; ++c)
      if (const std::vector<double>& all = row.repeats[c]; !all.empty())
        row.value[c] = std::accumulate(all.begin(), all.end(), 0.0) / static_cast<double>(all.size());
  }

  // Completes a row: a mean and one direction give the other.
  void complete(const std::string& name, SheetRow& row) const {
    if (!row.has(SheetColumn::mean) || row.has(SheetColumn::warp) == row.has(SheetColumn::weft)) return;
    const int other = row.has(SheetColumn::warp) ? 1 : 0;
    const SheetColumn column = static_cast<SheetColumn>(other);
    row.value[other] = 2 * row.value[2] - row.value[1 - other];
    if (!(row.value[other] > 0))
      throw refusal(name + " has a mean that is less than half of its " +
                        column_name(static_cast<SheetColumn>(1 - other)) + ": the other direction cannot be",
                    row.place);
    const SheetQuantity& quantity = *quantity_named(name);
    const double printed = row.value[other] / unit_of(quantity, row.unit, row.place);
    check_size(quantity, row.value[other], number_text(printed, 4) + " " + row.unit,
               row.place + ", column " + column_name(column) + ", as the mean tells it");
  }

  // Is the row filled in? An empty row is ignored.
  static bool is_filled_in(const SheetRow& row) {
    return std::any_of(std::begin(row.value), std::end(row.value), [](double x) { return std::isfinite(x); });
  }

  struct CsvColumns {
    std::size_t quantity;
    std::optional<std::size_t> unit, value[3];
  };

  // Returns the column of one of these names; refuses a second one, of the same name or of another of them.
  std::optional<std::size_t> column_named(const Table& table,
                                          std::initializer_list<const char*> names) const {
    std::optional<std::size_t> found;
    for (std::size_t c = 0; c < table.head.size(); ++c) {
      const std::string field = lower_trimmed(table.head[c]);
      if (std::find(names.begin(), names.end(), field) == names.end()) continue;
      if (found) {
        const std::string first = lower_trimmed(table.head[*found]);
        throw refusal(first == field ? "column '" + field + "' stands twice"
                                     : "columns '" + first + "' and '" + field + "' are one column twice",
                      file_.filename().string() + ":1");
      }
      found = c;
    }
    return found;
  }

  CsvColumns csv_columns(const Table& table) const {
    const auto quantity = column_named(table, {"quantity", "property", "parameter", "symbol"});
    CsvColumns columns{quantity.value_or(0),
                       column_named(table, {"unit", "units"}),
                       {column_named(table, {"warp", "wp"}), column_named(table, {"weft", "wf", "filling"}),
                        column_named(table, {"mean", "value", "average"})}};
    if (!quantity || !(columns.value[0] || columns.value[2]))
      throw refusal("the first line must name the columns quantity, unit, warp, weft, mean; it has " +
                        join(table.head, ", "),
                    file_.filename().string() + ":1");
    return columns;
  }

  SheetRow row_of_csv(const Table& table, std::size_t i, const CsvColumns& columns,
                      const SheetQuantity& quantity, const std::string& place) {
    SheetRow row;
    row.place = place;
    if (columns.unit) row.unit = std::string(trimmed(table.rows[i][*columns.unit]));
    const double factor = unit_of(quantity, row.unit, place);
    for (int c = 0; c < 3; ++c)
      if (columns.value[c] && !trimmed(table.rows[i][*columns.value[c]]).empty())
        take(row, c, quantity, factor * table.finite(i, *columns.value[c]),
             std::string(trimmed(table.rows[i][*columns.value[c]])));
    return row;
  }

  void read_csv_rows() {
    Table table = read_table(file_);
    table.reader = reader_;
    const CsvColumns columns = csv_columns(table);
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
      const std::string place = file_.filename().string() + ":" + std::to_string(table.lines[i]),
                        named(trimmed(table.rows[i][columns.quantity]));
      if (lower_trimmed(named) == "name") {
        for (const auto& c : columns.value)
          if (c && !trimmed(table.rows[i][*c]).empty()) sheet_.name = std::string(trimmed(table.rows[i][*c]));
        continue;
      }
      const SheetQuantity& quantity = known_quantity(named, place);
      SheetRow row = row_of_csv(table, i, columns, quantity, place);
      if (is_filled_in(row)) add(quantity, std::move(row));
    }
  }

  void read_toml_rows() {
    const ValueTree root = read_toml(file_.string());
    for (const ValueTree& node : root.children) {
      const std::string place = file_.filename().string() + ":" + std::to_string(node.line);
      if (node.key == "name") {
        const auto* name = std::get_if<std::string>(&node.value);
        if (!name) throw refusal("name must be a text", place);
        sheet_.name = *name;
        continue;
      }
      read_toml_row(node, known_quantity(node.key, place), place);
    }
  }

  void read_toml_row(const ValueTree& node, const SheetQuantity& quantity, const std::string& place) {
    SheetRow row;
    row.place = place;
    if (const ValueTree* unit = node.find("unit")) {
      const auto* text = std::get_if<std::string>(&unit->value);
      if (!text) throw refusal(node.key + ": unit must be a text", place);
      row.unit = *text;
    }
    const double factor = unit_of(quantity, row.unit, place);
    const auto take_from = [&](int column, const ValueTree& from) {
      const std::optional<double> printed = from.number();
      if (!printed) throw refusal(from.key + " must be a number", place);
      take(row, column, quantity, factor * *printed, number_text(*printed));
    };
    if (node.kind == ValueTree::Kind::value) take_from(2, node);
    for (const ValueTree& child : node.children) {
      if (child.key == "unit") continue;
      int column = 0;
      while (column < 3 && child.key != column_name(static_cast<SheetColumn>(column))) ++column;
      if (column == 3) throw refusal(node.key + " has warp, weft, mean and unit, no " + child.key, place);
      take_from(column, child);
    }
    if (is_filled_in(row)) add(quantity, std::move(row));
  }

  // Warns if a quantity without directions has numbers in both columns, whose mean is taken.
  void warn_of_directions() {
    for (const SheetQuantity& quantity : quantities_) {
      if (quantity.has_directions || !sheet_.has(quantity.name)) continue;
      const SheetRow& row = sheet_.row.at(quantity.name);
      if (!row.has(SheetColumn::warp) || !row.has(SheetColumn::weft)) continue;
      if (std::abs(row.value[0] / row.value[1] - 1) > kPrintedDigits)
        sheet_.warn(quantity.name,
                    "has no direction, and other numbers in the columns warp and weft: their mean is taken");
    }
  }

  void warn_of_blanks() {
    for (const SheetQuantity& quantity : quantities_) {
      if (!quantity.has_directions || !sheet_.has(quantity.name)) continue;
      const SheetRow& row = sheet_.row.at(quantity.name);
      const bool warp = row.has(SheetColumn::warp), weft = row.has(SheetColumn::weft);
      if (warp != weft && !row.has(SheetColumn::mean))
        sheet_.warn(quantity.name, std::string("has no number in the column ") + (warp ? "weft" : "warp") +
                                       "; that of " + (warp ? "warp" : "weft") + " is taken for both");
    }
  }

  void warn_of_means() {
    for (const auto& [quantity, row] : sheet_.row) {
      if (!row.has(SheetColumn::mean) || !row.has(SheetColumn::warp) || !row.has(SheetColumn::weft)) continue;
      const double mean = (row.value[0] + row.value[1]) / 2;
      if (std::abs(row.value[2] / mean - 1) > kPrintedDigits)
        sheet_.warn(quantity, "has a mean that is " + number_text(row.value[2] / mean, 3) +
                                  " times that of its warp and weft");
    }
  }

  const std::filesystem::path& file_;
  const std::string& reader_;
  std::span<const SheetQuantity> quantities_;
  LaboratorySheet sheet_;
};

}  // namespace

Error sheet_refusal(const std::string& reader, const std::string& what, const std::string& place) {
  return Error::invalid_input(reader + ": " + what + " (" + place + ")")
      .with_key(reader.substr(reader.find("--") + 2), "");
}

const char* column_name(SheetColumn column) {
  constexpr const char* kNames[] = {"warp", "weft", "mean"};
  return kNames[static_cast<int>(column)];
}

void check_laboratory_sheet(const LaboratorySheet& sheet, const SheetRules& rules, const std::string& file) {
  for (const char* needed : rules.needed)
    if (!sheet.has(needed))
      throw sheet_refusal(rules.reader, std::string("the sheet has no row ") + needed + rules.why_needed,
                          file);
  if (sheet.has(kDrapeOfJis.name) && sheet.has(kDrapeOfIso.name))
    throw sheet_refusal(rules.reader, "one drape coefficient can be compared with, not two",
                        sheet.row.at(kDrapeOfIso.name).place);
  const std::string thick = rules.thick, thin = rules.thin;
  if (sheet.has(thick) && sheet.has(thin) && sheet.mean(thick) < sheet.mean(thin))
    throw sheet_refusal(rules.reader, thick + " must be >= " + thin + ": cloth is thinner " + rules.pressed,
                        sheet.row.at(thick).place);
}

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

double SheetRow::relative_error(SheetColumn column) const {
  int of = static_cast<int>(column);
  if (!has(column)) of = has(SheetColumn::mean) ? 2 : has(SheetColumn::warp) ? 0 : 1;
  const std::vector<double>& all = repeats[of];
  if (all.size() < 2) return kNone;
  const auto count = static_cast<double>(all.size());
  double squares = 0;
  for (const double one : all) squares += (one - value[of]) * (one - value[of]);
  return std::sqrt(squares / (count * (count - 1))) / value[of];
}

void LaboratorySheet::warn(const std::string& quantity, const std::string& what) {
  warnings.push_back(quantity + " (" + row.at(quantity).place + ") " + what);
}

double LaboratorySheet::along(const std::string& quantity, SheetColumn column) const {
  const auto found = row.find(quantity);
  return found == row.end() ? kNone : found->second.along(column);
}

double LaboratorySheet::mean(const std::string& quantity) const {
  const auto found = row.find(quantity);
  return found == row.end() ? kNone : found->second.mean();
}

LaboratorySheet read_laboratory_sheet(const std::filesystem::path& file, const std::string& reader,
                                      std::span<const SheetQuantity> quantities) {
  return SheetReader(file, reader, quantities).read();
}

std::string sheet_template(const std::string& head, std::span<const SheetQuantity> quantities) {
  std::string text = head + "quantity,unit,warp,weft,mean\n";
  for (const SheetQuantity& quantity : quantities)
    text += "# " + std::string(quantity.meaning) + ": " + number_text(quantity.low) + " to " +
            number_text(quantity.high) + " are usual\n" + quantity.name + "," + quantity.unit + ",,,\n";
  return text;
}

}  // namespace hysteron
