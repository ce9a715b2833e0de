// A run is alone in its folder, removes only what runs have left, and stays inside.
#include "experiments/workbench/app/run_folder.h"

#include <fstream>
#include <map>

#include "experiments/workbench/app/exit_status.h"
#include "experiments/workbench/app/set_aside.h"
#include "sim/base/error.h"
#include "sim/base/whole_file.h"
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

// Runs `body` in a child that ends as by `kill -9` at its end.
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

// Files later than its checkpoint are set aside without the first ones of its sequence, and are deleted in
// the end.
TEST_F(RunFolder, OfARunThatGoesOnHasNothingSetAsideInTheEnd) {
  killed([&] {
    auto* run = new ExperimentRun(drape_line(), setup_in(out_));
    for (const char* frame : {"frames/0000.png", "frames/0001.png", "frames/0002.png", "frames/0003.png"})
      write(run->path(frame));
  });
  SetAside aside(out_, Successor::run);
  aside.move({"frames/0000.png", "frames/0001.png"});
  ASSERT_TRUE(fs::exists(out_ / ".stopped" / "frames/0003.png"));
  write(out_ / "frames/0002.png", "new");
  aside.remove();
  EXPECT_FALSE(fs::exists(out_ / ".stopped"));
  EXPECT_EQ(file_content(out_ / "frames/0002.png"), "new");
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

TEST_F(RunFolder, KeepsAManifestThatIsDamagedAndSaysWhatHasHappenedToIt) {
  const std::pair<const char*, const char*> cases[] = {
      {"", "manifest.json is damaged: it is empty"},
      {R"({"hysteron": {"version": "0.1.0", "comm)", "manifest.json is damaged: it was cut off or edited"}};
  for (const auto& [text, message] : cases) {
    const Folder folder;
    const fs::path manifest = folder.path() / "manifest.json";
    write(manifest, text);
    EXPECT_TRUE(says(refused_run(folder.path()), message));
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

// The fixture has a complete run in a folder, and another one there that ends in different ways.
class SuccessorOfARun : public RunFolder {
 protected:
  SuccessorOfARun() {
    earlier_run(out_, "frames/0000.png");
    write(out_ / "report.html", "the earlier page");
    write(out_ / "notes.txt");
  }
  // Returns the content of every file below the folder, by its name.
  std::map<std::string, std::string> contents() const {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(out_))
      if (entry.is_regular_file()) files[fs::relative(entry.path(), out_)] = file_content(entry.path());
    return files;
  }
  // Its exit code; `end` may write and throw.
  int run(const std::function<void(ExperimentRun&)>& end) const {
    return run_guarded("drape",
                       [&] {
                         ExperimentRun run(drape_line(), setup_in(out_));
                         end(run);
                         return 0;
                       })
        .exit_code;
  }
};

TEST_F(SuccessorOfARun, ThatIsRefusedLeavesEveryByteAsItWas) {
  const auto before = contents();
  EXPECT_EQ(run([](ExperimentRun& run) {
              write(run.path("table.csv"), "new");
              write(run.path("frames/0000.png"), "new");
              run.path("mesh/0000.obj");
              throw Error::invalid_input("no");
            }),
            2);
  EXPECT_EQ(contents(), before);
  EXPECT_FALSE(fs::exists(out_ / "mesh"));
  EXPECT_FALSE(fs::exists(out_ / ".before"));
}

TEST_F(SuccessorOfARun, ThatFailsBeforeItsFirstResultLeavesEveryByteAsItWas) {
  const auto before = contents();
  EXPECT_EQ(run([](ExperimentRun& run) {
              run.path("table.csv");
              throw Error::system("no GPU");
            }),
            1);
  EXPECT_EQ(contents(), before);
}

TEST_F(SuccessorOfARun, ThatCannotGoOnKeepsItsFilesAndTheRunBeforeBesideThem) {
  const auto before = contents();
  const auto fail = [](ExperimentRun& run) {
    write(run.path("table.csv"), "new");
    throw Error::simulation("no feasible state");
  };
  for (int k = 0; k < 2; ++k) {  // the second one replaces the first, which was not complete
    EXPECT_EQ(run(fail), 3);
    EXPECT_EQ(manifest_in(out_)["complete"], false);
    EXPECT_EQ(file_content(out_ / "table.csv"), "new");
    for (const char* name : {"manifest.json", "report.html", "frames/0000.png"})
      EXPECT_EQ(file_content(out_ / ".before" / name), before.at(name)) << name;
    EXPECT_FALSE(fs::exists(out_ / ".stopped"));
  }
  const auto stopped = contents();
  EXPECT_EQ(run([](ExperimentRun&) { throw Error::invalid_input("no"); }), 2);
  EXPECT_EQ(contents(), stopped);
  EXPECT_EQ(run([](ExperimentRun& run) { run.finish(); }), 0);
  EXPECT_EQ(manifest_in(out_)["complete"], true);
  EXPECT_FALSE(fs::exists(out_ / ".before"));
  EXPECT_EQ(file_content(out_ / "notes.txt"), "mine");
}

TEST_F(SuccessorOfARun, ThatIsKilledLeavesTheRunBeforeBesideIt) {
  const std::string manifest = file_content(out_ / "manifest.json");
  killed([&] {
    auto* run = new ExperimentRun(drape_line(), setup_in(out_));
    write(run->path("table.csv"));
  });
  EXPECT_EQ(file_content(out_ / ".before" / "manifest.json"), manifest);
  EXPECT_EQ(run([](ExperimentRun& run) { run.finish(); }), 0);
  EXPECT_FALSE(fs::exists(out_ / ".before"));
  EXPECT_FALSE(fs::exists(out_ / "table.csv"));
}

TEST_F(SuccessorOfARun, MayNotReadWhatItReplaces) {
  const std::string frame = out_ / "frames/0000.png";
  const auto before = contents();
  const ExitStatus ending = run_guarded("drape", [&] {
    whole_file(frame, "");  // as a scene may name it
    ExperimentRun(drape_line(), setup_in(out_));
    return 0;
  });
  EXPECT_TRUE(says(ending.error, frame + " is of the run in " + out_.string())) << ending.error;
  EXPECT_EQ(contents(), before);
}

TEST_F(RunFolder, ThatWasNotThereIsNotThereAfterARefusal) {
  const fs::path out = out_ / "new" / "run";
  EXPECT_EQ(run_guarded("drape",
                        [&] {
                          ExperimentRun run(drape_line(), setup_in(out));
                          write(run.path("frames/0000.png"));
                          throw Error::invalid_input("no");
                          return 0;
                        })
                .exit_code,
            2);
  EXPECT_FALSE(fs::exists(out_ / "new"));
}

}  // namespace
}  // namespace hysteron::experiments
