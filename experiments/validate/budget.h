// What each unknown of a fabric explains of a drape: one at a time at both ends of its range.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/validate/drapes.h"
#include "render/plot.h"

namespace hysteron::experiments {

// A drape that is told one thing more: "shear", "30".
struct Trial {
  std::string number, value;
  Drape drape;
};
// As the fabric's file says, each number that states a range at its low and its high end, the other tester,
// four times the triangles.
std::vector<Trial> budget_trials(const std::string& fabric, const ValidateFlags& flags);

// A row of budget.csv.  Coefficients [%] are means of the meshes.
struct BudgetRow {
  std::string fabric, number, value;
  int meshes = 0;
  double coefficient = NAN, error = NAN;  // the mean's standard error
  double change = NAN, published = NAN;   // from what the fabric's file says
};
// Throws as read_table() does, and Error::invalid_input where a column is missing.
std::vector<BudgetRow> read_budget(const std::filesystem::path& csv);
// Of one fabric, the first row being as its file says.
render::Plot budget_plot(const std::vector<BudgetRow>& rows);

// What each unknown explains.  For each fabric under the first law, each trial on `draws` meshes: budget.csv,
// plot_budget_<fabric>.
void write_budget(const ValidateFlags& flags, Run& run);

}  // namespace hysteron::experiments
