// The measures that `hysteron diff` takes of two pictures, and the limits on pictures and metrics, from flags
// and from a file.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sim/scene/key_table.h"

namespace hysteron::experiments {

// The measures of a pair, or a limit on each.
struct Measures {
  double mean_abs = 0;               // mean absolute difference of the channels [8-bit steps]
  double rmse = 0;                   // root of the mean squared difference [8-bit steps]
  double psnr_db = 0;                // 20 log10(255 / rmse) [dB], infinite for equal pictures
  double ssim = 0;                   // mean structural similarity of luma, 1 for equal pictures (ssim.h)
  double flip = 0;                   // mean visible difference, 0 to 1 (flip.h)
  double pixels_over_8_percent = 0;  // pixels with a channel that differs by more than 8 steps
};

// Returns limits that no pair exceeds.
Measures no_limits();

struct Measure {
  const char* name;    // as printed: "psnr_db"
  const char* column;  // head of the table with the unit: "mean_abs [steps]"
  const char* limit;   // key of the limit: "max-flip", "min-ssim"
  double Measures::*value;
  bool least;  // the limit is the least value allowed, not the largest
};
// Returns all measures, in the order in which they are printed.
const std::array<Measure, 6>& all_measures();

// Returns the worse value of each measure.
Measures worse_measures(const Measures& a, const Measures& b);

// Binds the keys of limits, as flags and in files: "max-flip", "min-ssim", ...
Keys bind_limits(Measures& limits);

// The limits on one picture.
struct PictureLimits {
  Measures values = no_limits();
  std::map<std::string, std::string> places{};  // where a file sets each key: "limits.toml:3"
  std::string table{};                          // where the file's table of this picture begins

  // Overrides these limits with those that `over` has.
  void set(const PictureLimits& over);
  bool has_any() const;
};

// Returns "flip = 0.2 must be <= 0.1 (--max-flip)" for every broken limit; a NaN breaks any limit.
std::vector<std::string> broken_limits(const Measures& found, const PictureLimits& limits);

// Names that match a limit's pattern but are compared with nothing, and the reason.
struct NotCompared {
  std::vector<std::string> names{};
  std::string why{};
};

// The limits of a file; in its names * and ? stand for any text and any character:
//
//   max-flip = 0.01                        # for all pictures
//   [[picture]]                            # for those of this name in their folder; later ones override
//   name = "frames/*.png"
//   max-flip = 0.02
//   [[metric]]                             # for `verify`: replaces the error that the run has stated
//   name = "drape_coefficient_percent"
//   max-difference = 0.5                   # in the metric's unit
struct Limits {
  PictureLimits all;
  std::vector<std::pair<std::string, PictureLimits>> pictures;  // by the pattern of the name
  // Largest difference in the metric's unit, by the pattern of the name.
  std::vector<std::pair<std::string, double>> metrics;
  std::vector<std::string> metric_tables;  // where the tables of these begin

  PictureLimits of_picture(const std::string& name) const;
  std::optional<double> of_metric(const std::string& name) const;
  bool has_pictures() const;  // true if there is a limit on any picture
  // Throws Error::invalid_input, with its place, for a pattern that matches none of these pictures or
  // metrics, or only those that are not compared.
  void refuse_unused_pictures(const std::vector<std::string>& names, const NotCompared& others = {}) const;
  void refuse_unused_metrics(const std::vector<std::string>& names, const NotCompared& others = {}) const;
};

// Reads the limits from a file, or by name from assets/limits.  Throws Error::system, Error::invalid_input
// with file and line.
Limits read_limits(const std::string& name_or_file);

}  // namespace hysteron::experiments
