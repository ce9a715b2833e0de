// The result of a fit: a fabric's three numbers, how well the data fix each, and what was assumed instead.
#pragma once

#include <array>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "sim/bending/laws/law.h"

namespace hysteron {

inline constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// A number b1, b2 [N m] or k0 [1/m].
struct Estimate {
  double value = 0;
  double standard_error = kNone;  // kNone: not fixed by the data, or the data have no errors
  bool determined = true;         // the data fix it within a factor of kWidestFactor
  std::string source;             // for the fabric's file
  std::string confidence = "fitted";
  double low = kNone, high = kNone;  // bounds of an assumed value
};

struct Identification {
  std::string law;  // the law with which the numbers were identified
  Estimate b1, b2, k0;
  std::vector<double> curvature, moment, model;         // data [1/m], [N], and the law's moments there [N]
  int iterations = 0;                                   // iterations of the solver; 0: closed form
  std::vector<std::pair<std::string, double>> further;  // more metrics, names with units
  std::vector<std::string> statements;                  // plain sentences on what the data say and do not say

  VirginCurve curve() const { return {b1.value, b2.value, k0.value}; }
  std::vector<std::string> undetermined() const;
  double residual_rms() const;    // [N]
  double largest_moment() const;  // [N]
};

inline constexpr double kNormal95 = 1.96;  // half width of a 95 % interval over the standard deviation

// A quantity whose 95 % interval spans more than this factor is called undetermined.
inline constexpr double kWidestFactor = 3;

// Twice the logarithm of the likelihood may fall by this much within a 95 % interval (Wilks 1938); numbers
// that lower it more contradict the data.
inline constexpr double kLikelihoodFall = 3.84;

// The values that replace what the data cannot decide.
struct Assumptions {
  double ratio = 0.5;  // b2/b1: no source gives it
  double k0 = 8;       // [1/m], as the shipped fabrics have it, whose files give the source

  std::string ratio_source() const;
  std::string k0_source() const;
  Estimate assumed_k0() const;  // with the range of the shipped fabrics
};

}  // namespace hysteron
