// What a run's manifest says, as words and pieces of a page.
#pragma once

#include <string>
#include <vector>

#include "experiments/workbench/app/manifest.h"

namespace hysteron::experiments {

// Numbers with six digits, texts without quotes.
std::string shown(const MetricValue& value);

struct NamedUnit {
  std::string name, unit;
  std::string text() const { return name + (unit.empty() ? "" : " [" + unit + "]"); }
};
// "drape_coefficient_percent" is "drape coefficient" in %: results carry their unit at the end of their name.
NamedUnit split_unit(std::string key);

// Value and unit of a result as readers want them: four digits, the prefix of SI that leaves 1 to 999 before
// the point, zero below 1e-12 of a unit that is one of mechanics: "0.94" "mN" of 0.00094 N.
struct ShownQuantity {
  std::string value, unit;
  std::string errors{};      // of a headline: "± 0.10 step ± 0.6 mesh ± 0.8 draw"
  std::string more() const;  // unit and errors
  std::string text() const;  // one after the other
};
ShownQuantity shown_quantity(const MetricValue& value, const std::string& unit);
// How the solver fared, and what every simulated run counts beside its own question.
bool is_numerics(const std::string& metric);

// "complete" or "incomplete".
std::string state_badge(const Manifest& manifest);

// "hysteron 0.1.0, commit 0123456789ab, modified"
std::string program_description(const Manifest& manifest);

// The texts that are not empty, with `between` between them.
std::string joined(std::vector<std::string> texts, const std::string& between);
std::string first_upper(std::string text);
// "3 rows", "1 row".
std::string counted(std::size_t count, const std::string& thing);
// "1000" is "1,000".
std::string grouped(long count);
// "0.35 s", "20.6 s", "1042 s".
std::string seconds_text(double seconds);

// Fabric, law and what a comparison compares, "cotton-broad, law prandtl", "cotton-broad, 14 laws", "columns
// linear, prandtl"; what the manifest does not say is left out.
std::string scene_subject(const Manifest& manifest);

// The same and more, as a paragraph of HTML: mesh, precision, times, device, date, program.
std::string about_html(const Manifest& manifest);

}  // namespace hysteron::experiments
