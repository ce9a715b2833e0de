// What a run is expected to take, before it takes any.
#include "experiments/workbench/app/memory.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/experiments/folder.h"
#include "tests/experiments/program.h"
#include "tests/sim/base/refusal.h"

namespace hysteron::experiments {
namespace {

constexpr double kMegabyte = 1e6;

// Of resident memory [bytes].
double peak_of(const std::string& arguments) {
  const std::string line = "exec " HYSTERON_PROGRAM " " + arguments + " >/dev/null";
  const pid_t child = ::fork();
  if (child == 0) {
    ::execl("/bin/sh", "sh", "-c", line.c_str(), nullptr);
    ::_exit(1);
  }
  int status = 0;
  rusage usage{};
  ::wait4(child, &status, 0, &usage);
  EXPECT_EQ(status, 0) << arguments;
  return 1024. * static_cast<double>(usage.ru_maxrss);
}

double expected(const std::string& arguments) {
  const std::string out = program(arguments + " --explain").out, key = "about ";
  return kMegabyte * std::stod(out.substr(out.rfind(key) + key.size()));
}

#ifndef __SANITIZE_ADDRESS__  // which takes several times as much
TEST(Memory, ExpectedBeforehandIsOnceToTwiceWhatARunTakes) {
  constexpr double kFit = 2;
  for (const std::string scene : {"swing --triangles 20000 --seconds 0.02",
                                  "swing --triangles 20000 --seconds 0.02 --element hinge --law dahl",
                                  "crumple --triangles 4000 --seconds 0.004"}) {
    const Folder folder;
    const std::string run = scene + " --no-images --device cpu --threads 1";
    const double need = expected(run),
                 peak = peak_of(run + " --quiet --out " + (folder.path() / "out").string());
    EXPECT_GT(need, peak) << scene;
    EXPECT_LT(need, kFit * peak) << scene;
  }
}
#endif

TEST(Memory, GrowsWithTheTrianglesAndWhatTheLawRemembers) {
  experiments::Setup setup{default_scene(), {}};
  const MemoryNeed small = memory_need(setup, 1e5), large = memory_need(setup, 2e5);
  EXPECT_EQ(large.cloth, 2 * small.cloth);
  EXPECT_EQ(large.program, small.program);
  EXPECT_GT(large.pictures, small.pictures) << "the shapes that the contact sheet chooses from";
  setup.scene.law = "linear";
  EXPECT_EQ(memory_need(setup, 1e5).history, 0);
  EXPECT_GT(small.history, 0);
}

TEST(Memory, ThatIsTooMuchIsRefusedBeforeAnyIsTaken) {
  const Folder folder;
  const std::string out = (folder.path() / "out").string();
  const Outcome outcome =
      program("swing --triangles 300000 --no-images --max-memory 500 --device cpu --out " + out);
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.err,
            "hysteron swing: 300000 triangles would take about 1005 MB of memory, more than max-memory = 500 "
            "MB (--max-memory)\n");
  EXPECT_FALSE(std::filesystem::exists(out));
}

// The file is looked at before it is read.
TEST(Memory, OfAnObjIsWhatReadingItTakes) {
  const Folder folder;
  const std::string file = (folder.path() / "large.obj").string();
  std::ofstream(file) << "v 0 0 0\n";
  std::filesystem::resize_file(file, std::uintmax_t{1} << 30);
  const Outcome outcome = program("swing --cloth.shape file --cloth.file " + file +
                                  " --max-memory 1000 --no-images --out " + (folder.path() / "out").string());
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("reading " + file + " would take about 10769 MB"), std::string::npos)
      << outcome.err;
}

}  // namespace
}  // namespace hysteron::experiments
