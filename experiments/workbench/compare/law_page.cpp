#include "experiments/workbench/compare/law_page.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "experiments/workbench/compare/comparison_table.h"
#include "experiments/workbench/pages/report.h"
#include "render/color_map.h"
#include "render/contact_sheet.h"
#include "render/png_writer.h"
#include "sim/base/comma_list.h"
#include "sim/base/error.h"
#include "sim/bending/laws/law_parameters.h"
#include "sim/scene/assets.h"

namespace hysteron::experiments {
namespace {

struct Finding {
  std::string law, failed;
  LawOutcome outcome;
};

bool is_law(const Flag& flag) { return flag.path == "law"; }
bool is_fabric(const Flag& flag) { return flag.path == "fabric" || flag.path == "fabric.name"; }
bool is_integrator(const Flag& flag) { return flag.path == "integrator"; }
bool is_list(const std::string& text) {
  return text == "all" || text.find_first_of(",+") != std::string::npos;
}

// The same line for one variant, into a folder of its name.
CommandLine line_of(const CommandLine& line, const LawVariant& law, const std::filesystem::path& folder) {
  CommandLine one = line;
  std::erase_if(one.flags, [](const Flag& f) { return f.path == "out" || f.path == "json"; });
  one.flags = with_later(one.flags, law.flags);
  one.flags.push_back({"out", (folder / law.name).string()});
  one.command += " (" + law.name + ")";
  return one;
}

// The names of the last such flag, `all` being `every`; one empty name without the flag.
std::vector<std::string> names_in(const CommandLine& line, bool (*is_it)(const Flag&),
                                  const std::vector<std::string>& every) {
  std::string text;
  for (const Flag& flag : line.flags)
    if (is_it(flag)) text = flag.text;
  if (text.empty()) return {""};
  return text == "all" ? every : split(text);
}

// "linear" is --law linear; "linear+fabric.damping=1e-3" is --fabric.damping 1e-3 besides.
void add_flags(std::vector<Flag>& flags, const std::string& path, const std::string& text) {
  std::istringstream parts(text);
  std::string part;
  std::getline(parts, part, '+');
  flags.push_back({path, part});
  while (std::getline(parts, part, '+')) {
    const std::size_t equals = part.find('=');
    if (equals == part.npos) throw Error::request(text + ": \"" + part + "\" must be key=value");
    flags.push_back({part.substr(0, equals), part.substr(equals + 1)});
  }
}

// Each variant with each of the names, which stand in its own name where there are several.
std::vector<LawVariant> multiplied(const std::vector<LawVariant>& variants, const std::string& path,
                                   const std::vector<std::string>& names) {
  std::vector<LawVariant> result;
  for (const LawVariant& variant : variants)
    for (const std::string& name : names) {
      LawVariant one = variant;
      if (names.size() > 1 && name.empty())
        throw Error::request(path + " has a comma without a name before it (--" + path + ")");
      if (names.size() > 1) one.name += (one.name.empty() ? "" : "-") + column_name(name);
      if (!name.empty()) add_flags(one.flags, path, name);
      result.push_back(std::move(one));
    }
  return result;
}

bool are_same(const std::vector<Flag>& a, const std::vector<Flag>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const Flag& x, const Flag& y) { return x.path == y.path && x.text == y.text; });
}

// Each has a folder: those of files with equal stems are numbered.
void name_apart(std::vector<LawVariant>& variants) {
  std::set<std::string> taken;
  for (std::size_t i = 0; i < variants.size(); ++i) {
    std::string& name = variants[i].name;
    for (std::size_t j = 0; j < i; ++j)
      if (are_same(variants[i].flags, variants[j].flags))
        throw Error::request(name + " is named twice: columns must differ");
    const std::string stem = name;
    for (int number = 2; !taken.insert(name).second; ++number) name = stem + "-" + std::to_string(number);
  }
}

void write_findings(Run& run, const std::string& varied, const std::vector<Finding>& all) {
  std::vector<ComparisonRow> rows;
  for (const Finding& f : all) {
    rows.push_back({f.law, {}, f.failed});
    for (const auto& [name, value] : f.outcome.numbers) rows.back().metrics.set(name, value);
  }
  write_comparison_table(run, varied, rows);
}

void draw(Run& run, const LawPage& page, const std::vector<Finding>& all) {
  std::vector<render::SheetEntry> entries;
  for (const Finding& f : all)
    if (f.outcome.picture) entries.push_back({*f.outcome.picture, f.law + ": " + f.outcome.caption});
  if (!entries.empty())
    render::write_png(run.path("sheet.png"), render::contact_sheet(entries, {page.title}),
                      render::PngEffort::best);
  for (std::size_t p = 0; p < page.plots.size(); ++p) {
    render::Plot plot = page.plots[p].second;
    const std::size_t given = plot.series.size();
    for (const Finding& f : all) {
      if (p >= f.outcome.series.size()) continue;
      render::Series series = f.outcome.series[p];
      series.label = f.law;
      const bool again = plot.series.size() - given >= render::kMethodColors;  // the same colours
      if (again) series.style = render::Series::Style::dashed;
      plot.series.push_back(std::move(series));
    }
    if (plot.series.size() > given)
      run.plot(page.plots[p].first, [&](const auto& base) { render::write_plot(base, plot); });
  }
}

}  // namespace

std::vector<Flag> with_later(std::vector<Flag> flags, const std::vector<Flag>& later) {
  std::erase_if(flags, [&](const Flag& flag) {
    return std::any_of(later.begin(), later.end(), [&](const Flag& own) {
      return own.path == flag.path || (is_fabric(own) && is_fabric(flag));
    });
  });
  flags.insert(flags.end(), later.begin(), later.end());
  return flags;
}

std::vector<LawVariant> variants_of(const CommandLine& line) {
  std::vector<std::string> every_law;
  for (const auto& law : law_catalogue()) every_law.push_back(law.name);
  std::vector<LawVariant> variants = {{"", {}}};
  variants = multiplied(variants, "fabric", names_in(line, is_fabric, list_assets("fabrics")));
  variants = multiplied(variants, "law", names_in(line, is_law, every_law));
  variants = multiplied(variants, "integrator",
                        names_in(line, is_integrator, {"semi-implicit", "implicit", "bdf2"}));
  if (variants.size() == 1 && last_text(line.flags, "law", "") != "")
    variants[0].name = column_name(names_in(line, is_law, every_law)[0]);
  name_apart(variants);
  return variants;
}

std::string column_name(const std::string& text) {
  std::istringstream parts(text);
  std::string name;
  for (std::string part; std::getline(parts, part, '+');) {
    const std::size_t value = part.find('=') + 1;  // 0 without one
    const std::filesystem::path file = part.substr(value);
    const bool is_file = file.has_parent_path() || file.extension() == ".toml";
    name += (name.empty() ? "" : "+") + part.substr(0, value) + (is_file ? file.stem() : file).string();
  }
  return name.empty() || name.front() == '.' ? "column" + name : name;
}

std::string varied_of(const std::vector<LawVariant>& variants) {
  std::map<std::string, std::set<std::string>> texts;
  for (const LawVariant& variant : variants)
    for (const Flag& flag : variant.flags) texts[is_fabric(flag) ? "fabric" : flag.path];
  for (auto& [path, known] : texts)
    for (const LawVariant& variant : variants) {
      std::string own;
      for (const Flag& flag : variant.flags)
        if ((is_fabric(flag) ? "fabric" : flag.path) == path) own = flag.text;
      known.insert(own);
    }
  std::erase_if(texts, [](const auto& text) { return text.second.size() < 2; });
  return texts.size() == 1 ? texts.begin()->first : "column";
}

CommandLine without_lists(const CommandLine& line) {
  CommandLine one = line;
  std::erase_if(one.flags, [](const Flag& f) {
    return (is_law(f) || is_fabric(f) || is_integrator(f)) && is_list(f.text);
  });
  return one;
}

std::string page_title(const std::string& what, const CommandLine& line, const Setup& setup) {
  const bool listed = std::any_of(line.flags.begin(), line.flags.end(),
                                  [](const Flag& f) { return is_fabric(f) && is_list(f.text); });
  return listed ? what : what + ", " + setup.scene.fabric.name;
}

int compare_laws(const CommandLine& line, const Setup& setup, const Json& keys, LawPage page) {
  Options options = setup.options;
  if (options.explain) {
    for (const LawVariant& law : page.laws) page.once(line_of(line, law, {}));
    return 0;
  }
  if (options.out.empty()) options.out = "out/" + line.experiment;
  Json all_keys = keys;
  all_keys["fabric"] = to_json(setup.scene)["fabric"];  // of variants that name none
  for (const LawVariant& law : page.laws) all_keys["variants"].push_back(law.name);
  Run run(line, options, all_keys);
  std::vector<Finding> all;
  for (const LawVariant& law : page.laws) {
    Finding finding{law.name, {}, {}};
    try {
      finding.outcome = page.once(line_of(line, law, run.folder()));
    } catch (const Error& error) {
      if (error.exit_code() == 1) throw;
      finding.failed = error.what();
    }
    run.progress(law.name + ": " + (finding.failed.empty() ? finding.outcome.caption : finding.failed));
    all.push_back(std::move(finding));
    write_findings(run, varied_of(page.laws), all);
  }
  if (!options.no_images) draw(run, page, all);
  finish_with_report(run);
  return 0;
}

}  // namespace hysteron::experiments
