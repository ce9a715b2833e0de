#include "experiments/workbench/pages/report.h"

#include <algorithm>

#include "experiments/workbench/pages/closing_words.h"
#include "experiments/workbench/pages/manifest.h"
#include "experiments/workbench/pages/metrics.h"
#include "experiments/workbench/pages/page.h"
#include "experiments/workbench/pages/pictures.h"
#include "sim/base/atomic_file.h"
#include "sim/base/error.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;
using Rows = std::vector<std::vector<std::string>>;

constexpr int kMostFrames = 24;  // more would make a page of many megabytes

// A cloth that still moves has no shape that could be measured: the page says so before any number.
std::string unrest(const Json& manifest) {
  const std::string words = unrest_words(manifest.value("metrics", Json::object()));
  return words.empty() ? "" : "<p><span class=\"state bad\">" + escaped(words) + "</span></p>\n";
}

std::string heading(const Json& manifest) {
  const Json& scene = manifest.at("scene");
  const std::string fabric = fabric_name(manifest);
  std::string about;
  for (const char* key : {"law", "element"}) {
    if (scene.contains(key)) about += std::string(key) + " " + shown(scene[key]) + " · ";
  }
  return "<h1>" + escaped(manifest.value("experiment", "run") + (fabric.empty() ? "" : ": " + fabric)) + " " +
         state_badge(manifest) + "</h1>\n" + unrest(manifest) + "<p class=\"about\">" +
         escaped(about + manifest.value("started", "") + " · " + program_of(manifest)) + "</p>\n<pre>" +
         escaped(manifest.value("command", "")) + "</pre>\n";
}

std::string energy_table(const Json& energy) {
  if (!energy.is_object() || energy.empty()) return "";
  Rows rows;
  for (const auto& [term, joules] : energy.items()) rows.push_back({split_unit(term).name, shown(joules)});
  return html_table({"term", "J"}, rows, {1});
}

std::string fabric_table(const Json& fabric) {
  Rows rows;
  const Json provenance = fabric.value("provenance", Json::object());
  for (const auto& [name, from] : provenance.items()) {
    rows.push_back(
        {name, shown(fabric.value(name, Json())), shown(from.at("confidence")), shown(from.at("source"))});
  }
  std::string tables = html_table({"SI", "value", "", "source"}, rows, {1});
  rows.clear();
  const Json published = fabric.value("published", Json::object());
  for (const auto& [name, number] : published.items()) {
    rows.push_back({name, shown(number.at("value")) + " " + shown(number.at("unit")),
                    shown(number.at("confidence")), shown(number.at("source"))});
  }
  if (!rows.empty()) tables += html_table({"as published", "value", "", "source"}, rows, {1});
  return tables;
}

std::string run_table(const Json& manifest) {
  Rows rows;
  for (const char* key : {"device", "renderer", "positions", "precision", "triangles", "hinges", "steps",
                          "seconds_simulated", "bytes_device", "state_hash"}) {
    if (manifest.contains(key) && !manifest[key].is_null())
      rows.push_back({split_unit(key).name, shown(manifest[key])});
  }
  const Json wall = manifest.value("wall_seconds", Json::object());
  for (const auto& [stage, seconds] : wall.items()) {
    if (seconds.is_number() && seconds.get<double>() > 0)
      rows.push_back({"wall time, " + stage, shown(seconds) + " s"});
  }
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

Json manifest_in(const fs::path& folder) {
  if (!has_manifest(folder))
    throw Error::request("no run in " + folder.string() + ": it has no manifest.json");
  return read_manifest(folder / "manifest.json");
}

}  // namespace

std::string report_page(const fs::path& folder, PageForm form) {
  const Json manifest = manifest_in(folder);
  const Json fabric = manifest.at("scene").value("fabric", Json::object());
  const Json metrics = manifest.value("metrics", Json::object());
  const std::string body =
      heading(manifest) +
      html_section("Results", metric_cards(metrics) + missing_errors(manifest) + metric_table(metrics)) +
      html_section("Pictures", pictures(folder, form)) + html_section("Plots", plots(folder, form)) +
      html_section("Sequence", player(folder, "", kMostFrames, form)) +
      html_section("Time series", series_charts(folder, true)) +
      html_section("Energy", energy_table(manifest.value("energy", Json()))) +
      html_section("Fabric", fabric_table(fabric)) + html_section("Run", run_table(manifest));
  const std::string name = fabric_name(manifest);
  return html_page(manifest.value("experiment", "run") + (name.empty() ? "" : ", " + name), body);
}

fs::path write_report(const fs::path& folder, PageForm form) {
  const std::string page = report_page(folder, form);
  AtomicFile file((folder / "report.html").string());
  file.stream() << page;
  file.commit();
  return folder / "report.html";
}

}  // namespace hysteron::experiments
