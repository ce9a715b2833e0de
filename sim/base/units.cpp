#include "sim/base/units.h"

#include <numbers>

#include "sim/base/plain_text.h"

namespace hysteron {
namespace {

constexpr double kGramForce = 9.80665e-3;  // [N]
constexpr double kDegree = std::numbers::pi / 180;
constexpr double kOuncePerSquareYard = 28.349523125e-3 / (0.9144 * 0.9144);  // [kg/m^2]

struct KnownUnit {
  const char *si, *unit;
  double factor;
};

// The rows of one quantity stand together; another spelling of a unit stands below it.
constexpr KnownUnit kUnits[] = {
    {"N m", "gf cm^2/cm", kGramForce * 1e-2},
    {"N m", "gf cm", kGramForce * 1e-2},
    {"N m", "mg cm", kGramForce * 1e-5},
    {"N m", "cN cm^2/cm", 1e-4},
    {"N m", "cN cm", 1e-4},
    {"N m", "mN m", 1e-3},
    {"N m", "uN m", 1e-6},
    {"N m", "N m^2/m", 1},
    {"N", "gf cm/cm", kGramForce},
    {"N", "gf", kGramForce},
    {"N", "cN cm/cm", 1e-2},
    {"N", "cN", 1e-2},
    {"N", "mN", 1e-3},
    {"N", "N m/m", 1},
    {"N/m", "gf/cm", kGramForce * 1e2},
    {"N/m", "cN/cm", 1},
    {"N/m", "N/cm", 1e2},
    {"N/m", "N/mm", 1e3},
    {"N/m", "kN/m", 1e3},
    {"N/m", "gf/cm degree", kGramForce * 1e2 / kDegree},
    {"N/m", "gf/(cm degree)", kGramForce * 1e2 / kDegree},
    {"N/m", "gf/cm/degree", kGramForce * 1e2 / kDegree},
    {"N/m", "gf/cm deg", kGramForce * 1e2 / kDegree},
    {"N/m", "gf/cm/deg", kGramForce * 1e2 / kDegree},
    {"N/m", "gf/(cm deg)", kGramForce * 1e2 / kDegree},
    {"N/m", "N/(m degree)", 1 / kDegree},
    {"N/m", "N/m/degree", 1 / kDegree},
    {"J/m2", "gf cm/cm^2", kGramForce * 1e2},
    {"J/m2", "cN cm/cm^2", 1},
    {"J/m2", "N/m", 1},
    {"kg/m^2", "mg/cm^2", 1e-2},
    {"kg/m^2", "g/m^2", 1e-3},
    {"kg/m^2", "gsm", 1e-3},
    {"kg/m^2", "g/cm^2", 10},
    {"kg/m^2", "oz/yd^2", kOuncePerSquareYard},
    {"m", "cm", 1e-2},
    {"m", "mm", 1e-3},
    {"m", "um", 1e-6},
    {"m", "micron", 1e-6},
    {"1/m", "1/cm", 1e2},
    {"1/m", "1/mm", 1e3},
    {"s", "ms", 1e-3},
    {"s", "min", 60},
    {"s", "h", 3600},
    {"Pa", "gf/cm^2", kGramForce * 1e4},
    {"Pa", "kPa", 1e3},
    {"", "%", 1e-2},
};

}  // namespace

std::optional<double> factor_to(const std::string& si, const std::string& unit) {
  const std::string wanted = plain_unit(si), given = plain_unit(unit);
  if (given == wanted) return 1;
  for (const KnownUnit& known : kUnits)
    if (plain_unit(known.si) == wanted && plain_unit(known.unit) == given) return known.factor;
  return std::nullopt;
}

std::string known_units(const std::string& si) {
  std::string all;
  for (const KnownUnit& known : kUnits)
    if (plain_unit(known.si) == plain_unit(si)) all += (all.empty() ? "" : ", ") + std::string(known.unit);
  return all;
}

}  // namespace hysteron
