#include "experiments/workbench/app/law_family.h"

#include <algorithm>
#include <vector>

#include "render/color_map.h"

namespace hysteron::experiments {
namespace {

constexpr render::Rgb8 kGrey{96, 99, 104};

struct Family {
  const char* name;
  std::vector<std::string> laws;  // from dark to light
};

const std::vector<Family>& families() {
  static const std::vector<Family> kAll = {
      {"elastic", {"linear", "pabst", "bridson", "spring"}},
      {"plastic", {"narain", "obrien", "kim", "terzopoulos", "grinspun-edit"}},
      {"hysteretic", {"prandtl", "dahl", "wong", "bilinear", "gong", "chapman"}}};
  return kAll;
}

}  // namespace

std::string family_of_law(const std::string& law) {
  for (const Family& family : families())
    if (std::count(family.laws.begin(), family.laws.end(), law)) return family.name;
  return "";
}

render::Rgb8 color_of_law(const std::string& law) {
  for (const auto& [family, laws] : families()) {
    const auto found = std::find(laws.begin(), laws.end(), law);
    if (found != laws.end())
      return color_in_family(family, static_cast<int>(found - laws.begin()), static_cast<int>(laws.size()));
  }
  return kGrey;
}

render::Rgb8 color_in_family(const std::string& family, int member, int members) {
  for (std::size_t f = 0; f < families().size(); ++f)
    if (families()[f].name == family) return render::family_color(static_cast<int>(f), member, members);
  return kGrey;
}

}  // namespace hysteron::experiments
