// Pictures, frames and series of a run's folder, as pieces of a page.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace hysteron::experiments {

// Not a link that leads nowhere, or to itself.
bool is_there(const std::filesystem::path& file);

// Files of the folder with that ending (".png"), by name; none if it is no folder.
std::vector<std::filesystem::path> files_ending(const std::filesystem::path& folder,
                                                const std::string& ending);

// Throws Error::machine if the file cannot be read.
std::vector<std::uint8_t> bytes_of(const std::filesystem::path& file);

bool is_plot(const std::filesystem::path& file);

// A PNG file of a picture, shrunk to at most `width` pixels and drawn in few colours.  Error::request, naming
// the file, if it is no picture.
std::vector<std::uint8_t> thumbnail(const std::filesystem::path& file, int width);

// FOLDER/frames as a sequence that plays; at most `count` of them, spread over the whole of it.  "" if there
// are none.
std::string player(const std::filesystem::path& folder, int count);

// Charts of the columns of FOLDER/metrics.csv against its first.  "" if there is no series.
std::string series_charts(const std::filesystem::path& folder, bool with_energies);

}  // namespace hysteron::experiments
