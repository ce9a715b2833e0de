// Measures how far two pictures, or the pictures of two folders, differ.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/diff/limits.h"
#include "render/flip.h"
#include "render/image.h"

namespace hysteron::experiments {

// Names within the folder of --out: the heat maps of two folders' pictures, and their table.
inline constexpr const char* kHeatFolder = "heat";
inline constexpr const char* kDiffTable = "diff.csv";

// The quantity of heat maps: the largest difference of a channel, or FLIP.
enum class HeatMap { steps, flip };
constexpr std::array<const char*, 2> names(HeatMap) { return {"steps", "flip"}; }

struct DiffFlags {
  Measures limits = no_limits();
  std::string limits_file;                              // "" if there is none
  Limits from_file;                                     // contents of that file
  double pixels_per_degree = render::kPixelsPerDegree;  // assumed by FLIP for the eye
  HeatMap map = HeatMap::steps;
  std::string out;    // a PNG file, or a folder for folders; "": nothing is written
  std::string junit;  // an XML file; "" if there is none
  bool json = false;

  // Returns the limits of the picture of that name: the file's, overridden by the flags'.
  PictureLimits picture_limits(const std::string& name) const;
};

// Two pictures of one size, their measures, and the heat map of where they differ.
struct Comparison {
  render::Image a, b, heat;
  Measures measures;
};
// Compares two pictures.  Transparent ones are compared on black and on white, and each measure is the worse
// of both.  Throws Error::invalid_input if the sizes differ.
Comparison compare_pictures(render::Image a, render::Image b, const DiffFlags& flags);
// Throws Error::invalid_input, naming the file or both, if one cannot be read or the sizes differ.
Comparison compare_files(const std::filesystem::path& a, const std::filesystem::path& b,
                         const DiffFlags& flags);

// The comparison of the pictures of two folders, by their names within them.
struct FolderDiff {
  std::filesystem::path a, b;
  struct Row {
    std::string name;  // relative path: "frames/0003.png"
    Measures measures;
    std::vector<std::string> broken;  // the limits that are broken
    std::string error;                // why it could not be compared, or ""
    int exit_code = 0;                // exit code of that error
  };
  std::vector<Row> rows;
  Measures worst;  // worst value of each measure over the compared pictures

  std::ptrdiff_t compared() const;
};

// Returns the names of all PNG files under either folder, sorted.  Throws Error::invalid_input if there is
// none.
std::vector<std::string> pictures_in_either(const std::filesystem::path& a, const std::filesystem::path& b);
// Compares one pair; a picture that is missing, broken or of another size has its reason in the row.
FolderDiff::Row compare_in_folders(const std::filesystem::path& a, const std::filesystem::path& b,
                                   const std::string& name, const DiffFlags& flags, render::Image& heat);

}  // namespace hysteron::experiments
