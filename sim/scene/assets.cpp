#include "sim/scene/assets.h"

#include <algorithm>
#include <cstdlib>

#include "sim/base/error.h"
#include "sim/scene/key_table.h"

namespace hysteron {
namespace fs = std::filesystem;

namespace {
constexpr char kAssets[] = "assets";  // how names in records begin
fs::path assets_place;                // the folder of another program that uses the library; empty: none

fs::path folder_if_any() {
  try {
    return assets_folder();
  } catch (const Error&) {  // in an installation without assets
    return {};
  }
}
}  // namespace

void set_assets_place(const fs::path& folder) { assets_place = folder; }

fs::path assets_folder() {
  std::error_code ignored;
  if (const char* named = std::getenv("HYSTERON_ASSETS"); named && *named) {
    if (fs::is_directory(named, ignored)) return named;
    throw Error::system(std::string("HYSTERON_ASSETS = ") + named + " is no folder; unset it or name one");
  }
  const fs::path binary = fs::read_symlink("/proc/self/exe", ignored);
  const fs::path beside = binary.parent_path();
  std::vector<fs::path> places = {beside / "assets", beside.parent_path() / "share" / "hysteron" / "assets",
                                  fs::path(HYSTERON_SOURCE_DIR) / "assets"};
  if (!assets_place.empty()) places.insert(places.begin(), assets_place);
  std::vector<std::string> looked;
  for (const fs::path& place : places) {
    if (fs::is_directory(place, ignored)) return place;
    looked.push_back(place.string());
  }
  throw Error::system("no assets folder at " + join(looked, " or ") + "; set HYSTERON_ASSETS to it");
}

fs::path find_asset(const std::string& kind, const std::string& name, const std::string& origin) {
  std::error_code ignored;
  for (const fs::path& file : {fs::path(name), asset_place(name)})
    if (fs::is_regular_file(file, ignored)) return file;
  const fs::path folder = assets_folder() / kind;
  std::string hyphenated = name;  // others spell the same names with hyphens
  std::replace(hyphenated.begin(), hyphenated.end(), '_', '-');
  for (const std::string& spelled : {name, hyphenated})
    if (const fs::path file = folder / (spelled + ".toml");
        !spelled.empty() && fs::is_regular_file(file, ignored))
      return file;
  const std::vector<std::string> names = list_assets(kind);
  throw Error::invalid_input("no file and none of the " + kind + " is called \"" + name + "\" (" + origin +
                             "); there are: " + join(names, ", ") + suggestion(name, names));
}

std::string asset_name(const fs::path& file) {
  const fs::path folder = folder_if_any();
  if (folder.empty()) return file.string();
  const fs::path inside =
      fs::absolute(file).lexically_normal().lexically_relative(fs::absolute(folder).lexically_normal());
  const bool outside = inside.empty() || *inside.begin() == "..";
  return outside ? file.string() : (fs::path(kAssets) / inside).string();
}

fs::path asset_place(const std::string& name) {
  const fs::path path = name;
  if (path.empty() || *path.begin() != kAssets) return path;
  const fs::path folder = folder_if_any();
  return folder.empty() ? path : folder / path.lexically_relative(kAssets);
}

std::vector<std::string> list_assets(const std::string& kind) {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(assets_folder() / kind, ignored)) {
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace hysteron
