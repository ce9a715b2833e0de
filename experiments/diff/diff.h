// How far two pictures, or the pictures of two folders, differ.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/diff/limits.h"
#include "render/flip.h"
#include "render/image.h"

namespace hysteron::experiments {

// In the folder of --out, for the heat maps of two folders' pictures.
inline constexpr const char* kHeatFolder = "heat";
inline constexpr const char* kDiffTable = "diff.csv";

struct DiffFlags {
  Measures limits = no_limits();
  std::string limits_file;                              // "": none
  Limits from_file;                                     // what it says
  double pixels_per_degree = render::kPixelsPerDegree;  // of the eye that FLIP assumes
  std::string map = "steps";                            // what heat maps show: steps | flip
  std::string out;    // a PNG file, for folders a folder; "": nothing is written
  std::string junit;  // an XML file; "": none
  bool json = false;

  // Of the picture of that name: the file's, and in their place the flags'.
  PictureLimits picture_limits(const std::string& name) const;
};

// Two pictures of one size, the measures, and the picture of where they differ.
struct Comparison {
  render::Image a, b, heat;
  Measures measures;
};
// Pictures that let something show through are compared as they look on black and on white, the worse of
// both counting in each measure.  Error::invalid_input if the sizes differ.
Comparison compare_pictures(render::Image a, render::Image b, const DiffFlags& flags);
// Throws Error::invalid_input, naming the file or both, if one cannot be read or the sizes differ.
Comparison compare_files(const std::filesystem::path& a, const std::filesystem::path& b,
                         const DiffFlags& flags);

// The pictures of two folders by their names within them.
struct FolderDiff {
  std::filesystem::path a, b;
  struct Row {
    std::string name;  // "frames/0003.png"
    Measures measures;
    std::vector<std::string> broken;  // limits
    std::string error;                // why it could not be compared; "": it was
    int exit_code = 0;                // of that error
  };
  std::vector<Row> rows;
  Measures worst;  // of each measure by itself, of those that were compared

  std::ptrdiff_t compared() const;
};

// Names of all PNG files under either folder, sorted.  Throws Error::invalid_input if there is none.
std::vector<std::string> pictures_in_either(const std::filesystem::path& a, const std::filesystem::path& b);
// One that is missing, broken or of another size has its reason in the row.
FolderDiff::Row compare_in_folders(const std::filesystem::path& a, const std::filesystem::path& b,
                                   const std::string& name, const DiffFlags& flags, render::Image& heat);

}  // namespace hysteron::experiments
