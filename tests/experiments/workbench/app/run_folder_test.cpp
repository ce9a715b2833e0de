// What a run does to its folder: it is alone there, takes away only what runs have left, and stays inside.
#include "experiments/workbench/app/run_folder.h"

#include <fstream>

#include "tests/experiments/folder.h"

namespace hysteron::experiments {
namespace {
using test::refusal;

void write(const fs::path& file, const std::string& text = "mine") { std::ofstream(file) << text; }

std::string refused_run(const fs::path& out, const CommandLine& line = drape_line()) {
  return refusal([&] { ExperimentRun(line, setup_in(out)); });
}

// A run that has written this file and come to its end.
void earlier_run(const fs::path& out, const std::string& file) {
  ExperimentRun run(drape_line(), setup_in(out));
  write(run.path(file));
  run.finish();
}

// In a child that ends as by `kill -9` at the end of `body`.
template <class Body>
void killed(Body body) {
  const pid_t child = fork();
  if (child == 0) {
    body();
    raise(SIGKILL);
  }
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
}

class RunFolder : public testing::Test {
 protected:
  const Folder folder_;
  const fs::path out_ = folder_.path();
};

TEST_F(RunFolder, HoldsOneRunAtATime) {
  {
    ExperimentRun first(drape_line(), setup_in(out_));
    EXPECT_EQ(refused_run(out_),
              out_.string() + " is in use by another run: wait for its end, or give another folder (--out)");
    EXPECT_EQ(refused_run(out_ / "errors" / "step"), "(accepted)");  // a run of the run's own
    first.finish();
  }
  EXPECT_EQ(refused_run(out_), "(accepted)");
}

TEST_F(RunFolder, IsFreeAgainWhenItsRunIsKilled) {
  killed([&] { new ExperimentRun(drape_line(), setup_in(out_)); });
  EXPECT_EQ(refused_run(out_), "(accepted)");
}

TEST_F(RunFolder, LosesWhatAKilledRunHasLeftAndNothingElse) {
  const std::vector<std::string> left = {
      "frames/0000.png",  "frames/0001.png",          "mesh/0000.obj", "mesh/0001.obj", "table.csv",
      "metrics.csv.part", "frames/0002.png.part-71-3"};
  const std::vector<std::string> others = {"notes.csv.part",  "frames/0000.txt", "0001.png",
                                           "frames/0004.png", "mesh/12345.obj",  "frames/9999.png.part",
                                           "mesh/cloth.obj"};
  killed([&] {
    auto* run = new ExperimentRun(drape_line(), setup_in(out_));
    for (const char* name :
         {"metrics.csv", "table.csv", "frames/0000.png", "frames/0001.png", "mesh/0000.obj"})
      run->path(name);
    for (const std::string& name : left) write(out_ / name);
  });
  for (const std::string& name : others) write(out_ / name);
  ExperimentRun run(drape_line(), setup_in(out_));
  for (const std::string& name : left) EXPECT_FALSE(fs::exists(out_ / name)) << name;
  for (const std::string& name : others) EXPECT_EQ(file_content(out_ / name), "mine") << name;
}

TEST_F(RunFolder, LosesFilesAndFoldersOfAnEarlierRunAndNoOthers) {
  earlier_run(out_, "frames/0000.png");
  write(out_ / "mine.txt");
  ExperimentRun run(drape_line(), setup_in(out_));
  EXPECT_FALSE(fs::exists(out_ / "frames"));
  EXPECT_TRUE(fs::exists(out_ / "mine.txt"));
}

TEST_F(RunFolder, KeepsAFileThatNoRunHasWritten) {
  const fs::path file = out_ / "README.md";
  write(file);
  ExperimentRun run(drape_line(), setup_in(out_));
  EXPECT_EQ(refusal([&] { run.path("README.md"); }),
            file.string() + " is not of an earlier run and is not replaced: give another folder (--out)");
  EXPECT_EQ(file_content(file), "mine");
}

TEST_F(RunFolder, IsRefusedAtTheStartWhereAPageThatNoRunHasWrittenStands) {
  const fs::path page = out_ / "report.html";
  write(page);
  EXPECT_EQ(refused_run(out_),
            page.string() + " is not of an earlier run and is not replaced: give another folder (--out)");
  EXPECT_EQ(file_content(page), "mine");
  EXPECT_FALSE(fs::exists(out_ / "manifest.json"));
}

TEST_F(RunFolder, IsReservedBeforeFilesAreWritten) {
  for (const char* name : {"table.csv", "plot_drape.svg", "frames/0007.png", "mesh"}) {
    const Folder folder;
    fs::create_directories((folder.path() / name).parent_path());
    write(folder.path() / name);
    const ExperimentRun run(drape_line(), setup_in(folder.path()));
    const std::string message = refusal([&] {
      run.reserve({"table.csv", "plot_drape", "frames/0000.png", "mesh/0000.ply"});
    });
    EXPECT_TRUE(says(message, folder.path() / name));
    EXPECT_EQ(refusal([&] { run.reserve({"sheet.png", "plot_tip", "frames/0000.ply"}); }), "(accepted)");
    EXPECT_EQ(file_content(folder.path() / name), "mine");
  }
}

TEST_F(RunFolder, KeepsAManifestThatIsNoRuns) {
  for (const char* text : {R"({"name": "a web page"})", "[]", "no JSON"}) {
    const Folder folder;
    const fs::path manifest = folder.path() / "manifest.json";
    write(manifest, text);
    EXPECT_TRUE(says(refused_run(folder.path()), "manifest.json is not of a run"));
    EXPECT_EQ(file_content(manifest), text);
  }
}

TEST_F(RunFolder, IsNotLeftThroughALink) {
  const Folder outside;
  write(outside.path() / "0000.png");
  earlier_run(out_, "frames/0000.png");
  fs::remove_all(out_ / "frames");
  fs::create_directory_symlink(outside.path(), out_ / "frames");
  ExperimentRun run(drape_line(), setup_in(out_));
  EXPECT_EQ(file_content(outside.path() / "0000.png"), "mine");
  EXPECT_TRUE(says(refusal([&] { run.path("frames/0000.png"); }), "would be written outside"));
  EXPECT_TRUE(says(refusal([&] { run.path("../0000.png"); }), "would be written outside"));
}

TEST_F(RunFolder, IsNotWhereTheRunReads) {
  const fs::path loops = out_ / "loops.csv";
  earlier_run(out_, "loops.csv");
  const CommandLine fit = {"fit", "hysteron fit", {{"loop", loops.string()}}, {}},
                    render = {"render", "hysteron render", {}, {out_.string()}};
  EXPECT_EQ(refused_run(out_, fit), "--loop " + loops.string() + " is of the run in " + out_.string() +
                                        ", which this one would replace: give another folder (--out)");
  EXPECT_TRUE(says(refused_run(out_, render), "is of the run in"));
  EXPECT_EQ(file_content(loops), "mine");
}

}  // namespace
}  // namespace hysteron::experiments
