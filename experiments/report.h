// A run's folder as one page.
#pragma once

#include <filesystem>

namespace hysteron::experiments {

// Writes FOLDER/report.html from manifest.json, metrics.csv and the pictures that are there; nothing is
// computed again.  The page needs no other file: pictures are embedded, frames of a sequence as thumbnails.
// Returns its path.  Throws Error::request if the folder holds no run, Error::machine if the page cannot be
// written.
std::filesystem::path write_report(const std::filesystem::path& folder);

}  // namespace hysteron::experiments
