// Whether a text has a part.
#pragma once

#include <gtest/gtest.h>

#include <string>

namespace hysteron::test {

// A failure shows both.
inline testing::AssertionResult has(const std::string& text, const std::string& part) {
  const bool found = text.find(part) != std::string::npos;
  return testing::AssertionResult(found) << '"' << part << (found ? "\" is in\n" : "\" is not in\n") << text;
}

}  // namespace hysteron::test
