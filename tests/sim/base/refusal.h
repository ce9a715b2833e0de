// What a call says that is refused as a wrong request.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "sim/base/error.h"

namespace hysteron::test {

// "(accepted)" if it is not refused.
template <class Body>
std::string refusal(const Body& body) {
  try {
    body();
  } catch (const Error& error) {
    EXPECT_EQ(error.exit_code(), 2) << error.what();
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << "the message must be one line";
    return error.what();
  }
  return "(accepted)";
}

}  // namespace hysteron::test
