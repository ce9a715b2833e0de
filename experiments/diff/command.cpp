// `hysteron diff` compares two pictures, or the pictures of two folders, with each other and with limits.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>
#include <set>

#include "experiments/diff/diff.h"
#include "experiments/workbench/app/exit_status.h"
#include "experiments/workbench/app/experiment.h"
#include "experiments/workbench/app/run_files.h"
#include "experiments/workbench/pages/junit.h"
#include "sim/base/atomic_file.h"
#include "sim/base/csv.h"
#include "sim/base/error.h"
#include "sim/base/whole_file.h"
#include "sim/mesh/file_extension.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

using F = DiffFlags;
// clang-format off
const KeyRow<DiffFlags> kRows[] = {
    {"out", at<&F::out>, "", any(), "heat map, a PNG file; of folders: a folder for heat maps and diff.csv"},
    {"limits", at<&F::limits_file>, "", any(), "a TOML file of limits, or one of assets/limits by its name; flags take precedence"},
    {"junit", at<&F::junit>, "", any(), "a JUnit XML file, with a test case for each picture"},
    {"pixels-per-degree", at<&F::pixels_per_degree>, "1/degree", between(1, 1000), "of the eye that FLIP assumes; default 67: 3840 pixels on 0.7 m, seen from 0.7 m"},
    {"map", at<&F::map>, "", any(), "what heat maps show: the largest channel's difference, or FLIP"},
    {"json", at<&F::json>, "", any(), "one JSON object on stdout"},
};
// clang-format on

Keys bind_diff(DiffFlags& flags) {
  Keys keys = bind(kRows, flags);
  for (const BoundKey& key : bind_limits(flags.limits)) keys.push_back(key);
  return keys;
}

Json diff_json(const Measures& measures) {
  Json json;
  for (const Measure& m : all_measures()) json[m.name] = measures.*m.value;  // infinite values become null
  return json;
}

std::string measure_text(double value) { return std::isinf(value) ? "inf" : number_field(value); }

// Prints one line on stderr for a pair beyond its limits.
void report_error(const fs::path& a, const fs::path& b, const std::vector<std::string>& broken) {
  if (!broken.empty())
    std::cerr << "hysteron diff: " << a.string() << " against " << b.string() << ": " << join(broken, "; ")
              << std::endl;
}

std::string suite_name(const fs::path& a, const fs::path& b) { return a.string() + " against " + b.string(); }

TestCase test_case(const std::string& name, const std::vector<std::string>& broken) {
  using Outcome = TestCase::Outcome;
  return {name, broken.empty() ? Outcome::passed : Outcome::failed, join(broken, "; ")};
}

TestCase case_not_compared(const std::string& name, const std::string& why) {
  return {name, TestCase::Outcome::broken, why};
}

void make_parent_folder(const fs::path& file) {
  if (file.has_parent_path()) make_folders(file.parent_path());
}

// Throws if the output would overwrite an input.
void require_other(const fs::path& out, const fs::path& input) {
  std::error_code missing;
  if (fs::equivalent(out, input, missing))
    throw Error::invalid_input("--out " + out.string() + " is " + input.string() +
                               ", which is compared: give another name")
        .with_key("out", out.string());
}

// Compares two files; a pair that cannot be compared is also recorded in the JUnit file.
Comparison compared_files(const fs::path& a, const fs::path& b, const DiffFlags& flags) {
  try {
    return compare_files(a, b, flags);
  } catch (const Error& error) {
    if (!flags.junit.empty())
      write_junit(flags.junit, "diff", suite_name(a, b),
                  {case_not_compared(a.filename().string(), error.what())});
    throw;
  }
}

// Throws if the file limits none of these pictures: it was meant for something else, and all would pass.
void require_a_limit(const DiffFlags& flags, const std::vector<std::string>& names) {
  if (flags.limits_file.empty()) return;
  for (const std::string& name : names)
    if (flags.from_file.of_picture(name).has_any()) return;
  throw Error::invalid_input("limits = " + flags.limits_file + " must limit " +
                             (names.size() == 1 ? names.front() : "a picture that is compared") +
                             ", and limits none (--limits)")
      .with_key("limits", flags.limits_file);
}

int diff_pictures(const fs::path& a, const fs::path& b, const DiffFlags& flags) {
  if (!flags.out.empty() && (file_extension(flags.out) != ".png" || fs::is_directory(flags.out)))
    throw Error::invalid_input("--out " + flags.out + " must be a file *.png: the heat map of two pictures")
        .with_key("out", flags.out);
  for (const fs::path& picture : {a, b}) require_other(flags.out, picture);
  require_own_file(flags.out, render::kPngMark, "a picture", "out");
  const std::string name = a.filename().string();
  require_a_limit(flags, {name});
  const Comparison comparison = compared_files(a, b, flags);
  const std::vector<std::string> broken = broken_limits(comparison.measures, flags.picture_limits(name));
  if (!flags.out.empty()) {
    make_parent_folder(flags.out);
    render::write_png(flags.out, comparison.heat);
  }
  if (flags.json) {
    Json json = {{"a", a.string()}, {"b", b.string()}};
    json.update(diff_json(comparison.measures));
    json["broken"] = broken;
    std::cout << json.dump(2) << std::endl;
  } else {
    for (const Measure& m : all_measures())
      std::cout << m.name << " " << measure_text(comparison.measures.*m.value) << "\n";
  }
  report_error(a, b, broken);
  if (!flags.junit.empty()) write_junit(flags.junit, "diff", suite_name(a, b), {test_case(name, broken)});
  return broken.empty() ? 0 : kDiffers;
}

// Throws if the output lies in a compared folder, where the next comparison would find it as a picture.
void require_outside(const fs::path& out, const fs::path& folder) {
  const fs::path inner = fs::weakly_canonical(out), outer = fs::weakly_canonical(folder);
  const auto [end, ignored] = std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end());
  if (end == outer.end())
    throw Error::invalid_input("--out " + out.string() + " must not be in " + folder.string() +
                               ", whose pictures are compared")
        .with_key("out", out.string());
}

void print_row(const std::string& name, std::size_t width, std::vector<std::string> cells) {
  std::vector<int> widths = {-static_cast<int>(width)};
  for (const Measure& m : all_measures())
    widths.push_back(static_cast<int>(1 + std::max<std::size_t>(10, std::string(m.name).size())));
  cells.insert(cells.begin(), name);
  std::cout << aligned(cells, widths) << std::endl;
}

std::vector<std::string> cells(const Measures& measures) {
  std::vector<std::string> texts;
  for (const Measure& m : all_measures()) texts.push_back(measure_text(measures.*m.value));
  return texts;
}

std::vector<std::string> no_cells() { return std::vector<std::string>(all_measures().size(), "-"); }

FolderDiff compare_folders(const fs::path& a, const fs::path& b, const DiffFlags& flags,
                           const std::vector<std::string>& names, std::size_t width) {
  FolderDiff diff{a, b, {}, {}};
  for (const std::string& name : names) {
    render::Image heat;
    const FolderDiff::Row& row = diff.rows.emplace_back(compare_in_folders(a, b, name, flags, heat));
    const bool compared = row.error.empty();
    if (compared) diff.worst = diff.compared() == 1 ? row.measures : worse_measures(diff.worst, row.measures);
    if (compared && !flags.out.empty()) {
      const fs::path file = fs::path(flags.out) / kHeatFolder / name;
      make_parent_folder(file);
      render::write_png(file, heat);
    }
    if (!flags.json) print_row(name, width, compared ? cells(row.measures) : no_cells());
    report_error(a / name, b / name, compared ? row.broken : std::vector{row.error});
  }
  return diff;
}

Json diff_json(const FolderDiff& diff) {
  Json pictures = Json::array();
  for (const FolderDiff::Row& row : diff.rows) {
    Json picture = {{"name", row.name}};
    if (row.error.empty()) {
      picture.update(diff_json(row.measures));
      picture["broken"] = row.broken;
    } else {
      picture["error"] = row.error;
    }
    pictures.push_back(picture);
  }
  Json all = {{"a", diff.a.string()}, {"b", diff.b.string()}, {"pictures", pictures}};
  if (diff.compared() > 0) all["worst"] = diff_json(diff.worst);
  return all;
}

// Writes a row for each picture.
void write_table(const fs::path& path, const FolderDiff& diff) {
  std::vector<std::string> head = {"picture"};
  for (const Measure& m : all_measures()) head.push_back(m.column);
  head.push_back("error");
  Table table(head);
  for (const FolderDiff::Row& row : diff.rows) {
    std::vector<Cell> fields = {row.name};
    for (const Measure& m : all_measures())
      fields.push_back(row.error.empty() ? Cell(row.measures.*m.value) : Cell(""));
    fields.push_back(row.error);
    table.row(fields);
  }
  table.write(path);
}

// Returns the names of the heat maps that an earlier comparison wrote into this folder, as listed in its
// table.
std::set<fs::path> earlier_heat_maps(const fs::path& out) {
  std::set<fs::path> names;
  std::error_code ignored;
  if (out.empty() || !fs::is_regular_file(out / kDiffTable, ignored)) return names;
  try {
    const Table table = read_table(out / kDiffTable);
    for (std::size_t row = 0; row < table.rows.size(); ++row)
      if (const fs::path name = table.word(row, "picture");
          stays_inside(name) && !is_behind_a_link(out / kHeatFolder, name))
        names.insert(name);
  } catch (const Error&) {
    // A table that cannot be read lists no heat maps.
  }
  return names;
}

// Removes the earlier heat maps of pictures that were not compared this time.
void remove_earlier_heat_maps(const fs::path& out, std::set<fs::path> earlier, const FolderDiff& diff) {
  for (const FolderDiff::Row& row : diff.rows)
    if (row.error.empty()) earlier.erase(row.name);
  remove_files(out / kHeatFolder, earlier);
}

int diff_folders(const fs::path& a, const fs::path& b, const DiffFlags& flags) {
  if (!flags.out.empty()) {
    require_outside(flags.out, a);
    require_outside(flags.out, b);
    for (const fs::path& folder : {a, b}) require_other(fs::path(flags.out) / kHeatFolder, folder);
    require_own_file(fs::path(flags.out) / kDiffTable, std::string("picture,") + all_measures()[0].column,
                     "a table of differences", "out");
  }
  const std::vector<std::string> names = pictures_in_either(a, b);
  flags.from_file.refuse_unused_pictures(names);
  require_a_limit(flags, names);
  const std::set<fs::path> earlier = earlier_heat_maps(flags.out);
  std::size_t width = std::string("picture").size();
  for (const std::string& name : names) width = std::max(width, name.size());
  if (!flags.json) {
    std::vector<std::string> head;
    for (const Measure& m : all_measures()) head.push_back(m.name);
    print_row("picture", width, head);
  }
  const FolderDiff diff = compare_folders(a, b, flags, names, width);
  if (flags.json) {
    std::cout << diff_json(diff).dump(2) << std::endl;
  } else {
    print_row("worst", width, diff.compared() > 0 ? cells(diff.worst) : no_cells());
  }
  if (!flags.out.empty()) {
    remove_earlier_heat_maps(flags.out, earlier, diff);
    write_table(fs::path(flags.out) / kDiffTable, diff);
  }
  std::vector<TestCase> cases;
  int exit_code = 0;  // a failed comparison outweighs a difference
  for (const FolderDiff::Row& row : diff.rows) {
    const bool compared = row.error.empty();
    cases.push_back(compared ? test_case(row.name, row.broken) : case_not_compared(row.name, row.error));
    if (!compared)
      exit_code = row.exit_code;
    else if (!row.broken.empty() && exit_code == 0)
      exit_code = kDiffers;
  }
  if (!flags.junit.empty()) write_junit(flags.junit, "diff", suite_name(a, b), cases);
  return exit_code;
}

int run_diff(const CommandLine& line) {
  DiffFlags flags;
  set_keys(line, bind_diff(flags));
  if (line.positionals.size() != 2)
    throw Error::invalid_input("needs two pictures or two folders: hysteron diff A.png B.png; " +
                               std::to_string(line.positionals.size()) + " given");
  const fs::path a = line.positionals[0], b = line.positionals[1];
  require_own_junit(flags.junit);
  if (!flags.limits_file.empty()) flags.from_file = read_limits(flags.limits_file);
  if (!fs::is_directory(a) && !fs::is_directory(b)) return diff_pictures(a, b, flags);
  check_there(a);
  check_there(b);
  if (fs::is_directory(a) != fs::is_directory(b))
    throw Error::invalid_input((fs::is_directory(a) ? a : b).string() + " is a folder and " +
                               (fs::is_directory(a) ? b : a).string() +
                               " is not: give two pictures or two folders");
  return diff_folders(a, b, flags);
}

}  // namespace

Experiment diff() {
  return {.name = "diff",
          .question = "how far two pictures, or two folders of them, differ",
          .run = run_diff,
          .own_keys = own_key_descriptions<bind_diff>,
          .positionals = "A.png B.png",
          .differs = "a picture is beyond a limit",
          .conditions = {{"map", "out"}}};
}

}  // namespace hysteron::experiments
