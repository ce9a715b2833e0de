// What `hysteron diff` measures of two pictures, and how far pictures and metrics may differ: limits of
// flags, and of a file.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sim/scene/key_table.h"

namespace hysteron::experiments {

// Measures, or a limit on each.
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
  const char* limit;   // the key: "max-flip", "min-ssim"
  double Measures::*value;
  bool least;  // the limit is the least value allowed, not the largest
};
// All of them, in the order in which they are printed.
const std::array<Measure, 6>& all_measures();

// How the worse of both differs.
Measures worse_measures(const Measures& a, const Measures& b);

// "max-flip", "min-ssim", ...: the keys of limits, as flags and in files.
Keys bind_limits(Measures& limits);

// Limits on one picture.
struct PictureLimits {
  Measures values = no_limits();
  std::map<std::string, std::string> places{};  // where a file sets them, by key: "limits.toml:3"
  std::string table{};                          // where the table stands that says whose they are

  // Those of `over` stand in place of these.
  void set(const PictureLimits& over);
  bool has_any() const;
};

// "flip = 0.2 must be <= 0.1 (--max-flip)" for every limit that is broken; not a number breaks a limit.
std::vector<std::string> broken_limits(const Measures& found, const PictureLimits& limits);

// Names that have a limit's pattern and are compared with nothing, and why.
struct NotCompared {
  std::vector<std::string> names{};
  std::string why{};
};

// What a file says, in whose names * and ? stand for any text and any character:
//
//   max-flip = 0.01                        # of all pictures
//   [[picture]]                            # of those of this name in their folder; later ones take
//   precedence name = "frames/*.png" max-flip = 0.02
//   [[metric]]                             # of `verify`: in place of the error that the run has stated
//   name = "drape_coefficient_percent"
//   max-difference = 0.5                   # in the metric's unit
struct Limits {
  PictureLimits all;
  std::vector<std::pair<std::string, PictureLimits>> pictures;  // by name
  std::vector<std::pair<std::string, double>> metrics;          // largest difference, by name
  std::vector<std::string> metric_tables;                       // where these stand

  PictureLimits of_picture(const std::string& name) const;
  std::optional<double> of_metric(const std::string& name) const;
  bool has_pictures() const;  // a limit on any picture
  // Throws Error::invalid_input, with its place, for a name that none of these pictures or metrics has, or
  // only those that are not compared.
  void refuse_unused_pictures(const std::vector<std::string>& names, const NotCompared& others = {}) const;
  void refuse_unused_metrics(const std::vector<std::string>& names, const NotCompared& others = {}) const;
};

// Of a file, or of assets/limits by its name.  Throws Error::system, Error::invalid_input with file and line.
Limits read_limits(const std::string& name_or_file);

}  // namespace hysteron::experiments
