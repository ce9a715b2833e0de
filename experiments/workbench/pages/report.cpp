#include "experiments/workbench/pages/report.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "experiments/workbench/app/manifest_file.h"
#include "experiments/workbench/pages/closing_summary.h"
#include "experiments/workbench/pages/manifest.h"
#include "experiments/workbench/pages/metrics.h"
#include "experiments/workbench/pages/page.h"
#include "experiments/workbench/pages/pictures.h"
#include "experiments/workbench/pages/text_table.h"
#include "experiments/workbench/pictures/archived_geometry.h"
#include "sim/base/atomic_file.h"
#include "sim/base/error.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;
using Rows = std::vector<std::vector<std::string>>;

constexpr int kMaxFrames = 24;  // more would make a page of many megabytes

std::string report_title(const Manifest& manifest, const std::string& between) {
  const std::string fabric = manifest.text("fabric.name");
  return manifest.experiment + (fabric.empty() ? "" : between + fabric);
}

std::string law_and_program(const Manifest& manifest) {
  std::string about;
  for (const char* key : {"law", "element"})
    if (const std::string name = manifest.text(key); !name.empty()) about += key + (" " + name) + " · ";
  return about + manifest.started + " · " + program_description(manifest);
}

std::string energy_table(const Manifest& manifest) {
  Rows rows;
  for (const auto& [term, joules] : manifest.energy) rows.push_back({split_unit(term).name, shown(joules)});
  return rows.empty() ? "" : html_table({"term", "J"}, rows, {1});
}

std::string fabric_table(const Manifest& manifest) {
  Rows rows;
  for (const SourcedNumber& number : manifest.fabric_numbers())
    rows.push_back({number.name, shown(number.value), number.confidence, number.source});
  std::string tables = html_table({"SI", "value", "", "source"}, rows, {1});
  rows.clear();
  for (const SourcedNumber& number : manifest.published_numbers())
    rows.push_back({number.name, shown(number.value) + " " + number.unit, number.confidence, number.source});
  if (!rows.empty()) tables += html_table({"as published", "value", "", "source"}, rows, {1});
  return tables;
}

std::string run_table(const Manifest& m) {
  Rows rows;
  const std::pair<const char*, MetricValue> facts[] = {{"device", m.device},
                                                       {"renderer", m.renderer},
                                                       {"positions", m.positions},
                                                       {"precision", m.precision},
                                                       {"triangles", m.triangles},
                                                       {"hinges", m.hinges},
                                                       {"steps", m.steps},
                                                       {"seconds_simulated", m.seconds_simulated},
                                                       {"bytes_device", m.bytes_device},
                                                       {"state_hash", m.state_hash}};
  for (const auto& [name, value] : facts)
    if (value.is_known()) rows.push_back({split_unit(name).name, shown(value)});
  const std::string of_all = m.batch ? " of " + std::to_string(*m.batch) + " runs together" : "";
  for (const auto& [stage, seconds] : m.wall_seconds)
    if (seconds > 0) rows.push_back({"wall time, " + stage + of_all, shown(seconds) + " s"});
  return html_table({"", ""}, rows, {1});
}

std::string picture(const fs::path& file, const std::string& words, PageForm form) {
  return html_figure(image_element({file, file.filename().string(), words}, form), words);
}

// True for plots of moment against curvature, of a probe, of cycles or of a law.
bool is_loop(const fs::path& file) {
  const std::string name = file.stem().string();
  return name == "plot_probe_moment" || name.find("_moment") != name.npos || name.find("loop") != name.npos;
}

// Returns the files of the run itself, as other files beside them are another's.  Early programs listed none.
std::vector<fs::path> own_files(const fs::path& folder, const Manifest& manifest, const std::string& ending) {
  std::vector<fs::path> files = files_ending(folder, ending);
  const auto& own = manifest.files;
  std::erase_if(files, [&](const fs::path& file) {
    return !own.empty() && !std::count(own.begin(), own.end(), file.filename().string());
  });
  return files;
}

bool has_frames(const Manifest& manifest) {
  const auto is_frame = [](const std::string& file) { return file.starts_with("frames/"); };
  return manifest.files.empty() || std::ranges::any_of(manifest.files, is_frame);
}

// Returns the plots, as SVG if there is one.
std::string plots(const fs::path& folder, const Manifest& manifest, bool loops, PageForm form) {
  std::string html;
  for (const fs::path& file : own_files(folder, manifest, ".svg"))
    if (is_loop(file) == loops) html += picture(file, file.stem().string(), form);
  for (const fs::path& file : own_files(folder, manifest, ".png")) {
    if (is_plot(file) && is_loop(file) == loops && !is_there(fs::path(file).replace_extension(".svg")))
      html += picture(file, file.stem().string(), form);
  }
  return html.empty() ? "" : "<div class=\"plot\">" + html + "</div>\n";
}

// Returns the other pictures.
std::string pictures(const fs::path& folder, const Manifest& manifest, PageForm form) {
  std::string html;
  for (const fs::path& file : own_files(folder, manifest, ".png")) {
    if (!is_plot(file) && file.filename() != "sheet.png")
      html += picture(file, file.filename().string(), form);
  }
  return html;
}

// Returns the cloth as a view that a script rotates; kept geometry of usual size is embedded in the page.
std::string turning_cloth(const fs::path& folder) {
  constexpr std::uintmax_t kMax = 400000;  // [bytes]
  const fs::path file = folder / kArchivedSheet;
  if (!is_there(file) || fs::file_size(file) > kMax) return "";
  return filled("turn.html",
                {{"caption", "The cloth, to be turned: drag it, or use the arrow keys, + and -."},
                 {"data", base64(content_bytes(file))}});
}

// Returns the question, and the numbers and the picture that answer it.
std::string answer(const fs::path& folder, const Manifest& manifest, PageForm form) {
  const std::vector<fs::path> drawn = own_files(folder, manifest, ".png");
  const fs::path sheet = folder / "sheet.png";
  const bool has_sheet = std::count(drawn.begin(), drawn.end(), sheet) > 0;
  return "<div class=\"answer\">" +
         filled("answer.html", {{"question", experiment_named(manifest.experiment).question},
                                {"numbers", answer_cards(manifest) + missing_errors(manifest)},
                                {"picture", has_sheet ? picture(sheet, "contact sheet", form) : ""},
                                {"turn", turning_cloth(folder)}}) +
         "</div>\n";
}

// Returns the section on solver, energy and times, for readers who doubt the numbers above.
std::string numerics_html(const fs::path& folder, const Manifest& manifest) {
  const std::string all =
      metric_cards(numerics(manifest.metrics)) + html_section("Energy", energy_table(manifest)) +
      html_section("Run", run_table(manifest)) + html_section("Time series", series_charts(folder));
  return html_details("Numerics: solver, energy, times", all, false);
}

// The following functions show tables of a study (`hysteron sweep`), from the CSV files in its folder.

Table table_if_there(const fs::path& file) { return is_there(file) ? read_table(file) : Table{}; }

// Shows a table; columns with the same value in every row are listed above it.
std::string shown_table(Table table) {
  const std::string common = take_common(table);
  return (common.empty() ? "" : html_about("In all rows " + common)) + text_table_html(table);
}

// Returns "1, 2, 3"; for many values the first few and the last.
std::string listed_values(const Json& values) {
  constexpr std::size_t kMax = 16;
  std::string text;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values.size() > kMax && i >= kMax / 2 && i + 1 < values.size()) continue;
    const bool gap = values.size() > kMax && i + 1 == values.size();
    text += (i ? gap ? ", ..., " : ", " : "") + values[i].get<std::string>();
  }
  return text;
}

// Returns the study's request: the keys that its runs share, and the axes.
std::string study_keys(const Manifest& manifest) {
  if (!manifest.keys) return "";
  const Json& keys = *manifest.keys;
  std::vector<std::vector<std::string>> rows = {{"experiment", keys.value("experiment", "")}};
  for (const Json& flag : keys.value("shared", Json::array())) {
    const std::string text = flag.get<std::string>();
    const std::size_t equals = text.find('=');
    rows.push_back({text.substr(0, equals), text.substr(equals + 1)});
  }
  for (const Json& axis : keys.value("axes", Json::array()))
    rows.push_back({"axis " + axis.value("key", ""), listed_values(axis.value("values", Json::array()))});
  return html_table({"", ""}, rows, {});
}

// Returns "" if there is no means.csv.
std::string study_means(const fs::path& folder) {
  const Table means = table_if_there(folder / "means.csv");
  return means.rows.empty() ? "" : shown_table(means);
}

// Returns the incomplete runs, and the reasons.
std::string study_failures(const fs::path& folder) {
  Table table = table_if_there(folder / "table.csv").only({"run", "exit_code", "stopped"});
  std::erase_if(table.rows, [](const auto& row) { return row.back().empty(); });
  return table.rows.empty() ? "" : text_table_html(table);
}

// Returns a folded table with a row for each run: its name, the metrics in means.csv, or else all that
// differ, and the time.
std::string study_runs(const fs::path& folder) {
  Table table = table_if_there(folder / "table.csv");
  if (table.rows.empty()) return "";
  constexpr std::string_view kMean = "_mean";
  std::vector<std::string> columns = {"run"};
  for (const std::string& name : table_if_there(folder / "means.csv").head)
    if (name.ends_with(kMean)) columns.push_back(name.substr(0, name.size() - kMean.size()));
  columns.insert(columns.end(), {"wall_s", "state_hash"});
  constexpr std::size_t kWithoutMeans = 3;
  if (columns.size() > kWithoutMeans) table = table.only(columns);
  return html_details(std::to_string(table.rows.size()) + " runs", shown_table(table),
                      table.rows.size() < 25);
}

}  // namespace

std::string report_page(const fs::path& folder, PageForm form) {
  if (!has_manifest(folder))
    throw Error::invalid_input("no run in " + folder.string() + ": it has no manifest.json");
  const Manifest manifest = read_manifest(folder / "manifest.json");
  const Metrics& metrics = manifest.metrics;
  const bool study = manifest.experiment == "sweep";
  if (study) form = PageForm::self_contained;  // plots and tables only, to be sent alone
  const std::pair<const char*, std::string> sections[] = {
      {"Not complete", study ? study_failures(folder) : ""},
      {"Loop", plots(folder, manifest, true, form)},
      {"Plots", plots(folder, manifest, false, form)},
      {"Results", metric_cards(further_metrics(manifest)) + metric_table(metrics)},
      {"Pictures", pictures(folder, manifest, form)},
      {"Means", study ? study_means(folder) : ""},
      {"Runs", study ? study_runs(folder) : ""},
      {"Sequence", has_frames(manifest) ? player(folder, "", kMaxFrames, form) : ""},
      {"Study", study ? study_keys(manifest) : ""},
      {"Fabric", study ? "" : fabric_table(manifest)}};
  std::string all = answer(folder, manifest, form);
  for (const auto& [title, html] : sections) all += html_section(title, html);
  all += numerics_html(folder, manifest);
  std::vector<Fields> warnings;
  for (const std::string& text : manifest.warnings) warnings.push_back({{"text", text}});
  // Before any number the page warns if the cloth still moves, because its shape cannot be measured then.
  const std::string body = filled("report.html", {{"title", report_title(manifest, ": ")},
                                                  {"badge", state_badge(manifest)},
                                                  {"unrest", not_at_rest_warning(metrics)},
                                                  {"warnings", warnings},
                                                  {"about", law_and_program(manifest)},
                                                  {"command", manifest.command},
                                                  {"sections", all}});
  return html_page(report_title(manifest, ", "), body);
}

fs::path write_report(const fs::path& folder, PageForm form) {
  write_text(folder / "report.html", report_page(folder, form));
  return folder / "report.html";
}

void finish_with_report(Run& run) {
  run.path("report.html");
  run.finish();
  write_report(run.folder());
}

void finish_incomplete_with_report(Run& run) {
  run.path("report.html");
  run.finish_incomplete();
  write_report(run.folder());
}

}  // namespace hysteron::experiments
