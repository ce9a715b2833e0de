// How far two pictures, or the pictures of two folders, differ.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "render/flip.h"
#include "render/image.h"

namespace hysteron::experiments {

// What `hysteron diff` measures, or a limit on each.
struct Measures {
  double mean_abs = 0;               // mean absolute difference of the channels [8-bit steps]
  double rmse = 0;                   // root of the mean squared difference [8-bit steps]
  double psnr_db = 0;                // 20 log10(255 / rmse) [dB], infinite for equal pictures
  double ssim = 0;                   // mean structural similarity of luma, 1 for equal pictures (ssim.h)
  double flip = 0;                   // mean visible difference, 0 to 1 (flip.h)
  double pixels_over_8_percent = 0;  // pixels with a channel that differs by more than 8 steps
};

// Limits that nothing is beyond.
Measures no_limits();

struct Measure {
  const char* name;    // as printed: "psnr_db"
  const char* column;  // with the unit: "mean_abs [steps]"
  const char* limit;   // the flag: "max-flip", "min-ssim"
  double Measures::*value;
  bool least;  // the limit is the least value allowed, not the largest
};
// All of them, in the order in which they are printed.
const std::array<Measure, 6>& all_measures();

// How the worse of both differs.
Measures worst_of(const Measures& a, const Measures& b);

// "flip = 0.2 must be <= 0.1 (--max-flip)" for every limit that is broken; not a number breaks a limit.
std::vector<std::string> broken_limits(const Measures& found, const Measures& limits);

// In the folder of --out, for the heat maps of two folders' pictures.
inline constexpr const char* kHeatFolder = "heat";

struct DiffFlags {
  Measures limits = no_limits();
  double pixels_per_degree = render::kPixelsPerDegree;  // of the eye that FLIP assumes
  std::string map = "steps";                            // what heat maps show: steps | flip
  std::string out;  // a PNG file, for folders a folder; "": nothing is written
  bool json = false;
};

// Two pictures of one size, the measures, and the picture of where they differ.
struct Comparison {
  render::Image a, b, heat;
  Measures measures;
};
// Error::request if the sizes differ.
Comparison compare_pictures(render::Image a, render::Image b, const DiffFlags& flags);
// Throws Error::request, naming the file or both, if one cannot be read or the sizes differ.
Comparison compare_files(const std::filesystem::path& a, const std::filesystem::path& b,
                         const DiffFlags& flags);

// The pictures of two folders by their names within them.
struct FolderDiff {
  std::filesystem::path a, b;
  struct Row {
    std::string name;  // "frames/0003.png"
    Measures measures;
    std::vector<std::string> broken;  // limits
  };
  std::vector<Row> rows;
  Measures worst;  // of each measure by itself
};

// Names of all PNG files under both folders, sorted.  Throws Error::request if a picture is in one of them
// only, or if there is none.
std::vector<std::string> paired_pictures(const std::filesystem::path& a, const std::filesystem::path& b);

// Writes FOLDER/diff.csv (a row for each picture) and FOLDER/diff.html (self-contained: the table and the
// pictures that differ most, with the heat maps of FOLDER/heat).  Throws Error::machine.
void write_folder_diff(const FolderDiff& diff, const DiffFlags& flags, const std::string& command);

}  // namespace hysteron::experiments
