// `hysteron validate`: where the model stands against measurements.  Cusick's drape of the fabrics that
// publish both a KES pair and a drape coefficient, with and without hysteresis, let down by a plate and
// dropped, on finer meshes and shorter steps as well; and their bending length.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "experiments/workbench/app/experiment.h"
#include "experiments/workbench/app/manifest_file.h"
#include "experiments/workbench/app/run.h"
#include "experiments/workbench/pages/report.h"
#include "render/plot.h"
#include "sim/base/comma_list.h"
#include "sim/base/csv.h"

namespace hysteron::experiments {
namespace {

struct ValidateFlags {
  std::string fabrics = "cotton-broad,wool-tropical,polyester-tropical,polyester-faille";
  std::string laws = "prandtl,linear", device = "cpu";
  double triangles = 6000, step = 1.0 / 120, tolerance = 1e-5, seconds = 4;
  Options options;
};

using F = ValidateFlags;
// clang-format off
const KeyRow<F> kRows[] = {
    {"fabrics", at<&F::fabrics>, "", any(), "", "those that publish a drape coefficient, separated by commas"},
    {"laws", at<&F::laws>, "", any(), "", "separated by commas"},
    {"device", at<&F::device>, "", any(), "cpu | cuda", "of the drapes"},
    {"triangles", at<&F::triangles>, "", between(100, 1e6), "", "of the disc; four times as many to measure the mesh's share of the error"},
    {"step", at<&F::step>, "s", positive(), "", "halved to measure the step's share of the error"},
    {"tolerance", at<&F::tolerance>, "m", at_least(0), "", "of the parts of a step, as --tolerance of drape; an eighth of it with half the step"},
    {"seconds", at<&F::seconds>, "s", positive(), "", "longest simulated time of a drape"},
};
// clang-format on

Keys keys_of(F& flags) { return with_output_options(bind(kRows, flags), flags.options); }

// A drape and what came of it.
struct Drape {
  std::string fabric, law, release, varied;  // varied: "" | mesh | step
  int triangles = 0;
  double step = 0, tolerance = 0;
  Metrics metrics{};
  double seconds = 0;

  std::string name() const {
    return fabric + "-" + law + "-" + release + (varied.empty() ? "" : "-" + varied);
  }
  double number(const std::string& key) const { return metrics.number(key); }
};

// Runs another subcommand into a folder of this one; its manifest.
Manifest result_of(const std::string& name, const std::vector<Flag>& own, const F& flags, const Run& run,
                   const std::string& folder) {
  CommandLine line{name, "hysteron " + name, own, {}};
  const std::filesystem::path out = run.folder() / folder;
  line.flags.push_back({"out", out.string()});
  line.flags.push_back({"quiet", "true"});
  if (flags.options.no_images) line.flags.push_back({"no-images", "true"});
  for (const Flag& flag : own) line.command += " --" + flag.path + " " + flag.text;
  experiment_named(name).run(line);
  return read_manifest(out / "manifest.json");
}

std::vector<Drape> planned(const F& flags) {
  std::vector<Drape> plan;
  const int triangles = static_cast<int>(flags.triangles);
  for (const std::string& fabric : split(flags.fabrics)) {
    for (const std::string& law : split(flags.laws))
      for (const char* release : {"lowered", "dropped"}) {
        plan.push_back({fabric, law, release, "", triangles, flags.step, flags.tolerance});
        if (flags.options.quick) break;
      }
    if (flags.options.quick) continue;
    const std::string law = split(flags.laws).front();
    plan.push_back({fabric, law, "lowered", "mesh", 4 * triangles, flags.step, flags.tolerance});
    plan.push_back({fabric, law, "lowered", "step", triangles, flags.step / 2, flags.tolerance / 8});
  }
  return plan;
}

void run_drape(Drape& drape, const F& flags, Run& run) {
  const Manifest manifest = result_of("drape",
                                      {{"fabric", drape.fabric},
                                       {"law", drape.law},
                                       {"drape.release", drape.release},
                                       {"triangles", std::to_string(drape.triangles)},
                                       {"step", number_field(drape.step)},
                                       {"tolerance", number_field(drape.tolerance)},
                                       {"seconds", number_field(flags.seconds)},
                                       {"device", flags.device}},
                                      flags, run, drape.name());
  drape.metrics = manifest.metrics;
  drape.seconds = manifest.total_seconds();
  run.progress(fmt::format("{}: drape coefficient {:.1f} % (published {:.1f}), {:.0f} nodes, {:.1f} s",
                           drape.name(), drape.number("drape_coefficient_percent"),
                           drape.number("published_drape_coefficient_percent"), drape.number("node_count"),
                           drape.seconds));
}

void write_drapes(Run& run, const std::vector<Drape>& drapes) {
  CsvFile file(run.path("drape.csv"),
               "fabric,law,release,triangles,step [s],drape coefficient [%],nodes,settled,published drape "
               "coefficient [%],published nodes,sharp edges [%],computing [s]");
  for (const Drape& d : drapes)
    file.row({d.fabric, d.law, d.release, d.triangles, d.step, d.number("drape_coefficient_percent"),
              d.number("node_count"), d.metrics["settled"].is(true) ? "yes" : "no",
              d.number("published_drape_coefficient_percent"), d.number("published_node_count"),
              d.number("sharp_edges_percent"), d.seconds});
  file.commit();
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

// Bending length of ASTM D1388, cloth and curve.
void measure_bending_lengths(const F& flags, Run& run) {
  CsvFile file(run.path("cantilever.csv"),
               "fabric,law,bending length [m],of the elastica [m],remaining drop over length");
  for (const std::string& fabric : split(flags.fabrics))
    for (const std::string& law : split(flags.laws)) {
      const std::string name = "cantilever-" + fabric + "-" + law;
      const Metrics metrics =
          result_of("cantilever", {{"fabric", fabric}, {"law", law}, {"triangles", "512"}}, flags, run, name)
              .metrics;
      const double cloth = metrics["bending_length_m"].number(),
                   curve = metrics["elastica_bending_length_m"].number();
      file.row({fabric, law, cloth, curve, metrics["residual_drop_over_length"].number()});
      run.metric(name + ".bending_length_m", cloth);
      run.progress(name + ": bending length " + number_field(cloth) + " m, elastica " + number_field(curve) +
                   " m");
    }
  file.commit();
}

int run_validate(const CommandLine& line) {
  F flags;
  set_keys(line, keys_of(flags), [&] {
    flags.triangles = std::min(flags.triangles, 400.0);
    flags.seconds = std::min(flags.seconds, 1.0);
  });
  Run run(line, flags.options, to_json(bind(kRows, flags)));
  std::vector<Drape> drapes = planned(flags);
  for (Drape& drape : drapes) {
    run_drape(drape, flags, run);
    write_drapes(run, drapes);  // a run that is cut short keeps what it has found
  }
  note_drapes(run, drapes);
  measure_bending_lengths(flags, run);
  if (!flags.options.no_images) draw_drapes(run, drapes);
  finish_with_report(run);
  return 0;
}

}  // namespace

Experiment validate() {
  return {.name = "validate",
          .question = "the model against measurements: drape coefficients, bending lengths",
          .run = run_validate,
          .own_keys = own_keys_of<keys_of>};
}

}  // namespace hysteron::experiments
