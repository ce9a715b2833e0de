// Folders include each other one way only: python -> experiments -> render -> libraries beside the simulation
// -> the rest of sim, and inside each of them no folder one that includes it, directly or through others.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "sim/base/whole_file.h"
#include "tests/sim/base/folder.h"

namespace hysteron {
namespace {
namespace fs = std::filesystem;

// Each may include those before it; the folder of the longest name counts.
constexpr std::array kLayers = {"sim",    "sim/reference", "sim/identification",
                                "render", "experiments",   "python"};

using Folders = std::map<std::string, std::set<std::string>>;  // what each includes

std::string layer_of(const std::string& folder) {
  std::string found;
  for (const std::string layer : kLayers)
    if ((folder + "/").starts_with(layer + "/") && layer.size() > found.size()) found = layer;
  return found;
}

bool is_source(const fs::path& file) {
  static const std::set<std::string> kEndings = {".h", ".cpp", ".in"};
  return kEndings.contains(file.extension().string());
}

Folders folders_of(const fs::path& root) {
  static const std::regex kInclude(
      "#\\s*include \"((?:sim|render|experiments|python)(?:/[^\"/]+)*)/[^/\"]+\"");
  Folders folders;
  for (const char* layer : kLayers) {
    if (!fs::exists(root / layer)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(root / layer)) {
      if (!entry.is_regular_file() || !is_source(entry.path())) continue;
      const std::string folder = fs::relative(entry.path().parent_path(), root).string(),
                        text = whole_file(entry.path().string(), "reading includes");
      for (std::sregex_iterator match(text.begin(), text.end(), kInclude), end; match != end; ++match)
        if ((*match)[1] != folder) folders[folder].insert((*match)[1]);
    }
  }
  return folders;
}

bool leads_to(const Folders& folders, const std::string& from, const std::string& to) {
  std::set<std::string> seen;
  std::vector<std::string> waiting = {from};
  while (!waiting.empty()) {
    const std::string at = waiting.back();
    waiting.pop_back();
    if (at == to) return true;
    if (!seen.insert(at).second || !folders.contains(at)) continue;
    waiting.insert(waiting.end(), folders.at(at).begin(), folders.at(at).end());
  }
  return false;
}

std::vector<std::string> arrows_back(const Folders& folders) {
  const auto rank = [](const std::string& folder) {
    return std::find(kLayers.begin(), kLayers.end(), layer_of(folder)) - kLayers.begin();
  };
  std::vector<std::string> back;
  for (const auto& [folder, included] : folders)
    for (const std::string& other : included)
      if (rank(other) > rank(folder) || leads_to(folders, other, folder))
        back.push_back(folder + " -> " + other);
  return back;
}

TEST(Includes, OfTheProjectRunOneWay) {
  const Folders folders = folders_of(HYSTERON_SOURCE_FOLDER);
  EXPECT_GT(folders.size(), 30u);
  EXPECT_EQ(arrows_back(folders), std::vector<std::string>());
}

TEST(Includes, ThatRunBackAreFound) {
  const test::Folder folder;
  const fs::path root = folder.file("root");
  const auto write = [&](const std::string& name, const std::string& included) {
    fs::create_directories((root / name).parent_path());
    folder.write("root/" + name, "#include \"" + included + "\"\n");
  };
  write("sim/a/a.h", "sim/b/b.h");
  write("sim/b/b.cpp", "sim/c/c.h");
  EXPECT_EQ(arrows_back(folders_of(root)), std::vector<std::string>());
  write("sim/c/c.cpp", "sim/a/a.h");
  EXPECT_EQ(arrows_back(folders_of(root)),
            (std::vector<std::string>{"sim/a -> sim/b", "sim/b -> sim/c", "sim/c -> sim/a"}));
  write("sim/c/c.cpp", "sim/identification/i.h");
  EXPECT_EQ(arrows_back(folders_of(root)), std::vector<std::string>{"sim/c -> sim/identification"});
  write("experiments/a/a.cpp", "python/a.h");
  EXPECT_EQ(arrows_back(folders_of(root)).front(), "experiments/a -> python");
  write("experiments/a/a.cpp", "sim/a/a.h");
  write("sim/c/c.cpp", "render/a/a.h");
  EXPECT_EQ(arrows_back(folders_of(root)), std::vector<std::string>{"sim/c -> render/a"});
}

}  // namespace
}  // namespace hysteron
