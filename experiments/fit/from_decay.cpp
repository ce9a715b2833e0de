#include "experiments/fit/from_decay.h"

#include <cmath>

#include "render/plot.h"
#include "sim/base/csv.h"
#include "sim/base/error.h"

namespace hysteron::experiments {
namespace {

void draw_decay(Run& run, const DecaySeries& series, const std::vector<double>& found,
                const std::vector<double>& saturated) {
  render::Plot plot{"Amplitude against time", {"time [s]"}, {"amplitude of the free end [mm]"}};
  const auto add = [&](const std::string& label, std::vector<double> values, render::Series::Style style) {
    for (double& a : values) a *= 1e3;
    plot.series.push_back({label, series.time, values, style});
  };
  add("measured", series.amplitude, render::Series::Style::points);
  add("fitted", found, render::Series::Style::line);
  if (!saturated.empty()) add("k0 = 50/m", saturated, render::Series::Style::dashed);
  run.plot("plot_decay", plot);
}

}  // namespace

std::string report_decay(Run& run, const DecayFlags& flags, double density, double rigidity,
                         const FabricNotes& notes, bool pictures) {
  const DecaySeries series = read_decay(flags.file, "fit");
  const DecayQuestion question{flags.length, density, rigidity, flags.noise};
  FabAnswer answer;
  answer.found.bending = {identify_decay(series, question)};
  answer.found.from = notes.from;
  answer.forms = {even_forms(series, question)};
  const FabBending& b = answer.found.bending[0];
  if (!b.converged) run.warn("the fit did not converge");
  if (!(b.law.spring > 0))
    throw Error::invalid_input(
        "decay: the friction that is found is steeper than kes.b = " + number_text(rigidity) +
        " N m where a tester reads it: check kes.b, fabric.density and decay.length")
        .with_key("kes.b", number_text(rigidity));
  write_fab_fabric(run.path("fabric.toml"), answer.found, notes);
  write_forms(run, answer);
  add_shape(run, b, "");
  run.metric("HB_N", b.law.friction());
  run.metric("HB_N_stderr", b.friction_error);
  run.metric("b2_N_m", b.law.spring);
  run.metric("residual_over_noise", b.residual_rms);
  run.metric("iterations", b.iterations);
  run.metric("undetermined", b.undetermined());

  const auto by = [&](const FabBending& form) {
    return decay_by(series, question, {form.law.thresholds, form.law.stiffnesses}, form.first);
  };
  const std::vector<double> found = by(b);
  std::vector<double> saturated;
  for (const FabForm& form : answer.forms[0])
    if (form.name == "k0 = 50/m") saturated = by(form.found);
  Table({{"time [s]", series.time}, {"amplitude [m]", series.amplitude}, {"fitted [m]", found}})
      .write(run.path("decay.csv"));
  if (pictures) draw_decay(run, series, found, saturated);
  return summary(answer);
}

}  // namespace hysteron::experiments
