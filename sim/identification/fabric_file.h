// Writes an identified fabric as a file.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sim/identification/identification.h"

namespace hysteron {

// The content of a fabric's file besides the fitted numbers.
struct FabricNotes {
  std::string name;  // name of the fabric
  std::string from;  // one line on the data from which it was identified
  // [kg/m^2], [m]; none: another fabric's, marked as assumed.
  std::optional<double> density, thickness;
};

// Returns a line for each number of the fabric's file that is another fabric's, because none was given.
std::vector<std::string> borrowed_warnings(const FabricNotes& notes);

// Returns a text of TOML, between quotation marks.
std::string quoted(const std::string& text);
// Returns a line of the table [parameters] with its line's end; a ratio has no unit.
std::string fabric_entry(const std::string& name, const std::string& unit, const Estimate& from);
// Returns a file for read_fabric() that ends in its table [parameters], with standard errors as `stderr`
// beside the values.
std::string fabric_text(const Identification& found, const FabricNotes& notes);

// Writes a file that read_fabric() and scenes accept: it is read back before it gets its name.  Throws
// Error::simulation where it would be refused, Error::system.
void write_fabric_text(const std::filesystem::path& file, const std::string& text);
void write_fabric(const std::filesystem::path& file, const Identification& found, const FabricNotes& notes);

}  // namespace hysteron
