// Writes a run's folder as one page.
#pragma once

#include <filesystem>
#include <string>

#include "experiments/workbench/app/run.h"
#include "experiments/workbench/pages/page.h"

namespace hysteron::experiments {

// Returns HTML from manifest.json, metrics.csv and the existing pictures; nothing is computed again.
// Pictures are linked, or embedded, with frames of a sequence as thumbnails.  The same folder gives the same
// bytes.  Throws Error::invalid_input if the folder holds no run, or a picture of it is broken.
std::string report_page(const std::filesystem::path& folder, PageForm form = PageForm::linked);

// Writes it as FOLDER/report.html and returns that path.  Throws Error::system if it cannot be written.
std::filesystem::path write_report(const std::filesystem::path& folder, PageForm form = PageForm::linked);

// Finishes a run with its page.
void finish_with_report(Run& run);
// Does the same for a page that lacks some of its runs (Run::finish_incomplete()).
void finish_incomplete_with_report(Run& run);

}  // namespace hysteron::experiments
