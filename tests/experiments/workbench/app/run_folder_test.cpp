// What a run does to its folder: it is alone there, takes away only what runs have left, and stays inside.
#include "experiments/workbench/app/run_folder.h"

#include <sys/stat.h>

#include <fstream>

#include "sim/base/error.h"
#include "tests/experiments/folder.h"

namespace hysteron::experiments {
namespace {
using test::refusal;

void write(const fs::path& file, const std::string& text = "mine") { std::ofstream(file) << text; }

std::string refused_run(const fs::path& out, const CommandLine& line = drape_line()) {
  return refusal([&] { ExperimentRun(line, setup_in(out)); });
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

TEST(RunFolder, HoldsOneRunAtATime) {
  const Folder folder;
  {
    ExperimentRun first(drape_line(), setup_in(folder.path()));
    EXPECT_EQ(refused_run(folder.path()),
              folder.path().string() +
                  " is in use by another run: wait for its end, or give another folder (--out)");
    EXPECT_EQ(refused_run(folder.path() / "errors" / "step"), "(accepted)");  // a run of the run's own
    first.finish();
  }
  EXPECT_EQ(refused_run(folder.path()), "(accepted)");
}

TEST(RunFolder, IsFreeAgainWhenItsRunIsKilled) {
  const Folder folder;
  killed([&] { new ExperimentRun(drape_line(), setup_in(folder.path())); });
  EXPECT_EQ(refused_run(folder.path()), "(accepted)");
}

TEST(RunFolder, LosesWhatAKilledRunHasLeftAndNothingElse) {
  const Folder folder;
  const fs::path out = folder.path();
  const std::vector<std::string> left = {
      "frames/0000.png",  "frames/0001.png",          "mesh/0000.obj", "mesh/0001.obj", "table.csv",
      "metrics.csv.part", "frames/0002.png.part-71-3"};
  const std::vector<std::string> others = {"notes.csv.part",  "frames/0000.txt", "0001.png",
                                           "frames/0004.png", "mesh/12345.obj",  "frames/9999.png.part",
                                           "mesh/cloth.obj"};
  killed([&] {
    auto* run = new ExperimentRun(drape_line(), setup_in(out));
    for (const char* name :
         {"metrics.csv", "table.csv", "frames/0000.png", "frames/0001.png", "mesh/0000.obj"})
      run->path(name);
    for (const std::string& name : left) write(out / name);
  });
  for (const std::string& name : others) write(out / name);
  ExperimentRun run(drape_line(), setup_in(out));
  for (const std::string& name : left) EXPECT_FALSE(fs::exists(out / name)) << name;
  for (const std::string& name : others) EXPECT_EQ(file_content(out / name), "mine") << name;
}

TEST(RunFolder, LeavesNoEmptyFoldersOfAnEarlierRun) {
  const Folder folder;
  {
    ExperimentRun run(drape_line(), setup_in(folder.path()));
    write(run.path("frames/0000.png"));
    run.finish();
  }
  ExperimentRun run(drape_line(), setup_in(folder.path()));
  EXPECT_FALSE(fs::exists(folder.path() / "frames"));
}

TEST(RunFolder, KeepsAFileThatNoRunHasWritten) {
  const Folder folder;
  const fs::path file = folder.path() / "README.md";
  write(file);
  ExperimentRun run(drape_line(), setup_in(folder.path()));
  EXPECT_EQ(refusal([&] { run.path("README.md"); }),
            file.string() + " is not of an earlier run and is not replaced: give another folder (--out)");
  EXPECT_EQ(file_content(file), "mine");
}

TEST(RunFolder, IsRefusedAtTheStartWhereAPageThatNoRunHasWrittenStands) {
  const Folder folder;
  const fs::path page = folder.path() / "report.html";
  write(page);
  EXPECT_EQ(refused_run(folder.path()),
            page.string() + " is not of an earlier run and is not replaced: give another folder (--out)");
  EXPECT_EQ(file_content(page), "mine");
  EXPECT_FALSE(fs::exists(folder.path() / "manifest.json"));
}

TEST(RunFolder, IsReservedBeforeFilesAreWritten) {
  for (const char* name : {"table.csv", "plot_drape.svg", "frames/0007.png", "mesh"}) {
    const Folder folder;
    fs::create_directories((folder.path() / name).parent_path());
    write(folder.path() / name);
    const ExperimentRun run(drape_line(), setup_in(folder.path()));
    const std::string message = refusal([&] {
      run.reserve({"table.csv", "plot_drape", "frames/0000.png", "mesh/0000.ply"});
    });
    EXPECT_TRUE(has(message, folder.path() / name));
    EXPECT_EQ(refusal([&] { run.reserve({"sheet.png", "plot_tip", "frames/0000.ply"}); }), "(accepted)");
    EXPECT_EQ(file_content(folder.path() / name), "mine");
  }
}

TEST(RunFolder, KeepsAManifestThatIsNoRuns) {
  for (const char* text : {R"({"name": "a web page"})", "[]", "no JSON"}) {
    const Folder folder;
    const fs::path manifest = folder.path() / "manifest.json";
    write(manifest, text);
    EXPECT_TRUE(has(refused_run(folder.path()), "manifest.json is not of a run"));
    EXPECT_EQ(file_content(manifest), text);
  }
}

TEST(RunFolder, IsNotLeftThroughALink) {
  const Folder folder, outside;
  write(outside.path() / "0000.png");
  {
    ExperimentRun first(drape_line(), setup_in(folder.path()));
    first.path("frames/0000.png");
    first.finish();
  }
  fs::remove(folder.path() / "frames");
  fs::create_directory_symlink(outside.path(), folder.path() / "frames");
  ExperimentRun run(drape_line(), setup_in(folder.path()));
  EXPECT_EQ(file_content(outside.path() / "0000.png"), "mine");
  EXPECT_TRUE(has(refusal([&] { run.path("frames/0000.png"); }), "would be written outside"));
  EXPECT_TRUE(has(refusal([&] { run.path("../0000.png"); }), "would be written outside"));
}

TEST(RunFolder, IsNotWhereTheRunReads) {
  const Folder folder;
  const fs::path loops = folder.path() / "loops.csv";
  {
    ExperimentRun first(drape_line(), setup_in(folder.path()));
    write(first.path("loops.csv"));
    first.finish();
  }
  const CommandLine fit = {"fit", "hysteron fit", {{"loop", loops.string()}}, {}},
                    render = {"render", "hysteron render", {}, {folder.path().string()}};
  EXPECT_EQ(refused_run(folder.path(), fit),
            "--loop " + loops.string() + " is of the run in " + folder.path().string() +
                ", which this one would replace: give another folder (--out)");
  EXPECT_TRUE(has(refused_run(folder.path(), render), "is of the run in"));
  EXPECT_EQ(file_content(loops), "mine");
}

}  // namespace
}  // namespace hysteron::experiments
