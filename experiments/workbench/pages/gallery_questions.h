// A gallery leads with questions, each with one picture and one number.
#pragma once

#include <filesystem>
#include <string>

#include "experiments/workbench/pages/page.h"

namespace hysteron::experiments {

// FOLDER/questions.json, which people write, as HTML; "" where there is none.  It is a list of objects:
//   question  in words
//   picture   PNG or SVG file below the folder
//   run       folder of the manifest that has the number
//   metric    its name there
//   words     behind the number
// Throws Error::invalid_input, naming the file, where it is not that, or where a picture, a run or a metric
// is not there.
std::string questions_html(const std::filesystem::path& folder, PageForm form);

}  // namespace hysteron::experiments
