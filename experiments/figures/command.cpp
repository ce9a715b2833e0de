// `hysteron figures` draws the chapter's figures as pictures, curves and captions in one folder.
#include <fmt/core.h>

#include <iostream>
#include <nlohmann/json.hpp>

#include "experiments/figures/figures.h"
#include "experiments/workbench/app/experiment.h"
#include "experiments/workbench/app/run.h"
#include "experiments/workbench/pages/gallery_exhibit.h"
#include "sim/base/atomic_file.h"
#include "sim/base/error.h"

namespace hysteron::experiments {
namespace {

// Writes the curves and named points of a figure, one point per row.
void write_curves(const std::filesystem::path& path, const Figure& figure) {
  const render::Plot& plot = figure.plot;
  AtomicFile file(path.string());
  const auto row = [&](const std::string& name, double x, double y) {
    file.stream() << fmt::format("\"{}\",{:.12g},{:.12g}\n", name, x, y);
  };
  file.stream() << "curve," << figure.columns << "\n";
  for (const render::Series& series : plot.series)
    for (std::size_t i = 0; i < series.x.size() && !series.label.empty(); ++i)
      row(series.label, series.x[i], series.y[i]);
  for (const render::Mark& mark : plot.marks)
    if (mark.dot) row("point " + mark.text, mark.x, mark.y);
  file.commit();
}

std::vector<FigureCaption> figure_captions(const std::vector<Figure>& figures) {
  std::vector<FigureCaption> captions;
  for (const Figure& figure : figures)
    captions.push_back({figure.name + ".png", figure.plot.title, figure.caption});
  return captions;
}

constexpr const char* kUsualFabric = "cotton-broad-k50";

std::vector<KeyDescription> figure_fabric_keys() {
  std::vector<KeyDescription> keys = fabric_keys();
  for (KeyDescription& key : keys)
    if (key.path == "fabric.name") key.default_text = kUsualFabric;
  return keys;
}

// Throws for fabrics beyond b1, b2, K0: friction by stops has no transition curvature, which every figure
// shows; a set leaves other residual curvatures than friction does; branches relax.
void check_three_numbers(const Fabric& fabric, const std::string& name) {
  const BendingParts& parts = fabric.bending;
  const std::string other = !parts.stops.empty()      ? " has friction by stops"
                            : parts.set.on()          ? " has a permanent set"
                            : !parts.branches.empty() ? " has branches that relax"
                            : parts.faces.on()        ? " has faces that differ"
                                                      : "";
  if (other.empty()) return;
  throw Error::invalid_input("--fabric " + name + other +
                             ", and the figures are of b1, b2 and k0 alone: give a fabric without, as " +
                             kUsualFabric)
      .with_key("fabric", name)
      .with_experiment("figures");
}

int run_figures(const CommandLine& line) {
  Options options;
  set_keys(line, bind_output_options(options));
  const std::string name = last_text(line.flags, "fabric", kUsualFabric);
  Scene scene;
  scene.fabric = resolved_fabric(name, line.flags);
  check_three_numbers(scene.fabric, name);
  const std::vector<Figure> all = chapter_figures(scene.fabric);
  Run run(line, options, {{"fabric", to_json(scene)["fabric"]}});
  for (const Figure& figure : all) {
    write_curves(run.path(figure.name + ".csv"), figure);
    if (options.no_images) continue;
    for (const char* ending : {".png", ".svg"}) run.path(figure.name + ending);
    render::write_plot(run.folder() / figure.name, figure.plot);
  }
  write_captions(run.path("README.md"), "The chapter's figures, from the program's own laws",
                 "Wong, \"Modelling Bending Behaviour Using Hysteresis\" (Wong, Leach, Zambetta, Computer "
                 "Graphics Forum 2013). Letters as in the chapter. Written by `" +
                     line.command + "`; curves and points are in the CSV files.",
                 figure_captions(all));
  run.finish();
  if (!options.json) {
    for (const Figure& figure : all) std::cout << figure.name << ": " << figure.plot.title << "\n";
  }
  return 0;
}

}  // namespace

Experiment figures() {
  return {.name = "figures",
          .question = "the chapter's Figures 4.2 to 4.4 and its Eq. 4.3 from the program's own laws",
          .run = run_figures,
          .own_keys = own_key_descriptions<bind_output_options, figure_fabric_keys>};
}

}  // namespace hysteron::experiments
