#include "experiments/workbench/app/law_family.h"

#include <algorithm>
#include <vector>

#include "render/color_map.h"

namespace hysteron::experiments {
namespace {

constexpr render::Rgb8 kGrey{96, 99, 104};

struct Family {
  const char* name;
  std::vector<std::string> laws;  // coloured from dark to light
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
  const std::vector<Family>& all = families();
  for (std::size_t f = 0; f < all.size(); ++f) {
    const std::vector<std::string>& laws = all[f].laws;
    const auto found = std::find(laws.begin(), laws.end(), law);
    if (found != laws.end())
      return render::family_color(static_cast<int>(f), static_cast<int>(found - laws.begin()),
                                  static_cast<int>(laws.size()));
  }
  return kGrey;
}

}  // namespace hysteron::experiments
