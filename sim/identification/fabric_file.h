// An identified fabric as a file.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sim/identification/identification.h"

namespace hysteron {

// What a fabric's file holds besides the fitted numbers.
struct FabricNotes {
  std::string name;                          // of the fabric
  std::string from;                          // one line: what it was identified from
  std::optional<double> density, thickness;  // [kg/m^2], [m]; none: another fabric's, marked as assumed
};

// A line for each number of the fabric's file that is another fabric's, because none was given.
std::vector<std::string> borrowed_warnings(const FabricNotes& notes);

// A text of TOML, between quotation marks.
std::string quoted(const std::string& text);
// A line of the table [parameters] with its line's end; a ratio has no unit.
std::string fabric_entry(const std::string& name, const std::string& unit, const Estimate& from);
// A file for read_fabric() that ends in its table [parameters]; standard errors as `stderr` beside the
// values.
std::string fabric_text(const Identification& found, const FabricNotes& notes);

// Writes what read_fabric() takes and scenes accept: it is read back before it gets its name.  Throws
// Error::simulation where it would be refused, Error::system.
void write_fabric_text(const std::filesystem::path& file, const std::string& text);
void write_fabric(const std::filesystem::path& file, const Identification& found, const FabricNotes& notes);

}  // namespace hysteron
