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
#include "sim/base/error.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;

constexpr std::size_t kMostRows = 40, kMostColumns = 16;  // of a table that is shown; larger ones are linked
constexpr std::size_t kOpenRows = 24;                     // longer ones are folded away
constexpr std::size_t kMostCards = 8;

std::string file_name(const fs::path& file) { return file.filename().string(); }

// How the solver fared, and what every simulated run counts beside its own question.
bool is_aside(const std::string& key) {
  const auto ends = [&](const char* ending) { return key.ends_with(ending); };
  return ends("_per_step") || ends("steps_count") || ends("_relative") || key == "parts_count" ||
         (key.starts_with("recovery_") && ends("_count")) || key == "sharp_edges_percent" ||
         key == "residual_curvature_formula_rms_per_m";
}

std::string metrics_html(const Json& metrics, bool has_table) {
  Json first = Json::object(), others = Json::object();
  std::set<std::string> compared;  // laws, fabrics, problems
  std::size_t cards = 0, more = 0;
  for (const auto& [key, value] : metrics.items()) {
    if (const std::size_t dot = key.rfind('.'); dot != key.npos) {
      compared.insert(key.substr(0, dot));
    } else if (const std::string headline = headline_of(metrics, key); !headline.empty()) {
      (first.contains(headline) ? first : others)[key] = value;
    } else {
      const bool aside = is_aside(key) || cards == kMostCards;
      ++(aside ? more : cards);
      (aside ? others : first)[key] = value;
    }
  }
  std::string html = metric_cards(first);
  const bool said = has_table || (compared.size() == 1 && !first.empty());
  if (!compared.empty() && !said) html += html_details("Metrics", metric_table(metrics), true);
  if (!others.empty()) html += html_details(counted(more, "more metric"), metric_cards(others), false);
  return html;
}

// Complete is what a run is expected to be.
std::string warning(const Json& manifest) {
  return manifest.value("complete", false) ? "" : " " + state_badge(manifest);
}

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
std::string runs_table(const std::vector<std::pair<std::string, const Json*>>& runs, PageForm form) {
  if (runs.empty()) return "";
  std::vector<std::vector<std::string>> rows;
  for (const auto& [link, manifest] : runs) {
    const auto cell = [&, &manifest = *manifest](const char* key) {
      return manifest.contains(key) && !manifest[key].is_null() ? escaped(shown(manifest[key])) : "";
    };
    const bool folder = link.ends_with("/manifest.json");
    const fs::path path = folder ? fs::path(link).parent_path() : fs::path(link);
    const double wall = manifest->value("wall_seconds", Json::object()).value("total", 0.0);
    rows.push_back({file_link(link, path.stem().string(), form) + warning(*manifest) + "<code>" +
                        cell("command") + "</code>",
                    cell("law"), cell("element"), cell("precision"), cell("triangles"), cell("steps"),
                    escaped(seconds_text(wall)), cell("device")});
  }
  return html_table_of_html(
      {"run", "law", "element", "precision", "triangles", "steps", "computed in", "device"}, rows, {4, 5, 6});
}

bool is_table(const Json& json) {
  return json.is_array() && !json.empty() &&
         std::all_of(json.begin(), json.end(), [](const Json& row) { return row.is_object(); });
}

Tables lists_of(const Exhibit& exhibit, PageForm form) {
  Tables tables;
  std::vector<std::pair<std::string, const Json*>> runs;
  Json metrics = Json::object();
  for (const auto& [file, json] : exhibit.lists) {
    const std::string link = exhibit.name + "/" + file_name(file);
    tables.links += " · " + file_link(link, file_name(file), form);
    if (is_manifest(json)) {
      runs.emplace_back(link, &json);
      const Json& own = json.value("metrics", Json::object());
      for (const auto& [key, value] : own.items()) {
        if (!is_aside(key)) metrics[file.stem().string() + "." + key] = value;
      }
    } else if (is_table(json)) {
      TextTable table = table_of(json);
      tables.html += table_html(file_name(file), table, kMostColumns);
    }
  }
  const std::string compared = metric_table(metrics);
  tables.html = runs_table(runs, form) +
                (compared.empty() ? "" : html_details("Metrics", compared, runs.size() > 1)) + tables.html;
  return tables;
}

std::string parts_table(const Exhibit& exhibit, PageForm form) {
  std::vector<std::pair<std::string, const Json*>> runs;
  for (const Exhibit& part : exhibit.parts) {
    if (!part.manifest.is_null()) runs.emplace_back(part.name + "/manifest.json", &part.manifest);
  }
  return runs.empty() ? "" : html_details(counted(runs.size(), "run"), runs_table(runs, form), false);
}

std::string body_of(const Exhibit& exhibit, PageForm form) {
  const Tables tables = tables_of(exhibit, form), lists = lists_of(exhibit, form);
  std::string links = tables.links + lists.links, html, command;
  const Json& manifest = exhibit.manifest;
  if (!manifest.is_null()) {
    html += about_html(manifest);
    command = "<pre>" + escaped(manifest.value("command", "")) + "</pre>\n";
    links = " · " + file_link(exhibit.name + "/manifest.json", "manifest.json", form) + links;
  }
  for (const char* page : {"report.html", "README.md"}) {
    if (is_there(exhibit.folder / page)) links += " · " + file_link(exhibit.name + "/" + page, page, form);
  }
  html += pictures_html(exhibit, form);
  if (!manifest.is_null())
    html += metrics_html(manifest.value("metrics", Json::object()), !tables.html.empty()) +
            missing_errors(manifest);
  html +=
      series_charts(exhibit.folder, false) + tables.html + lists.html + parts_table(exhibit, form) + command;
  return html + "<p class=\"files\">" + links.substr(std::min(links.size(), std::string(" · ").size())) +
         "</p>\n";
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
  const std::string badge = exhibit.manifest.is_null() ? "" : warning(exhibit.manifest);
  try {
    return "<article id=\"" + anchor_of(exhibit) + "\"><h3><a href=\"#" + anchor_of(exhibit) + "\">" +
           escaped(exhibit.name) + "</a>" + badge + "</h3>\n" + body_of(exhibit, form) + "</article>\n";
  } catch (const Json::exception& broken) {
    throw Error::request((exhibit.folder / "manifest.json").string() +
                         " is no manifest of hysteron: " + broken.what());
  }
}

}  // namespace hysteron::experiments
