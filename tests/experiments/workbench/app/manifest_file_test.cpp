// A manifest as it stands on disk: names and order are a contract that scripts rely on.
#include "experiments/workbench/app/manifest_file.h"

#include <cmath>

#include "tests/experiments/folder.h"

namespace hysteron::experiments {
namespace {

Manifest whole_manifest() {
  Manifest m;
  m.version = "0.1.0";
  m.commit = "0123456789abcdef";
  m.experiment = "swing";
  m.command = "hysteron swing --quick";
  m.started = "2026-01-02T03:04:05Z";
  m.keys = std::make_shared<const Json>(json_in(
      R"({"law":"prandtl","fabric":{"name":"wool","b1":2e-05},"gravity":[0.0,0.0,-9.81],"seconds":4.0})",
      "keys"));
  m.device = "cpu: CPU, 2 threads";
  m.law = "prandtl";
  m.triangles = 96;
  m.seconds_simulated = 0.4;
  m.wall_seconds = {{"total", 1.5}, {"solve", 1.0}};
  m.energy = {{"kinetic", 1e-6}};
  m.state_hash = "00000000deadbeef";
  m.substeps = 1;
  m.own = {{"drape", std::make_shared<const Json>(Json{{"release", "dropped"}})}};
  m.series = {{"tip_x [m]"}};
  m.frames = Frames{{{"cloth"}, {"curvature", Frames::Bar{"curvature", "1/m", 0, 100}}},
                    0.25,
                    {{0, ""}, {0.5, "hang", 2.5}}};
  m.curves = {{"plot_decay", "turns.csv", "turn", "amplitude [mm]", true, "Amplitudes."}};
  m.plots_missing = {"plot_tip: no gnuplot"};
  m.metrics = {{"turns", 3}, {"loss_J", NAN}, {"settled", false}, {"decay_shape", "linear"}, {"drop", 0.1}};
  m.files = {"metrics.csv"};
  m.complete = true;
  return m;
}

// Every entry in its place; what is not known is null, and what only some runs have is left out.
constexpr const char* kWhole = R"({
  "hysteron": {"version": "0.1.0", "commit": "0123456789abcdef", "dirty": false},
  "experiment": "swing",
  "command": "hysteron swing --quick",
  "started": "2026-01-02T03:04:05Z",
  "scene": {"law": "prandtl", "fabric": {"name": "wool", "b1": 2e-05}, "gravity": [0.0, 0.0, -9.81], "seconds": 4.0},
  "device": "cpu: CPU, 2 threads",
  "renderer": null,
  "positions": null,
  "precision": null,
  "element": null,
  "law": "prandtl",
  "triangles": 96,
  "hinges": null,
  "steps": null,
  "seconds_simulated": 0.4,
  "wall_seconds": {"total": 1.5, "solve": 1.0},
  "bytes_device": null,
  "energy": {"kinetic": 1e-06},
  "state_hash": "00000000deadbeef",
  "substeps": 1,
  "drape": {"release": "dropped"},
  "series": ["tip_x [m]"],
  "frames": {
    "looks": {"cloth": null, "curvature": {"label": "curvature", "unit": "1/m", "low": 0.0, "high": 100.0}},
    "m_per_pixel": 0.25,
    "moments": [{"s": 0.0, "phase": ""}, {"s": 0.5, "phase": "hang", "difference_rms_per_m": 2.5}]
  },
  "curves": [
    {
      "plot": "plot_decay", "file": "turns.csv", "x": "turn", "y": "amplitude [mm]",
      "logarithmic": true, "caption": "Amplitudes."
    }
  ],
  "plots_missing": ["plot_tip: no gnuplot"],
  "metrics": {"turns": 3, "loss_J": null, "settled": false, "decay_shape": "linear", "drop": 0.1},
  "files": ["metrics.csv"],
  "complete": true
})";

TEST(ManifestFile, HoldsEveryEntryUnderItsNameInItsOrder) {
  EXPECT_EQ(to_json(whole_manifest()).dump(), json_in(kWhole, "kWhole").dump());
}

TEST(ManifestFile, OfARunThatHasJustBegunHoldsNullsWhereNothingIsKnown) {
  Manifest begun;
  begun.keys = std::make_shared<const Json>(Json::object());
  EXPECT_EQ(
      to_json(begun).dump(),
      R"({"hysteron":{"version":"","commit":"","dirty":false},"experiment":"","command":"","started":"",)"
      R"("scene":{},"device":null,"renderer":null,"positions":null,"precision":null,"element":null,)"
      R"("law":null,"triangles":null,"hinges":null,"steps":null,"seconds_simulated":null,)"
      R"("wall_seconds":null,"bytes_device":null,"energy":null,"state_hash":null,"metrics":{},)"
      R"("files":[],"complete":false})");
}

TEST(ManifestFile, IsReadAsItWasWritten) {
  Manifest read = parsed_manifest(json_in(kWhole, "manifest.json"));
  EXPECT_EQ(read.text("fabric.name"), "wool");
  EXPECT_EQ(read.number("fabric.b1"), 2e-5);
  EXPECT_EQ(read.names("law"), std::vector<std::string>{"prandtl"});
  EXPECT_EQ(read.number("seconds"), 4.0);
  EXPECT_EQ(read.total_seconds(), 1.5);
  EXPECT_EQ(read.metrics["turns"], MetricValue(3));
  EXPECT_FALSE(read.metrics["loss_J"].is_known());
  EXPECT_TRUE(read.metrics["settled"].is(false));
  read.own = whole_manifest().own;  // which only their experiment reads
  EXPECT_EQ(to_json(read).dump(), json_in(kWhole, "kWhole").dump());
}

TEST(ManifestFile, OfAnOlderProgramIsReadAsFarAsItGoes) {
  const Manifest old = parsed_manifest(json_in(
      R"({"hysteron":{"version":1,"commit":"c"},"scene":{"laws":["linear",{"name":"dahl"}]},"steps":"many"})",
      "manifest.json"));
  EXPECT_EQ(old.version, "1");
  EXPECT_EQ(old.experiment, "run");
  EXPECT_EQ(old.names("law"), (std::vector<std::string>{"linear", "dahl"}));
  EXPECT_FALSE(old.steps || old.frames || old.complete);
  EXPECT_TRUE(old.metrics.empty());
}

}  // namespace
}  // namespace hysteron::experiments
