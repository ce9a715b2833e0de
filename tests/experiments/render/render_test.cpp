// Meshes from files in the look of a run.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>

#include "render/compare.h"
#include "render/image.h"
#include "sim/base/error.h"
#include "sim/mesh/cloth_mesh.h"
#include "tests/experiments/folder.h"

namespace hysteron::experiments {
namespace {

using FlagList = std::vector<Flag>;

int rendered(const fs::path& out, const std::vector<std::string>& names, FlagList flags) {
  flags.push_back({"out", out.string()});
  flags.push_back({"quiet", true});
  if (std::none_of(flags.begin(), flags.end(), [](const Flag& f) { return f.path == "size"; }))
    flags.push_back({"size", "160x120"});
  return experiment_named("render").run({"render", "hysteron render", flags, names});
}

// The message of a refusal, before anything is written.
std::string refusal(const std::vector<std::string>& names, const FlagList& flags = {}) {
  const Folder folder;
  const std::string message = test::refusal([&] { rendered(folder.path() / "out", names, flags); });
  EXPECT_FALSE(fs::exists(folder.path() / "out"));
  return message;
}

std::string write(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream(file) << text;
  return file.string();
}

// A quick swing and what `render` makes of its exported meshes, with the same box, camera and caption.
struct Twins {
  Folder folder;
  fs::path run = folder.path() / "run", files = folder.path() / "files";

  Twins(const std::string& format, const std::string& look, FlagList further = {}) {
    const FlagList common = {{"size", "480x270"}, {"look", look}};
    FlagList flags = {{"out", run.string()}, {"quiet", true},   {"quick", true}, {"export", format},
                      {"seconds", 0.3},      {"probe", "none"}, {"fps", 10}};
    flags.insert(flags.end(), common.begin(), common.end());
    run_experiment({"swing", "hysteron swing", flags, {}});
    // Swing's own strip is 90 x 30 mm
    flags = {
        {"fps", "10"},
        {"camera.direction", Numbers{0.2, -1, 0.3}},
        {"camera.fov", 24},
        {"render.low", Numbers{-0.063, 0, -0.09}},
        {"render.high", Numbers{0.09, 0.03, 0.0135}},
        {"render.title", manifest_in(run)["scene"]["fabric"]["name"].get<std::string>() + ", law prandtl"}};
    flags.insert(flags.end(), common.begin(), common.end());
    flags.insert(flags.end(), further.begin(), further.end());
    rendered(files, {run.string()}, flags);
  }

  render::Difference difference(const std::string& frame) const {
    return render::compare(render::read_png(run / "frames" / frame),
                           render::read_png(files / "frames" / frame));
  }
};

constexpr double kPixels = 0.1;  // [%] that may differ by more than 8 of 255

TEST(RenderedFiles, LookLikeTheRunThatWroteThem) {
  const Twins obj("obj", "cloth");
  for (const char* frame : {"0000.png", "0001.png", "0003.png"})
    EXPECT_LE(obj.difference(frame).pixels_over_8_percent, kPixels) << frame;
  EXPECT_FALSE(fs::exists(obj.files / "frames" / "0004.png"));
}

TEST(RenderedFiles, ShowTheCurvatureThatTheRunWroteIntoThem) {
  const Twins ply("ply", "curvature", {{"render.curvature", "file"}});
  for (const char* frame : {"0001.png", "0003.png"})
    EXPECT_LE(ply.difference(frame).pixels_over_8_percent, kPixels) << frame;
}

TEST(RenderedFiles, ShowTheRunsCurvatureFromPositionsAlone) {
  const Twins obj("obj", "curvature");
  for (const char* frame : {"0001.png", "0003.png"})
    EXPECT_LE(obj.difference(frame).pixels_over_8_percent, kPixels) << frame;
}

// Coordinates as a file has them.
using Axes = std::string (*)(double x, double y, double z);

std::string metres(double x, double y, double z) {
  return "v " + std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z) + "\n";
}
std::string millimetres_y_up(double x, double y, double z) { return metres(1000 * x, 1000 * z, -1000 * y); }

// Returns quads of an upright sheet of n x n that sways; n differs from time to time.
std::string swaying(double time, Axes vertex) {
  std::string text;
  const int n = 4 + static_cast<int>(time / 0.1 + 0.01) % 2;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const double across = 0.1 * i / n, height = 0.1 * j / n;
      text += vertex(across, 0.02 * std::sin(10 * time + 20 * height), height);
    }
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i + 1, above = a + n + 1;
      for (const int v : {a, a + 1, above + 1, above}) text += (v == a ? "f " : " ") + std::to_string(v);
      text += "\n";
    }
  return text;
}

std::string sequence(const fs::path& folder, int frames, double fps, Axes vertex) {
  for (int k = 0; k < frames; ++k)
    write(folder / ("frame" + std::to_string(k) + ".obj"), swaying(k / fps, vertex));
  return folder.string();
}

// Returns the picture without the line of the caption that names the sequence.
render::Image without_name(const fs::path& file) {
  const render::Image image = render::read_png(file);
  const int cut = image.height() / 5;
  render::Image rest(image.width(), image.height() - cut);
  render::paste(rest, image, 0, -cut);
  return rest;
}

// It would be zero: no edge has two triangles.
TEST(RenderedFiles, CurvatureOfLooseTrianglesIsDoubted) {
  const Folder folder;
  const std::string soup = write(folder.path() / "soup.obj",
                                 "v 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nv 0.1 0 0\nv 0.1 0.1 0\nv 0 0.1 0\n"
                                 "f 1 2 3\nf 4 5 6\n");
  ASSERT_EQ(rendered(folder.path() / "out", {soup}, {{"look", "curvature"}}), 0);
  const Json warnings = manifest_in(folder.path() / "out")["warnings"];
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_EQ(warnings[0], "mesh " + soup + ": 2 triangles in 2 parts that share no edge, with 0 hinges");
}

TEST(RenderedFiles, OfSeveralFoldersStandInColumnsEachInItsUnitAxesAndRate) {
  const Folder folder;
  const fs::path out = folder.path() / "out";
  const std::string ours = sequence(folder.path() / "ours/mesh", 3, 10, metres),
                    theirs = sequence(folder.path() / "theirs", 6, 20, millimetres_y_up);
  ASSERT_EQ(rendered(out, {fs::path(ours).parent_path().string(), theirs},
                     {{"render.unit", "metre,millimetre"},
                      {"render.up", "z,y"},
                      {"fps", "10,20"},
                      {"look", "curvature"},
                      {"render.ground", "0"},
                      {"size", "320x240"}}),
            0);
  for (const char* file : {"theirs/0005.png", "sheet.png", "report.html"})
    EXPECT_TRUE(fs::exists(out / file));
  EXPECT_FALSE(fs::exists(out / "ours/0003.png"));
  const auto difference = [&](const char* mine, const char* yours) {
    return render::compare(without_name(out / mine), without_name(out / yours)).pixels_over_8_percent;
  };
  EXPECT_LE(difference("ours/0001.png", "theirs/0002.png"), kPixels);
  EXPECT_LE(difference("ours/0002.png", "theirs/0004.png"), kPixels);
  EXPECT_GT(difference("ours/0002.png", "theirs/0002.png"), 1) << "other times look different";
  const Json manifest = manifest_in(out);
  EXPECT_EQ(manifest["complete"], true);
  EXPECT_EQ(manifest["metrics"]["ours.frames_count"], 3);
  EXPECT_EQ(manifest["metrics"]["theirs.triangles_count"], 32);  // of the last frame
  EXPECT_GT(manifest["metrics"]["ours.curvature_rms_per_m"], 1.0);
  EXPECT_EQ(manifest["scene"]["render"]["up"], "z,y");
}

// Three files of which two show the same make the sheet of two, whether an instant is a cell or a row.
TEST(RenderedFiles, AnInstantThatLooksLikeOneBeforeIsNotOnTheSheet) {
  const auto sheet = [](const std::vector<double>& instants, const std::string& fps, int columns) {
    const Folder folder;
    std::vector<std::string> sequences;
    for (int c = 0; c < columns; ++c) {
      sequences.push_back((folder.path() / std::to_string(c)).string());
      for (std::size_t k = 0; k < instants.size(); ++k)
        write(fs::path(sequences.back()) / (std::to_string(k) + ".obj"), swaying(instants[k], metres));
    }
    EXPECT_EQ(rendered(folder.path() / "out", sequences, {{"fps", fps}, {"render.title", "a title"}}), 0);
    return render::read_png(folder.path() / "out/sheet.png");
  };
  for (const int columns : {1, 2}) {
    const render::Image two = sheet({0, 0.2}, "1", columns);
    EXPECT_EQ(sheet({0, 0, 0.2}, "2", columns), two) << columns;
    EXPECT_NE(sheet({0, 0.1, 0.2}, "2", columns), two) << columns;
  }
}

// Files 0, 1, 5, 6 of ten frames a second are the instants 0, 0.1, 0.5 and 0.6 s, beside those of a complete
// sequence.
TEST(RenderedFiles, AreTheFramesThatTheirNumbersSay) {
  const Folder folder;
  const fs::path whole = folder.path() / "whole", gap = folder.path() / "gap",
                 first = folder.path() / "first";
  sequence(whole, 8, 10, metres);
  for (const int k : {0, 1, 5, 6}) {
    const std::string name = "frame" + std::to_string(k) + ".obj";
    write(gap / name, swaying(k / 10., metres));
    if (k != 5) write(first / name, swaying(k / 10., metres));
  }
  const auto sheet = [&](const std::vector<std::string>& names, const FlagList& flags, const char* out) {
    FlagList all = {{"render.title", "a title"}};
    all.insert(all.end(), flags.begin(), flags.end());
    EXPECT_EQ(rendered(folder.path() / out, names, all), 0);
    return manifest_in(folder.path() / out);
  };
  const Json both = sheet({whole.string(), gap.string()}, {{"fps", "10"}}, "both");
  EXPECT_EQ(both["sequences"][1]["frames"], (std::vector<int>{0, 1, 5, 6}));
  ASSERT_EQ(both["warnings"].size(), 1u);
  EXPECT_EQ(
      both["warnings"][0],
      "the sequence gap has no file for 3 of its frames 0 to 6, the first after frame1.obj: its files are "
      "frames by the numbers in their names");
  // Equal pictures of equal files: 5 beside 5, as file 2 of the second folder.
  EXPECT_EQ(without_name(folder.path() / "both/whole/0005.png"),
            without_name(folder.path() / "both/gap/0002.png"));
  EXPECT_EQ(sheet({first.string(), whole.string()}, {}, "none")["sequences"][0]["frames"],
            (std::vector<int>{0, 1, 6}));
}

TEST(RenderedFiles, WithoutAnInstantInCommonAreRefused) {
  const Folder folder;
  for (const int k : {1, 2, 5, 6})
    write(folder.path() / (k < 4 ? "early" : "late") / (std::to_string(k) + ".obj"), swaying(0, metres));
  EXPECT_EQ(
      refusal({(folder.path() / "early").string(), (folder.path() / "late").string()}),
      "the sequences have no instant in common: of frames, early has 1 to 2, late has 5 to 6; rename the "
      "files, or render each sequence alone");
}

// The last frame from there stands below, and the frames' own pictures are as without it.
TEST(RenderedFiles, AFurtherDirectionIsAFurtherRowOfTheSheet) {
  const Folder folder;
  std::vector<std::string> sequences;
  for (const double time : {0.0, 0.2}) {
    sequences.push_back((folder.path() / std::to_string(sequences.size())).string());
    write(fs::path(sequences.back()) / "0.obj", swaying(time, metres));
  }
  EXPECT_EQ(rendered(folder.path() / "one", sequences, {}), 0);
  EXPECT_EQ(rendered(folder.path() / "two", sequences, {{"render.also", Numbers{0, -0.02, 1}}}), 0);
  const auto picture = [&](const char* out, const char* file) {
    return render::read_png(folder.path() / out / file);
  };
  for (const char* frame : {"0/0000.png", "1/0000.png"})
    EXPECT_EQ(picture("one", frame), picture("two", frame)) << frame;
  EXPECT_EQ(picture("two", "sheet.png").width(), picture("one", "sheet.png").width());
  EXPECT_GT(picture("two", "sheet.png").height(), picture("one", "sheet.png").height());
}

// As a recorded folder has them: its sheet is drawn again from the meshes within, and flags win.
TEST(RenderedFiles, WithinTheFolderOfTheirSheetAreDrawnAgain) {
  const Folder folder;
  const fs::path recorded = folder.path() / "recorded";
  std::vector<std::string> sequences;
  for (const double time : {0.0, 0.2}) {
    sequences.push_back((recorded / std::to_string(sequences.size())).string());
    write(fs::path(sequences.back()) / "mesh/0.obj", swaying(time, metres));
  }
  const fs::path first = folder.path() / "first", again = folder.path() / "again",
                 other = folder.path() / "other";
  ASSERT_EQ(
      rendered(first, sequences, {{"render.title", "a title"}, {"look", "curvature"}, {"size", "200x150"}}),
      0);
  fs::copy_file(first / "manifest.json", recorded / "manifest.json");
  ASSERT_EQ(rendered(again, {recorded.string()}, {{"size", "200x150"}}), 0);
  EXPECT_EQ(render::read_png(again / "sheet.png"), render::read_png(first / "sheet.png"));
  ASSERT_EQ(rendered(other, {recorded.string()}, {{"look", "clay"}, {"size", "200x150"}}), 0);
  EXPECT_NE(render::read_png(other / "sheet.png"), render::read_png(first / "sheet.png"));
}

TEST(RenderedFiles, OfAHundredThousandTrianglesAreDrawn) {
  const Folder folder;
  const ClothMesh mesh = make_rectangle(1, 1, 100000, MeshFamily::unionjack, 1);
  std::vector<Eigen::Vector3d> x = mesh.rest;
  for (Eigen::Vector3d& p : x) p.z() = 0.05 * std::sin(2 * std::numbers::pi * p.x() / 0.5);
  write_ply(folder.path() / "large.ply", mesh, x, {});
  EXPECT_EQ(
      rendered(folder.path() / "out", {(folder.path() / "large.ply").string()}, {{"look", "curvature"}}), 0);
  // A shallow z = a sin(qx) has a q^2/sqrt(2) along its length; the arc of a steep one bends less.
  const double rms = manifest_in(folder.path() / "out")["metrics"]["large.curvature_rms_per_m"];
  EXPECT_GT(rms, 3);
  EXPECT_LT(rms, 0.05 * std::pow(2 * std::numbers::pi / 0.5, 2) / std::sqrt(2));
}

TEST(RenderedFiles, ThatAreBesideTheirPictureFail) {
  const Folder folder;
  const std::string mesh = write(folder.path() / "flat.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const Error error = test::thrown_error([&] {
    rendered(folder.path() / "out", {mesh},
             {{"render.low", Numbers{5, 5, 5}}, {"render.high", Numbers{6, 6, 6}}});
  });
  EXPECT_EQ(error.exit_code(), 3);
  EXPECT_EQ(error.what(), "mesh " + mesh + " is not in its picture: frame where it is");
}

TEST(RenderedFiles, WhatIsNoSequenceIsRefusedInOneLine) {
  const Folder folder;
  const std::string here = folder.path().string();
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  const std::string good = write(folder.path() / "good.obj", triangle);
  const std::string ply =
      write(folder.path() / "other.ply",
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
            "property float z\nelement face 1\nproperty list uchar int vertex_index\n"
            "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  fs::create_directories(folder.path() / "empty");
  EXPECT_EQ(refusal({}), "needs mesh files or folders: hysteron render FILES...");
  EXPECT_EQ(refusal({here + "/none.obj"}), "no such file or folder: " + here + "/none.obj");
  EXPECT_EQ(refusal({here + "/empty"}), "the folder " + here + "/empty holds no .obj and no .ply");
  EXPECT_EQ(refusal({good, ply}), "one sequence of two formats: " + good + " and " + ply);
  const std::string text = write(folder.path() / "note.txt", "");
  EXPECT_EQ(refusal({text}), "mesh " + text + ": its name must end in .obj or .ply");
  const std::string bare = write(folder.path() / "bare/a.obj", "v 0 0 0\n");
  EXPECT_EQ(refusal({good, bare}), "mesh " + bare + ": no faces");
  const std::string nan = write(folder.path() / "nan/a.obj", "v 0 0 0\nv 1 0 nan\nv 0 1 0\nf 1 2 3\n");
  EXPECT_EQ(refusal({here + "/nan"}), "mesh " + nan + ": line 2: coordinate \"nan\" must be a finite number");
}

TEST(RenderedFiles, OptionsOutOfRangeAreRefused) {
  const Folder folder;
  const std::string good = write(folder.path() / "good.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_EQ(refusal({good}, {{"render.ground", "low"}}),
            "render.ground = low must be a height [m] or none (--render.ground)");
  EXPECT_EQ(refusal({good}, {{"render.low", Numbers{1, 0, 0}}, {"render.high", Numbers{0, 1, 1}}}),
            "render.low must be less than render.high in x, y and z (--render.low, --render.high)");
  EXPECT_EQ(refusal({good}, {{"look", "friction"}}),
            "look = friction must be cloth | grid | clay | curvature | wireframe | silhouette (--look)");
  EXPECT_EQ(refusal({good}, {{"render.unit", "foot"}}),
            "render.unit = foot must be metre | centimetre | millimetre | inch (--render.unit)");
  EXPECT_EQ(refusal({good}, {{"render.up", "z,y"}}),
            "render.up = z,y must be one value, or as many as sequences: 1 (--render.up)");
  EXPECT_EQ(refusal({good}, {{"fps", "0"}}), "fps = 0 must be a number in (0, 10000] [1/s] (--fps)");
  EXPECT_EQ(refusal({good}, {{"render.body", (folder.path() / "no.obj").string()}}),
            "no such file or folder: " + (folder.path() / "no.obj").string());
  EXPECT_EQ(refusal({good}, {{"look", "curvature"}, {"render.curvature", "file"}}),
            "mesh " + good + ": no property curvature of its vertices (--render.curvature file)");
}

}  // namespace
}  // namespace hysteron::experiments
