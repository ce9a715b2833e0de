// A folder of runs as one page.
#pragma once

#include <filesystem>
#include <string>

namespace hysteron::experiments {

// HTML of all that exhibits_in() finds, grouped by experiment.  The page works from disk without a network:
// pictures are embedded, shrunk and in few colours, and lead to the files beside the page.  Everything is
// read from the folders, nothing is computed again, and the same folders give the same bytes.  Throws
// Error::request, naming the file, if a picture, table or manifest is broken or there is nothing to show.
std::string gallery_page(const std::filesystem::path& folder);

// Writes it as FOLDER/index.html and returns that path.  Throws Error::machine if it cannot be written.
std::filesystem::path write_gallery(const std::filesystem::path& folder);

}  // namespace hysteron::experiments
