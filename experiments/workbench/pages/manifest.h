// Formats a run's manifest as words and pieces of a page.
#pragma once

#include <string>
#include <vector>

#include "experiments/workbench/app/manifest.h"

namespace hysteron::experiments {

// Formats numbers with six digits, texts without quotes.
std::string shown(const MetricValue& value);

struct NamedUnit {
  std::string name, unit;
  std::string text() const { return name + (unit.empty() ? "" : " [" + unit + "]"); }
};
// Splits a result's name from the unit at its end: "drape_coefficient_percent" is "drape coefficient" in %.
NamedUnit split_unit(std::string key);

// Value and unit of a result for readers: four digits, the SI prefix that leaves 1 to 999 before the point,
// and zero below 1e-12 of a mechanical unit: "0.94" "mN" for 0.00094 N.
struct ShownQuantity {
  std::string value, unit;
  std::string errors{};      // errors of a headline: "± 0.10 step ± 0.6 mesh ± 0.8 draw"
  std::string more() const;  // unit and errors
  std::string text() const;  // value, unit and errors
};
ShownQuantity shown_quantity(const MetricValue& value, const std::string& unit);
// True for metrics of the solver, and those that every simulated run counts beside its own results.
bool is_numerics(const std::string& metric);

// Returns "complete" or "incomplete" as HTML.
std::string state_badge(const Manifest& manifest);

// Returns "hysteron 0.1.0, commit 0123456789ab, modified".
std::string program_description(const Manifest& manifest);

// Joins the texts that are not empty, with `between` between them.
std::string joined(std::vector<std::string> texts, const std::string& between);
std::string first_upper(std::string text);
// Returns "3 rows", "1 row".
std::string counted(std::size_t count, const std::string& thing);
// Formats "0.35 s", "20.6 s", "1042 s".
std::string seconds_text(double seconds);

// Returns fabric, law and what a comparison compares, "cotton-broad, law prandtl", "cotton-broad, 14 laws",
// "columns linear, prandtl"; what the manifest lacks is left out.
std::string scene_subject(const Manifest& manifest);

// Returns the same and mesh, precision, times, device, date and program, as a paragraph of HTML.
std::string about_html(const Manifest& manifest);

}  // namespace hysteron::experiments
