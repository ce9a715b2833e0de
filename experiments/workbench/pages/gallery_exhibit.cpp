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

constexpr std::size_t kMostRows = 8, kMostColumns = 8;  // of a table that is shown; larger ones are linked
constexpr std::size_t kMostCards = 4;
constexpr std::size_t kMostWarnings = 4;  // of many runs in one, most are alike; the manifest has all

std::string file_name(const fs::path& file) { return file.filename().string(); }

// A table of a readable size, or nothing.
std::string small_table(const Metrics& compared) {
  std::set<std::string> names, keys;
  for (const auto& [key, value] : compared) {
    const std::size_t dot = key.rfind('.');
    if (dot == key.npos) continue;
    names.insert(key.substr(0, dot));
    keys.insert(key.substr(dot + 1));
  }
  const bool readable = names.size() <= kMostRows && keys.size() <= kMostColumns;
  return readable && !names.empty() ? html_details("Metrics", metric_table(compared), true) : "";
}

// Of laws, fabrics, problems: "prandtl.recovery_angle_deg".
Metrics without_asides(const Metrics& compared) {
  Metrics kept;
  for (const auto& [key, value] : compared)
    if (!is_numerics(key.substr(key.rfind('.') + 1))) kept.set(key, value);
  return kept;
}

// What the experiment is asked for, else the first of what it found; the manifest has all.
std::string metrics_html(const Manifest& manifest, bool has_table) {
  if (const std::string answers = answer_cards(manifest); !answers.empty()) return answers;
  Metrics first;
  std::size_t cards = 0, compared = 0;
  for (const auto& [key, value] : manifest.metrics) {
    if (key.find('.') != key.npos)
      ++compared;
    else if (!headline_of(manifest.metrics, key).empty() || (!is_numerics(key) && cards++ < kMostCards))
      first.set(key, value);
  }
  std::string html = metric_cards(first);
  if (compared > 0 && !has_table) html += small_table(without_asides(manifest.metrics));
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
  return html_details(caption + (common.empty() ? "" : ". In all rows " + common), html_of(table), true);
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
  tables.html = (runs.size() <= kMostRows ? runs_table(runs, form) : "") +
                small_table(without_asides(metrics)) + tables.html;
  return tables;
}

// Manifests of the runs that it is the summary of.
std::string parts_links(const Exhibit& exhibit, PageForm form) {
  std::string links;
  for (const Exhibit& part : exhibit.parts) {
    if (part.manifest)
      links += " · " +
               file_link(part.name + "/manifest.json", fs::path(part.name).filename().string(), form) +
               warning(*part.manifest);
  }
  return links;
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
      manifest ? metrics_html(*manifest, !tables.html.empty()) + missing_errors(*manifest) : "";
  const std::vector<Fields> warnings = manifest ? shown_warnings(manifest->warnings) : std::vector<Fields>();
  return filled(
      "exhibit.html",
      {{"anchor", anchor_of(exhibit)},
       {"name", exhibit.name},
       {"badge", manifest ? warning(*manifest) : ""},
       {"warnings", warnings},
       {"about", manifest ? about_html(*manifest) : ""},
       {"pictures", pictures_html(exhibit, form)},
       {"metrics", metrics},
       {"tables", tables.html + lists.html},
       {"has_command", manifest.has_value()},
       {"command", manifest ? manifest->command : ""},
       {"links", links_of(exhibit, tables.links + lists.links + parts_links(exhibit, form), form)}});
}

}  // namespace hysteron::experiments
