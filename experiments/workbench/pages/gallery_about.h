// What a manifest says of its run in one line.
#pragma once

#include <string>
#include <vector>

#include "experiments/workbench/app/manifest.h"

namespace hysteron::experiments {

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
