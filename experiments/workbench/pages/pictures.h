// Pictures, frames and series of a run's folder, as pieces of a page.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "experiments/workbench/pages/page.h"

namespace hysteron::experiments {

// Not a link that leads nowhere, or to itself.
bool is_there(const std::filesystem::path& file);

// Files of the folder with that ending (".png"), by name; none if it is no folder.
std::vector<std::filesystem::path> files_ending(const std::filesystem::path& folder,
                                                const std::string& ending);

// Throws Error::system if the file cannot be read.
std::vector<std::uint8_t> content_bytes(const std::filesystem::path& file);

bool is_plot(const std::filesystem::path& file);

// A PNG file of a picture, shrunk to at most `width` pixels.  Error::invalid_input, naming
// the file, if it is no picture.
std::vector<std::uint8_t> thumbnail(const std::filesystem::path& file, int width);

// Of an SVG file; 0 x 0 where its first tag does not say it in numbers alone.
render::ImageSize drawing_size(const std::filesystem::path& file);

// An <img> of a PNG or SVG file.  `path` is where it lies, seen from the page, which reads it once it comes
// near the window; `words` stand for it where it cannot be seen.  Where the page is self-contained, a PNG
// picture is shrunk to `width` pixels, 0: embedded as it is.  Throws Error::invalid_input, naming the file,
// if a PNG picture that is linked or shrunk is broken.
struct PagePicture {
  std::filesystem::path file;
  std::string path, words;
  int width = 0;
};
std::string image_element(const PagePicture& picture, PageForm form);

// FOLDER/frames as a sequence that plays; at most `count` of them, spread over the whole of it.  `path` is
// where the folder lies, seen from the page: "" or "NAME/".  "" if there are none.
std::string player(const std::filesystem::path& folder, const std::string& path, int count, PageForm form);

// Charts of the columns of FOLDER/metrics.csv against its first.  "" if there is no series.
std::string series_charts(const std::filesystem::path& folder);

}  // namespace hysteron::experiments
