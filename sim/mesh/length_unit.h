// Units of length in the files of other programs.
#pragma once

#include <array>

#include "sim/base/enum_names.h"

namespace hysteron {

enum class LengthUnit { metre, centimetre, millimetre, inch };
constexpr std::array<const char*, 4> names(LengthUnit) {
  return {"metre", "centimetre", "millimetre", "inch"};
}

// Converts `x` of that unit to metres, by division, so that 15 centimetres have the bits of 0.15 m.
constexpr double in_metres(double x, LengthUnit unit) {
  switch (unit) {
    case LengthUnit::centimetre:
      return x / 100;
    case LengthUnit::millimetre:
      return x / 1000;
    case LengthUnit::inch:
      return x * 254 / 10000;
    case LengthUnit::metre:
      break;
  }
  return x;
}

}  // namespace hysteron
