// What `hysteron diff` measures of two pictures.
#pragma once

#include <array>

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

}  // namespace hysteron::experiments
