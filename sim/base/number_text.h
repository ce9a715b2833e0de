// Texts of numbers.
#pragma once

#include <charconv>
#include <string>

namespace hysteron {

// The shortest that number_in() reads back as the same number: "0.1", "1e-300".
inline std::string number_text(double x) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, x).ptr};
}

}  // namespace hysteron
