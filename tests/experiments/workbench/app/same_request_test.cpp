// A result is taken again only for the same request: scene, options, flags, every file that was read,
// program.
#include "experiments/workbench/app/same_request.h"

#include <algorithm>
#include <array>

#include "sim/base/atomic_file.h"
#include "sim/base/csv.h"
#include "sim/base/job.h"
#include "sim/base/whole_file.h"
#include "tests/experiments/program.h"

namespace hysteron::experiments {
namespace {

// A strip that is held at one end: its free end falls, further where the metric's point is farther out.
constexpr const char* kHeldStrip =
    "triangles = 40\nstep = 0.01\nseconds = 0.05\nno-images = true\ndevice = \"cpu\"\n"
    "[[pin]]\nlow = [-1, -1, -1]\nhigh = [0.011, 1, 1]\n"
    "[[metric]]\nname = \"tip\"\nkind = \"height\"\npoint = [0.1, 0.025, 0]\n";
constexpr const char* kShape = "[cloth]\nlength = 0.1\n";

// 4 by 1 squares of 25 mm, lifted by `height` [m].
std::string strip_obj(double height) {
  std::string text;
  for (int i = 0; i <= 4; ++i)
    for (int j = 0; j <= 1; ++j)
      text += "v " + std::to_string(0.025 * i) + " " + std::to_string(0.025 * j) + " " +
              std::to_string(height) + "\n";
  for (int i = 0; i < 4; ++i) {
    const int a = 2 * i + 1;
    text += "f " + std::to_string(a) + " " + std::to_string(a + 2) + " " + std::to_string(a + 3) + "\n";
    text += "f " + std::to_string(a) + " " + std::to_string(a + 3) + " " + std::to_string(a + 1) + "\n";
  }
  return text;
}

std::string fabric_text(const std::string& density) {
  std::string text = "name = \"mine\"\ndescription = \"of a test\"\n[parameters]\n";
  const std::vector<std::array<std::string, 3>> numbers = {{"b1", "4e-5", "N m"},
                                                           {"b2", "3e-5", "N m"},
                                                           {"k0", "40", "1/m"},
                                                           {"density", density, "kg/m^2"},
                                                           {"thickness", "4e-4", "m"}};
  for (const auto& [name, value, unit] : numbers)
    text += name + " = {value = " + value + ", unit = \"" + unit +
            "\", source = \"given\", confidence = \"given\"}\n";
  return text;
}

class SameRequest : public testing::Test {
 protected:
  void write(const std::string& name, const std::string& text) const { write_text(root_ / name, text); }
  std::string at(const std::string& name) const { return (root_ / name).string(); }
  Outcome run(const std::string& more = "") const {
    return finished("run " + at("scene.toml") + " --resume --threads 1 " + more + out_flag(out_));
  }
  std::string said(const std::string& more = "") const { return without_warnings(run(more).err); }
  double tip() const { return metrics_of(out_)["tip_m"]; }
  std::string again(const std::string& why) const {
    return out_.string() + " is complete, but " + why + ": from the start\n";
  }
  bool is_repeated_since(const std::string& why, const std::string& more) const {
    return run(more).err.starts_with(again(why));
  }
  std::string complete() const { return out_.string() + " is complete\n"; }

  const Folder folder_;
  const fs::path root_ = folder_.path(), out_ = root_ / "out";
};

TEST_F(SameRequest, IsNotThatOfAMeshThatHasChanged) {
  write("scene.toml", std::string(kHeldStrip).substr(std::string("triangles = 40\n").size()));
  write("c.obj", strip_obj(0));
  const std::string mesh = "--cloth.shape file --cloth.file " + at("c.obj");
  run(mesh);
  const double before = tip();
  EXPECT_EQ(said(mesh), complete());
  write("c.obj", strip_obj(0.5));
  EXPECT_TRUE(is_repeated_since(at("c.obj") + " has changed", mesh));
  constexpr double kLifted = 0.5;  // [m], and nothing else differs: forces do not depend on the place
  EXPECT_NEAR(tip() - before, kLifted, 1e-9);
}

TEST_F(SameRequest, IsNotThatOfAnotherMetric) {
  write("scene.toml", std::string(kHeldStrip) + kShape);
  run();
  const double before = tip();
  std::string text = std::string(kHeldStrip) + kShape;
  text.replace(text.find("0.1, 0.025"), 3, "0.05");
  write("scene.toml", text);
  EXPECT_TRUE(
      is_repeated_since("it has other values of metric.0.point.0, " + at("scene.toml") + " has changed", ""));
  EXPECT_GT(tip(), before);  // nearer to the pin
}

TEST_F(SameRequest, IsNotThatOfARunThatWasAskedForLess) {
  write("scene.toml", std::string(kHeldStrip) + kShape);
  run();
  const std::string manifest = file_content(out_ / "manifest.json");
  EXPECT_EQ(said("--quiet=false --json=false --threads 2"), complete());
  EXPECT_EQ(file_content(out_ / "manifest.json"), manifest);
  EXPECT_TRUE(is_repeated_since("it has other values of probe", "--probe 0.05,0.02"));
  EXPECT_TRUE(fs::exists(out_ / "probes.csv"));
  EXPECT_TRUE(is_repeated_since("it has other values of fps, probe", "--fps 50"));
  EXPECT_FALSE(fs::exists(out_ / "probes.csv"));
  EXPECT_TRUE(is_repeated_since("it has other values of fps, export", "--export ply"));
  EXPECT_TRUE(fs::exists(out_ / "mesh" / "0000.ply"));
}

TEST_F(SameRequest, IsNotThatOfARunWithoutErrors) {
  write("scene.toml", std::string(kHeldStrip) + kShape);
  run();
  EXPECT_TRUE(is_repeated_since("it has other values of --errors", "--errors"));
  EXPECT_TRUE(metrics_of(out_).contains("tip_m_step_error"));
  EXPECT_EQ(said("--errors"), complete());
}

TEST_F(SameRequest, IsNotThatOfAnotherBuildOfTheProgram) {
  write("scene.toml", std::string(kHeldStrip) + kShape);
  run();
  Json manifest = manifest_in(out_);
  manifest["hysteron"]["build"] = "another";
  write_text(out_ / "manifest.json", manifest.dump());
  EXPECT_TRUE(says(run().err, "is complete, but its program is another build of "));
  EXPECT_NE(manifest_in(out_)["hysteron"]["build"], "another");
}

// The files stand in the manifest as they are named from here; shipped ones as assets/...
TEST_F(SameRequest, StandsInTheManifestWithEveryFileThatWasRead) {
  write("scene.toml", std::string("fabric = \"wool-tropical\"\n") + kHeldStrip + kShape);
  write("camera.json", "{\"camera\": {\"fov\": 30}}");
  run("--camera " + at("camera.json"));
  std::vector<std::string> names;
  const Json manifest = manifest_in(out_);
  for (const auto& [name, hash] : manifest["inputs"].items()) names.push_back(name);
  std::sort(names.begin(), names.end());
  // cotton-broad is the fabric of a scene before its file says otherwise.
  std::vector<std::string> expected = {"assets/fabrics/cotton-broad.toml",
                                       "assets/fabrics/wool-tropical.toml", at("camera.json"),
                                       at("scene.toml")};
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(names, expected);
}

TEST_F(SameRequest, NamesTheFilesThatHaveChangedOrAreGone) {
  write("a", "1");
  write("b", "2");
  const Job job;
  whole_file(root_ / "a", "");
  whole_file(root_ / "b", "");
  const std::vector<InputRecord> then = inputs_of_job(out_);
  EXPECT_EQ(input_changes(then), std::vector<std::string>());
  write("a", "3");
  fs::remove(root_ / "b");
  EXPECT_EQ(input_changes(then), (std::vector{at("a") + " has changed", at("b") + " is not there any more"}));
  // The content that was read for the request counts; the same bytes by another name are the same file.
  const std::string hash_of_a = then[0].hash;
  EXPECT_EQ(input_changes({then[0]}, {{"elsewhere/a", hash_of_a}}), std::vector<std::string>());
  EXPECT_EQ(input_changes({then[0]}, {then[0], {"c", "5"}}), std::vector{std::string("c was not read")});
}

class StaleColumns : public SameRequest {
 protected:
  StaleColumns() {
    write("scene.toml", std::string("fabric.name = \"wool-tropical\"\n") + kHeldStrip + kShape);
    write("mine.toml", fabric_text("0.12"));
    write("study.toml",
          "experiment = \"run\"\n[scene]\nscene = \"scene.toml\"\nno-images = true\n"
          "[[axis]]\nkey = \"fabric\"\nvalues = [\"mine.toml\", \"wool-tropical\"]\n");
  }
  Outcome sweep(int exit_code, const std::string& more = "") const {
    return ended(exit_code, "sweep " + at("study.toml") + " --no-images --jobs 1 " + more + out_flag(out_));
  }
  std::string tip_of(const std::string& run) const {
    return read_table(out_ / "table.csv").where("run", run).word(0, "tip_m");
  }
};

TEST_F(StaleColumns, OfAStudyAreRunAgainAndNotCollected) {
  sweep(0);
  const std::string before = tip_of("fabric=mine"), other = tip_of("fabric=wool-tropical");
  sweep(0, "--collect");
  EXPECT_EQ(tip_of("fabric=mine"), before);
  write("mine.toml", fabric_text("0.5"));
  const Outcome collected = sweep(3, "--collect");
  const std::string why = at("mine.toml") + " has changed";
  EXPECT_TRUE(says(collected.err, "1 of 2 runs are not complete")) << collected.err;
  EXPECT_TRUE(says(collected.err, "not run: " + why)) << collected.err;
  EXPECT_EQ(tip_of("fabric=mine"), "");
  EXPECT_EQ(tip_of("fabric=wool-tropical"), other);
  EXPECT_TRUE(says(sweep(0, "--resume").err, "fabric=mine: done again: " + why));
  EXPECT_NE(tip_of("fabric=mine"), before);
  EXPECT_EQ(manifest_in(out_)["metrics"]["kept_count"], 1);
  EXPECT_EQ(tip_of("fabric=wool-tropical"), other);
  sweep(0, "--collect");
}

TEST_F(StaleColumns, OfAStudyWhoseSceneHasChangedAreAllRunAgain) {
  sweep(0);
  write("scene.toml",
        std::string("fabric.name = \"wool-tropical\"\ngravity = [0, 0, -1]\n") + kHeldStrip + kShape);
  sweep(3, "--collect");
  sweep(0, "--resume");
  EXPECT_EQ(manifest_in(out_)["metrics"]["kept_count"], 0);
}

TEST_F(StaleColumns, OfAComparisonAreRunAgain) {
  const std::string line = "compare " + at("scene.toml") +
                           " --no-images --threads 1 --compare.match fabric --fabrics " + at("mine.toml") +
                           ",wool-tropical" + out_flag(out_);
  finished(line);
  const double before = metrics_of(out_)["mine.tip_m"];
  write("mine.toml", fabric_text("0.5"));
  const Outcome again = finished(line + " --resume");
  EXPECT_TRUE(says(again.err, "mine: done again: " + at("mine.toml") + " has changed")) << again.err;
  EXPECT_TRUE(says(again.err, "wool-tropical: kept"));
  EXPECT_NE(metrics_of(out_)["mine.tip_m"].get<double>(), before);
}

}  // namespace
}  // namespace hysteron::experiments
