#include "sim/base/error.h"

#include <gtest/gtest.h>

namespace hysteron {
namespace {

TEST(Error, CarriesKeyValueAndExperimentBesideItsMessage) {
  const Error error = Error::invalid_input("k0 = -1 1/m must be >= 0")
                          .with_key("k0", "-1")
                          .with_experiment("law")
                          .with_origin("--k0");
  EXPECT_STREQ(error.what(), "law: k0 = -1 1/m must be >= 0 (--k0)");
  EXPECT_EQ(error.exit_code(), 2);
  EXPECT_EQ(error.key(), "k0");
  EXPECT_EQ(error.value(), "-1");
  EXPECT_EQ(error.experiment(), "law");
}

TEST(Error, OfNothingInParticularHasItsMessageAlone) {
  const Error error = Error::system("disk: full");
  EXPECT_STREQ(error.what(), "disk: full");
  EXPECT_EQ(error.key() + error.value() + error.experiment(), "");
}

TEST(Error, IsOneLineWhateverItQuotes) {
  EXPECT_STREQ(Error::invalid_input("law = a\r\n\tb must be c\n").with_experiment("swing").what(),
               "swing: law = a   b must be c");
}

}  // namespace
}  // namespace hysteron
