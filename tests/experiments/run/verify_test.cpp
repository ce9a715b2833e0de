#include <nlohmann/json.hpp>

#include "tests/experiments/program.h"

namespace hysteron::experiments {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

// A run in a folder of its own.
class Recorded : public testing::Test {
 protected:
  void record(const std::string& arguments) {
    const Outcome outcome = program(arguments + " --quiet --threads 1 --device cpu --out " + run().string());
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  }
  fs::path run() const { return folder_.path() / "runs" / "one"; }
  fs::path manifest() const { return run() / "manifest.json"; }
  std::string in(const std::string& name) const { return (folder_.path() / name).string(); }
  static Json json_in(const fs::path& folder) { return Json::parse(text_of(folder / "manifest.json")); }
  void edit(const std::function<void(Json&)>& change) {
    Json json = json_in(run());
    change(json);
    std::ofstream(manifest()) << json.dump(2);
  }

  Folder folder_;
};

const std::string kCrease = "crease --crease.fold pleat --crease.recovery 0.02 --triangles 60 --no-images";
const std::string kDrape = "drape --quick --triangles 120 --seconds 0.1 --no-images";

// A crease changes the scene that it is asked for: number of triangles, hands, plate.
TEST_F(Recorded, RunIsRepeatedToTheBit) {
  for (const std::string& command : {kDrape, kCrease, std::string("swing --quick --no-images")}) {
    record(command);
    const Outcome outcome = program("rerun " + run().string() + " --quiet --out " + in("again"));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const Json before = json_in(run()), again = json_in(in("again"));
    EXPECT_EQ(before["state_hash"], again["state_hash"]) << command;
    EXPECT_EQ(before["scene"], again["scene"]) << command;
    EXPECT_EQ(before["options"], again["options"]) << command;
  }
}

TEST_F(Recorded, SceneNeedsItsFileNoMore) {
  std::ofstream(in("mine.toml"))
      << "triangles = 64\nseconds = 0.05\n[[metric]]\nname = \"edge\"\nto = [0.5, 0, 0]\n";
  record("run " + in("mine.toml") + " --no-images");
  fs::remove(in("mine.toml"));
  ASSERT_EQ(program("rerun " + manifest().string() + " --quiet --out " + in("again")).exit_code, 0);
  EXPECT_EQ(json_in(run())["state_hash"], json_in(in("again"))["state_hash"]);
  EXPECT_EQ(json_in(run())["metrics"]["edge_m"], json_in(in("again"))["metrics"]["edge_m"]);
}

TEST_F(Recorded, ManifestIsASceneOfItsExperiment) {
  record(kDrape);
  const std::string again =
      "drape --quiet --no-images --scene " + manifest().string() + " --out " + in("again");
  ASSERT_EQ(program(again).exit_code, 0);
  EXPECT_EQ(json_in(run())["state_hash"], json_in(in("again"))["state_hash"]);
}

// Without what it was asked for, as older programs left it, the keys that were given are known.
TEST_F(Recorded, ManifestOfAnOlderProgramIsRepeatedByItsCommand) {
  record(kCrease);
  edit([](Json& json) { json.erase("options"), json.erase("asked"); });
  ASSERT_EQ(program("rerun " + run().string() + " --quiet --out " + in("again")).exit_code, 0);
  EXPECT_EQ(json_in(run())["state_hash"], json_in(in("again"))["state_hash"]);
}

TEST_F(Recorded, SceneIsDumpedAsAFileOfTheSameRun) {
  record(kCrease);
  const std::string dump =
      kCrease + " --threads 1 --device cpu --dump-scene " + in("dump.toml") + " --out " + in("none");
  ASSERT_EQ(program(dump).exit_code, 0);
  EXPECT_FALSE(fs::exists(in("none")));
  const std::string again = "crease --quiet --scene " + in("dump.toml") + " --out " + in("again");
  const Outcome outcome = program(again);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(json_in(run())["state_hash"], json_in(in("again"))["state_hash"]);
}

TEST_F(Recorded, RunIsVerified) {
  record(kDrape);
  const std::string verify = "verify " + in("runs") + " --out " + in("check");
  const Outcome same = program(verify);
  EXPECT_EQ(same.exit_code, 0) << same.out << same.err;
  EXPECT_NE(same.out.find("same state"), std::string::npos) << same.out;

  edit([](Json& json) {
    json["metrics"]["drape_coefficient_percent"] =
        json["metrics"]["drape_coefficient_percent"].get<double>() + 1;
  });
  const Outcome beyond = program(verify);
  EXPECT_EQ(beyond.exit_code, 4);
  EXPECT_NE(beyond.out.find("beyond: drape_coefficient_percent"), std::string::npos) << beyond.out;

  edit([](Json& json) {
    json["metrics"]["drape_coefficient_percent_step_error"] = 2.0;
    json["state_hash"] = "0123456789abcdef";
    json["hysteron"]["commit"] = "0123456789";
    json["device"] = "cpu: another";
  });
  const Outcome within = program(verify);
  EXPECT_EQ(within.exit_code, 4);
  for (const char* words : {"state differs", "within their errors: drape_coefficient_percent",
                            "program 0123456", "device cpu: another, now"})
    EXPECT_NE(within.out.find(words), std::string::npos) << within.out;
}

TEST_F(Recorded, RunThatTookLongIsLeftOut) {
  record(kDrape);
  edit([](Json& json) { json["wall_seconds"]["total"] = 5.0; });
  const Outcome outcome = program("verify " + in("runs") + " --quick --out " + in("check"));
  EXPECT_NE(outcome.out.find("took 5 s, more than 4 s"), std::string::npos) << outcome.out;
  EXPECT_EQ(outcome.exit_code, 2) << "nothing was compared";
}

}  // namespace
}  // namespace hysteron::experiments
