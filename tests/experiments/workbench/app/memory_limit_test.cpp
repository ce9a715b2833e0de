// --max-memory ends a run that asks for more.
#include "tests/experiments/program.h"

namespace hysteron::experiments {
namespace {

#ifndef __SANITIZE_ADDRESS__  // whose own memory counts, too
TEST(MaxMemory, EndsARunThatAsksForMoreInOneLine) {
  const Folder folder;
  const auto swing = [&](const std::string& megabytes) {
    return program(
        "swing --triangles 20000 --seconds 0.005 --no-images --device cpu --threads 1 --quiet --max-memory " +
        megabytes + out_flag(folder.path() / megabytes));
  };
  EXPECT_EQ(swing("1000").exit_code, 0);
  const Outcome outcome = swing("30");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(
      outcome.err,
      "hysteron swing: out of memory: use fewer triangles (--triangles), or allow more (--max-memory)\n");
  EXPECT_FALSE(fs::exists(folder.path() / "30/manifest.json"));
}
#endif

}  // namespace
}  // namespace hysteron::experiments
