// A request that is refused leaves the folder that it names as it was, whatever it asks for.
#include <fstream>
#include <map>

#include "sim/base/atomic_file.h"
#include "tests/experiments/program.h"

namespace hysteron::experiments {
namespace {

// A scene whose second metric lies on no element, which is found out when the cloth is there.
constexpr const char* kNoSuchElement =
    "triangles = 40\nstep = 0.01\nseconds = 0.02\nno-images = true\ndevice = \"cpu\"\n[cloth]\nlength = 0.1\n"
    "[[metric]]\nname = \"tip\"\nkind = \"height\"\npoint = [0.1, 0.1, 0]\n"
    "[[metric]]\nname = \"bend\"\nkind = \"angle\"\nlow = [5, -1, -1]\nhigh = [6, 1, 1]\n"
    "other-low = [-1, -1, -1]\nother-high = [1, 1, 1]\n";

class RefusedRequest : public testing::Test {
 protected:
  RefusedRequest() {
    finished("kes --no-images --law prandtl" + out_flag(out_));
    std::ofstream(out_ / "notes.txt") << "mine";
  }
  std::string file(const std::string& name, const std::string& text) const {
    write_text(folder_.path() / name, text);
    return folder_.path() / name;
  }
  std::map<std::string, std::string> contents() const {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(out_))
      files[fs::relative(entry.path(), out_)] =
          entry.is_regular_file() ? file_content(entry.path()) : "(a folder)";
    return files;
  }
  void expect_untouched(const std::string& line, int exit_code = 2) const {
    const auto before = contents();
    ended(exit_code, line + out_flag(out_));
    EXPECT_EQ(contents(), before) << line;
  }

  const Folder folder_;
  const fs::path out_ = folder_.path() / "out";
};

TEST_F(RefusedRequest, LeavesEveryByteOfTheRunThatWasThere) {
  expect_untouched("run " + file("bad.toml", kNoSuchElement));
  const std::string decay = file("decay.csv", "time [s],amplitude [mm]\n0,3\n1,2\n2,1.5\n");
  expect_untouched("fit --decay " + decay + " --decay.length 0.08 --fabric.density 0.1 --kes.b 1e-5");
  expect_untouched("fit --loop " + decay);
  expect_untouched("drape --quick --no-images --triangles 60 --probe 7,7");
  expect_untouched("law --in " + decay);
  expect_untouched("render " + folder_.path().string());
  expect_untouched("figures --fabric none-such");
  expect_untouched("validate --parts figure --recorded " + (folder_.path() / "none").string(), 1);
  expect_untouched("kes --law none-such");
  expect_untouched("sweep " +
                   file("study.toml",
                        "experiment = \"kes\"\n[scene]\nno-images = true\n[[axis]]\nkey = \"law\"\n"
                        "values = [\"none-such\"]\n"));
}

// The first column runs, the second one is refused.
TEST_F(RefusedRequest, OfAComparisonLeavesItsColumnsToo) {
  const std::string good = " --no-images --quiet --threads 1 --triangles 40 --seconds 0.02 --compare.jobs 1";
  finished("compare swing --laws linear,dahl" + good + out_flag(out_));
  const std::string second_is_wrong = "compare swing --laws linear,dahl+triangles=1";
  expect_untouched(second_is_wrong + good);
  const fs::path nowhere = folder_.path() / "nowhere";
  refused(second_is_wrong + good + out_flag(nowhere));
  EXPECT_FALSE(fs::exists(nowhere));
}

}  // namespace
}  // namespace hysteron::experiments
