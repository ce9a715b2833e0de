#include "experiments/report.h"

#include <algorithm>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "experiments/csv.h"
#include "experiments/experiments.h"
#include "experiments/metric_name.h"
#include "experiments/report_page.h"
#include "render/image.h"
#include "sim/atomic_file.h"
#include "sim/error.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using Rows = std::vector<std::vector<std::string>>;

constexpr int kThumbnailWidth = 320;         // [pixels]
constexpr std::size_t kMostThumbnails = 12;  // more would make a page of many megabytes

Json read_manifest(const fs::path& folder) {
  const fs::path file = folder / "manifest.json";
  std::ifstream stream(file);
  if (!stream) throw Error::request("no run in " + folder.string() + ": it has no manifest.json");
  const Json manifest = Json::parse(stream, nullptr, false);
  if (!manifest.is_object() || !manifest.contains("hysteron")) {
    throw Error::request(file.string() + " is no manifest of hysteron");
  }
  return manifest;
}

std::vector<std::uint8_t> bytes_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// Numbers with six digits, texts without quotes.
std::string shown(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_null()) return "–";
  if (!value.is_number_float()) return value.dump();
  std::ostringstream text;
  text.precision(6);
  text << value.get<double>();
  return text.str();
}

// "" where a run has none, or several.
std::string fabric_name(const Json& manifest) {
  return manifest.at("scene").value("fabric", Json::object()).value("name", "");
}

std::string heading(const Json& manifest) {
  const Json& scene = manifest.at("scene");
  const std::string fabric = fabric_name(manifest);
  std::string about;
  for (const char* key : {"law", "element"}) {
    if (scene.contains(key)) about += std::string(key) + " " + shown(scene[key]) + " · ";
  }
  const bool complete = manifest.value("complete", false);
  const std::string state =
      complete ? "<span class=\"state\">complete</span>" : "<span class=\"state bad\">incomplete</span>";
  const Json& program = manifest.at("hysteron");
  return "<h1>" + escaped(manifest.value("experiment", "run") + (fabric.empty() ? "" : ": " + fabric)) + " " +
         state + "</h1>\n<p class=\"about\">" +
         escaped(about + manifest.value("started", "") + " · hysteron " + shown(program.at("version")) +
                 ", commit " + shown(program.at("commit")).substr(0, 12) +
                 (program.value("dirty", false) ? ", modified" : "")) +
         "</p>\n<pre>" + escaped(manifest.value("command", "")) + "</pre>\n";
}

std::string metric_cards(const Json& metrics) {
  if (metrics.empty()) return "";
  std::string cards = "<div class=\"cards\">\n";
  for (const auto& [key, value] : metrics.items()) {
    if (key.find('.') != key.npos) continue;
    const NamedUnit what = split_unit(key);
    cards += "<div class=\"card\"><b>" + escaped(shown(value)) + " <small>" + escaped(what.unit) +
             "</small></b><span>" + escaped(what.name) + "</span></div>\n";
  }
  return cards + "</div>\n";
}

// Metrics of several laws or fabrics, "prandtl.2HB_N": a row for each, a column for each metric.
std::string metric_table(const Json& metrics) {
  std::vector<std::string> names, keys;
  const auto once = [](std::vector<std::string>& known, const std::string& word) {
    if (!std::count(known.begin(), known.end(), word)) known.push_back(word);
    return word;
  };
  std::map<std::pair<std::string, std::string>, std::string> cells;
  for (const auto& [key, value] : metrics.items()) {
    const std::size_t dot = key.rfind('.');
    if (dot == key.npos) continue;
    cells[{once(names, key.substr(0, dot)), once(keys, key.substr(dot + 1))}] = shown(value);
  }
  if (names.empty()) return "";
  std::vector<std::string> head = {""};
  std::vector<std::size_t> numeric;
  for (const std::string& key : keys) {
    const NamedUnit what = split_unit(key);
    numeric.push_back(head.size());
    head.push_back(what.name + (what.unit.empty() ? "" : " [" + what.unit + "]"));
  }
  Rows rows;
  for (const std::string& name : names) {
    rows.push_back({name});
    for (const std::string& key : keys) rows.back().push_back(cells[{name, key}]);
  }
  return html_table(head, rows, numeric);
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

std::vector<fs::path> pictures_in(const fs::path& folder, const std::string& ending) {
  std::vector<fs::path> files;
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
    if (entry.path().extension() == ending) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

bool is_plot(const fs::path& file) { return file.filename().string().starts_with("plot_"); }

std::string plots(const fs::path& folder) {
  std::string html;
  for (const fs::path& file : pictures_in(folder, ".svg")) {
    html += embedded_picture(bytes_of(file), "image/svg+xml", file.stem().string());
  }
  for (const fs::path& file : pictures_in(folder, ".png")) {
    if (is_plot(file) && !fs::exists(fs::path(file).replace_extension(".svg"))) {
      html += embedded_picture(bytes_of(file), "image/png", file.stem().string());
    }
  }
  return html.empty() ? "" : "<div class=\"plot\">" + html + "</div>\n";
}

std::string pictures(const fs::path& folder) {
  std::string html;
  for (const fs::path& file : pictures_in(folder, ".png")) {
    if (!is_plot(file)) html += embedded_picture(bytes_of(file), "image/png", file.filename().string());
  }
  return html;
}

std::string thumbnails(const fs::path& folder) {
  const std::vector<fs::path> frames = pictures_in(folder / "frames", ".png");
  const std::size_t count = std::min(kMostThumbnails, frames.size());
  std::string html;
  for (std::size_t i = 0; i < count; ++i) {
    const fs::path& file = frames[count < 2 ? 0 : i * (frames.size() - 1) / (count - 1)];
    const render::Image frame = render::read_png(file);
    const int width = std::min(kThumbnailWidth, frame.width());
    const int height = std::max(1, frame.height() * width / frame.width());
    html += embedded_picture(encode_png(shrink(frame, width, height), render::PngEffort::best), "image/png",
                             "frames/" + file.filename().string());
  }
  return html.empty() ? "" : "<div class=\"thumbs\">\n" + html + "</div>\n";
}

// Columns of a CSV file as its first line names them; empty if the file has no row.
std::vector<std::string> columns_of(const fs::path& file) {
  std::ifstream stream(file);
  std::string header, row, name;
  if (!std::getline(stream, header) || !std::getline(stream, row)) return {};
  std::vector<std::string> columns;
  for (std::istringstream names(header); std::getline(names, name, ',');) columns.push_back(name);
  return columns;
}

// Every column against the first.
std::string series(const fs::path& folder) {
  const fs::path file = folder / "metrics.csv";
  const std::vector<std::string> columns = columns_of(file);
  if (columns.size() < 2) return "";
  const Table table = read_csv(file, columns, {}, "report");
  std::string charts = "<div class=\"charts\">\n";
  for (std::size_t i = 1; i < columns.size(); ++i) {
    charts +=
        line_chart(columns[i], table.find(columns[0])->values, columns[0], table.find(columns[i])->values);
  }
  return charts + "</div>\n";
}

}  // namespace

fs::path write_report(const fs::path& folder) {
  const Json manifest = read_manifest(folder);
  const Json fabric = manifest.at("scene").value("fabric", Json::object());
  const Json metrics = manifest.value("metrics", Json::object());
  const std::string body =
      heading(manifest) + html_section("Results", metric_cards(metrics) + metric_table(metrics)) +
      html_section("Pictures", pictures(folder)) + html_section("Plots", plots(folder)) +
      html_section("Sequence", thumbnails(folder)) + html_section("Time series", series(folder)) +
      html_section("Energy", energy_table(manifest.value("energy", Json()))) +
      html_section("Fabric", fabric_table(fabric)) + html_section("Run", run_table(manifest));
  const std::string name = fabric_name(manifest);
  const std::string title = manifest.value("experiment", "run") + (name.empty() ? "" : ", " + name);
  const fs::path page = folder / "report.html";
  AtomicFile file(page.string());
  file.stream() << html_page(title, body);
  file.commit();
  return page;
}

int report(const CommandLine& line) {
  if (line.names.empty()) throw Error::request("needs the folder of a run: hysteron report DIR");
  for (const std::string& folder : line.names) std::cout << write_report(folder).string() << std::endl;
  return 0;
}

}  // namespace hysteron::experiments
