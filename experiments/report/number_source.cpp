#include "experiments/report/number_source.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <sstream>

#include "experiments/workbench/app/json_file.h"
#include "experiments/workbench/pages/gallery_about.h"
#include "experiments/workbench/pages/text_table.h"
#include "sim/base/error.h"
#include "sim/base/number_in.h"
#include "sim/scene/key_table.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;

// The words of a title, taken one after the other.
class Words {
 public:
  explicit Words(const std::string& text) {
    for (std::size_t at = 0; (at = text.find_first_not_of(" \n", at)) != text.npos;) {
      const bool quoted = text[at] == '\'';
      std::size_t end = quoted ? at + 1 : text.find_first_of(" \n", at);
      // The apostrophe in `'the chapter's'` is followed by a letter.
      while (quoted && (end = text.find('\'', end)) != text.npos && end + 1 < text.size() &&
             text[end + 1] != ' ' && text[end + 1] != '\n')
        ++end;
      if (quoted && end == text.npos) throw Error::invalid_input("a quote is not closed");
      words_.push_back(text.substr(at + quoted, end == text.npos ? end : end - at - quoted));
      at = end == text.npos ? text.size() : end + quoted;
    }
  }

  std::string next(const char* what) {
    if (done()) throw Error::invalid_input(std::string("needs ") + what);
    return words_[at_++];
  }
  // The next word, which stays; "" behind the last.
  std::string ahead() const { return done() ? "" : words_[at_]; }
  bool done() const { return at_ == words_.size(); }

 private:
  std::vector<std::string> words_;
  std::size_t at_ = 0;
};

std::optional<double> as_number(const std::string& text) {
  const std::optional<double> value = number_in(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

double json_number(const Json& value, const std::string& name) {
  if (!value.is_number()) throw Error::invalid_input(name + " is no number");
  return value.get<double>();
}

std::string hint(const std::string& name, const std::vector<std::string>& known) {
  const std::string nearest = nearest_name(name, known);
  return nearest.empty() ? "" : "; did you mean " + nearest + "?";
}

double at_pointer(const Json& json, const std::string& pointer, const std::string& file) {
  try {
    return json_number(json.at(Json::json_pointer(pointer)), file + " " + pointer);
  } catch (const Json::exception&) {
    throw Error::invalid_input(file + " has no " + pointer);
  }
}

// A number, and what its errors are looked up in.
struct Found {
  double value = 0;                      // NaN for a cell that is none
  std::optional<std::string> cell;       // of a table
  std::string name;                      // of a metric or a column; "" of a JSON pointer
  std::map<std::string, double> beside;  // the other metrics of the run, the other cells of the row
};

Found manifest_metric(const Json& manifest, const std::string& key, const std::string& file) {
  const Json metrics = manifest.value("metrics", Json::object());
  Found found;
  std::vector<std::string> known;
  for (const auto& [name, value] : metrics.items()) {
    known.push_back(name);
    if (value.is_number()) found.beside[name] = value.get<double>();
  }
  if (!metrics.contains(key)) throw Error::invalid_input(file + " has no metric " + key + hint(key, known));
  found.value = json_number(metrics[key], "metric " + key + " of " + file);
  found.name = key;
  return found;
}

std::string text_in(const Json& value) { return value.is_string() ? value.get<std::string>() : value.dump(); }

// A CSV file, or a list of objects of which each is a row.
Table table_at(const fs::path& path, const std::string& file) {
  Table table;
  if (path.extension() == ".csv") table = read_table(path);
  table.file = file;
  if (path.extension() == ".csv") return table;
  const Json list = read_json(path);
  if (!list.is_array())
    throw Error::invalid_input(file + " is no list: it needs a JSON pointer such as /steps");
  for (const Json& object : list)
    for (const auto& [key, value] : object.items())
      if (!table.find(key)) table.head.push_back(key);
  for (const Json& object : list) {
    table.rows.emplace_back();
    for (const std::string& key : table.head)
      table.rows.back().push_back(object.contains(key) ? text_in(object[key]) : "");
  }
  return table;
}

std::size_t place_in_head(const Table& table, const std::string& column) {
  if (const auto place = table.find(column)) return *place;
  throw Error::invalid_input(table.file + " has no column " + column + hint(column, table.head));
}

// "10" is the row that starts so, "law=wong&element=hinge" the one with these fields.
Table rows_at(const Table& table, const std::string& row) {
  const auto begins = [&](const auto& fields) { return fields[0] == row; };
  if (std::any_of(table.rows.begin(), table.rows.end(), begins) || row.find('=') == row.npos)
    return table.where(table.head[0], row);
  Table found = table;
  std::istringstream parts(row);
  for (std::string part; std::getline(parts, part, '&');) {
    const std::size_t equals = part.find('=');
    if (equals == part.npos) throw Error::invalid_input("\"" + part + "\" must be column=value");
    const std::string& column = table.head[place_in_head(table, part.substr(0, equals))];
    found = found.where(column, part.substr(equals + 1));
  }
  return found;
}

Found table_cell(const Table& table, const std::string& row, const std::string& column) {
  const Table fitting = rows_at(table, row);
  const std::size_t at = place_in_head(table, column);
  if (fitting.rows.size() > 1) throw Error::invalid_input(table.file + " has several rows " + row);
  if (fitting.rows.empty()) throw Error::invalid_input(table.file + " has no row " + row);
  const std::vector<std::string>& found = fitting.rows[0];
  Found cell{as_number(found[at]).value_or(std::nan("")), found[at], column, {}};
  for (std::size_t c = 0; c < table.head.size(); ++c)
    if (const auto value = as_number(found[c])) cell.beside[table.head[c]] = *value;
  return cell;
}

// Reads the words of one source and the number that they lead to.
Found found_in(const std::string& file, const fs::path& folder, Words& words) {
  const fs::path path = folder / file, name = path.filename();
  if (words.ahead().starts_with('/') && path.extension() == ".json")
    return {at_pointer(read_json(path), words.next("a JSON pointer"), file), {}, "", {}};
  if (name == "manifest.json" || name == "errors.csv") {
    if (!fs::exists(path)) throw Error::invalid_input("no file " + file);
    return manifest_metric(read_json(path.parent_path() / "manifest.json"), words.next("a metric"), file);
  }
  const Table table = table_at(path, file);
  std::string row = words.next("a row");
  while (words.ahead().find('=') != std::string::npos) row += "&" + words.next("a column");
  return table_cell(table, row, words.next("a column"));
}

struct Format {
  bool sign = false;
  int digits = 0;
  char kind = 'f';  // g: significant digits, ',': a count, thousands apart
  std::string unit;
};

Format parsed_format(const std::string& word) {
  Format format;
  if (word.starts_with(',')) return {false, 0, ',', word.substr(1)};
  std::size_t at = 0;
  if (word.starts_with('+')) format.sign = true, ++at;
  const bool right = at + 2 < word.size() && word[at] == '.' && word[at + 1] >= '0' && word[at + 1] <= '9' &&
                     (word[at + 2] == 'f' || word[at + 2] == 'g');
  if (!right) throw Error::invalid_input("format " + word + " must be like .1f, .2g, +.1f or , for a count");
  format.digits = word[at + 1] - '0';
  format.kind = word[at + 2];
  format.unit = word.substr(at + 3);
  return format;
}

std::string written(double value, const Format& format) {
  if (value == 0) return "0" + format.unit;
  if (format.kind == ',') return grouped(std::lround(value)) + format.unit;
  const std::string pattern = std::string(format.sign ? "%+.*" : "%.*") + format.kind;
  char digits[400];  // the largest double has 309 before the point
  std::snprintf(digits, sizeof digits, pattern.c_str(), format.digits, value);
  std::string text = digits;
  for (const char* padded : {"e-0", "e+0"})  // 2e-07
    if (const std::size_t at = text.find(padded); at != text.npos) text.erase(at + 2, 1);
  return text + format.unit;
}

// " ± 0.1 ± 0.3 ± 0.2"
std::string errors_text(const Found& found, const Format& format, double factor) {
  const std::string& name = found.name;
  const bool is_mean = name.ends_with("_mean");
  const std::string one = is_mean ? name.substr(0, name.size() - 5) : name;
  std::vector<std::string> errors = {one + "_step_error", one + "_mesh_error"};
  if (is_mean)
    errors.insert(errors.end(), {name + "_stderr", one + "_stderr"});
  else
    errors.push_back(one + "_draw_error");
  std::string text;
  for (const std::string& error : errors)
    if (const auto at = found.beside.find(error); !name.empty() && at != found.beside.end())
      text += " ± " + written(std::abs(factor) * at->second, format);
  if (text.empty())
    throw Error::invalid_input((name.empty() ? "this number" : name) + " has no errors: leave +- out");
  return text;
}

}  // namespace

bool names_a_file(const std::string& word) { return word.ends_with(".csv") || word.ends_with(".json"); }

std::vector<std::string> values_of_column(const std::string& target, const std::string& column,
                                          const fs::path& folder) {
  const Table table = table_at(folder / target, target);
  return table.values(table.head[place_in_head(table, column)]);
}

std::string number_from(const NumberSource& source, const fs::path& folder) {
  Words words(source.title);
  Found found = found_in(source.target, folder, words);
  double factor = 1;
  std::string word = words.next("a format");
  if (word == "text" && words.done() && found.cell) return *found.cell;
  if (found.cell && found.cell->empty()) return "–";
  if (word == "minus" || word == "over") {
    const std::string other = names_a_file(words.ahead()) ? words.next("a file") : source.target;
    const double second = found_in(other, folder, words).value;
    found = {word == "over" ? found.value / second : found.value - second, {}, "", {}};
    word = words.next("a format");
  }
  if (word == "times") {
    const std::string number = words.next("a number after times");
    const std::optional<double> read = as_number(number);
    if (!read) throw Error::invalid_input("times " + number + " is no number");
    factor = *read;
    word = words.next("a format");
  }
  if (!std::isfinite(factor * found.value)) throw Error::invalid_input("this is no finite number");
  std::string result = written(factor * found.value, parsed_format(word));
  if (words.done()) return result;
  word = words.next("a format of errors");
  if (word.starts_with("+-") && words.done())
    return result + errors_text(found, parsed_format(word.substr(2)), factor);
  throw Error::invalid_input("\"" + word + "\" is one word too many");
}

}  // namespace hysteron::experiments
