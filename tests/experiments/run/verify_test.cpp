#include <fstream>

#include "sim/mesh/cloth_mesh.h"
#include "tests/experiments/program.h"

namespace hysteron::experiments {
namespace {

// The fixture has a run in a folder of its own.
class Recorded : public testing::Test {
 protected:
  void record(const std::string& arguments) {
    finished(arguments + " --quiet --threads 1 --device cpu" + out_flag(run()));
  }
  fs::path run() const { return folder_.path() / "runs" / "one"; }
  fs::path manifest() const { return run() / "manifest.json"; }
  std::string in(const std::string& name) const { return folder_.file(name); }
  void edit(const std::function<void(Json&)>& change) {
    Json json = manifest_in(run());
    change(json);
    std::ofstream(manifest()) << json.dump(2);
  }

  static void move(Json& json, const char* metric, double by) {
    Json& value = json["metrics"][metric];
    value = value.get<double>() + by;
  }

  Folder folder_;
};

const std::string kCrease = "crease --crease.fold pleat --crease.recovery 0.02 --triangles 60 --no-images";
const std::string kDrape = "drape --quick --triangles 120 --seconds 0.1 --no-images";

// A crease changes the scene that it is asked for: number of triangles, pins, plate.
TEST_F(Recorded, RunIsRepeatedToTheBit) {
  for (const std::string& command : {kDrape, kCrease, std::string("swing --quick --no-images")}) {
    record(command);
    finished("rerun " + run().string() + " --quiet --out " + in("again"));
    const Json before = manifest_in(run()), again = manifest_in(in("again"));
    EXPECT_EQ(before["state_hash"], again["state_hash"]) << command;
    EXPECT_EQ(before["scene"], again["scene"]) << command;
    EXPECT_EQ(before["options"], again["options"]) << command;
  }
}

// Whose text is read only where an older program has noted nothing else.
TEST_F(Recorded, RunIsRepeatedFromItsFlagsNotFromItsCommand) {
  record("fold --fold.law-alone --fold.cycles 3 --no-images");
  const Json before = manifest_in(run());
  const std::string again = "rerun " + run().string() + " --quiet --out " + in("again");
  edit([](Json& json) { json["command"] = "another program"; });
  finished(again);
  EXPECT_EQ(manifest_in(in("again"))["metrics"], before["metrics"]);
  edit([](Json& json) { json.erase("spec"); });
  refused(again);
  edit([&](Json& json) { json["command"] = before["command"]; });
  finished(again);
  EXPECT_EQ(manifest_in(in("again"))["metrics"], before["metrics"]);
}

TEST_F(Recorded, RunWithAnotherStateIsRepeatedWithAWarningThoughItIsQuiet) {
  record("swing --quick --no-images");
  edit([](Json& json) { json["state_hash"] = "0123456789abcdef"; });
  const Outcome outcome = finished("rerun " + run().string() + " --quiet --out " + in("again"));
  const std::string words = " differs from the recorded 0123456789abcdef";
  EXPECT_TRUE(says(outcome.err, "warning: state "));
  EXPECT_TRUE(says(outcome.err, words));
  const Json warnings = manifest_in(in("again"))["warnings"];
  EXPECT_TRUE(says(warnings.back().get<std::string>(), words)) << warnings;
  EXPECT_TRUE(says(file_content(fs::path(in("again")) / "report.html"), words));
}

TEST_F(Recorded, FolderOfRunsIsWrittenAsAWorkflow) {
  record(kDrape);
  fs::create_directories(folder_.path() / "runs" / "other");
  Json other = manifest_in(run());
  other["device"] = "cuda: a GPU";
  other["bytes_device"] = 2'000'000'000;
  other["wall_seconds"]["total"] = 3600;
  std::ofstream(folder_.path() / "runs" / "other" / "on-gpu.json") << other.dump();
  other["complete"] = false;
  std::ofstream(folder_.path() / "runs" / "stopped.json") << other.dump();

  const auto config = [&](const std::string& more) {
    const Outcome outcome =
        finished("rerun " + in("runs") + " --out " + in("again") + " --snakemake " + in("flow") + more);
    EXPECT_TRUE(says(outcome.out, "left out: stopped is not complete"));
    return read_json(folder_.path() / "flow" / "config.json");
  };
  const Json jobs = config("")["jobs"];
  ASSERT_EQ(jobs.size(), 2u);
  EXPECT_EQ(jobs["one"]["cores"], 1);
  EXPECT_EQ(jobs["one"]["gpus"], 0);
  EXPECT_EQ(jobs["other/on-gpu"]["gpus"], 1);
  EXPECT_EQ(jobs["other/on-gpu"]["minutes"], 4 * 60);
  EXPECT_EQ(jobs["other/on-gpu"]["memory_mb"], 1000 + 4 * 2000);
  EXPECT_EQ(jobs["other/on-gpu"]["words"][3], in("again/other/on-gpu"));
  EXPECT_EQ(config(" --device cpu")["jobs"]["other/on-gpu"]["gpus"], 0);
  EXPECT_EQ(config(" --threads 3")["jobs"]["one"]["cores"], 3);
}

TEST_F(Recorded, SceneNeedsItsFileNoMore) {
  const std::string scene = folder_.write(
      "mine.toml", "triangles = 64\nseconds = 0.05\n[[metric]]\nname = \"edge\"\nto = [0.5, 0, 0]\n");
  record("run " + scene + " --no-images");
  fs::remove(scene);
  finished("rerun " + manifest().string() + " --quiet --out " + in("again"));
  EXPECT_EQ(manifest_in(run())["state_hash"], manifest_in(in("again"))["state_hash"]);
  EXPECT_EQ(manifest_in(run())["metrics"]["edge_m"], manifest_in(in("again"))["metrics"]["edge_m"]);
}

// The fixture has a scene beside a mesh, named from its own folder, and its run beside both.
class RecordedMesh : public testing::Test {
 protected:
  RecordedMesh() {
    fs::create_directories(project_ / "meshes");
    const ClothMesh mesh = make_grid(0.2, 0.1, 4, 2, MeshFamily::unionjack, 1);
    write_obj(mesh_, mesh, mesh.rest);
    std::ofstream(project_ / "mine.toml")
        << "seconds = 0.05\n[cloth]\nshape = \"file\"\nfile = \"meshes/c.obj\"\n";
  }
  Outcome run(const std::string& arguments) const {
    return finished(arguments + " --quiet --no-images --threads 1 --device cpu");
  }
  void record() const { run("run " + (project_ / "mine.toml").string() + out_flag(project_ / "run")); }

  Folder folder_;
  const fs::path project_ = folder_.path() / "project", mesh_ = project_ / "meshes" / "c.obj";
};

TEST_F(RecordedMesh, IsFoundFromElsewhereAndWhereAllHasMoved) {
  record();
  const Json before = manifest_in(project_ / "run");
  EXPECT_EQ(before["scene"]["cloth"]["file"], mesh_.string());
  EXPECT_EQ(before["meshes"]["cloth.file"]["file"], mesh_.string());
  const fs::path moved = folder_.path() / "elsewhere";
  fs::rename(project_, moved);
  const Outcome again = run("rerun " + (moved / "run").string() + out_flag(moved / "again"));
  EXPECT_EQ(without_warnings(again.err), "");
  const Json now = manifest_in(moved / "again");
  EXPECT_EQ(now["state_hash"], before["state_hash"]);
  EXPECT_EQ(now["meshes"]["cloth.file"]["hash"], before["meshes"]["cloth.file"]["hash"]);
  EXPECT_EQ(now["scene"]["cloth"]["file"], (moved / "meshes" / "c.obj").string());
}

TEST_F(RecordedMesh, ThatHasChangedIsNamed) {
  record();
  std::ofstream(mesh_, std::ios::app) << "# another file\n";
  const std::string out = (folder_.path() / "again").string();
  const Outcome again = run("rerun " + (project_ / "run").string() + " --out " + out);
  const std::string words = "mesh " + mesh_.string() + " (cloth.file) has changed since it was recorded";
  EXPECT_TRUE(says(again.err, "warning: " + words));
  EXPECT_EQ(manifest_in(out)["warnings"][0].get<std::string>().substr(0, words.size()), words);
  finished("verify " + (project_ / "run").string());  // the same cloth
}

TEST_F(Recorded, ManifestIsASceneOfItsExperiment) {
  record(kDrape);
  finished("drape --quiet --no-images --scene " + manifest().string() + " --out " + in("again"));
  EXPECT_EQ(manifest_in(run())["state_hash"], manifest_in(in("again"))["state_hash"]);
}

// Older programs left out `asked`; the keys that were given are known nevertheless.
TEST_F(Recorded, ManifestOfAnOlderProgramIsRepeatedByItsCommand) {
  record(kCrease);
  edit([](Json& json) { json.erase("options"), json.erase("asked"); });
  finished("rerun " + run().string() + " --quiet --out " + in("again"));
  EXPECT_EQ(manifest_in(run())["state_hash"], manifest_in(in("again"))["state_hash"]);
}

TEST_F(Recorded, SceneIsDumpedAsAFileOfTheSameRun) {
  record(kCrease);
  finished(kCrease + " --threads 1 --device cpu --dump-scene " + in("dump.toml") + " --out " + in("none"));
  EXPECT_FALSE(fs::exists(in("none")));
  finished("crease --quiet --scene " + in("dump.toml") + " --out " + in("again"));
  EXPECT_EQ(manifest_in(run())["state_hash"], manifest_in(in("again"))["state_hash"]);
}

TEST_F(Recorded, RunIsVerified) {
  record(kDrape);
  const std::string verify = "verify " + in("runs") + " --out " + in("check");
  const Outcome same = finished(verify);
  for (const char* words : {"same    one", "same state", "1 the same, 0 within errors, 0 differ"})
    EXPECT_TRUE(says(same.out, words));

  edit([](Json& json) { move(json, "drape_coefficient_percent", 1); });
  const Outcome beyond = ended(4, verify);
  EXPECT_TRUE(says(beyond.out, "beyond: drape_coefficient_percent"));

  edit([](Json& json) {
    json["metrics"]["drape_coefficient_percent_step_error"] = 2.0;
    json["state_hash"] = "0123456789abcdef";
    json["hysteron"]["commit"] = "0123456789";
    json["device"] = "cpu: another, 1 threads";
  });
  const Outcome within = finished(verify);
  for (const char* words : {"within  one", "state differs", "within their errors: drape_coefficient_percent",
                            "program 0123456", "device cpu: another, now cpu: "})
    EXPECT_TRUE(says(within.out, words));
  ended(4, verify + " --exact");
}

TEST_F(Recorded, FabricFilesAndMeshesAreVerified) {
  record("swing --quick --no-images --triangles 60 --seconds 0.05 --export ply");
  const std::string verify = "verify " + in("runs") + " --out " + in("check");
  EXPECT_TRUE(says(finished(verify).out, "data files the same"));
  std::vector<std::string> meshes;
  const Json manifest = manifest_in(run());
  for (const Json& file : manifest["files"])
    if (file.get<std::string>().ends_with(".ply")) meshes.push_back(file);
  ASSERT_FALSE(meshes.empty());
  std::ofstream(run() / meshes.front(), std::ios::app) << "1 2 3\n";
  EXPECT_TRUE(says(ended(4, verify).out, "files differ: " + meshes.front()));
  fs::remove(run() / meshes.front());
  EXPECT_TRUE(says(ended(4, verify).out, "no longer in the folder: " + meshes.front()));
}

// A test of a fabric's file has no scene in its manifest: the file is read again.
TEST_F(Recorded, FileThatHasChangedSinceIsNamedWhereItIsReadAgain) {
  const std::string file = in("mine.toml");
  const auto write = [&](const char* b2) {
    std::ofstream(file) << "[parameters]\ndensity = 0.12\nthickness = 4e-4\nb2 = " << b2
                        << "\nb1 = 6e-5\nk0 = 8\n";
  };
  write("1e-5");
  finished("kes --quick --no-images --quiet --fabric " + file + out_flag(run()));
  const std::string again = "rerun " + run().string() + " --quiet --out " + in("again");
  EXPECT_FALSE(says(finished(again).err, "has changed"));
  write("2e-5");
  EXPECT_TRUE(
      says(finished(again).err, "mine.toml has changed since the recorded run, and is read as it is now"));
}

TEST_F(Recorded, AFitsFabricFileIsVerified) {
  finished("fit --kes.b 1e-5 --kes.2hb 1e-3 --fabric.density 0.1 --fabric.thickness 3e-4 --quiet" +
           out_flag(run()));
  const std::string verify = "verify " + in("runs") + " --out " + in("check");
  EXPECT_TRUE(says(finished(verify).out, "1 data file the same"));
  std::ofstream(run() / "fabric.toml", std::ios::app) << "# b1 = 1\n";
  EXPECT_TRUE(says(ended(4, verify).out, "files differ: fabric.toml"));
}

// A run that stood in its folder before and is kept there makes no page of it.
TEST_F(Recorded, RunBesideOneThatIsSetAsideIsVerified) {
  finished("kes --quick --no-images --quiet" + out_flag(run()));
  const fs::path aside = run() / ".page-before";
  fs::create_directories(aside);
  fs::copy(manifest(), aside / "manifest.json");
  EXPECT_TRUE(says(finished("verify " + in("runs") + " --out " + in("check")).out, "1 the same, 0 within"));
}

// Results do not depend on the number of threads, which is no reason of a difference.
TEST_F(Recorded, RunThatDiffersIsSaidToBeOfAnotherProgramNotOfOtherThreads) {
  record(kDrape);
  edit([](Json& json) {
    json["hysteron"]["commit"] = "0123456789";
    json["state_hash"] = "0123456789abcdef";
  });
  const std::string verify = "verify " + in("runs") + " --out " + in("check") + " --threads 2";
  const std::string out = ended(4, verify).out;
  EXPECT_TRUE(says(out, "recorded by another: program 0123456"));
  for (const char* same : {"threads", "device", "instructions", "compiler"}) EXPECT_FALSE(says(out, same));
}

// The program promises them of one build on one device.
TEST_F(Recorded, RunWithOtherBitsDiffersOnlyWhereTheyAreDue) {
  record(kDrape);
  edit([](Json& json) { json["state_hash"] = "0123456789abcdef"; });
  const std::string verify = "verify " + in("runs") + " --out " + in("check");
  ended(4, verify);
  const Json here = manifest_in(run())["hysteron"];
  edit([](Json& json) { json["hysteron"]["instructions"] = "x86-64-v9"; });
  EXPECT_TRUE(says(finished(verify).out, "instructions x86-64-v9, now x86-64"));
  edit([](Json& json) { json["hysteron"].erase("instructions"); });
  finished(verify);  // older programs did not note them
  edit([&](Json& json) { json["hysteron"] = here, json["hysteron"]["compiler"] = "cc 1"; });
  EXPECT_TRUE(says(finished(verify).out, "compiler cc 1, now "));
}

// A mathematical library without fused multiplication stands for that of another processor.
TEST_F(Recorded, RunOnAnotherProcessorIsTheSameWithinRoundOff) {
  for (const std::string& command : {kCrease, std::string("swing --quick --no-images")}) {
    record(command);
    edit([](Json& json) { json["hysteron"].erase("instructions"); });
    const std::string verify = "verify " + in("runs") + " --out " + in("check");
    setenv("GLIBC_TUNABLES", "glibc.cpu.hwcaps=-AVX2,-FMA", 1);
    const Outcome outcome = finished(verify);
    unsetenv("GLIBC_TUNABLES");
    if (outcome.out.find("same state") == std::string::npos) {
      EXPECT_TRUE(says(outcome.out, "within round-off"));
    }
  }
}

TEST_F(Recorded, RunIsHeldToLimitsFromAFile) {
  record(kDrape);
  edit([](Json& json) {
    move(json, "drape_coefficient_percent", 0.4), json["hysteron"].erase("instructions");
  });
  const auto verified = [&](const std::string& limit) {
    const std::string limits =
        folder_.write("limits.toml", "[[metric]]\nname = \"drape_*\"\nmax-difference = " + limit + "\n");
    return program("verify " + in("runs") + " --limits " + limits + " --junit " + in("tests.xml") +
                   " --out " + in("check"));
  };
  EXPECT_EQ(verified("0.5").exit_code, 0);
  EXPECT_TRUE(says(file_content(in("tests.xml")), "tests=\"1\" failures=\"0\" errors=\"0\""));
  EXPECT_EQ(verified("0.3").exit_code, 4);
  const std::string xml = file_content(in("tests.xml"));
  EXPECT_TRUE(says(xml, "<testcase name=\"one\" classname=\"hysteron.verify\""));
  EXPECT_TRUE(says(xml, "<failure message=\"same state; "));
}

TEST_F(Recorded, RunWhoseManifestHoldsLessThanItFindsDiffers) {
  record(kDrape);
  const Json whole = manifest_in(run());
  const std::string verify = "verify " + in("runs") + " --out " + in("check");
  const auto without = [&](const std::function<void(Json&)>& change) {
    std::ofstream(manifest()) << whole.dump();
    edit(change);
    return ended(4, verify).out;
  };
  EXPECT_TRUE(
      says(without([](Json& json) { json["state_hash"] = nullptr; }), "not in the manifest: the state"));
  EXPECT_TRUE(says(without([](Json& json) { json["metrics"] = Json::object(); }),
                   "0 of 0 metrics the same; not in the manifest: ", "drape_coefficient_percent"));
  EXPECT_TRUE(says(without([](Json& json) { json["metrics"].erase("node_count"); }),
                   "not in the manifest: node_count"));
  EXPECT_TRUE(says(without([](Json& json) { json["metrics"]["gone_m"] = 1; }), "no longer measured: gone_m"));
}

TEST_F(Recorded, RunWhoseEnergyOrSeriesIsNotThatOfItsRepetitionDiffers) {
  record("run " + folder_.write("mine.toml", "seconds = 0.02\nstep = 0.01\ntriangles = 20\n") +
         " --no-images");
  const std::string verify = "verify " + in("runs") + " --out " + in("check");
  EXPECT_TRUE(says(finished(verify).out, "21 energy terms the same", "table columns the same"));
  edit([](Json& json) { json["energy"]["bending"] = 1.0; });
  const std::string series = file_content(run() / "metrics.csv");
  std::ofstream(run() / "metrics.csv") << series.substr(0, series.rfind('\n', series.size() - 2) + 1);
  EXPECT_TRUE(says(ended(4, verify).out, "beyond: energy.bending 1 -> ", "metrics.csv with "));
}

TEST_F(Recorded, RunThatCannotBeRepeatedIsAFailureBesideOthers) {
  record(kDrape);
  Json other = manifest_in(run());
  other["scene"]["law"] = "of-no-one";
  fs::create_directories(folder_.path() / "runs" / "other");
  std::ofstream(folder_.path() / "runs" / "other" / "manifest.json") << other.dump();
  const Outcome outcome = ended(3, "verify " + in("runs") + " --out " + in("check"));
  EXPECT_TRUE(says(outcome.out, "1 the same, 0 within errors, 0 differ; 1 could not be"));
  EXPECT_TRUE(says(outcome.err, "1 of 2 runs could not be repeated, the first other: "));
}

TEST_F(Recorded, RunWhoseManifestIsDamagedIsAFailureBesideOthers) {
  record(kDrape);
  const std::string whole = file_content(manifest());
  const std::pair<const char*, std::string> damaged[] = {{"empty", ""},
                                                         {"torn", whole.substr(0, whole.size() / 2)}};
  for (const auto& [name, text] : damaged) {
    fs::create_directories(folder_.path() / "runs" / name);
    std::ofstream(folder_.path() / "runs" / name / "manifest.json") << text;
  }
  const Outcome outcome = ended(3, "verify " + in("runs") + " --out " + in("check"));
  EXPECT_TRUE(says(outcome.out, "empty/manifest.json is damaged: it is empty"));
  EXPECT_TRUE(says(outcome.out, "torn/manifest.json is damaged: it was cut off or edited"));
  EXPECT_TRUE(says(outcome.out, "1 the same, 0 within errors, 0 differ; 2 could not be"));
  EXPECT_TRUE(says(outcome.err, "2 of 3 runs could not be repeated, the first empty: "));
}

TEST_F(Recorded, RunIsHeldToNoLimitThatIsForNothing) {
  record(kDrape);
  const auto refusal_of = [&](const std::string& limits) {
    return refused("verify " + in("runs") + " --out " + in("check") + " --limits " +
                   folder_.write("limits.toml", limits));
  };
  EXPECT_TRUE(says(refusal_of("[[metric]]\nname = \"node_counts\"\nmax-difference = 1\n"),
                   "a limit is for the metric node_counts, and none is called so; did you mean node_count?"));
  EXPECT_TRUE(says(refusal_of("[[picture]]\nname = \"shadows*.png\"\nmax-mean = 0\n"),
                   "a limit is for the picture shadows*.png, and none is called so"));
  edit([](Json& json) {
    json["files"].push_back("plot_gap.png");
    json["metrics"]["computing_s"] = 1.0;
  });
  EXPECT_TRUE(
      says(refusal_of("[[picture]]\nname = \"plot_gap.png\"\nmax-mean = 0\n"),
           "a limit is for the picture plot_gap.png, which is not compared: plots depend on gnuplot"));
  EXPECT_TRUE(says(refusal_of("[[metric]]\nname = \"computing_s\"\nmax-difference = 1\n"),
                   "a limit is for the metric computing_s, which is not compared: durations depend on"));
}

TEST_F(Recorded, RunWithoutPicturesIsSaidToBeHeldToNoLimitOnThem) {
  record(kDrape);
  const std::string verify = "verify " + in("runs") + " --no-images --out " + in("check");
  EXPECT_FALSE(says(finished(verify).err, "no picture is held")) << "nobody asked for limits";
  const std::string limits = folder_.write("limits.toml", "max-mean = 0\n");
  EXPECT_TRUE(says(finished(verify + " --limits " + limits).err,
                   "warning: no picture is held to the limits of " + limits));
}

// In another folder, whose name is no part of its pictures.
TEST_F(Recorded, RunOfASceneOfOnesOwnIsRepeatedWithItsPictures) {
  const std::string scene = folder_.write(
      "mine.toml",
      "seconds = 0.02\nstep = 0.01\ntriangles = 20\n[[metric]]\nname = \"tip\"\nto = [0.5, 0, 0]\n");
  record("run " + scene + " --size 160x120 --fps 50");
  EXPECT_EQ(manifest_in(run())["scene_name"], "mine");
  const std::string verify = "verify " + in("runs") + " --limits " +
                             folder_.write("limits.toml", "max-mean = 0\n") + " --out " + in("check");
  EXPECT_TRUE(says(finished(verify).out, "3 pictures the same"));
  EXPECT_EQ(manifest_in(folder_.path() / "check" / "one")["scene_name"], "mine");
  edit([](Json& json) { json.erase("scene_name"); });  // as older programs wrote it
  finished(verify);
}

TEST_F(Recorded, RunThatTookLongIsLeftOut) {
  record(kDrape);
  edit([](Json& json) { json["wall_seconds"]["total"] = 5.0; });
  const Outcome outcome = program("verify " + in("runs") + " --quick --out " + in("check"));
  EXPECT_TRUE(says(outcome.out, "took 5 s, more than 4 s"));
  EXPECT_EQ(outcome.exit_code, 2) << "nothing was compared";
  edit([](Json& json) { json["experiment"] = "sweep", json["wall_seconds"]["total"] = 0.1; });
  EXPECT_TRUE(says(program("verify " + in("runs") + " --quick --out " + in("check")).out,
                   "was collected from runs that are not here"))
      << "whose time it does not say";
}

}  // namespace
}  // namespace hysteron::experiments
