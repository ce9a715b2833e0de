// An experiment is one file and one line: everything that names or runs experiments knows of it by itself.
#include <fstream>

#include "sim/base/csv.h"
#include "tests/experiments/program.h"

namespace hysteron::experiments {
namespace {

class OneMore : public testing::Test {
 protected:
  std::string in(const std::string& name) const { return (folder_.path() / name).string(); }
  // Returns the output of the program, which must succeed with these arguments.
  static std::string said(const std::string& arguments) { return finished(arguments).out; }

  Folder folder_;
  const std::string small_ = " --quiet --no-images --device cpu --threads 1 --out ";
};

TEST_F(OneMore, IsListedAndHelped) {
  EXPECT_TRUE(says(said("--help"), "a cloth that nothing moves"));
  EXPECT_TRUE(says(said("still --help"), "a cloth that nothing moves"));
  EXPECT_TRUE(says(refused("compare"), "drape, still, "));
}

TEST_F(OneMore, IsRunWithErrorsShownAndVerified) {
  const std::string words = said("still --errors" + small_ + in("still") + " --errors.draws 1");
  EXPECT_TRUE(says(words, "stillness"));
  const auto metrics = metrics_of(folder_.path() / "still");
  const double step = metrics["stillness_m"];
  EXPECT_GT(step, 0);
  EXPECT_DOUBLE_EQ(metrics["stillness_m_step_error"], step / 2);
  const std::string verdict = said("verify " + in("still") + " --out " + in("again"));
  EXPECT_TRUE(says(verdict, "4 of 4 runs repeated: 4 the same"));
  said("report " + folder_.path().string());
  const std::string page = file_content(folder_.path() / "index.html");
  EXPECT_TRUE(says(page, "cloth that nothing moves")) << "its question";
  EXPECT_TRUE(says(page, "stillness")) << "its headline";
}

TEST_F(OneMore, IsExplainedDumpedAndResumedWithoutALineOfItsOwn) {
  said("still" + small_ + in("still"));
  const Json first = manifest_in(folder_.path() / "still");
  EXPECT_TRUE(says(said("still --explain --device cpu"), first["triangles"].dump() + " triangles"));
  said("still --dump-scene " + in("still.toml"));
  said("still --scene " + in("still.toml") + small_ + in("dumped"));
  EXPECT_EQ(manifest_in(folder_.path() / "dumped")["state_hash"], first["state_hash"]);
  const Outcome again = finished("still --resume --no-images --device cpu --threads 1 --out " + in("still"));
  EXPECT_TRUE(says(again.err, in("still") + " is complete")) << again.err;
}

TEST_F(OneMore, IsComparedByItsName) {
  said("compare still --laws linear,prandtl" + small_ + in("laws"));
  EXPECT_EQ(read_table(folder_.path() / "laws" / "table.csv").numbers("stillness_m").size(), 2u);
}

TEST_F(OneMore, IsSweptWithItsHeadlines) {
  std::ofstream(in("study.toml")) << "experiment = \"still\"\n[scene]\nno-images = true\n"
                                     "[[axis]]\nkey = \"seed\"\nvalues = [1, 2]\n";
  said("sweep " + in("study.toml") + " --quiet --no-images --out " + in("sweep"));
  EXPECT_FALSE(read_table(folder_.path() / "sweep" / "means.csv").numbers("stillness_m_mean").empty());
}

}  // namespace
}  // namespace hysteron::experiments
