// Units that textile laboratories print, in this program's own.
#pragma once

#include <optional>
#include <string>

namespace hysteron {

// How many of the unit `si` ("N m", "1/m", "kg/m^2", ... as keys of scenes have it) one of `unit` is,
// whatever signs either is written with (plain_unit()): 9.80665e-5 of "gf cm^2/cm" for "N m". 1 of the same
// unit; nothing of a unit that is unknown or of another quantity. 1 gf = 9.80665e-3 N by definition; an angle
// in degrees is taken in radians.
std::optional<double> factor_to(const std::string& si, const std::string& unit);

// The units that are known for the quantity, as messages list them: "gf cm^2/cm, mN m, ...".
std::string known_units(const std::string& si);

}  // namespace hysteron
