#include "experiments/workbench/app/key_conditions.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "sim/base/comma_list.h"
#include "sim/base/error.h"
#include "sim/base/number_in.h"

namespace hysteron::experiments {
namespace {

using Json = nlohmann::ordered_json;

std::vector<std::string> parts(const std::string& text, const std::string& separator) {
  std::vector<std::string> all;
  std::size_t begin = 0;
  for (std::size_t end; (end = text.find(separator, begin)) != text.npos; begin = end + separator.size())
    all.push_back(text.substr(begin, end - begin));
  all.push_back(text.substr(begin));
  return all;
}

bool names_key(const KeyCondition& condition, const std::string& key) {
  for (const std::string& name : parts(condition.keys, " | "))
    if (name == key || (name.ends_with('.') && key.starts_with(name))) return true;
  return false;
}

// A term of a condition: "not fab", "cloth.copies > 1", "crease.fold = rod | pleat".
struct Term {
  std::string key;
  std::string relation;  // one of "", "not", "=", "!=" or ">"
  std::vector<std::string> values;
};

Term parsed_term(const std::string& text) {
  if (text.starts_with("not ")) return {text.substr(4), "not", {}};
  for (const char* relation : {" != ", " = ", " > "}) {
    const std::size_t at = text.find(relation);
    if (at != text.npos)
      return {text.substr(0, at), parts(relation, " ")[1],
              parts(text.substr(at + std::string(relation).size()), " | ")};
  }
  return {text, "", {}};
}

std::string term_text(const Term& term) {
  std::vector<std::string> values = term.values;
  for (std::string& value : values)
    if (value == "*.obj") value = "FILE.obj";
  if (term.relation == "not") return "no --" + term.key;
  if (term.relation == "!=") return "--" + term.key + " other than " + join(values, " or ");
  if (term.relation == ">") return "--" + term.key + " above " + values[0];
  return "--" + term.key + (values.empty() ? "" : " " + join(values, " or "));
}

std::string needs_text(const KeyCondition& condition) {
  if (*condition.text) return condition.text;
  std::vector<std::string> alternatives;
  for (const std::string& alternative : parts(condition.needs, " or ")) {
    std::vector<std::string> terms;
    for (const std::string& term : parts(alternative, " and ")) terms.push_back(term_text(parsed_term(term)));
    alternatives.push_back(join(terms, " and "));
  }
  return join(alternatives, ", or ");
}

bool matches(const std::string& name, const std::string& pattern) {
  if (pattern.starts_with('*')) return name.ends_with(pattern.substr(1));
  if (pattern.ends_with('*')) return name.starts_with(pattern.substr(0, pattern.size() - 1));
  return name == pattern;
}

std::string shown_value(const Json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

// True unless the value is an empty text, false, zero, or an unset number.
bool is_on(const Json& value) {
  if (value.is_boolean()) return value.get<bool>();
  if (value.is_number()) return std::isfinite(value.get<double>()) && value.get<double>() != 0;
  if (value.is_string()) return !value.get_ref<const std::string&>().empty();
  return value.is_structured() && !value.empty();
}

// True if the flag is present and neither empty nor false.
bool is_given(const CommandLine& line, const std::string& key) {
  const std::string text = last_text(line.flags, key, "");
  return !text.empty() && text != "false";
}

// A request, for which conditions hold or do not.
class Request {
 public:
  Request(const CommandLine& line, const KeyValues& values) : line_(line), values_(values) {}

  bool holds(const KeyCondition& condition) const {
    for (const std::string& alternative : parts(condition.needs, " or ")) {
      const std::vector<std::string> terms = parts(alternative, " and ");
      if (std::all_of(terms.begin(), terms.end(), [&](const auto& term) { return holds(parsed_term(term)); }))
        return true;
    }
    return false;
  }

  // Returns the values for which the condition does not hold: "crease.fold = plate".
  std::string state(const KeyCondition& condition) const {
    std::vector<std::string> states;
    for (const std::string& alternative : parts(condition.needs, " or "))
      for (const std::string& text : parts(alternative, " and ")) {
        const Term term = parsed_term(text);
        if (holds(term)) continue;
        const Json& now = value(term.key);
        std::string state = is_on(now) ? term.key + " = " + shown_value(now) : "no --" + term.key;
        if (!std::count(states.begin(), states.end(), state)) states.push_back(state);
      }
    return join(states, ", ");
  }

 private:
  const Json& value(const std::string& key) const { return values_.at(key); }

  // True if the term holds or is not yet known.
  bool holds(const Term& term) const {
    if (std::count(line_.listed.begin(), line_.listed.end(), term.key) || !values_.contains(term.key))
      return true;
    const Json& now = value(term.key);
    const bool on = is_on(now) || (now.is_number() && is_given(line_, term.key));
    if (term.relation.empty()) return on;
    if (term.relation == "not") return !on;
    if (term.relation == ">") return now.is_number() && now.get<double>() > *number_in(term.values[0]);
    std::vector<std::string> names = split(shown_value(now));
    names.push_back(shown_value(now));
    const bool equal = std::any_of(names.begin(), names.end(), [&](const std::string& name) {
      return std::any_of(term.values.begin(), term.values.end(),
                         [&](const std::string& pattern) { return matches(name, pattern); });
    });
    return equal == (term.relation == "=");
  }

  const CommandLine& line_;
  const KeyValues& values_;
};

// Returns the first condition of the key that does not hold; null if all do.
const KeyCondition* broken_condition(const std::vector<KeyCondition>& conditions, const Request& request,
                                     const std::string& key) {
  for (const KeyCondition& condition : conditions)
    if (names_key(condition, key) && !request.holds(condition)) return &condition;
  return nullptr;
}

std::string unread_message(const Request& request, const KeyCondition& condition, const std::string& what,
                           const std::string& key) {
  return what + " is not used: " + key + " needs " + needs_text(condition) + " (" + request.state(condition) +
         ")";
}

// True if a condition depends on a key that the experiment fixes; it must then declare that condition itself.
bool depends_on_fixed_key(const KeyCondition& condition, const std::vector<FixedKey>& fixed) {
  for (const std::string& alternative : parts(condition.needs, " or "))
    for (const std::string& term : parts(alternative, " and "))
      if (has_key(fixed, parsed_term(term).key)) return true;
  return false;
}

}  // namespace

std::vector<KeyCondition> key_conditions(const Experiment& experiment) {
  std::vector<KeyCondition> all = experiment.conditions;
  if (!experiment.simulates) return all;
  const std::vector<FixedKey> fixed = experiment.fixed_keys();
  for (const KeyDescription& key : simulation_keys()) {
    const KeyCondition condition{key.path.c_str(), key.traits.needs, key.traits.needs_text};
    if (*condition.needs && !depends_on_fixed_key(condition, fixed)) all.push_back(condition);
  }
  return all;
}

std::string condition_text(const std::vector<KeyCondition>& conditions, const std::string& key) {
  std::vector<std::string> needs;
  for (const KeyCondition& condition : conditions)
    if (names_key(condition, key)) needs.push_back(needs_text(condition));
  return needs.empty() ? "" : "needs " + join(needs, "; ");
}

KeyValues key_values(const Keys& keys) {
  KeyValues values;
  for (const BoundKey& key : keys) {
    std::string place = "/" + key.description.path;
    std::replace(place.begin(), place.end(), '.', '/');
    values[key.description.path] = to_json(Keys{key}).at(Json::json_pointer(place));
  }
  return values;
}

std::vector<std::string> listed_names(const std::string& key, const std::string& list,
                                      const std::vector<std::string>& every) {
  if (!every.empty() && list == "all") return every;
  std::vector<std::string> names = split(list);
  if (names.empty())
    throw Error::invalid_input(key + " = \"" + list + "\" names none (--" + key + ")").with_key(key, list);
  for (auto name = names.begin(); name != names.end(); ++name)
    if (std::find(names.begin(), name, *name) != name)
      throw Error::invalid_input(key + " = " + list + " names " + *name + " twice (--" + key + ")")
          .with_key(key, list);
  return names;
}

void refuse_unread_flags(const CommandLine& line, const KeyValues& values) {
  const std::vector<KeyCondition> conditions = key_conditions(experiment_named(line.experiment));
  const Request request(line, values);
  for (const Flag& flag : line.flags) {
    const KeyCondition* condition = broken_condition(conditions, request, flag.path);
    if (!condition || !is_given(line, flag.path)) continue;
    throw Error::invalid_input(unread_message(request, *condition, flag.shown(), flag.path))
        .with_key(flag.path, flag.text());
  }
}

std::vector<Flag> without_unread_flags(const CommandLine& line, const Flag& change) {
  const std::vector<KeyCondition> conditions = key_conditions(experiment_named(line.experiment));
  const Json value = std::visit([](const auto& x) { return Json(x); }, change.value);
  const KeyValues changed = {{change.path, value}};
  const Request request(line, changed);
  std::vector<Flag> flags = line.flags;
  std::erase_if(flags, [&](const Flag& flag) { return broken_condition(conditions, request, flag.path); });
  return flags;
}

std::vector<std::string> unread_key_warnings(const CommandLine& line, const KeyValues& values,
                                             const KeyValues& usual) {
  const std::vector<KeyCondition> conditions = key_conditions(experiment_named(line.experiment));
  const Request request(line, values);
  std::vector<std::string> warnings;
  for (const auto& [key, value] : values) {
    const KeyCondition* condition = broken_condition(conditions, request, key);
    if (!condition || is_given(line, key) || value == usual.at(key) || !is_on(value)) continue;
    const std::string what = key + " = " + shown_value(value) + " of the scene's file";
    warnings.push_back(unread_message(request, *condition, what, key));
  }
  return warnings;
}

}  // namespace hysteron::experiments
