// Runs that are ended at any moment and go on (--checkpoint, --resume): what they write in the end is what
// one that was left alone writes.
#include <chrono>
#include <csignal>
#include <fstream>
#include <map>
#include <random>
#include <thread>

#include "tests/experiments/program.h"

namespace hysteron::experiments {
namespace {

const std::string kResumedSwing = "swing --quick --no-images --threads 1 --device cpu --fps 240";
const std::string kResumedCrumple =
    "crumple --quick --no-images --threads 1 --device cpu --fps 240 --triangles 100 --seconds 0.3";

// The series of a run that has begun, which catches signals by then.
constexpr const char* kSeries = "metrics.csv.part";

// Waits until the file is there, for half a minute at most.
void wait_for(const fs::path& file) {
  for (int k = 0; k < 30000 && !fs::exists(file); ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

// Starts the program, which gets a signal after some milliseconds.  Its wait status.
int signalled(const std::string& arguments, int signal, int milliseconds, const fs::path& err) {
  const pid_t child = started(arguments + " >/dev/null 2>" + err.string());
  std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
  kill(child, signal);
  int status = 0;
  waitpid(child, &status, 0);
  return status;
}

// Starts the program, which is terminated as soon as it has written one more checkpoint.  Its exit code.
int after_a_checkpoint(const std::string& arguments, const fs::path& out, const fs::path& err = "/dev/null") {
  const fs::path file = out / "checkpoint";
  std::error_code none;
  const auto before = fs::last_write_time(file, none);
  const pid_t child = started(arguments + " >/dev/null 2>" + err.string());
  int status = 0;
  for (bool requested = false; waitpid(child, &status, WNOHANG) == 0;) {
    if (!requested && fs::exists(file, none) && fs::last_write_time(file, none) != before) {
      kill(child, SIGTERM);
      requested = true;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

// Returns all files but those that tell of wall clock, and of the command.  A PDF of cairo 1.18 tells, too,
// packed away.
std::map<std::string, std::string> results_in(const fs::path& out) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(out)) {
    const std::string name = fs::relative(entry.path(), out).string();
    if (entry.is_regular_file() && name != "manifest.json" && name != "report.html")
      files[name] = entry.path().extension() == ".pdf" ? "" : file_content(entry.path());
  }
  return files;
}

void expect_same_results(const fs::path& a, const fs::path& b) {
  const auto one = results_in(a), other = results_in(b);
  for (const auto& [name, text] : one) {
    ASSERT_TRUE(other.contains(name)) << name;
    EXPECT_TRUE(other.at(name) == text) << name;
  }
  for (const auto& [name, text] : other) EXPECT_TRUE(one.contains(name)) << name;
  const Json first = manifest_in(a), second = manifest_in(b);
  for (const char* key :
       {"state_hash", "metrics", "energy", "files", "steps", "series", "frames", "complete"})
    EXPECT_EQ(first.value(key, Json()), second.value(key, Json())) << key;
  EXPECT_EQ(first["complete"], true);
}

// Runs the program into this folder and returns the time that it took [ms].
int time_of_whole(const std::string& arguments, const fs::path& out) {
  const auto start = std::chrono::steady_clock::now();
  finished(arguments + out_flag(out));
  const auto taken = std::chrono::steady_clock::now() - start;
  return static_cast<int>(std::chrono::duration_cast<std::chrono::milliseconds>(taken).count());
}

// Kills the run again and again, each time within a sixth to a third of what the whole takes [ms], and lets
// it go on; how often it went on from a checkpoint.
std::size_t kill_often(const std::string& arguments, const fs::path& out, int kills, int whole) {
  std::mt19937 random(7);
  int status = -1;
  for (int k = 0; k < kills && status != 0; ++k) {
    status = signalled(arguments + " --resume" + out_flag(out), SIGKILL,
                       std::uniform_int_distribution(whole / 6, whole / 3)(random), out.string() + ".err");
    EXPECT_TRUE(WIFSIGNALED(status) || status == 0) << file_content(out.string() + ".err");
  }
  finished(arguments + " --resume" + out_flag(out));
  EXPECT_FALSE(fs::exists(out / "checkpoint"));
  return manifest_in(out).value("resumed_at_s", Json::array()).size();
}

// Every experiment with what it collects on the way, a swing's pictures and meshes among it, each with a
// checkpoint at every instant.
class ResumingEvery : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(
    Experiments, ResumingEvery,
    testing::Values("drape --triangles 150 --seconds 0.2 --fps 120 --no-images",
                    "crease --triangles 60 --crease.fold pleat --crease.recovery 0.1 --no-images",
                    "fold --triangles 60 --fold.cycles 2 --no-images --fps 7",
                    "buckle --triangles 60 --no-images",
                    "swing --seconds 0.2 --fps 60 --size 96x64 --look cloth,curvature --export obj"),
    [](const auto& line) { return std::string(line.param).substr(0, std::string(line.param).find(' ')); });

TEST_P(ResumingEvery, EndsInTheSameBits) {
  const Folder folder;
  const fs::path parts = folder.path() / "parts", said = folder.path() / "said";
  const std::string line = std::string(GetParam()) + " --quick --threads 1 --device cpu";
  const FinishedRun whole(line);
  for (int k = 0; k < 2; ++k)
    ASSERT_EQ(after_a_checkpoint(line + " --checkpoint 1e-6 --resume" + out_flag(parts), parts, said), 3);
  EXPECT_TRUE(says(file_content(said), "the same command with --resume goes on"));
  EXPECT_EQ(manifest_in(parts)["complete"], false);
  finished(line + " --resume" + out_flag(parts));
  EXPECT_EQ(manifest_in(parts)["resumed_at_s"].size(), 2u);
  expect_same_results(whole.out, parts);
}

// Both instants to compare with are over before the first checkpoint, and most cycles when the last one is
// written.
TEST(Resuming, KeepsWhatRequestedMetricsAndCyclesHaveFound) {
  const Folder folder;
  const fs::path parts = folder.path() / "parts";
  const std::string line =
      "run " +
      folder.write(
          "scene.toml",
          "triangles = 60\nstep = 0.01\ncycles = 20\n[cloth]\nlength = 0.2\n"
          "[[phase]]\nname = \"shake\"\nseconds = 0.02\nrepeat = true\n[[pin]]\nhigh = [0.2, 0, 0]\n"
          "keys = [{time = 0}, {time = 0.01, position = [0, 0, 0.004]}, {time = 0.02}]\n"
          "[[metric]]\nname = \"outline\"\nkind = \"silhouette\"\nfrom = 0\ndirection = [1, 0, 0.5]\n"
          "[[metric]]\nname = \"fallen\"\nkind = \"height\"\npoint = [0.2, 0.2, 0]\nfrom = 0\n") +
      " --no-images --threads 1 --device cpu --fps 100";
  const FinishedRun whole(line);
  EXPECT_GT(whole.metrics()["outline_cycle_20_percent"], 1);
  for (int k = 0; k < 2; ++k)
    ASSERT_EQ(after_a_checkpoint(line + " --checkpoint 1e-6 --resume" + out_flag(parts), parts), 3);
  finished(line + " --resume" + out_flag(parts));
  EXPECT_EQ(manifest_in(parts)["resumed_at_s"].size(), 2u);
  expect_same_results(whole.out, parts);
}

// Which leaves no time for last words, and half-written files.
TEST(Resuming, ASwingThatIsKilledEndsInTheSameBits) {
  const Folder folder;
  const int whole = time_of_whole(kResumedSwing + " --checkpoint 1e-6", folder.path() / "whole");
  std::size_t kills = 0;  // too few where the machine had other work while the whole run was timed
  for (int times = whole; kills <= 2 && times > 10; times /= 2) {
    fs::remove_all(folder.path() / "parts");
    kills = kill_often(kResumedSwing + " --checkpoint 1e-6", folder.path() / "parts", 10, times);
  }
  EXPECT_GT(kills, 2u);
  expect_same_results(folder.path() / "whole", folder.path() / "parts");
}

TEST(Resuming, AnAnimationIsThereWhenARunEndsEarlyAndWholeInTheEnd) {
  const Folder folder;
  const fs::path parts = folder.path() / "parts", file = parts / "mesh" / "cloth.pc2";
  const std::string line = kResumedSwing + " --export pc2";
  finished(line + out_flag(folder.path() / "whole"));
  ASSERT_EQ(after_a_checkpoint(line + " --checkpoint 1e-6" + out_flag(parts), parts), 3);
  ASSERT_TRUE(fs::exists(file));
  EXPECT_LT(fs::file_size(file), fs::file_size(folder.path() / "whole" / "mesh" / "cloth.pc2"));
  finished(line + " --resume" + out_flag(parts));
  expect_same_results(folder.path() / "whole", parts);
}

class ResumingAnimation : public testing::TestWithParam<std::pair<const char*, const char*>> {};
INSTANTIATE_TEST_SUITE_P(Formats, ResumingAnimation,
                         testing::Values(std::pair("usd", "cloth.usda"), std::pair("glb", "cloth.glb")),
                         [](const auto& format) { return std::string(format.param.first); });

TEST_P(ResumingAnimation, HasTheInstantsSoFarAndAllOfThemInTheEnd) {
  const Folder folder;
  const fs::path whole = folder.path() / "whole" / "mesh", parts = folder.path() / "parts";
  const std::string line = kResumedSwing + " --export " + GetParam().first;
  finished(line + out_flag(whole.parent_path()));
  EXPECT_TRUE(fs::exists(whole / GetParam().second));
  EXPECT_FALSE(fs::exists(whole / "cloth.pc2")) << "kept positions go";
  ASSERT_EQ(after_a_checkpoint(line + " --checkpoint 1e-6" + out_flag(parts), parts), 3);
  const fs::path file = parts / "mesh" / GetParam().second;
  ASSERT_TRUE(fs::exists(file));
  EXPECT_LT(fs::file_size(file), fs::file_size(whole / GetParam().second));
  EXPECT_TRUE(fs::exists(parts / "mesh" / "cloth.pc2"));
  finished(line + " --resume" + out_flag(parts));
  expect_same_results(folder.path() / "whole", parts);
}

TEST(Resuming, TwoSignalsAtOnceAreOneAndTwoApartEndTheProcess) {
  const Folder folder;
  const fs::path out = folder.path() / "out", err = folder.path() / "err";
  const std::string line = kResumedSwing + " --triangles 1000 --checkpoint 1000" + out_flag(out);
  const pid_t first = started(line + " >/dev/null 2>" + err.string());
  wait_for(out / kSeries);
  for (int k = 0; k < 2; ++k) kill(first, SIGTERM);
  int status = 0;
  waitpid(first, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 3) << status;
  EXPECT_TRUE(fs::exists(out / "checkpoint")) << file_content(err);
  EXPECT_EQ(manifest_in(out)["complete"], false);
  // The next instant is seconds away.
  const std::string slow =
      "run hanging-square --no-images --quiet --threads 1 --device cpu --triangles 6000 --step 1e-4 --fps 1";
  const pid_t child = started(slow + " --checkpoint 1000" + out_flag(folder.path() / "slow"));
  wait_for(folder.path() / "slow" / kSeries);
  std::this_thread::sleep_for(std::chrono::milliseconds(700));
  kill(child, SIGTERM);
  std::this_thread::sleep_for(std::chrono::milliseconds(700));
  EXPECT_EQ(waitpid(child, &status, WNOHANG), 0);
  kill(child, SIGTERM);
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGTERM) << status;
}

TEST(Resuming, ACompleteRunIsNotRepeatedAndOneWithoutCheckpointBeginsAnew) {
  const FinishedRun run(kResumedSwing + " --resume");
  EXPECT_TRUE(says(run.outcome.err, "no checkpoint in " + run.out.string() + ": from the start"));
  const std::string manifest = file_content(run.out / "manifest.json");
  const Outcome again = finished(kResumedSwing + " --resume --threads 2" + out_flag(run.out));
  EXPECT_TRUE(again.err.ends_with("\n" + run.out.string() + " is complete\n"));
  EXPECT_EQ(program(kResumedSwing + " --resume --json" + out_flag(run.out)).out, manifest);
  EXPECT_EQ(file_content(run.out / "manifest.json"), manifest);
  fs::remove(run.out / "turns.csv");
  EXPECT_TRUE(
      says(finished(kResumedSwing + " --resume" + out_flag(run.out)).err,
           run.out.string() + " is complete, but its turns.csv is not there any more: from the start"));
  EXPECT_TRUE(fs::exists(run.out / "turns.csv"));
  std::ofstream(run.out / "metrics.csv") << "time [s]\n";
  EXPECT_TRUE(says(finished(kResumedSwing + " --resume" + out_flag(run.out)).err,
                   " is complete, but its metrics.csv is not as it was written: from the start"));
  EXPECT_TRUE(says(finished(kResumedSwing + " --resume --law linear" + out_flag(run.out)).err,
                   run.out.string() + " is complete, but it has other values of law: from the start"));
  EXPECT_EQ(manifest_in(run.out)["law"], "linear");
}

// One folder has a checkpoint for all of them: a refusal changes nothing in it.
class RefusedCheckpoint : public testing::Test {
 protected:
  RefusedCheckpoint() {
    signalled(kLine + out_flag(out_), SIGTERM, 250, folder_.path() / "err");
    good_ = file_content(out_ / "checkpoint");
  }
  void expect_refusal(const std::string& why, const std::string& more = "") {
    EXPECT_TRUE(refused(kLine + more + " --resume" + out_flag(out_))
                    .ends_with("hysteron swing: cannot resume from " + (out_ / "checkpoint").string() + ": " +
                               why + "; without --resume the run begins anew\n"))
        << why;
  }
  void put(const std::string& text) const { std::ofstream(out_ / "checkpoint", std::ios::binary) << text; }

  const std::string kLine = kResumedSwing + " --triangles 1000 --checkpoint 1e-6";
  const Folder folder_;
  const fs::path out_ = folder_.path() / "out";
  std::string good_;
};

TEST_F(RefusedCheckpoint, NamesWhatIsWrong) {
  ASSERT_GT(good_.size(), 100000u) << file_content(folder_.path() / "err");
  expect_refusal("other values of fabric.density", " --fabric.density 0.2");
  expect_refusal("other values of fps", " --fps 60");
  put("");
  expect_refusal("it is cut off");
  for (const std::size_t size : {std::size_t{10}, std::size_t{25}, std::size_t{1000}, good_.size() - 1}) {
    put(good_.substr(0, size));
    expect_refusal("it is cut off");
  }
  put("time [s]\n" + good_);
  expect_refusal("it is no checkpoint");
  put(good_ + "x");
  expect_refusal("it is damaged");
  std::string flipped = good_;
  for (const std::size_t at : {std::size_t{50}, good_.size() / 2, good_.size() - 1}) {
    flipped[at] ^= 16;
    put(flipped);
    expect_refusal("it is damaged");
    flipped[at] ^= 16;
  }
  std::string future = good_;
  future[std::string("hysteron checkpoint ").size()] = '9';
  put(future);
  expect_refusal("it has the format of another version of hysteron");
  const std::string manifest = file_content(out_ / "manifest.json");
  put(good_);
  fs::remove(out_ / "manifest.json");
  expect_refusal("there is no manifest.json beside it");
  std::ofstream(out_ / "manifest.json") << manifest;
  std::ofstream(out_ / "checkpoint.part-1-0") << "half";  // a file half written beside it is not looked at
  finished(kLine + " --resume" + out_flag(out_));
  EXPECT_FALSE(fs::exists(out_ / "checkpoint.part-1-0"));
}

TEST(Checkpoints, AreRefusedWhereSeveralRunsAreAskedFor) {
  const Folder folder;
  EXPECT_EQ(
      refused(kResumedCrumple + " --law linear,prandtl --checkpoint 1" + out_flag(folder.path() / "out")),
      "hysteron crumple: --checkpoint is of single runs: name one law, fabric, integrator\n");
}

TEST(Resuming, OfSeveralLawsKeepsThoseThatAreFinished) {
  const Folder folder;
  const fs::path out = folder.path() / "out";
  const std::string line = "crumple --quick --triangles 60 --seconds 0.02 --no-images --law linear,prandtl";
  finished(line + out_flag(out));
  const auto written = [&](const char* law) { return fs::last_write_time(out / law / "manifest.json"); };
  const auto first = written("linear");
  const auto second = written("prandtl");
  fs::remove(out / "prandtl" / "outcome.json");  // as if it had been interrupted
  finished(line + " --resume" + out_flag(out));
  EXPECT_EQ(written("linear"), first);
  EXPECT_GT(written("prandtl"), second);
}

// A run that begins anew does not go on later from what another has left.
TEST(Resuming, ARunThatBeginsAnewRemovesTheCheckpoint) {
  const Folder folder;
  const fs::path out = folder.path() / "out";
  signalled(kResumedSwing + " --triangles 1000 --checkpoint 1e-6" + out_flag(out), SIGKILL, 250,
            folder.path() / "err");
  ASSERT_TRUE(fs::exists(out / "checkpoint"));
  finished(kResumedSwing + out_flag(out));
  EXPECT_FALSE(fs::exists(out / "checkpoint"));
}

}  // namespace
}  // namespace hysteron::experiments
