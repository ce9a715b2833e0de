#include "experiments/workbench/app/json_file.h"

#include <algorithm>

#include "sim/base/error.h"
#include "sim/base/plain_text.h"
#include "sim/base/whole_file.h"

namespace hysteron::experiments {
namespace {

constexpr int kDeepest = 64;  // limit of nesting, as texts are assembled by recursion
constexpr std::size_t kMaxJsonBytes = std::size_t{256} << 20;

std::string json_text(const std::filesystem::path& file) {
  return utf8_text(whole_file(file, "cannot read " + file.string(), kMaxJsonBytes));
}

// Returns the damage of a text that is no JSON but may have been: "is empty", "was cut off or edited"; "" if
// it does not begin as JSON.
std::string damage_of(const std::string& text) {
  const std::string_view content = trimmed(text);
  if (content.empty()) return "is empty";
  return content.front() == '{' || content.front() == '[' ? "was cut off or edited" : "";
}

}  // namespace

Json json_in(const std::string& text, const std::filesystem::path& file, const std::string& kind) {
  const auto refuse = [&](const std::string& why) {
    throw Error::invalid_input(file.string() + " is no " + kind + ": it " + why);
  };
  const auto watch_depth = [&](int depth, Json::parse_event_t, const Json&) {
    if (depth > kDeepest) refuse("nests more than " + std::to_string(kDeepest) + " deep");
    return true;
  };
  Json json = Json::parse(text, watch_depth, false);
  if (!json.is_discarded()) return json;
  if (const std::string damage = damage_of(text); !damage.empty())
    throw Error::invalid_input(file.string() + " is damaged: it " + damage);
  refuse("was cut off or edited");
  return json;
}

Json read_json(const std::filesystem::path& file, const std::string& kind) {
  return json_in(json_text(file), file, kind);
}

std::string json_damage(const std::filesystem::path& file) {
  try {
    const std::string text = json_text(file);
    return parsed_json(text).is_discarded() ? damage_of(text) : "";
  } catch (const Error&) {
    return "";
  }
}

Json json_or_none(const std::filesystem::path& file) {
  try {
    return read_json(file);
  } catch (const Error&) {
    return Json(Json::value_t::discarded);
  }
}

Json parsed_json(std::string_view text) { return Json::parse(text, nullptr, false); }

const Json& json_at(const Json& json, std::string path) {
  static const Json kNothing;
  std::replace(path.begin(), path.end(), '.', '/');
  const Json::json_pointer place("/" + path);
  return json.contains(place) ? json.at(place) : kNothing;
}

std::string differing_keys(const Json& keys, const Json& others) {
  constexpr int kShown = 6;
  const auto a = keys.flatten(), b = others.flatten();
  std::string names;
  int count = 0;
  const auto add = [&](const std::string& pointer) {
    if (pointer.empty()) return;  // an empty object becomes one entry without a name
    if (++count > kShown) return;
    std::string path = pointer.substr(1);
    std::replace(path.begin(), path.end(), '/', '.');
    names += (names.empty() ? "" : ", ") + path;
  };
  for (const auto& [key, value] : a.items())
    if (!b.contains(key) || b[key] != value) add(key);
  for (const auto& [key, value] : b.items())
    if (!a.contains(key)) add(key);
  if (count > kShown) names += " and " + std::to_string(count - kShown) + " more";
  return names;
}

}  // namespace hysteron::experiments
