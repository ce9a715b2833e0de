// These functions return the message of a refused call, and check that a text has given parts.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "sim/base/error.h"

namespace hysteron::test {

inline constexpr const char* kAccepted = "(accepted)";

// Returns the message of a wrong request, or of another error with this exit code; kAccepted if it is not
// refused.
template <class Body>
std::string refusal(const Body& body, int exit_code = 2) {
  try {
    body();
  } catch (const Error& error) {
    EXPECT_EQ(error.exit_code(), exit_code) << error.what();
    return error.what();
  }
  return kAccepted;
}

// Checks that the text has all these parts; the failure shows it.
template <class... Parts>
::testing::AssertionResult says(const std::string& text, const Parts&... parts) {
  for (const std::string& part : {std::string(parts)...})
    if (text.find(part) == text.npos) return ::testing::AssertionFailure() << text << "\n  lacks " << part;
  return ::testing::AssertionSuccess() << text;
}

}  // namespace hysteron::test
