#include "experiments/workbench/app/json_file.h"

#include "sim/base/error.h"
#include "sim/base/whole_file.h"

namespace hysteron::experiments {
namespace {

constexpr int kDeepest = 64;  // its texts are put together by recursion
constexpr std::size_t kMaxJsonBytes = std::size_t{256} << 20;

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
  if (json.is_discarded()) refuse("was cut off or edited");
  return json;
}

Json read_json(const std::filesystem::path& file, const std::string& kind) {
  return json_in(whole_file(file, "cannot read " + file.string(), kMaxJsonBytes), file, kind);
}

Json json_or_none(const std::filesystem::path& file) {
  try {
    return read_json(file);
  } catch (const Error&) {
    return Json(Json::value_t::discarded);
  }
}

}  // namespace hysteron::experiments
