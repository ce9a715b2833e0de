// Identifies a fabric from the few numbers that a publication prints.
#pragma once

#include <filesystem>

#include "sim/identification/identification.h"

namespace hysteron {

// A number with its standard error; kNone if none is known.
struct Measured {
  double value = kNone;
  double standard_error = kNone;
  bool given() const { return value == value; }
};

// M = b1 K + c1 K^2 on loading is a fit to the first bend of a fabric (Wong, Eq. 4.2).
struct VirginNumbers {
  Measured b1;  // [N m]
  Measured c1;  // [N m^2], < 0
};

// Reads the means over the rows of a file, the specimens of one fabric, with standard errors from their
// scatter.  The columns are `b1 [N m]`, `c1 [N m2]`.  Throws Error::system, Error::invalid_input (a row with
// c1 >= 0 is named).
VirginNumbers read_virgin(const std::filesystem::path& file, const std::string& reader);

// Computes k0 = (b2 - b1)/(2 c1) with b2 = ratio b1.  Throws Error::invalid_input for b1 that no fabric has,
// and for c1 >= 0.
Identification identify_virgin(const VirginNumbers& numbers, const Assumptions& assumptions);

// The numbers that KES-FB2 (Kawabata 1980) prints of a pure bending test.
struct KesNumbers {
  Measured b;       // slope B [N m]
  Measured two_hb;  // width of the loop 2HB [N]
  Measured k0;      // [1/m]; not printed by KES
};

// Computes b2 = B, b1 = B + 2HB/k0.  Throws Error::invalid_input for B <= 0, 2HB < 0 and for magnitudes that
// no fabric has.
Identification identify_kes(const KesNumbers& numbers, const Assumptions& assumptions);

// Warns if the ratio of two printed quantities is beyond that of woven cloth: "is 0.5 1/m of B, and woven
// cloth has 16 to 300: is one of them in another unit?"; "" within these bounds.
std::string woven_ratio_warning(double ratio, const std::string& unit, const std::string& below, double low,
                                double high);
inline constexpr double kLeastWidthOverB = 16, kMostWidthOverB = 300;  // 2HB/B of woven cloth [1/m]

// Warns if 2HB and B can hardly be of one fabric and one unit; "" where nothing is doubtful.
std::string kes_warning(const KesNumbers& numbers);

}  // namespace hysteron
