// Converts units that textile laboratories print into this program's own.
#pragma once

#include <optional>
#include <string>

namespace hysteron {

// Returns how many of the unit `si` ("N m", "1/m", "kg/m^2", ... as keys of scenes have it) make one `unit`,
// whatever signs either is written with (plain_unit()): 9.80665e-5 for "gf cm^2/cm" in "N m", 1 for the same
// unit, nothing for a unit that is unknown or of another quantity. 1 gf = 9.80665e-3 N by definition; an
// angle in degrees is taken in radians.
std::optional<double> factor_to(const std::string& si, const std::string& unit);

// Lists the units that are known for the quantity, as messages do: "gf cm^2/cm, mN m, ...".
std::string known_units(const std::string& si);

}  // namespace hysteron
