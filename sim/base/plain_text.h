// The first step of reading any text that a user names: one encoding, one end of lines, one kind of space.
#pragma once

#include <string>
#include <string_view>

namespace hysteron {

// Returns the bytes as UTF-8: UTF-16, which its byte order mark tells, is converted; a byte order mark is
// left out.
std::string utf8_text(std::string bytes);

// Returns the same with lines that end in "\n", also those that ended in "\r" or "\r\n", and with plain
// spaces in place of no-break ones and the like.  Bytes that are not UTF-8 are taken as Latin-1, as older
// spreadsheets write it.
std::string plain_text(std::string bytes);

// Returns the text without blanks at either end.
std::string_view trimmed(std::string_view text);

// Returns a unit as this program writes it: "gf·cm/cm", "gf.cm/cm" and "gf*cm/cm" are "gf cm/cm", "m^-1" is
// "1/m", "J/m²" and "J/m^2" are "J/m2", "N·m/m" is "N"; "1" and "-" are "", as for numbers without a unit.
// Other units stay as they are.
std::string plain_unit(std::string_view unit);

}  // namespace hysteron
