// A gallery leads with questions, each with one picture and one number.
#pragma once

#include <filesystem>
#include <string>

#include "experiments/workbench/pages/page.h"

namespace hysteron::experiments {

// Returns FOLDER/questions.json as HTML; "" if there is none.  It is written by hand, a list of objects:
//   question  in words
//   picture   PNG or SVG file below the folder
//   run       folder of the manifest that has the number
//   metric    its name there
//   words     behind the number
// Throws Error::invalid_input, naming the file, if it has another form, or if a picture, a run or a metric
// is missing.
std::string questions_html(const std::filesystem::path& folder, PageForm form);

}  // namespace hysteron::experiments
