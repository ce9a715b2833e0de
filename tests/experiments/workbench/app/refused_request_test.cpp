// A request that is refused leaves the folder that it names as it was, whatever it asks for.
#include <fstream>
#include <map>

#include "render/image.h"
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

// A file of one's own is not replaced by one that a flag names; one that the program wrote before is.
TEST_F(RefusedRequest, ReplacesNoFileButTheProgramsOwn) {
  const std::string notes = "my notes\n";
  const std::string curvatures = file("K.csv", "curvature [1/m]\n0\n50\n0\n");
  const std::string picture = file("a.png", "");
  render::write_png(picture, render::Image(8, 8));
  const fs::path own = folder_.path() / "own", own_png = folder_.path() / "own.png";
  const auto expect_archived = [&](const std::string& line, const fs::path& target) {
    write_text(target, notes);
    EXPECT_TRUE(says(refused(line + target.string()), target.string() + " is a file that is there already"))
        << line;
    EXPECT_EQ(file_content(target), notes) << line;
    write_text(target, "");  // no one's
    finished(line + target.string());
    finished(line + target.string());
    fs::remove(target);
  };
  expect_archived("law --in " + curvatures + " --out ", own);
  expect_archived("drape --quick --triangles 40 --dump-scene ", own);
  expect_archived("diff " + picture + " " + picture + " --junit ", own);
  expect_archived("diff " + picture + " " + picture + " --out ", own_png);
  EXPECT_TRUE(says(refused("verify " + out_.string() + " --junit " + curvatures), "is not a JUnit file"));
  fs::create_directories(folder_.path() / "flow");
  write_text(folder_.path() / "flow" / "Snakefile", notes);
  EXPECT_TRUE(says(refused("rerun " + out_.string() + " --snakemake " + (folder_.path() / "flow").string()),
                   "Snakefile is a file that is there already"));
}

TEST_F(RefusedRequest, LeavesEveryByteOfTheRunThatWasThere) {
  expect_untouched("run " + file("bad.toml", kNoSuchElement));
  const std::string decay = file("decay.csv", "time [s],amplitude [mm]\n0,3\n1,2\n2,1.5\n");
  expect_untouched("fit --decay " + decay + " --decay.length 0.08 --fabric.density 0.1 --kes.b 1e-5");
  expect_untouched("fit --loop " + decay);
  expect_untouched("drape --quick --no-images --triangles 60 --probe 7,7");
  expect_untouched("law --in " + decay);
  expect_untouched("render " + folder_.path().string());
  expect_untouched("figures --fabric none-such");
  expect_untouched("validate --parts figure --recorded " + (folder_.path() / "none").string());
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

// A probe beside the cloth is found out when the cloth is there: the first column has run by then.
TEST_F(RefusedRequest, OfANewComparisonKeepsTheColumnsThatAreComplete) {
  const fs::path page = folder_.path() / "page";
  const std::string line =
      " --no-images --quiet --threads 1 --triangles 40 --seconds 0.02 --compare.jobs 1" + out_flag(page);
  refused("compare swing --laws linear,dahl+probe=7" + line);
  EXPECT_TRUE(manifest_in(page / "linear")["complete"].get<bool>());
  EXPECT_FALSE(fs::exists(page / "manifest.json"));
  EXPECT_TRUE(says(finished("compare swing --laws linear,dahl --resume" + line).out, "linear"));
}

TEST_F(RefusedRequest, OfATuningWritesNothing) {
  const fs::path page = folder_.path() / "page";
  refused(
      "compare swing --laws linear,linear+triangles=1 --compare.tune fabric.damping=1e-3:4e-3 "
      "--compare.tune-metric viscous_J --compare.match fabric --no-images --quiet --triangles 40 --seconds "
      "0.02" +
      out_flag(page));
  EXPECT_FALSE(fs::exists(page));
}

TEST_F(RefusedRequest, OfAReferenceThatIsNoRunIsFoundWithoutPicturesToo) {
  const std::string line =
      "swing --quick --triangles 40 --seconds 0.02 --no-images --look difference --reference ";
  EXPECT_TRUE(says(refused(line + (folder_.path() / "none").string() + out_flag(folder_.path() / "run")),
                   "must be the folder of a run with pictures and --export ply"));
  EXPECT_FALSE(fs::exists(folder_.path() / "run"));
}

TEST_F(RefusedRequest, OfAValidationWithoutMeasurementsIsFoundAtItsStart) {
  EXPECT_EQ(
      refused("validate --parts figure --recorded " + folder_.path().string() +
              out_flag(folder_.path() / "run")),
      "hysteron validate: recorded = " + folder_.path().string() +
          " has no fab-shirley/loops_L_D1.csv: the figure is drawn from a folder of all recorded results "
          "(--recorded)\n");
  EXPECT_FALSE(fs::exists(folder_.path() / "run"));
}

}  // namespace
}  // namespace hysteron::experiments
