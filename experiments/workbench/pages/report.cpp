#include "experiments/workbench/pages/report.h"

#include "experiments/workbench/app/manifest_file.h"
#include "experiments/workbench/pages/closing_summary.h"
#include "experiments/workbench/pages/gallery_about.h"
#include "experiments/workbench/pages/manifest.h"
#include "experiments/workbench/pages/metrics.h"
#include "experiments/workbench/pages/page.h"
#include "experiments/workbench/pages/pictures.h"
#include "experiments/workbench/pages/study_tables.h"
#include "experiments/workbench/pictures/kept_geometry.h"
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

// Moment against curvature: of a probe, of cycles, of a law.
bool is_loop(const fs::path& file) {
  const std::string name = file.stem().string();
  return name == "plot_probe_moment" || name.find("_moment") != name.npos || name.find("loop") != name.npos;
}

// SVG where there is one.
std::string plots(const fs::path& folder, bool loops, PageForm form) {
  std::string html;
  for (const fs::path& file : files_ending(folder, ".svg"))
    if (is_loop(file) == loops) html += picture(file, file.stem().string(), form);
  for (const fs::path& file : files_ending(folder, ".png")) {
    if (is_plot(file) && is_loop(file) == loops && !is_there(fs::path(file).replace_extension(".svg")))
      html += picture(file, file.stem().string(), form);
  }
  return html.empty() ? "" : "<div class=\"plot\">" + html + "</div>\n";
}

bool is_sheet(const fs::path& file) { return file.filename() == "sheet.png"; }

// What else was drawn.
std::string pictures(const fs::path& folder, PageForm form) {
  std::string html;
  for (const fs::path& file : files_ending(folder, ".png")) {
    if (!is_plot(file) && !is_sheet(file)) html += picture(file, file.filename().string(), form);
  }
  return html;
}

// Kept geometry of a usual size stands in the page, which a script shows.
std::string turning_cloth(const fs::path& folder) {
  constexpr std::uintmax_t kMax = 400000;  // [byte]
  const fs::path file = folder / kKeptSheet;
  if (!is_there(file) || fs::file_size(file) > kMax) return "";
  return filled("turn.html",
                {{"caption", "The cloth, to be turned: drag it, or use the arrow keys, + and -."},
                 {"data", base64(content_bytes(file))}});
}

// The question, the numbers and the picture that answer it.
std::string answer(const fs::path& folder, const Manifest& manifest, PageForm form) {
  const fs::path sheet = folder / "sheet.png";
  return "<div class=\"answer\">" +
         filled("answer.html", {{"question", experiment_question(manifest.experiment)},
                                {"numbers", answer_cards(manifest) + missing_errors(manifest)},
                                {"picture", is_there(sheet) ? picture(sheet, "contact sheet", form) : ""},
                                {"turn", turning_cloth(folder)}}) +
         "</div>\n";
}

// How the solver fared, for who doubts the numbers above.
std::string numerics_html(const fs::path& folder, const Manifest& manifest) {
  const std::string all =
      metric_cards(numerics(manifest.metrics)) + html_section("Energy", energy_table(manifest)) +
      html_section("Run", run_table(manifest)) + html_section("Time series", series_charts(folder, true));
  return html_details("Numerics: solver, energy, times", all, false);
}

Manifest manifest_in(const fs::path& folder) {
  if (!has_manifest(folder))
    throw Error::invalid_input("no run in " + folder.string() + ": it has no manifest.json");
  return read_manifest(folder / "manifest.json");
}

}  // namespace

std::string report_page(const fs::path& folder, PageForm form) {
  return report_page(folder, manifest_in(folder), form);
}

std::string report_page(const fs::path& folder, const Manifest& manifest, PageForm form) {
  const Metrics& metrics = manifest.metrics;
  const bool study = manifest.experiment == "sweep";
  if (study) form = PageForm::self_contained;  // plots and tables only, made to be sent
  const std::pair<const char*, std::string> sections[] = {
      {"Not complete", study ? study_failures(folder) : ""},
      {"Loop", plots(folder, true, form)},
      {"Plots", plots(folder, false, form)},
      {"Results", metric_cards(further_metrics(manifest)) + metric_table(metrics)},
      {"Pictures", pictures(folder, form)},
      {"Means", study ? study_means(folder) : ""},
      {"Runs", study ? study_runs(folder) : ""},
      {"Sequence", player(folder, "", kMaxFrames, form)},
      {"Study", study ? study_keys(manifest) : ""},
      {"Fabric", study ? "" : fabric_table(manifest)}};
  std::string all = answer(folder, manifest, form);
  for (const auto& [title, html] : sections) all += html_section(title, html);
  all += numerics_html(folder, manifest);
  std::vector<Fields> warnings;
  for (const std::string& text : manifest.warnings) warnings.push_back({{"text", text}});
  // A cloth that still moves has no shape that could be measured: the page says so before any number.
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
  const fs::path page = run.path("report.html");
  run.finish();
  write_text(page, report_page(run.folder(), run.manifest()));
}

}  // namespace hysteron::experiments
