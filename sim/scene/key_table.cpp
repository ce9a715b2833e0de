#include "sim/scene/key_table.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>

#include "sim/base/comma_list.h"
#include "sim/base/error.h"
#include "sim/base/plain_text.h"

namespace hysteron {
namespace {

template <class... Cases>
struct Overload : Cases... {
  using Cases::operator()...;
};
template <class... Cases>
Overload(Cases...) -> Overload<Cases...>;

std::string type_name(const Field& field) {
  static const char* const kNames[] = {"flag", "integer",    "integer", "number", "vector",
                                       "text", "name=value", "text",    "numbers"};
  return kNames[field.index()];
}

std::string quoted_text(const Value& value) {
  return std::visit(
      Overload{[](bool x) { return std::string(x ? "true" : "false"); },
               [](std::int64_t x) { return std::to_string(x); }, [](double x) { return number_text(x); },
               [](const std::string& x) { return '"' + x + '"'; },
               [](const std::vector<double>& x) {
                 std::vector<std::string> words;
                 for (double component : x) words.push_back(number_text(component));
                 return "[" + join(words, ", ") + "]";
               }},
      value);
}

// Composes a refusal: "fabric.b2 = -1 N m must be >= 0 (scene.toml:7)".
Error refusal(const KeyDescription& key, const std::string& value, const std::string& must,
              const std::string& origin) {
  return Error::invalid_input(key.path + " = " + value + " must be " + must)
      .with_origin(origin)
      .with_key(key.path, value);
}

Error wrong_type(const KeyDescription& key, const Value& value, const std::string& origin) {
  static const std::map<std::string, std::string> kArticle = {
      {"flag", "true or false"},   {"integer", "an integer"}, {"number", "a number"},
      {"vector", "three numbers"}, {"text", "a text"},        {"name=value", "of the form name=value"},
      {"numbers", "numbers"}};
  std::string must = kArticle.at(key.type);
  if (key.type == "integer" || key.type.starts_with("number") || key.type == "vector") {
    if (key.range.text() != "finite") must += " " + key.range.text();
    if (!key.unit.empty()) must += " [" + key.unit + "]";
  }
  if (!key.choices.empty()) must += ": " + join(key.choices, " | ");
  return refusal(key, quoted_text(value), must, origin);
}

void check_number(const KeyDescription& key, double x, const std::string& shown, const std::string& origin) {
  const std::string allowed = std::isfinite(x) ? key.range.text() : "finite";
  if (std::isfinite(x) && key.range.contains(x)) return;
  const std::string unit = key.unit.empty() ? "" : " " + key.unit;
  throw refusal(key, shown + unit, allowed, origin).with_key(key.path, shown);
}

void check_choice(const KeyDescription& key, const std::string& name, const std::string& origin) {
  if (key.choices.empty()) return;
  if (std::count(key.choices.begin(), key.choices.end(), name)) return;
  throw refusal(key, name, join(key.choices, " | "), origin + suggestion(name, key.choices));
}

double as_number(const KeyDescription& key, const Value& value, const std::string& origin) {
  if (const auto* integer = std::get_if<std::int64_t>(&value)) return static_cast<double>(*integer);
  if (const auto* number = std::get_if<double>(&value)) return *number;
  throw wrong_type(key, value, origin);
}

// Reads an integer, also from a number with an exponent or a point, "1e3", if nothing but zeros is behind the
// point.
std::int64_t as_integer(const KeyDescription& key, const Value& value, const std::string& origin) {
  constexpr double kExact = 9e15;  // below 2^53 every integer has a double of its own
  if (const auto* integer = std::get_if<std::int64_t>(&value)) return *integer;
  const auto* number = std::get_if<double>(&value);
  if (!number || *number != std::floor(*number)) throw wrong_type(key, value, origin);
  if (std::abs(*number) > kExact) check_number(key, *number, quoted_text(value), origin);
  if (std::abs(*number) > kExact) throw wrong_type(key, value, origin);
  return static_cast<std::int64_t>(*number);
}

void assign_parameter(const KeyDescription& key, Parameters& parameters, const Value& value,
                      const std::string& origin) {
  const auto* text = std::get_if<std::string>(&value);
  const std::size_t equals = text ? text->find('=') : std::string::npos;
  if (equals == std::string::npos || equals == 0) throw wrong_type(key, value, origin);
  parameters[text->substr(0, equals)] = text->substr(equals + 1);
}

template <class Integer>
void assign_integer(const KeyDescription& key, Integer& target, const Value& value,
                    const std::string& origin) {
  const std::int64_t x = as_integer(key, value, origin);
  check_number(key, static_cast<double>(x), std::to_string(x), origin);
  if (x < std::numeric_limits<Integer>::min() || x > std::numeric_limits<Integer>::max()) {
    throw refusal(key, std::to_string(x), "at most " + std::to_string(std::numeric_limits<Integer>::max()),
                  origin);
  }
  target = static_cast<Integer>(x);
}

const Numbers& as_numbers(const KeyDescription& key, const Value& value, const std::string& origin) {
  const auto* numbers = std::get_if<Numbers>(&value);
  if (!numbers || (key.type == "vector" && numbers->size() != 3)) throw wrong_type(key, value, origin);
  for (double x : *numbers) check_number(key, x, quoted_text(value), origin);
  return *numbers;
}

const std::string& as_text(const KeyDescription& key, const Value& value, const std::string& origin) {
  const auto* text = std::get_if<std::string>(&value);
  if (!text) throw wrong_type(key, value, origin);
  check_choice(key, *text, origin);
  return *text;
}

// Reads the whole text as a number; false if anything is left over.
template <class Number>
bool parse(std::string_view text, Number& number) {
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size();
}

// Reads numbers between blanks or commas; returns none if any part of the text is something else.
std::vector<double> parse_components(std::string text) {
  std::ranges::replace_if(
      text, [](char c) { return c == '[' || c == ']'; }, ' ');
  if (text.find(',') != text.npos)
    for (const std::string& part : split(text))
      if (trimmed(part).empty()) return {};
  std::ranges::replace(text, ',', ' ');
  std::istringstream words(text);
  std::vector<double> components;
  for (std::string word; words >> word;) {
    double x = 0;
    if (!parse(word, x)) return {};
    components.push_back(x);
  }
  return components;
}

// Writes a default with four digits; "" for a value that is not set.
std::string described_default(const Field& field) {
  const auto rounded = [](double x) { return std::isfinite(x) ? number_text(x, 4) : ""; };
  return std::visit(
      Overload{
          [](bool*) { return std::string(); }, [](int* x) { return std::to_string(*x); },
          [](unsigned* x) { return std::to_string(*x); }, [&](double* x) { return rounded(*x); },
          [&](Eigen::Vector3d* v) { return rounded(v->x()) + " " + rounded(v->y()) + " " + rounded(v->z()); },
          [](std::string* x) { return *x; }, [](Parameters*) { return std::string(); },
          [](const NamedValue& x) { return x.name(); }, [](Numbers*) { return std::string(); }},
      field);
}

}  // namespace

std::string Range::text() const {
  if (low > -kInfinity && high < kInfinity) {
    return std::string("in ") + (open_low ? "(" : "[") + number_text(low) + ", " + number_text(high) + "]";
  }
  if (low > -kInfinity) return (open_low ? "> " : ">= ") + number_text(low);
  if (high < kInfinity) return "<= " + number_text(high);
  return "finite";
}

KeyDescription describe(const char* path, const Field& field, const char* unit, Range range, const char* doc,
                        const KeyTraits& traits) {
  KeyDescription key{path, type_name(field), unit, range, {}, doc, described_default(field), traits};
  if (const auto* named = std::get_if<NamedValue>(&field)) key.choices = named->names;
  return key;
}

void assign(const BoundKey& key, const Value& value, const std::string& origin) {
  const KeyDescription& what = key.description;
  std::visit(Overload{[&](bool* target) {
                        const bool* flag = std::get_if<bool>(&value);
                        if (!flag) throw wrong_type(what, value, origin);
                        *target = *flag;
                      },
                      [&](int* target) { assign_integer(what, *target, value, origin); },
                      [&](unsigned* target) { assign_integer(what, *target, value, origin); },
                      [&](double* target) {
                        const double x = as_number(what, value, origin);
                        check_number(what, x, quoted_text(value), origin);
                        *target = x;
                      },
                      [&](Eigen::Vector3d* target) {
                        *target = Eigen::Vector3d::Map(as_numbers(what, value, origin).data());
                      },
                      [&](std::string* target) { *target = as_text(what, value, origin); },
                      [&](Parameters* target) { assign_parameter(what, *target, value, origin); },
                      [&](Numbers* target) { *target = as_numbers(what, value, origin); },
                      [&](const NamedValue& target) {
                        const std::string& text = as_text(what, value, origin);
                        target.set(target.value,
                                   static_cast<std::size_t>(
                                       std::find(target.names.begin(), target.names.end(), text) -
                                       target.names.begin()));
                      }},
             key.field);
}

Value parse_text(const KeyDescription& key, const std::string& text) {
  std::int64_t integer = 0;
  double number = 0;
  if (key.type == "flag" && (text == "true" || text == "false")) return text == "true";
  if (key.type == "integer" && parse(text, integer)) return integer;
  if ((key.type == "integer" || key.type == "number") && parse(text, number)) return number;
  if (key.type == "vector" && parse_components(text).size() == 3) return parse_components(text);
  if (key.type == "numbers" && (text == "[]" || !parse_components(text).empty()))
    return parse_components(text);
  return text;
}

std::string value_text(const Value& value) {
  if (const auto* numbers = std::get_if<Numbers>(&value)) {
    std::vector<std::string> words;
    for (double component : *numbers) words.push_back(number_text(component));
    return words.empty() ? "[]" : join(words, " ");
  }
  const auto* text = std::get_if<std::string>(&value);
  return text ? *text : quoted_text(value);
}

const BoundKey& find_key(const Keys& keys, const std::string& path, const std::string& origin) {
  std::vector<std::string> names;
  for (const BoundKey& key : keys) {
    if (key.description.path == path) return key;
    names.push_back(key.description.path);
  }
  throw Error::invalid_input("unknown key " + path + " (" + origin + ")" + suggestion(path, names))
      .with_key(path, "");
}

nlohmann::ordered_json to_json(const Keys& keys) {
  nlohmann::ordered_json tree = nlohmann::ordered_json::object();
  for (const BoundKey& key : keys) {
    std::string pointer = "/" + key.description.path;
    std::replace(pointer.begin(), pointer.end(), '.', '/');
    auto& entry = tree[nlohmann::ordered_json::json_pointer(pointer)];
    std::visit(Overload{[&](Eigen::Vector3d* v) {
                          entry = {v->x(), v->y(), v->z()};
                        },
                        [&](Parameters* p) { entry = *p; }, [&](const NamedValue& x) { entry = x.name(); },
                        [&](auto* x) { entry = *x; }},
               key.field);
  }
  return tree;
}

std::string nearest_name(const std::string& name, const std::vector<std::string>& candidates) {
  std::string nearest;
  std::size_t fewest = std::max<std::size_t>(2, name.size() / 3) + 1;
  for (const std::string& candidate : candidates) {
    std::vector<std::size_t> edits(candidate.size() + 1);  // a row of distances (Levenshtein 1966)
    for (std::size_t j = 0; j <= candidate.size(); ++j) edits[j] = j;
    for (std::size_t i = 1; i <= name.size(); ++i) {
      std::size_t diagonal = std::exchange(edits[0], i);
      for (std::size_t j = 1; j <= candidate.size(); ++j) {
        const std::size_t replaced = diagonal + (name[i - 1] != candidate[j - 1]);
        diagonal = edits[j];
        edits[j] = std::min({replaced, edits[j] + 1, edits[j - 1] + 1});
      }
    }
    if (edits.back() < fewest) fewest = edits.back(), nearest = candidate;
  }
  return nearest;
}

std::string suggestion(const std::string& name, const std::vector<std::string>& candidates) {
  const std::string nearest = nearest_name(name, candidates);
  return nearest.empty() ? "" : "; did you mean " + nearest + "?";
}

std::string join(const std::vector<std::string>& words, const std::string& separator) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : separator) + word;
  return text;
}

}  // namespace hysteron
