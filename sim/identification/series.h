// Reads a measured moment-curvature curve for `fit`, and drives a law through it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim/bending/laws/law_run.h"

namespace hysteron {

struct MomentSeries {
  std::string name;               // name of the file, without its folder
  std::vector<double> curvature;  // as measured [1/m], in the order of measurement
  std::vector<double> moment;     // [N]
  std::vector<double> seconds;    // from the row before [s]; empty: not measured
  // The curvature that a law follows [1/m]: the nearest one in the least squares sense that turns only where
  // the measured one comes back by more than noise.  A law with memory would take every ripple for a
  // reversal.
  std::vector<double> drive;
  std::vector<int> turns;  // rows where `drive` turns
  int reversals = 0;       // their number

  int rows() const { return static_cast<int>(moment.size()); }
  double largest_curvature() const;  // of |drive| [1/m]
  double largest_moment() const;     // of |moment| [N]
};

// Reads columns `curvature [1/m]`, `moment [N]`, optional `time [s]`, in a table as testers write it
// (tester_table.h).  `ripple` is the share of the range below which a return of curvature is noise.  Throws
// Error::system, and Error::invalid_input for a file that is not a moment-curvature curve: other units, which
// are named with the flag that converts them, few rows, constant curvature or moments, moments that fall with
// curvature, rows out of order or backwards, magnitudes that no fabric has (other units).
MomentSeries read_series(const std::filesystem::path& file, double ripple, const std::string& reader);

// Reads the same in the units of KES-FB2: columns `curvature [1/cm]` and `moment [gf cm/cm]`.
MomentSeries read_kes_series(const std::filesystem::path& file, double ripple, const std::string& reader);

// Fills `drive` and `reversals` from `curvature`; checks as read_series() does.
void prepare(MomentSeries& series, double ripple);

// Returns the accepted steps of a law: from rest, or (`cycling`) after once through the whole series.
std::vector<LawRow> law_rows(const MomentSeries& series, bool cycling);

inline constexpr int kFewestRows = 8;              // three parameters, and five to see that they fit
inline constexpr double kMinRigidity = 1e-8;       // [N m]: no fabric is limper
inline constexpr double kGreatestRigidity = 1e-3;  // [N m]: no fabric is stiffer

// Throws Error::invalid_input if `value` [N m] is not the rigidity of a fabric, and says by which factor it
// would be.  `what` names it: "kes.b", "the slope of loop.csv".
void check_rigidity(double value, const std::string& what);

}  // namespace hysteron
