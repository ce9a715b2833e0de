#include "experiments/workbench/app/law_family.h"

#include <algorithm>
#include <vector>

#include "render/color_map.h"
#include "sim/base/enum_names.h"
#include "sim/bending/laws/law_parameters.h"

namespace hysteron::experiments {
namespace {

constexpr render::Rgb8 kGrey{96, 99, 104};

// The laws from dark to light, each among its family; laws that are not listed follow.
constexpr const char* kFromDarkToLight[] = {"linear", "pabst", "bridson",     "spring",        "narain",
                                            "obrien", "kim",   "terzopoulos", "grinspun-edit", "prandtl",
                                            "dahl",   "wong",  "bilinear",    "gong",          "chapman"};

const LawEntry* entry_of(const std::string& law) {
  const auto entry = std::ranges::find(law_catalogue(), law, &LawEntry::name);
  return entry == law_catalogue().end() ? nullptr : &*entry;
}

std::vector<std::string> laws_of(LawFamily family) {
  std::vector<std::string> laws;
  for (const LawEntry& entry : law_catalogue())
    if (entry.family == family) laws.push_back(entry.name);
  const auto shade = [](const std::string& law) { return std::ranges::find(kFromDarkToLight, law); };
  std::ranges::stable_sort(laws, {}, shade);
  return laws;
}

}  // namespace

std::string family_of_law(const std::string& law) {
  const LawEntry* const entry = entry_of(law);
  return entry ? enum_name(entry->family) : "";
}

render::Rgb8 color_of_law(const std::string& law) {
  const LawEntry* const entry = entry_of(law);
  if (!entry) return kGrey;
  const std::vector<std::string> laws = laws_of(entry->family);
  const auto shade = std::ranges::find(laws, law) - laws.begin();
  return render::family_color(static_cast<int>(entry->family), static_cast<int>(shade),
                              static_cast<int>(laws.size()));
}

}  // namespace hysteron::experiments
