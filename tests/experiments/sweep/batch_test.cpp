// Runs that share a process (--batch): each as by itself.
#include <sys/prctl.h>
#include <sys/wait.h>

#include <algorithm>
#include <csignal>
#include <sstream>
#include <thread>

#include "sim/base/atomic_file.h"
#include "sim/time/back_end.h"
#include "tests/experiments/program.h"
#include "tests/experiments/sweep/timeless.h"

namespace hysteron::experiments {
namespace {

constexpr const char* kSwing = "swing --quick --no-images --triangles 60 --seconds 0.05 --threads 1 --quiet";

// Once the file is there.
void terminate_after(pid_t child, const fs::path& file) {
  while (!fs::exists(file) && waitpid(child, nullptr, WNOHANG) == 0)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  kill(child, SIGTERM);
}

class SweepInABatch : public testing::Test {
 protected:
  void write(const std::string& scene, const std::string& axis) const {
    write_text(study_, "experiment = \"swing\"\n[scene]\nquick = true\ntriangles = 60\n" + scene +
                           "[[axis]]\nkey = \"law\"\nvalues = [\"linear\", \"prandtl\"]\n[[axis]]\n" + axis);
  }
  std::string line(const std::string& out, const std::string& options) const {
    return "sweep " + study_.string() + " --no-images --jobs 2" + out_flag(folder_.path() / out) + " " +
           options;
  }
  Outcome run(int exit_code, const std::string& out, const std::string& options) const {
    return ended(exit_code, line(out, options));
  }
  fs::path law_folder(const std::string& out, const std::string& law) const {
    return folder_.path() / out / "runs" / ("law=" + law + ",k0=40");
  }
  Table table(const std::string& out) const { return read_table(folder_.path() / out / "table.csv"); }
  void expect_same(const std::string& a, const std::string& b) const {
    experiments::expect_same(table(a), table(b));
  }

  Folder folder_;
  fs::path study_ = folder_.path() / "s.toml";
};

constexpr const char* kOnCpu = "no-images = true\ndevice = \"cpu\"\nseconds = 0.05\n";
constexpr const char* kThree = "key = \"fabric.k0\"\nvalues = [20, 40, 80]\n";

TEST_F(SweepInABatch, FindsTheTableOfRunsByThemselves) {
  write(kOnCpu, kThree);
  run(0, "alone", "");
  run(0, "together", "--batch 4");
  EXPECT_EQ(table("alone").rows.size(), 6u);
  expect_same("alone", "together");
  for (const char* file : {"metrics.csv", "turns.csv"})
    EXPECT_EQ(file_content(law_folder("alone", "prandtl") / file),
              file_content(law_folder("together", "prandtl") / file));
  run(0, "together", "--batch 4 --resume");
  EXPECT_EQ(metrics_of(folder_.path() / "together")["kept_count"], 6);
  expect_same("alone", "together");
}

// As the scene's file may have no-images in place of a flag.
TEST_F(SweepInABatch, AndAComparisonTakeFromTheSceneThatNothingIsDrawn) {
  const std::string scene = folder_.path() / "plain.toml", drawn = folder_.path() / "drawn.toml";
  const std::string keys = "triangles = 20\nstep = 0.01\nseconds = 0.02\ndevice = \"cpu\"\n";
  write_text(scene, "no-images = true\n" + keys);
  write_text(drawn, keys);
  const auto study = [&](const std::string& file) {
    write_text(study_, "experiment = \"run\"\n[scene]\nscene = \"" + file +
                           "\"\n[[axis]]\nkey = \"law\"\nvalues = [\"linear\", \"prandtl\"]\n");
  };
  study(scene);
  run(0, "sweep", "--batch 2");
  study(drawn);
  EXPECT_TRUE(says(run(2, "none", "--batch 2").err, "with no-images among their keys"));
  const std::string laws = " --laws linear,prandtl --quiet" + out_flag(folder_.path() / "page");
  finished("compare " + scene + laws + " --batch 2");
  EXPECT_EQ(manifest_in(folder_.path() / "page")["renderer"], nullptr);
  EXPECT_FALSE(fs::exists(folder_.path() / "page" / "sheet.png"));
}

// A rigidity above b1 is refused when a run sets up its scene.
TEST_F(SweepInABatch, MarksWhatFailsAsAloneAndEndsTheOthers) {
  write(kOnCpu, "key = \"fabric.b2\"\nvalues = [1e-6, 1.0, 2e-6]\n");
  run(3, "alone", "");
  run(3, "together", "--batch 6");
  expect_same("alone", "together");
  const Table found = table("together");
  const auto failed = std::count_if(found.rows.begin(), found.rows.end(), [](const auto& row) {
    return row.back().find("b2") != std::string::npos;
  });
  EXPECT_EQ(failed, 2);
}

TEST_F(SweepInABatch, GoesOnFromWhereItWasKilled) {
  ASSERT_EQ(prctl(PR_SET_CHILD_SUBREAPER, 1), 0);  // the batch outlives its study and comes to this process
  const std::string longer = "no-images = true\ndevice = \"cpu\"\nseconds = 0.5\nfps = 240\n";
  write(longer, kThree);
  run(0, "whole", "");
  write(longer + "checkpoint = 1e-6\n", kThree);
  terminate_after(started(line("parts", "--batch 3 2>/dev/null")),
                  law_folder("parts", "linear") / "checkpoint");
  while (wait(nullptr) > 0) {
  }
  EXPECT_FALSE(fs::exists(folder_.path() / "parts/table.csv"));
  run(0, "parts", "--batch 3 --resume");
  expect_same("whole", "parts");
  const Json resumed = manifest_in(law_folder("parts", "linear"));
  EXPECT_EQ(resumed.value("resumed_at_s", Json::array()).size(), 1u);
}

TEST_F(SweepInABatch, IsRefusedWhereRunsDraw) {
  write("seconds = 0.05\n", kThree);
  const Outcome outcome = run(2, "out", "--batch 4");
  EXPECT_EQ(
      outcome.err,
      "hysteron sweep: batch = 4 is of runs without pictures, with no-images among their keys (--batch)\n");
  EXPECT_FALSE(fs::exists(folder_.path() / "out"));
}

TEST_F(SweepInABatch, OnAGpuEveryRunHasTheBitsThatItHasAlone) {
  std::string reason;
  if (gpu_count(reason) == 0) GTEST_SKIP() << "no GPU: " << reason;
  write("no-images = true\ndevice = \"cuda\"\nseconds = 0.05\n",
        "key = \"fabric.b2\"\nvalues = [1e-6, 1.0, 2e-6]\n");
  run(3, "alone", "");
  run(3, "together", "--batch 6");
  const Table alone = table("alone"), together = table("together");
  const auto at = std::find(alone.head.begin(), alone.head.end(), "state_hash") - alone.head.begin();
  for (std::size_t r = 0; r < alone.rows.size(); ++r) {
    const auto c = static_cast<std::size_t>(at);
    EXPECT_EQ(alone.rows[r][c], together.rows[r][c]) << r;
    EXPECT_EQ(alone.rows[r].back(), together.rows[r].back()) << r;
  }
  const fs::path run = folder_.path() / "together/runs/law=prandtl,b2=1e-06";
  const Json manifest = manifest_in(run);
  EXPECT_EQ(manifest["batch"], 3) << "of six runs in two jobs";
  EXPECT_EQ(manifest["wall_seconds"].size(), 1u) << "stages are of all of them";
  EXPECT_FALSE(manifest.contains("device_per_step"));
}

// `hysteron batch`, as sweeps start it.
class Batch : public testing::Test {
 protected:
  void write(const std::vector<std::string>& lines) const {
    std::string text;
    for (const std::string& line : lines) {
      std::istringstream stream(line);
      std::vector<std::string> words;
      for (std::string word; stream >> word;) words.push_back(word);
      text += Json(words).dump() + "\n";
    }
    write_text(folder_.path() / "lines", text);
  }
  std::string swing(const std::string& name, const std::string& more = "") const {
    return std::string(kSwing) + " --device cpu" + out_flag(folder_.path() / name) + more;
  }
  // Returns the reports of the batch about its runs, by their number.
  static std::vector<Json> reports_in(const std::string& text, std::size_t runs) {
    std::vector<Json> reports(runs);
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
      const Json report = json_in(line, "stdout");
      reports.at(report.at("run")) = report;
    }
    return reports;
  }

  Folder folder_;
};

TEST_F(Batch, EndsEveryRunAsTheProgramWouldByItself) {
  write_text(folder_.path() / "file", "no folder");
  const std::vector<std::string> lines = {swing("a"), swing("b", " --fabric.b2 -1"), swing("c", " --flie x"),
                                          swing("file/d"), "swung"};
  write(lines);
  const Outcome outcome = finished("batch <" + (folder_.path() / "lines").string());
  const std::vector<Json> reports = reports_in(outcome.out, lines.size());
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const Outcome alone = program(lines[i]);
    EXPECT_EQ(reports[i]["exit_code"], alone.exit_code) << lines[i];
    if (alone.exit_code != 0) {
      EXPECT_EQ(reports[i]["error"].get<std::string>() + "\n", alone.err);
    }
  }
  EXPECT_EQ(reports[0]["exit_code"], 0);
  EXPECT_EQ(reports[1]["exit_code"], 2);
  EXPECT_EQ(reports[3]["exit_code"], 1);
}

TEST_F(Batch, ASignalEndsAllItsRunsAtCheckpointsOfTheirOwn) {
  const std::string slow = " --seconds 2 --fps 240 --checkpoint 1000";
  write({swing("a", slow), swing("b", slow), swing("c", slow)});
  const fs::path out = folder_.path() / "said";
  const pid_t child =
      started("batch <" + (folder_.path() / "lines").string() + " >" + out.string() + " 2>/dev/null");
  while (!fs::exists(folder_.path() / "a/metrics.csv.part"))
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  kill(child, SIGTERM);
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_EQ(WEXITSTATUS(status), 0);
  for (const Json& report : reports_in(file_content(out), 3)) {
    EXPECT_EQ(report["exit_code"], 3) << report;
    EXPECT_EQ(report["error"].get<std::string>().find("hysteron swing: SIGTERM at t = "), 0u) << report;
  }
  for (const char* name : {"a", "b", "c"})
    EXPECT_TRUE(fs::exists(folder_.path() / name / "checkpoint")) << name;
}

TEST_F(Batch, RefusesWhatIsNoListOfWords) {
  write_text(folder_.path() / "lines", "[\"swing\"]\n{}\n");
  EXPECT_EQ(refused("batch <" + (folder_.path() / "lines").string()),
            "hysteron batch: line 2 of stdin is no list of words\n");
}

}  // namespace
}  // namespace hysteron::experiments
