#include "experiments/validate/drapes.h"

#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "experiments/workbench/compare/comparison.h"
#include "render/plot.h"
#include "sim/base/comma_list.h"
#include "sim/base/csv.h"
#include "sim/base/error.h"
#include "sim/scene/fabric_reader.h"

namespace hysteron::experiments {

std::vector<Manifest> run_manifests(const std::string& experiment, const std::vector<Variant>& runs,
                                    const ValidateFlags& flags, Run& run) {
  CommandLine line{experiment, "", {}, {}};
  if (flags.options.no_images) line.flags.push_back({"no-images", "true"});
  std::vector<ChildRun> columns;
  for (const Variant& one : runs) columns.push_back(child_run(one.name, line, one.flags, run.folder()));
  run_columns(run, columns, {.gpu = flags.device != "cpu"});
  std::vector<Manifest> manifests;
  for (ChildRun& column : columns) {
    if (!column.stopped.empty()) throw Error::simulation(column.name + ": " + column.stopped);
    manifests.push_back(std::move(column.manifest.value()));
  }
  return manifests;
}

Drape nominal_drape(const std::string& fabric, const ValidateFlags& flags) {
  const auto& published = read_fabric(fabric, "--fabrics").fabric.published;
  const auto drape = published.find("drape-coefficient");
  const bool named = drape != published.end() && drape->second.tester == "jis";
  const bool shaken = flags.standard == "published" ? named : flags.standard == "jis";
  return {fabric,
          split(flags.laws).front(),
          shaken ? "jis" : "iso9073",
          shaken ? "shaken" : "lowered",
          "",
          static_cast<int>(flags.triangles),
          flags.step,
          flags.tolerance};
}

std::vector<Flag> drape_flags(const Drape& drape, const ValidateFlags& flags) {
  std::vector<Flag> own = {{"fabric", drape.fabric},
                           {"law", drape.law},
                           {"drape.standard", drape.standard},
                           {"drape.release", drape.release},
                           {"triangles", std::to_string(drape.triangles)},
                           {"step", number_text(drape.step)},
                           {"tolerance", number_text(drape.tolerance)},
                           {"device", flags.device}};
  if (flags.seconds > 0) own.push_back({"seconds", number_text(flags.seconds)});
  if (flags.options.quick) {
    own.insert(own.end(), {{"drape.lowering", "0.3"}, {"drape.shakes", "1"}});
    if (!(flags.seconds > 0)) own.push_back({"seconds", "1.4"});
  }
  own.insert(own.end(), drape.further.begin(), drape.further.end());
  return own;
}

void run_drapes(std::vector<Drape>& drapes, const ValidateFlags& flags, Run& run) {
  std::vector<Variant> runs;
  for (const Drape& drape : drapes) runs.push_back({drape.name(), drape_flags(drape, flags)});
  const std::vector<Manifest> manifests = run_manifests("drape", runs, flags, run);
  for (std::size_t d = 0; d < drapes.size(); ++d) {
    Drape& drape = drapes[d];
    drape.metrics = manifests[d].metrics;
    drape.seconds = manifests[d].total_seconds();
    run.progress(fmt::format("{}: drape coefficient {:.1f} % (published {:.1f}), {:.0f} nodes, {:.1f} s",
                             drape.name(), drape.coefficient(), drape.published(), drape.number("node_count"),
                             drape.seconds));
  }
}

namespace {

std::vector<Drape> planned(const ValidateFlags& flags) {
  std::vector<Drape> plan;
  const int triangles = static_cast<int>(flags.triangles);
  for (const std::string& fabric : split(flags.fabrics)) {
    const Drape nominal = nominal_drape(fabric, flags);
    const auto add = [&](const std::string& law, const std::string& release) -> Drape& {
      plan.push_back(nominal);
      plan.back().law = law;
      plan.back().release = release;
      return plan.back();
    };
    for (const std::string& law : split(flags.laws)) {
      add(law, nominal.release);
      if (!flags.options.quick && nominal.release != "lowered") add(law, "lowered");
    }
    if (flags.options.quick) continue;
    Drape& finer = add(nominal.law, nominal.release);
    finer.varied = "mesh", finer.triangles = 4 * triangles;
    Drape& shorter = add(nominal.law, nominal.release);
    shorter.varied = "step", shorter.step /= 2, shorter.tolerance /= 8;
  }
  return plan;
}

void write_drapes(Run& run, const std::vector<Drape>& drapes) {
  Table table(
      "fabric,law,standard,release,triangles,step [s],drape coefficient [%],nodes,settled,published drape "
      "coefficient [%],published nodes,sharp edges [%],computing [s]");
  for (const Drape& d : drapes)
    table.row({d.fabric, d.law, d.standard, d.release, d.triangles, d.step,
               d.number("drape_coefficient_percent"), d.number("node_count"),
               d.metrics["settled"].is(true) ? "yes" : "no", d.number("published_drape_coefficient_percent"),
               d.number("published_node_count"), d.number("sharp_edges_percent"), d.seconds});
  table.write(run.path("drape.csv"));
}

void note_drapes(Run& run, const std::vector<Drape>& drapes) {
  for (const Drape& d : drapes) {
    run.metric(d.name() + ".drape_coefficient_percent", d.number("drape_coefficient_percent"));
    run.metric(d.name() + ".node_count", d.number("node_count"));
  }
}

void draw_drapes(Run& run, const std::vector<Drape>& drapes) {
  render::Plot plot{"Drape coefficient, simulated against measured", {"published [%]"}, {"simulated [%]"}};
  plot.series.push_back({"equal", {20, 100}, {20, 100}, render::Series::Style::dashed, "#888888"});
  for (const Drape& d : drapes) {
    if (!d.varied.empty()) continue;
    const std::string label = d.law + ", " + d.release;
    auto at = std::find_if(plot.series.begin(), plot.series.end(),
                           [&](const render::Series& s) { return s.label == label; });
    if (at == plot.series.end())
      at = plot.series.insert(plot.series.end(), {label, {}, {}, render::Series::Style::points});
    at->x.push_back(d.number("published_drape_coefficient_percent"));
    at->y.push_back(d.number("drape_coefficient_percent"));
    if (at == plot.series.begin() + 1)
      plot.marks.push_back({d.fabric, at->x.back(), 25, 0, 0, "#555555", false});
  }
  run.plot("plot_drape", plot);
}

}  // namespace

void compare_drapes(const ValidateFlags& flags, Run& run) {
  std::vector<Drape> drapes = planned(flags);
  run_drapes(drapes, flags, run);
  write_drapes(run, drapes);
  note_drapes(run, drapes);
  if (!flags.options.no_images) draw_drapes(run, drapes);
}

}  // namespace hysteron::experiments
