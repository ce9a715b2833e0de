// Builds pieces of a page from pictures, frames and series of a run's folder.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "experiments/workbench/pages/page.h"

namespace hysteron::experiments {

// True if the file exists and is no broken or circular link.
bool is_there(const std::filesystem::path& file);

// Returns the files of the folder with that ending (".png"), by name; none if it is no folder.
std::vector<std::filesystem::path> files_ending(const std::filesystem::path& folder,
                                                const std::string& ending);

// Throws Error::system if the file cannot be read.
std::vector<std::uint8_t> content_bytes(const std::filesystem::path& file);

bool is_plot(const std::filesystem::path& file);

// Returns a PNG of the picture, shrunk to at most `width` pixels.  Throws Error::invalid_input, naming the
// file, if it is no picture.
std::vector<std::uint8_t> thumbnail(const std::filesystem::path& file, int width);

// Returns the size of an SVG file; 0 x 0 if its first tag does not state it in plain numbers.
render::ImageSize drawing_size(const std::filesystem::path& file);

// Returns an <img> of a PNG or SVG file.  `path` is relative to the page, which loads it once it comes near
// the window; `words` replace it if it cannot be seen.  If the page is self-contained, a PNG picture is
// shrunk to `width` pixels, 0: embedded as it is.  Throws Error::invalid_input, naming the file, if a PNG
// picture that is linked or shrunk is broken.
struct PagePicture {
  std::filesystem::path file;
  std::string path, words;
  int width = 0;
};
std::string image_element(const PagePicture& picture, PageForm form);

// Returns FOLDER/frames as a sequence that plays, with at most `count` frames spread over the whole.  `path`
// is the folder relative to the page: "" or "NAME/".  "" if there are no frames.
std::string player(const std::filesystem::path& folder, const std::string& path, int count, PageForm form);

// Returns charts of the columns of FOLDER/metrics.csv against its first; "" if there is no series.
std::string series_charts(const std::filesystem::path& folder);

}  // namespace hysteron::experiments
