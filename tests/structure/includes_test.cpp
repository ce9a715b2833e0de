// Folders include each other one way only: python -> experiments -> render -> libraries beside the simulation
// -> the rest of sim, and inside each of them no folder one that includes it, directly or through others. Nor
// does a folder call what is defined above it.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <sstream>
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

std::string folder_layer(const std::string& folder) {
  std::string found;
  for (const std::string layer : kLayers)
    if ((folder + "/").starts_with(layer + "/") && layer.size() > found.size()) found = layer;
  return found;
}

bool is_source(const fs::path& file) {
  static const std::set<std::string> kEndings = {".h", ".cpp", ".in"};
  return kEndings.contains(file.extension().string());
}

Folders source_folders(const fs::path& root) {
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
    return std::find(kLayers.begin(), kLayers.end(), folder_layer(folder)) - kLayers.begin();
  };
  std::vector<std::string> back;
  for (const auto& [folder, included] : folders)
    for (const std::string& other : included)
      if (rank(other) > rank(folder) || leads_to(folders, other, folder))
        back.push_back(folder + " -> " + other);
  return back;
}

// The functions that files below a folder declare, not indented, or define.
struct Functions {
  std::map<std::string, std::string> declared;  // in headers, by name: the file
  std::set<std::string> defined;
};

void add_functions(const fs::path& file, Functions& all) {
  static const std::regex kFunction(
      "(?!using|struct|class|template|namespace|extern|typedef|enum|inline|constexpr|static_assert|#|/)"
      "[\\w:<>,&* ]+[ &*](?:\\w+::)?(\\w+)\\(.*");
  std::istringstream lines(whole_file(file.string(), "reading functions"));
  std::smatch found;
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line[0] == ' ' || !std::regex_match(line, found, kFunction)) continue;
    const std::string name = found[1];
    while (line.find_first_of(";{") == line.npos && std::getline(lines, line)) continue;
    const std::size_t end = line.find_first_of(";{");
    if (end == line.npos) continue;
    if (line[end] == '{')
      all.defined.insert(name);
    else if (file.extension() == ".h")
      all.declared.emplace(name, file.string());
  }
}

// "experiments() of sim/a/a.h": functions that a folder's headers promise and that no file in it defines, so
// that whoever calls them calls up.
std::vector<std::string> defined_above(const fs::path& root, const std::string& folder) {
  Functions all;
  for (const auto& entry : fs::recursive_directory_iterator(root / folder))
    if (entry.is_regular_file()) add_functions(entry.path(), all);
  all.defined.insert("embedded_file");  // by the build
  std::vector<std::string> above;
  for (const auto& [name, file] : all.declared)
    if (!all.defined.contains(name)) above.push_back(name + "() of " + fs::relative(file, root).string());
  return above;
}

TEST(Calls, OfTheProjectRunOneWay) {
  for (const char* folder : {"sim", "render", "experiments/workbench"})
    EXPECT_EQ(defined_above(HYSTERON_SOURCE_FOLDER, folder), std::vector<std::string>()) << folder;
}

TEST(Calls, ThatRunUpAreFound) {
  const test::Folder folder;
  const fs::path root = folder.file("root");
  fs::create_directories(root / "sim" / "a");
  folder.write("root/sim/a/a.h", "const std::vector<int>& all();\nint one(int a,\n        int b);\n");
  folder.write("root/sim/a/a.cpp", "int one(int a,\n        int b) {\n  return all()[a + b];\n}\n");
  EXPECT_EQ(defined_above(root, "sim"), std::vector<std::string>{"all() of sim/a/a.h"});
}

TEST(Includes, OfTheProjectRunOneWay) {
  const Folders folders = source_folders(HYSTERON_SOURCE_FOLDER);
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
  EXPECT_EQ(arrows_back(source_folders(root)), std::vector<std::string>());
  write("sim/c/c.cpp", "sim/a/a.h");
  EXPECT_EQ(arrows_back(source_folders(root)),
            (std::vector<std::string>{"sim/a -> sim/b", "sim/b -> sim/c", "sim/c -> sim/a"}));
  write("sim/c/c.cpp", "sim/identification/i.h");
  EXPECT_EQ(arrows_back(source_folders(root)), std::vector<std::string>{"sim/c -> sim/identification"});
  write("experiments/a/a.cpp", "python/a.h");
  EXPECT_EQ(arrows_back(source_folders(root)).front(), "experiments/a -> python");
  write("experiments/a/a.cpp", "sim/a/a.h");
  write("sim/c/c.cpp", "render/a/a.h");
  EXPECT_EQ(arrows_back(source_folders(root)), std::vector<std::string>{"sim/c -> render/a"});
}

}  // namespace
}  // namespace hysteron
