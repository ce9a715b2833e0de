#include "experiments/workbench/pages/gallery_exhibit.h"

#include <algorithm>
#include <set>

#include "experiments/workbench/pages/error_words.h"
#include "experiments/workbench/pages/gallery_about.h"
#include "experiments/workbench/pages/gallery_pictures.h"
#include "experiments/workbench/pages/manifest.h"
#include "experiments/workbench/pages/metrics.h"
#include "experiments/workbench/pages/pictures.h"
#include "experiments/workbench/pages/text_table.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;

constexpr std::size_t kMostRows = 16, kMostColumns = 12;  // of a table that is shown; larger ones are linked
constexpr std::size_t kOpenRows = 24;                     // longer ones are folded away
constexpr std::size_t kMostCards = 8;
constexpr std::size_t kMostWarnings = 4;  // of many runs in one, most are alike; the manifest has all

std::string file_name(const fs::path& file) { return file.filename().string(); }

// How the solver fared, and what every simulated run counts beside its own question.
bool is_aside(const std::string& key) {
  const auto ends = [&](const char* ending) { return key.ends_with(ending); };
  return ends("_per_step") || ends("steps_count") || ends("_relative") || key == "parts_count" ||
         (key.starts_with("recovery_") && ends("_count")) || key.starts_with("newton_") ||
         key == "integrator_share_percent" || key == "sharp_edges_percent" ||
         key == "residual_curvature_formula_rms_per_m";
}

// Of laws, fabrics, problems: "prandtl.recovery_angle_deg".
Metrics without_asides(const Metrics& compared) {
  Metrics kept;
  for (const auto& [key, value] : compared)
    if (!is_aside(key.substr(key.rfind('.') + 1))) kept.set(key, value);
  return kept;
}

std::string metrics_html(const Metrics& metrics, bool has_table) {
  Metrics first, others;
  std::set<std::string> compared;  // laws, fabrics, problems
  std::size_t cards = 0, more = 0;
  for (const auto& [key, value] : metrics) {
    if (const std::size_t dot = key.rfind('.'); dot != key.npos) {
      compared.insert(key.substr(0, dot));
    } else if (const std::string headline = headline_of(metrics, key); !headline.empty()) {
      (first.contains(headline) ? first : others).set(key, value);
    } else {
      const bool aside = is_aside(key) || cards == kMostCards;
      ++(aside ? more : cards);
      (aside ? others : first).set(key, value);
    }
  }
  std::string html = metric_cards(first);
  const bool said = has_table || (compared.size() == 1 && !first.empty());
  if (!compared.empty() && !said)
    html += html_details("Metrics", metric_table(without_asides(metrics)), true);
  if (!others.empty()) html += html_details(counted(more, "more metric"), metric_cards(others), false);
  return html;
}

std::vector<Fields> shown_warnings(const std::vector<std::string>& all) {
  std::vector<Fields> shown;
  for (std::size_t i = 0; i < std::min(all.size(), kMostWarnings); ++i) shown.push_back({{"text", all[i]}});
  if (all.size() > kMostWarnings)
    shown.push_back({{"text", std::to_string(all.size() - kMostWarnings) + " more in manifest.json"}});
  return shown;
}

// Complete is what a run is expected to be.
std::string warning(const Manifest& manifest) { return manifest.complete ? "" : " " + state_badge(manifest); }

std::string table_html(const std::string& caption, TextTable table, std::size_t columns) {
  const std::string common = take_common(table);
  if (table.head.size() > columns || table.rows.size() > kMostRows) return "";
  return html_details(caption + (common.empty() ? "" : ". In all rows " + common), html_of(table),
                      table.rows.size() <= kOpenRows);
}

// Tables of a readable size, and links to all of them.
struct Tables {
  std::string html, links;
};

Tables tables_of(const Exhibit& exhibit, PageForm form) {
  Tables tables;
  for (const fs::path& file : files_ending(exhibit.folder, ".csv")) {
    const TextTable table = read_words(file);
    const std::string size = counted(table.rows.size(), "row");
    tables.links +=
        " · " + file_link(exhibit.name + "/" + file_name(file), file_name(file), form) + " (" + size + ")";
    if (file_name(file) != "metrics.csv") tables.html += table_html(file_name(file), table, kMostColumns);
  }
  return tables;
}

// A row for each run of which there is only the manifest, or that is a part of another.
std::string runs_table(const std::vector<std::pair<std::string, const Manifest*>>& runs, PageForm form) {
  if (runs.empty()) return "";
  const auto cell = [](const MetricValue& value) { return value.is_known() ? escaped(shown(value)) : ""; };
  std::vector<std::vector<std::string>> rows;
  for (const auto& [link, run] : runs) {
    const bool folder = link.ends_with("/manifest.json");
    const fs::path path = folder ? fs::path(link).parent_path() : fs::path(link);
    rows.push_back({file_link(link, path.stem().string(), form) + warning(*run) + "<code>" +
                        escaped(run->command) + "</code>",
                    cell(run->law), cell(run->element), cell(run->precision), cell(run->triangles),
                    cell(run->steps), escaped(seconds_text(run->total_seconds())), cell(run->device)});
  }
  return html_table_of_html(
      {"run", "law", "element", "precision", "triangles", "steps", "computed in", "device"}, rows, {4, 5, 6});
}

Tables lists_of(const Exhibit& exhibit, PageForm form) {
  Tables tables;
  std::vector<std::pair<std::string, const Manifest*>> runs;
  Metrics metrics;
  for (const Exhibit::List& list : exhibit.lists) {
    const std::string link = exhibit.name + "/" + file_name(list.file);
    tables.links += " · " + file_link(link, file_name(list.file), form);
    if (list.manifest) {
      runs.emplace_back(link, &*list.manifest);
      for (const auto& [key, value] : list.manifest->metrics)
        metrics.set(list.file.stem().string() + "." + key, value);
    } else if (list.table) {
      tables.html += table_html(file_name(list.file), *list.table, kMostColumns);
    }
  }
  const std::string compared = metric_table(without_asides(metrics));
  tables.html = runs_table(runs, form) +
                (compared.empty() ? "" : html_details("Metrics", compared, runs.size() > 1)) + tables.html;
  return tables;
}

std::string parts_table(const Exhibit& exhibit, PageForm form) {
  std::vector<std::pair<std::string, const Manifest*>> runs;
  for (const Exhibit& part : exhibit.parts) {
    if (part.manifest) runs.emplace_back(part.name + "/manifest.json", &*part.manifest);
  }
  return runs.empty() ? "" : html_details(counted(runs.size(), "run"), runs_table(runs, form), false);
}

// Links to files, apart by dots.
std::string links_of(const Exhibit& exhibit, const std::string& to_tables, PageForm form) {
  std::string links =
      exhibit.manifest ? " · " + file_link(exhibit.name + "/manifest.json", "manifest.json", form) : "";
  links += to_tables;
  for (const char* page : {"report.html", "README.md"})
    if (is_there(exhibit.folder / page)) links += " · " + file_link(exhibit.name + "/" + page, page, form);
  return links.substr(std::min(links.size(), std::string(" · ").size()));
}

}  // namespace

std::string anchor_of(const Exhibit& exhibit) {
  std::string anchor = exhibit.name;
  for (char& c : anchor) {
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-' && c != '_' && c != '.') c = '-';
  }
  return anchor;
}

std::string exhibit_html(const Exhibit& exhibit, PageForm form) {
  const Tables tables = tables_of(exhibit, form), lists = lists_of(exhibit, form);
  const std::optional<Manifest>& manifest = exhibit.manifest;
  const std::string metrics =
      manifest ? metrics_html(manifest->metrics, !tables.html.empty()) + missing_errors(*manifest) : "";
  const std::vector<Fields> warnings = manifest ? shown_warnings(manifest->warnings) : std::vector<Fields>();
  return filled("exhibit.html", {{"anchor", anchor_of(exhibit)},
                                 {"name", exhibit.name},
                                 {"badge", manifest ? warning(*manifest) : ""},
                                 {"warnings", warnings},
                                 {"about", manifest ? about_html(*manifest) : ""},
                                 {"pictures", pictures_html(exhibit, form)},
                                 {"metrics", metrics},
                                 {"series", series_charts(exhibit.folder, false)},
                                 {"tables", tables.html + lists.html + parts_table(exhibit, form)},
                                 {"has_command", manifest.has_value()},
                                 {"command", manifest ? manifest->command : ""},
                                 {"links", links_of(exhibit, tables.links + lists.links, form)}});
}

}  // namespace hysteron::experiments
