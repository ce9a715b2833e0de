#include "experiments/workbench/pages/report.h"

#include "experiments/workbench/app/manifest_file.h"
#include "experiments/workbench/pages/closing_words.h"
#include "experiments/workbench/pages/manifest.h"
#include "experiments/workbench/pages/metrics.h"
#include "experiments/workbench/pages/page.h"
#include "experiments/workbench/pages/pictures.h"
#include "experiments/workbench/pages/study_tables.h"
#include "sim/base/atomic_file.h"
#include "sim/base/error.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;
using Rows = std::vector<std::vector<std::string>>;

constexpr int kMostFrames = 24;  // more would make a page of many megabytes

std::string title_of(const Manifest& manifest, const std::string& between) {
  const std::string& fabric = manifest.scene.fabric.name;
  return manifest.experiment + (fabric.empty() ? "" : between + fabric);
}

std::string about_of(const Manifest& manifest) {
  std::string about;
  if (manifest.scene.law) about += "law " + *manifest.scene.law + " · ";
  if (manifest.scene.element) about += "element " + *manifest.scene.element + " · ";
  return about + manifest.started + " · " + program_of(manifest);
}

std::string energy_table(const Manifest& manifest) {
  Rows rows;
  for (const auto& [term, joules] : manifest.energy) rows.push_back({split_unit(term).name, shown(joules)});
  return rows.empty() ? "" : html_table({"term", "J"}, rows, {1});
}

std::string fabric_table(const FabricRecord& fabric) {
  Rows rows;
  for (const FabricRecord::Number& number : fabric.numbers)
    rows.push_back({number.name, shown(number.value), number.confidence, number.source});
  std::string tables = html_table({"SI", "value", "", "source"}, rows, {1});
  rows.clear();
  for (const FabricRecord::Number& number : fabric.published)
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
  return html_figure(image_of({file, file.filename().string(), words}, form), words);
}

std::string plots(const fs::path& folder, PageForm form) {
  std::string html;
  for (const fs::path& file : files_ending(folder, ".svg")) html += picture(file, file.stem().string(), form);
  for (const fs::path& file : files_ending(folder, ".png")) {
    if (is_plot(file) && !is_there(fs::path(file).replace_extension(".svg")))
      html += picture(file, file.stem().string(), form);
  }
  return html.empty() ? "" : "<div class=\"plot\">" + html + "</div>\n";
}

std::string pictures(const fs::path& folder, PageForm form) {
  std::string html;
  for (const fs::path& file : files_ending(folder, ".png")) {
    if (!is_plot(file)) html += picture(file, file.filename().string(), form);
  }
  return html;
}

Manifest manifest_in(const fs::path& folder) {
  if (!has_manifest(folder))
    throw Error::request("no run in " + folder.string() + ": it has no manifest.json");
  return read_manifest(folder / "manifest.json");
}

}  // namespace

std::string report_page(const fs::path& folder, PageForm form) {
  const Manifest manifest = manifest_in(folder);
  const Metrics& metrics = manifest.metrics;
  const bool study = manifest.experiment == "sweep";
  if (study) form = PageForm::self_contained;  // plots and tables only, made to be sent
  const std::pair<const char*, std::string> sections[] = {
      {"Results", metric_cards(metrics) + missing_errors(manifest) + metric_table(metrics)},
      {"Not complete", study ? study_failures(folder) : ""},
      {"Pictures", pictures(folder, form)},
      {"Plots", plots(folder, form)},
      {"Means", study ? study_means(folder) : ""},
      {"Runs", study ? study_runs(folder) : ""},
      {"Sequence", player(folder, "", kMostFrames, form)},
      {"Time series", series_charts(folder, true)},
      {"Energy", energy_table(manifest)},
      {"Study", study ? study_keys(manifest) : ""},
      {"Fabric", study ? "" : fabric_table(manifest.scene.fabric)},
      {"Run", run_table(manifest)}};
  std::string all;
  for (const auto& [title, html] : sections) all += html_section(title, html);
  std::vector<Fields> warnings;
  for (const std::string& text : manifest.warnings) warnings.push_back({{"text", text}});
  // A cloth that still moves has no shape that could be measured: the page says so before any number.
  const std::string body = filled("report.html", {{"title", title_of(manifest, ": ")},
                                                  {"badge", state_badge(manifest)},
                                                  {"unrest", unrest_words(metrics)},
                                                  {"warnings", warnings},
                                                  {"about", about_of(manifest)},
                                                  {"command", manifest.command},
                                                  {"sections", all}});
  return html_page(title_of(manifest, ", "), body);
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

}  // namespace hysteron::experiments
