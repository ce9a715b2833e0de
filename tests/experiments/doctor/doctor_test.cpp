// `hysteron doctor`: what is there, what lacks cost, and an answer whatever a probe does.
#include <nlohmann/json.hpp>

#include "experiments/doctor/findings.h"
#include "tests/experiments/program.h"

namespace hysteron::experiments {
namespace {

// Runs doctor with variables of the environment before it.
Outcome doctor_with(const std::string& environment, const std::string& arguments = "") {
  const Folder folder;
  const std::string out = folder.path() / "out", err = folder.path() / "err";
  const int status = std::system(
      (environment + " " HYSTERON_PROGRAM " doctor " + arguments + " >" + out + " 2>" + err).c_str());
  return {WEXITSTATUS(status), file_content(out), file_content(err)};
}

// The first line about a part, behind its name; "" where there is none.
std::string line_on(const std::string& part, const std::string& text) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with(part + " ")) return line.substr(line.find_first_not_of(' ', part.size()));
  return "";
}

TEST(Doctor, HasALineOnEveryPart) {
  const Outcome outcome = doctor_with("");
  for (const char* part : {"program", "memory", "cpu", "cuda", "renderer", "gnuplot", "fonts", "ffmpeg",
                           "disk", "assets", "python"})
    EXPECT_NE(line_on(part, outcome.out), "") << part << " in\n" << outcome.out;
  EXPECT_TRUE(says(line_on("program", outcome.out), "which this CPU has"));
  EXPECT_TRUE(says(line_on("assets", outcome.out), " fabrics, "));
  EXPECT_EQ(outcome.err, "");
}

TEST(Doctor, EndsWellWhereADrapeHasAllThatItNeeds) {
  const Outcome outcome = doctor_with("");
  const bool is_ready = says(outcome.out, "\ndrape --quick runs here, with pictures\n");
  EXPECT_EQ(outcome.exit_code, is_ready ? 0 : 1);
  EXPECT_NE(is_ready, says(outcome.out, "\ndrape --quick does not run here with pictures: lacking are "));
}

// Neither gnuplot nor ffmpeg is in the empty folder, and a drape needs none of them.
TEST(Doctor, SaysWhatALackCostsAndWhichPackageMendsIt) {
  const Folder folder;
  const Outcome outcome = doctor_with("PATH=" + folder.path().string());
  EXPECT_EQ(line_on("gnuplot", outcome.out),
            "lacking: gnuplot cannot be started; plots are not drawn, their tables are written (apt install "
            "gnuplot-nox)");
  EXPECT_EQ(
      line_on("ffmpeg", outcome.out),
      "lacking: ffmpeg cannot be started; compare.video writes no film, pictures are drawn (apt install "
      "ffmpeg)");
  EXPECT_EQ(outcome.exit_code, doctor_with("").exit_code);
}

TEST(Doctor, OutlivesWhatItTries) {
  const Folder folder;
  folder.write("gnuplot", "#!/bin/sh\nkill -SEGV $$\n");
  fs::permissions(folder.path() / "gnuplot", fs::perms::owner_all);
  const Outcome outcome = doctor_with("GALLIUM_DRIVER=zink PATH=" + folder.path().string() + ":$PATH");
  EXPECT_LE(outcome.exit_code, 1) << outcome.err;
  EXPECT_TRUE(line_on("gnuplot", outcome.out).starts_with("lacking: gnuplot fails: ")) << outcome.out;
  EXPECT_TRUE(says(outcome.out, "\nrenderer   OSMesa") || says(outcome.out, "\nrenderer   lacking: OSMesa"));
  EXPECT_NE(line_on("python", outcome.out), "");
}

TEST(Doctor, EndsWithOneWhereNothingCanBeWrittenOrNoAssetsAreFound) {
  const Outcome nowhere = doctor_with("", "--out /dev/null/run");
  EXPECT_EQ(nowhere.exit_code, 1);
  EXPECT_TRUE(says(nowhere.out, "lacking are disk\n") || says(nowhere.out, ", disk\n"));
  const Outcome bare = doctor_with("HYSTERON_ASSETS=/nowhere");
  EXPECT_EQ(bare.exit_code, 1);
  EXPECT_TRUE(says(line_on("assets", bare.out), "lacking: HYSTERON_ASSETS = /nowhere is no folder"));
}

TEST(Doctor, LooksAtTheDiskOfAFolderThatIsNotThereYetAndMakesNone) {
  const Folder folder;
  const Finding finding = disk_finding(folder.path() / "not" / "yet");
  EXPECT_TRUE(finding.found) << finding.text;
  EXPECT_FALSE(fs::exists(folder.path() / "not"));
}

// One renderer that draws is enough; with none, pictures are what lacks.
TEST(Doctor, AsksForOneRenderer) {
  const TriedDevice fails{"renderer", "EGL device 0", "EGL device 0 fails", "no driver"};
  const TriedDevice draws{"renderer", "OSMesa", "OSMesa: llvmpipe", ""};
  const std::vector<Finding> both = device_findings({fails, draws}), none = device_findings({fails});
  EXPECT_TRUE(lacking_parts(both).empty());
  EXPECT_TRUE(says(finding_line(both[0]), "nothing is lost, OSMesa draws"));
  EXPECT_EQ(both[0].remedy, "");
  EXPECT_EQ(lacking_parts(none), std::vector<std::string>{"renderer"});
  EXPECT_EQ(
      finding_line(none[0]),
      "renderer   lacking: EGL device 0 fails: no driver; no pictures are drawn: runs take --no-images (apt "
      "install libegl1 libgl1-mesa-dri)");
}

TEST(Doctor, SaysAsJsonWhatItSaysInLinesAndDevicesAsListHasThem) {
  const Outcome outcome = doctor_with("", "--json");
  const Json all = json_in(outcome.out, "stdout");
  EXPECT_EQ(all.at("ready"), outcome.exit_code == 0);
  EXPECT_EQ(all.at("devices"), json_in(program("list devices --json").out, "stdout").at("devices"));
  EXPECT_EQ(all.at("findings").at(0).at("part"), "program");
  for (const auto& finding : all.at("findings"))
    EXPECT_NE(finding.at("found") == true, finding.contains("cost")) << finding;
}

TEST(Doctor, IsWhatListDevicesPrints) {
  const std::string list = finished("list devices").out, doctor = doctor_with("").out;
  for (const char* part : {"program", "cpu", "cuda", "renderer", "gnuplot", "assets"})
    EXPECT_EQ(line_on(part, list), line_on(part, doctor)) << part;
}

}  // namespace
}  // namespace hysteron::experiments
