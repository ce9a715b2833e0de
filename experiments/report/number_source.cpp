#include "experiments/report/number_source.h"

#include <cmath>
#include <cstdio>
#include <optional>
#include <sstream>
#include <vector>

#include "experiments/workbench/app/json_file.h"
#include "experiments/workbench/pages/simulated_run.h"
#include "experiments/workbench/pages/text_table.h"
#include "sim/base/error.h"
#include "sim/base/number_in.h"
#include "sim/scene/key_table.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;

// The words of a marker, taken one after the other.
class Words {
 public:
  explicit Words(const std::string& text) : stream_(text) {}

  std::string next(const char* what) {
    std::string word;
    if (!(stream_ >> std::ws) || stream_.peek() == EOF) throw Error::request(std::string("needs ") + what);
    if (stream_.peek() != '"') {
      stream_ >> word;
      return word;
    }
    stream_.get();
    if (!std::getline(stream_, word, '"') || stream_.eof()) throw Error::request("a quote is not closed");
    return word;
  }
  bool done() { return !(stream_ >> std::ws) || stream_.peek() == EOF; }

 private:
  std::istringstream stream_;
};

std::optional<double> as_number(const std::string& text) {
  const std::optional<double> value = number_in(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

double number_of(const Json& value, const std::string& name) {
  if (!value.is_number()) throw Error::request(name + " is no number");
  return value.get<double>();
}

std::string hint(const std::string& name, const std::vector<std::string>& known) {
  const std::string nearest = nearest_name(name, known);
  return nearest.empty() ? "" : "; did you mean " + nearest + "?";
}

double at_pointer(const Json& json, const std::string& pointer, const std::string& file) {
  try {
    return number_of(json.at(Json::json_pointer(pointer)), file + " " + pointer);
  } catch (const Json::exception&) {
    throw Error::request(file + " has no " + pointer);
  }
}

// A run's metrics, or a JSON file.
struct Source {
  fs::path path;
  std::string name;  // as the marker spells it
  Json json;
  bool is_metric = false;  // the number has a name that error keys start with
  std::string key;
  std::string cell;  // of a CSV file
};

double metric_of(const Source& source, const std::string& key) {
  const Json metrics = source.json.value("metrics", Json::object());
  std::vector<std::string> known;
  for (const auto& [name, value] : metrics.items()) known.push_back(name);
  if (!metrics.contains(key))
    throw Error::request(source.name + "/manifest.json has no metric " + key + hint(key, known));
  return number_of(metrics[key], "metric " + key + " of " + source.name);
}

std::size_t column_of(const TextTable& table, const std::string& name, const std::string& file) {
  for (std::size_t c = 0; c < table.head.size(); ++c)
    if (table.head[c] == name) return c;
  throw Error::request(file + " has no column " + name + hint(name, table.head));
}

// "10" is the row that starts so, "law=wong&element=hinge" the one with these fields.
std::vector<std::pair<std::size_t, std::string>> conditions(const TextTable& table, const std::string& row,
                                                            const std::string& file) {
  std::vector<std::pair<std::size_t, std::string>> wanted;
  for (const auto& r : table.rows)
    if (r[0] == row) return {{0, row}};
  if (row.find('=') == row.npos) return {{0, row}};
  std::istringstream parts(row);
  for (std::string part; std::getline(parts, part, '&');) {
    const std::size_t equals = std::min(part.find('='), part.size());
    if (equals == part.size()) throw Error::request("\"" + part + "\" must be column=value");
    wanted.emplace_back(column_of(table, part.substr(0, equals), file), part.substr(equals + 1));
  }
  return wanted;
}

std::string cell_of(const Source& source, const std::string& row, const std::string& column) {
  const TextTable table = read_words(source.path);
  const auto wanted = conditions(table, row, source.name);
  const std::size_t at = column_of(table, column, source.name);
  const std::vector<std::string>* found = nullptr;
  for (const auto& candidate : table.rows) {
    bool fits = true;
    for (const auto& [c, value] : wanted) fits = fits && candidate[c] == value;
    if (fits && found) throw Error::request(source.name + " has several rows " + row);
    if (fits) found = &candidate;
  }
  if (!found) throw Error::request(source.name + " has no row " + row);
  return (*found)[at];
}

// Reads the words of one source and the number that they lead to; NaN for a cell that is none.
double value_of(Source& source, Words& words) {
  if (source.path.extension() == ".csv") {
    const std::string row = words.next("a row"), column = words.next("a column");
    source.cell = cell_of(source, row, column);
    return as_number(source.cell).value_or(std::nan(""));
  }
  source.key = words.next("a metric or a JSON pointer");
  const bool is_file = source.path.extension() == ".json";
  source.json = read_json(is_file ? source.path : source.path / "manifest.json");
  if (source.key.starts_with('/')) return at_pointer(source.json, source.key, source.name);
  if (is_file) throw Error::request(source.name + " needs a JSON pointer such as /0/ms_per_step");
  source.is_metric = true;
  return metric_of(source, source.key);
}

Source source_at(const std::string& name, const fs::path& root) {
  Source source;
  source.name = name;
  source.path = root / name;
  return source;
}

struct Format {
  bool sign = false;
  int digits = 0;
  char kind = 'f';  // g: significant digits, ',': a count, thousands apart
  std::string unit;
};

Format format_of(const std::string& word) {
  Format format;
  if (word.starts_with(',')) return {false, 0, ',', word.substr(1)};
  std::size_t at = 0;
  if (word.starts_with('+')) format.sign = true, ++at;
  const bool right = at + 2 < word.size() && word[at] == '.' && word[at + 1] >= '0' && word[at + 1] <= '9' &&
                     (word[at + 2] == 'f' || word[at + 2] == 'g');
  if (!right) throw Error::request("format " + word + " must be like .1f, .2g, +.1f or , for a count");
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
std::string errors_of(const Source& source, const Format& format, double factor) {
  if (!source.is_metric) throw Error::request("only a metric has errors: leave +- out");
  const Json metrics = source.json.value("metrics", Json::object());
  std::string text;
  for (const char* kind : {"_step_error", "_mesh_error", "_draw_error"}) {
    const auto error = metrics.find(source.key + kind);
    if (error != metrics.end() && error->is_number())
      text += " ± " + written(std::abs(factor) * error->get<double>(), format);
  }
  if (text.empty()) throw Error::request(source.key + " of " + source.name + " has no errors: leave +- out");
  return text;
}

}  // namespace

fs::path path_in(const std::string& source) { return Words(source).next("a folder or a file"); }

std::string number_from(const std::string& text, const fs::path& root) {
  Words words(text);
  Source source = source_at(words.next("a folder or a file"), root);
  double value = value_of(source, words), factor = 1;
  std::string word = words.next("a format");
  if (word == "text" && words.done() && source.path.extension() == ".csv") return source.cell;
  if (word == "minus" || word == "over") {
    Source other = source_at(words.next("a folder or a file after minus or over"), root);
    const double second = value_of(other, words);
    value = word == "over" ? value / second : value - second;
    source.is_metric = false;
    word = words.next("a format");
  }
  if (word == "times") {
    const std::string number = words.next("a number after times");
    const std::optional<double> read = as_number(number);
    if (!read) throw Error::request("times " + number + " is no number");
    factor = *read;
    word = words.next("a format");
  }
  if (!std::isfinite(factor * value)) throw Error::request("this is no finite number");
  std::string result = written(factor * value, format_of(word));
  if (words.done()) return result;
  word = words.next("a format of errors");
  if (word.starts_with("+-") && words.done())
    return result + errors_of(source, format_of(word.substr(2)), factor);
  throw Error::request("\"" + word + "\" is one word too many");
}

}  // namespace hysteron::experiments
