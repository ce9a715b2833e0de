// What a manifest says of its run in one line.
#pragma once

#include <string>

#include "experiments/workbench/app/run.h"

namespace hysteron::experiments {

// "3 rows", "1 row".
std::string counted(std::size_t count, const std::string& thing);
// "0.35 s", "20.6 s", "1042 s".
std::string seconds_text(double seconds);

// Fabric and law, "cotton-broad, law prandtl", "cotton-broad, 14 laws"; what the manifest does not say is
// left out.
std::string subject_of(const Json& manifest);

// The same and more, as a paragraph of HTML: mesh, precision, times, device, date, program.
std::string about_html(const Json& manifest);

}  // namespace hysteron::experiments
