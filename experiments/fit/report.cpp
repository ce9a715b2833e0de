#include "experiments/fit/report.h"

#include <fmt/core.h>

#include <cmath>

#include "sim/base/csv.h"
#include "sim/scene/key_table.h"

namespace hysteron::experiments {
namespace {

struct Row {
  const char* metric;
  const char* name;
  const char* unit;
  const Estimate* estimate;
};

std::vector<Row> result_rows(const Identification& found) {
  return {{"b1_N_m", "b1", "N m", &found.b1},
          {"b2_N_m", "b2", "N m", &found.b2},
          {"k0_per_m", "k0", "1/m", &found.k0}};
}

void add_metrics(Run& run, const Identification& found, const std::string& prefix) {
  for (const Row& row : result_rows(found)) {
    run.metric(prefix + row.metric, row.estimate->value);
    run.metric(prefix + row.metric + "_stderr", row.estimate->standard_error);
  }
  run.metric(prefix + "undetermined", found.undetermined());
  run.metric(prefix + "2HB_N", 2 * found.curve().friction_moment());
  run.metric(prefix + "residual_rms_N", found.residual_rms());
  run.metric(prefix + "residual_rms_percent", 100 * found.residual_rms() / found.largest_moment());
  run.metric(prefix + "iterations", found.iterations);
  for (const auto& [name, value] : found.further) run.metric(prefix + name, value);
}

void write_rows(Run& run, const std::vector<Identification>& fits) {
  std::vector<Column> columns = {{"curvature [1/m]", fits[0].curvature}, {"moment [N]", fits[0].moment}};
  for (const Identification& fit : fits) {
    const std::string law = fits.size() > 1 ? "_" + fit.law : "";
    Column residual{"residual" + law + " [N]", fit.moment};
    for (std::size_t i = 0; i < fit.model.size(); ++i) residual.values[i] -= fit.model[i];
    columns.push_back({"model" + law + " [N]", fit.model});
    columns.push_back(residual);
  }
  Table(columns).write(run.path("fit.csv"));
}

std::string percent_text(const Identification& fit) {
  return fmt::format("{:.2g} %", 100 * fit.residual_rms() / fit.largest_moment());
}

std::string with_error(const Row& row) {
  const Estimate& e = *row.estimate;
  const std::string error =
      std::isfinite(e.standard_error) ? fmt::format(" +- {:.2g}", e.standard_error) : "";
  return fmt::format("  {} = {:.4g}{} {}{}\n", row.name, e.value, error, row.unit,
                     e.determined ? "" : "  (" + e.confidence + "; the data do not determine it)");
}

std::string fit_summary(const Identification& found) {
  std::string text = found.law + ": residual " + percent_text(found) + " of the largest moment (rms), " +
                     std::to_string(found.moment.size()) + " rows, " + std::to_string(found.iterations) +
                     " iterations\n";
  for (const Row& row : result_rows(found)) text += with_error(row);
  const std::vector<std::string> open = found.undetermined();
  text += "  undetermined: " + (open.empty() ? std::string("nothing") : join(open, ", ")) + "\n";
  for (const std::string& statement : found.statements) text += "  - " + statement + "\n";
  return text;
}

}  // namespace

void report_fits(Run& run, const std::vector<Identification>& fits, const FabricNotes& notes) {
  write_fabric(run.path("fabric.toml"), fits[0], notes);
  write_rows(run, fits);
  const bool several = fits.size() > 1;
  if (several) run.metric("best_law", fits[0].law);
  for (const Identification& fit : fits) add_metrics(run, fit, several ? fit.law + "." : "");
  for (const Identification& fit : fits) run.manifest().statements.push_back({fit.law, fit.statements});
  draw_fits(run, fits, notes.name + ": " + notes.from);
}

std::string summary(const std::vector<Identification>& fits) {
  std::string text;
  for (const Identification& fit : fits) {
    if (fits.size() == 1) break;
    const std::vector<std::string> open = fit.undetermined();
    text += fit.law + ": rms " + percent_text(fit) + "; b1 " + rounded(fit.b1.value) + ", b2 " +
            rounded(fit.b2.value) + " N m, k0 " + rounded(fit.k0.value) + "/m" +
            (open.empty() ? "" : "; undetermined: " + join(open, ", ")) + "\n";
  }
  return text + fit_summary(fits[0]);
}

}  // namespace hysteron::experiments
