// `hysteron diff` as a script meets it.
#include "experiments/diff/diff.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "render/color_map.h"
#include "render/compare.h"
#include "render/plane.h"
#include "sim/base/csv.h"
#include "tests/experiments/program.h"

namespace hysteron::experiments {
namespace {

render::Image ramp(int width = 64, int height = 48) {
  render::Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c) image.at(x, y)[c] = static_cast<std::uint8_t>(40 + 2 * x + y + 10 * c);
  return image;
}

// The ramp with a square of `side` pixels that is `steps` brighter.
render::Image marked(int side, int steps) {
  render::Image image = ramp();
  for (int y = 10; y < 10 + side; ++y)
    for (int x = 20; x < 20 + side; ++x)
      for (int c = 0; c < 3; ++c) image.at(x, y)[c] = static_cast<std::uint8_t>(image.at(x, y)[c] + steps);
  return image;
}

bool one_line(const std::string& text) { return std::count(text.begin(), text.end(), '\n') == 1; }

// The fixture has two pictures that differ in 8 x 8 of 64 x 48 pixels by 20 steps.
class Diff : public testing::Test {
 protected:
  Diff() {
    render::write_png(a_, ramp());
    render::write_png(b_, marked(8, 20));
  }
  Outcome diff(int exit_code, const std::string& more = "") const {
    return ended(exit_code, "diff " + a_ + " " + b_ + " " + more);
  }

  Folder folder_;
  std::string a_ = folder_.path() / "a.png", b_ = folder_.path() / "b.png";
};

TEST_F(Diff, PrintsEveryMeasureByItsName) {
  const Outcome outcome = diff(0);
  EXPECT_EQ(outcome.err, "");
  std::istringstream lines(outcome.out);
  std::string name;
  double value = 0;
  std::vector<std::string> names;
  std::vector<double> values;
  while (lines >> name >> value) names.push_back(name), values.push_back(value);
  EXPECT_EQ(names, (std::vector<std::string>{"mean_abs", "rmse", "psnr_db", "ssim", "flip",
                                             "pixels_over_8_percent"}));
  const double fraction = 64.0 / (64 * 48), digits = 1e-5;  // six significant ones are printed
  ASSERT_EQ(values.size(), 6u);
  EXPECT_NEAR(values[0], 20 * fraction, digits);
  EXPECT_NEAR(values[1], 20 * std::sqrt(fraction), digits * 10);
  EXPECT_NEAR(values[2], 20 * std::log10(255 / (20 * std::sqrt(fraction))), digits * 10);
  EXPECT_NEAR(values[3], render::ssim(ramp(), marked(8, 20)), digits);
  EXPECT_NEAR(values[4], render::flip(ramp(), marked(8, 20)), digits);
  EXPECT_NEAR(values[5], 100 * fraction, digits * 10);
}

TEST_F(Diff, OfEqualPicturesBreaksNoLimit) {
  const Outcome outcome = finished("diff " + a_ + " " + a_ +
                                   " --max-mean 0 --max-rmse 0 --min-psnr 1000 --min-ssim 1 --max-flip 0 "
                                   "--max-pixels-over-8 0");
  EXPECT_EQ(outcome.out, "mean_abs 0\nrmse 0\npsnr_db inf\nssim 1\nflip 0\npixels_over_8_percent 0\n");
}

// Each limit by itself, on both sides of what is found.
TEST_F(Diff, ExitsWithFourBeyondEachLimitAndNamesItTheValueAndBothFiles) {
  const Measures found = compare_files(a_, b_, {}).measures;
  for (const Measure& m : all_measures()) {
    const double value = found.*m.value, margin = 0.01 * std::abs(value);
    const auto limited = [&](int exit_code, double limit) {
      return diff(exit_code, std::string("--") + m.limit + " " + std::to_string(limit));
    };
    limited(0, m.least ? value - margin : value + margin);
    const Outcome outcome =
        limited(4, m.least ? std::min(value + margin, m.value == &Measures::ssim ? 1 : 1e9) : value - margin);
    EXPECT_TRUE(one_line(outcome.err)) << outcome.err;
    for (const std::string& part : {a_, b_, std::string("--") + m.limit, std::string(m.name) + " = "})
      EXPECT_TRUE(says(outcome.err, part));
    EXPECT_TRUE(says(outcome.out, "pixels_over_8_percent ")) << "results are printed anyway";
  }
}

TEST_F(Diff, NamesAllLimitsThatAreBrokenInOneLine) {
  const Outcome outcome = diff(4, "--max-mean 0.1 --min-ssim 0.5 --max-pixels-over-8 1");
  EXPECT_TRUE(one_line(outcome.err)) << outcome.err;
  EXPECT_TRUE(says(outcome.err, "must be <= 0.1 (--max-mean); pixels_over_8_percent = 2.08"));
  EXPECT_FALSE(says(outcome.err, "ssim"));
}

TEST_F(Diff, WritesAHeatMapOfStepsOrOfFlip) {
  const fs::path heat = folder_.path() / "new" / "heat.png";
  diff(4, "--max-mean 0" + out_flag(heat));
  EXPECT_EQ(render::read_png(heat), render::heat_map(ramp(), marked(8, 20)));
  EXPECT_TRUE(says(diff(2, "--map flip").err, "--map flip is not used: map needs --out (no --out)"));
  diff(0, "--map flip" + out_flag(heat));
  EXPECT_EQ(render::read_png(heat), render::heat_map(render::flip_map(ramp(), marked(8, 20))));
}

TEST_F(Diff, PrintsOneJsonObject) {
  const Json json = json_in(diff(4, "--json --max-mean 0.1").out, "stdout");
  EXPECT_EQ(json["a"], a_);
  EXPECT_DOUBLE_EQ(json["mean_abs"], 20 * 64.0 / (64 * 48));
  EXPECT_EQ(json["broken"].size(), 1u);
  const Json equal = json_in(program("diff --json " + a_ + " " + a_).out, "stdout");
  EXPECT_TRUE(equal["psnr_db"].is_null());
  EXPECT_EQ(equal["ssim"], 1);
}

TEST_F(Diff, RefusesWhatItCannotCompareInOneLine) {
  const fs::path root = folder_.path();
  render::write_png(root / "small.png", ramp(30, 20));
  std::ofstream(root / "text.png") << "no picture";
  std::ofstream(root / "cut.png", std::ios::binary) << file_content(a_).substr(0, 300);
  fs::create_directories(root / "empty");
  const auto refused = [&](const std::string& arguments, const std::vector<std::string>& parts) {
    const Outcome outcome = ended(2, "diff " + arguments);
    EXPECT_EQ(outcome.out, "") << arguments;
    EXPECT_TRUE(one_line(outcome.err)) << outcome.err;
    for (const std::string& part : parts) EXPECT_TRUE(says(outcome.err, part));
  };
  const auto in = [&](const char* name) { return (root / name).string(); };
  refused(a_ + " " + in("small.png"), {a_, "64 x 48", in("small.png"), "30 x 20"});
  refused(a_ + " " + in("nowhere.png"), {in("nowhere.png")});
  refused(a_ + " " + in("text.png"), {in("text.png"), "not a PNG"});
  refused(a_ + " " + in("cut.png"), {in("cut.png")});
  refused(a_ + " " + in("empty"), {in("empty"), "is a folder", a_});
  refused(in("empty") + " " + in("empty"), {"no *.png"});
  refused(a_, {"needs two pictures", "1 given"});
  refused(a_ + " " + b_ + " --min-ssim 1.5", {"min-ssim = 1.5", "in [-1, 1]"});
  refused(a_ + " " + b_ + " --max-mean few", {"max-mean"});
  refused(a_ + " " + b_ + " --out " + in("empty"), {"*.png"});
}

TEST_F(Diff, OfAPictureThatCannotBeReadIsAnErrorOfItsTestCase) {
  const std::string xml = folder_.path() / "tests.xml";
  for (const std::string& other : {folder_.path().string() + "/nowhere.png", xml}) {
    refused("diff " + a_ + " " + other + " --junit " + xml);
    EXPECT_TRUE(says(file_content(xml), "failures=\"0\" errors=\"1\""));
  }
}

// A hole shows what lies behind: white through black, and black through white.
TEST_F(Diff, ComparesWhatShowsThrough) {
  constexpr int kSide = 8;
  for (const int grey : {0, 128, 255}) {
    render::Image opaque(kSide, kSide, 4), hole(kSide, kSide, 4);
    for (int i = 0; i < kSide * kSide; ++i)
      for (int c = 0; c < 4; ++c) {
        opaque.pixels()[4 * i + c] = static_cast<std::uint8_t>(c < 3 ? grey : 255);
        hole.pixels()[4 * i + c] = static_cast<std::uint8_t>(c < 3 ? grey : i == 0 ? 0 : 255);
      }
    const Measures found = compare_pictures(opaque, hole, {}).measures;
    const double largest = std::max(grey, 255 - grey), pixels = kSide * kSide;
    EXPECT_DOUBLE_EQ(found.mean_abs, largest / pixels) << grey;
    EXPECT_DOUBLE_EQ(found.pixels_over_8_percent, 100 / pixels) << grey;
    EXPECT_LT(found.ssim, 1) << grey;
    EXPECT_GT(found.flip, 0) << grey;
    EXPECT_EQ(compare_pictures(hole, hole, {}).measures.mean_abs, 0) << grey;
  }
}

TEST_F(Diff, WritesOntoNeitherPicture) {
  for (const std::string& picture : {a_, b_}) {
    const std::string before = file_content(picture);
    const Outcome outcome =
        diff(2, "--out " + folder_.path().string() + "/./" + fs::path(picture).filename().string());
    EXPECT_TRUE(says(outcome.err, "which is compared: give another name"));
    EXPECT_EQ(file_content(picture), before);
  }
}

// The fixture has two folders with pictures in two places; the second picture differs.
class DiffOfFolders : public testing::Test {
 protected:
  DiffOfFolders() {
    for (const fs::path& side : {a_, b_}) {
      fs::create_directories(side / "frames");
      render::write_png(side / "sheet.png", ramp());
      std::ofstream(side / "notes.txt") << "no picture";
    }
    render::write_png(a_ / "frames/0000.png", ramp());
    render::write_png(b_ / "frames/0000.png", marked(8, 20));
  }
  Outcome diff(int exit_code, const std::string& more = "") const {
    return ended(exit_code, "diff " + a_.string() + " " + b_.string() + " " + more);
  }
  Folder folder_;
  fs::path a_ = folder_.path() / "a", b_ = folder_.path() / "b", out_ = folder_.path() / "out";
};

TEST_F(DiffOfFolders, HasARowForEachPictureAndTheWorst) {
  const Outcome outcome = diff(0);
  std::istringstream lines(outcome.out);
  std::vector<std::string> names;
  std::vector<double> means;
  std::string line;
  std::getline(lines, line);
  for (std::string name; std::getline(lines, line);) {
    double mean = 0;
    std::istringstream(line) >> name >> mean;
    names.push_back(name);
    means.push_back(mean);
  }
  EXPECT_EQ(names, (std::vector<std::string>{"frames/0000.png", "sheet.png", "worst"}));
  ASSERT_EQ(means.size(), 3u);
  EXPECT_GT(means[0], 0);
  EXPECT_EQ(means[1], 0);
  EXPECT_EQ(means[2], means[0]);
}

// Names in capitals, and pictures in a folder that a link leads to; a link to where it stands is not
// followed.
TEST_F(DiffOfFolders, OverlooksNoPicture) {
  const fs::path elsewhere = folder_.path() / "elsewhere";
  for (const fs::path& top : {a_, b_}) {
    fs::create_directories(elsewhere / top.filename());
    fs::create_directory_symlink(elsewhere / top.filename(), top / "linked");
    fs::create_directory_symlink("..", top / "linked" / "up");
    render::write_png(top / "SHOT.PNG", top == a_ ? ramp() : marked(8, 20));
    render::write_png(top / "linked" / "c.png", top == a_ ? ramp() : marked(8, 20));
  }
  const std::vector<std::string> names = pictures_in_either(a_, b_);
  for (const char* name : {"SHOT.PNG", "linked/c.png"})
    EXPECT_TRUE(std::count(names.begin(), names.end(), name)) << name;
  EXPECT_EQ(std::count(names.begin(), names.end(), "linked/up/linked/c.png"), 0);
  const Outcome outcome = ended(4, "diff " + a_.string() + " " + b_.string() + " --max-mean 0");
  for (const char* name : {"SHOT.PNG", "linked/c.png"}) EXPECT_TRUE(says(outcome.err, name)) << outcome.err;
}

TEST_F(DiffOfFolders, HoldsEachPictureToTheLimits) {
  const Outcome outcome = diff(4, "--max-mean 0.1");
  EXPECT_TRUE(one_line(outcome.err)) << outcome.err;
  EXPECT_TRUE(says(outcome.err, (b_ / "frames/0000.png").string()));
  diff(0, "--max-mean 1");
}

// One is missing on each side, one is broken, one has another size; the rest goes on.
TEST_F(DiffOfFolders, HasAnErrorOfItsOwnForEachPictureThatCannotBeCompared) {
  render::write_png(a_ / "frames/0001.png", ramp());
  render::write_png(b_ / "frames/0002.png", ramp());
  for (const fs::path& side : {a_, b_}) {
    std::ofstream(side / "cut.png", std::ios::binary) << file_content(a_ / "sheet.png").substr(0, 300);
    render::write_png(side / "small.png", side == a_ ? ramp() : ramp(30, 20));
  }
  const fs::path xml = folder_.path() / "tests.xml";
  const Outcome outcome = diff(2, "--max-mean 0.1" + out_flag(out_) + " --junit " + xml.string());
  const std::pair<const char*, const char*> kCases[] = {{"frames/0001.png", "missing in"},
                                                        {"frames/0002.png", "missing in"},
                                                        {"cut.png", "a broken PNG picture"},
                                                        {"small.png", "30 x 20"}};
  const std::string csv = file_content(out_ / "diff.csv"), tests = file_content(xml);
  for (const auto& [name, reason] : kCases) {
    const auto printed_line = [&, name = name](const std::string& text) {
      const std::size_t at = text.find(name);
      return at == text.npos ? "" : text.substr(at, text.find('\n', at) - at);
    };
    for (const std::string& line : {printed_line(csv), printed_line(outcome.err), printed_line(tests)})
      EXPECT_TRUE(says(line, reason)) << name << ": " << line;
    EXPECT_TRUE(says(printed_line(tests), "<error ")) << name;
    EXPECT_TRUE(says(printed_line(csv), ",,,,,,")) << name << ": no measures";
  }
  EXPECT_TRUE(says(tests, "tests=\"6\" failures=\"1\" errors=\"4\""));
  EXPECT_TRUE(says(csv, "\nsheet.png,0,0,,1,0,0,\n"));
  EXPECT_TRUE(fs::exists(out_ / "heat/frames/0000.png"));
  const Json json = json_in(diff(2, "--json").out, "stdout");
  EXPECT_EQ(json["pictures"].size(), 6u);
  EXPECT_EQ(json["worst"]["flip"], json["pictures"][1]["flip"]) << "of those that were compared";
}

TEST_F(DiffOfFolders, WithNothingToCompareHasNoWorst) {
  const fs::path empty = folder_.path() / "empty";
  fs::create_directories(empty);
  const Outcome outcome = ended(2, "diff --json " + a_.string() + " " + empty.string());
  EXPECT_FALSE(json_in(outcome.out, "stdout").contains("worst"));
}

TEST_F(DiffOfFolders, WritesHeatMapsAndATable) {
  diff(4, "--max-flip 0.001" + out_flag(out_));
  EXPECT_EQ(render::read_png(out_ / "heat/frames/0000.png"), render::heat_map(ramp(), marked(8, 20)));
  const std::string csv = file_content(out_ / "diff.csv");
  EXPECT_EQ(csv.substr(0, csv.find('\n')),
            "picture,mean_abs [steps],rmse [steps],psnr [dB],ssim,flip,pixels_over_8 [%],error");
  EXPECT_TRUE(says(csv, "\nsheet.png,0,0,,1,0,0,\n"));
}

TEST_F(DiffOfFolders, LeavesNoHeatMapOfAPictureThatIsNotComparedAnyMore) {
  diff(0, out_flag(out_));
  ASSERT_TRUE(fs::exists(out_ / "heat/sheet.png"));
  std::ofstream(out_ / "heat/mine.txt") << "of another\n";
  fs::remove(a_ / "sheet.png");
  diff(2, out_flag(out_));  // it is missing in one folder
  EXPECT_FALSE(fs::exists(out_ / "heat/sheet.png"));
  EXPECT_TRUE(fs::exists(out_ / "heat/frames/0000.png"));
  EXPECT_TRUE(fs::exists(out_ / "heat/mine.txt"));
}

TEST_F(DiffOfFolders, RefusesToWriteWhereItReads) {
  const Outcome outcome = diff(2, "--out " + (b_ / "difference").string());
  EXPECT_TRUE(says(outcome.err, "must not be in"));
  EXPECT_FALSE(fs::exists(b_ / "difference"));
  fs::rename(b_, folder_.path() / "heat");
  const std::string heat = folder_.path() / "heat", before = file_content(heat + "/sheet.png");
  refused("diff " + a_.string() + " " + heat + out_flag(folder_.path()));
  EXPECT_EQ(file_content(heat + "/sheet.png"), before);
}

// 64 of 64 x 48 pixels by 20 steps: mean_abs = 0.417.
TEST_F(Diff, TakesLimitsFromAFileAndFlagsInTheirPlace) {
  const std::string file = folder_.write("limits.toml", "max-mean = 0.4\nmin-ssim = 0.5\n");
  const Outcome outcome = diff(4, "--limits " + file);
  EXPECT_TRUE(one_line(outcome.err)) << outcome.err;
  EXPECT_TRUE(says(outcome.err, "must be <= 0.4 (" + file + ":1)"));
  diff(0, "--limits " + file + " --max-mean 0.5");
  EXPECT_TRUE(says(diff(4, "--limits " + file + " --max-mean 0.3").err, "<= 0.3 (--max-mean)"));
  diff(4, "--limits pictures");  // those that come with the program
}

TEST_F(DiffOfFolders, TakesLimitsOfSomePicturesFromAFile) {
  const auto limited = [&](int exit_code, const std::string& name, const std::string& mean) {
    const std::string limits = "max-mean = 0.1\n[[picture]]\nname = \"" + name + "\"\nmax-mean = " + mean;
    diff(exit_code, "--limits " + folder_.write("limits.toml", limits));
  };
  limited(0, "frames/*.png", "0.5");
  limited(4, "frames/*.png", "0.3");
  limited(4, "sheet.png", "0.5");  // the other picture keeps the limit of all
}

TEST(LimitsFile, TakesAColumnsUnitInBracketsAsItStands) {
  const Folder folder;
  const Limits limits =
      read_limits(folder.write("limits.toml",
                               "[[metric]]\nname = \"metrics.csv:tip [m]\"\nmax-difference = "
                               "2\n[[metric]]\nname = \"energy.*\"\nmax-difference = 3\n"));
  EXPECT_EQ(limits.of_metric("metrics.csv:tip [m]"), 2);
  EXPECT_EQ(limits.of_metric("energy.bending"), 3);
  EXPECT_EQ(limits.of_metric("metrics.csv:tip m"), std::nullopt);
}

// Every picture would pass.
TEST_F(DiffOfFolders, RefusesAFileThatLimitsNoPicture) {
  const std::string metrics =
      folder_.write("limits.toml", "[[metric]]\nname = \"tip_m\"\nmax-difference = 0\n");
  EXPECT_TRUE(says(diff(2, "--limits " + metrics).err,
                   "limits = " + metrics + " must limit a picture that is compared, and limits none"));
  const std::string other = folder_.write("other.toml", "[[picture]]\nname = \"a.png\"\nmax-mean = 0\n");
  const std::string sheet = (a_ / "sheet.png").string();
  EXPECT_TRUE(says(refused("diff " + sheet + " " + sheet + " --limits " + other),
                   "must limit sheet.png, and limits none (--limits)"));
}

TEST_F(DiffOfFolders, WritesATestCaseForEachPicture) {
  const std::string file = folder_.path() / "new" / "tests.xml";
  diff(4, "--max-mean 0.1 --junit " + file);
  const std::string xml = file_content(file);
  for (const char* part :
       {"tests=\"2\" failures=\"1\"", "<testcase name=\"sheet.png\" classname=\"hysteron.diff\"",
        "<failure message=\"mean_abs = 0.416667 must be &lt;= 0.1 (--max-mean)\""})
    EXPECT_TRUE(says(xml, part));
}

TEST(LimitsFile, RefusesInOneLineWhatIsNoLimit) {
  const Folder folder;
  const std::pair<const char*, const char*> kCases[] = {
      {"max-flop = 1", "unknown key max-flop"},
      {"max-flip = 2", "max-flip = 2 must be in [0, 1]"},
      {"max-flip = [1]", "max-flip"},
      {"[picture]\nmax-flip = 1", "must be an array of tables, [[picture]]"},
      {"[[picture]]\nmax-flip = 1", "a limit needs a name"},
      {"[[metric]]\nname = \"a\"", "needs max-difference"},
      {"[[metric]]\nname = \"a\"\nmax-difference = -1", "must be >= 0"}};
  for (const auto& [text, message] : kCases) {
    const std::string file = folder.write("limits.toml", text);
    const std::string said = refused("diff " + file + " " + file + " --limits " + file);
    EXPECT_TRUE(one_line(said)) << said;
    EXPECT_TRUE(says(said, message));
    EXPECT_TRUE(says(said, "limits.toml:"));
  }
}

TEST(BrokenLimits, CountNotANumberAsBroken) {
  PictureLimits limits;
  Measures found;
  EXPECT_TRUE(broken_limits(found, limits).empty());
  limits.values.flip = 0.5;
  found.flip = std::nan("");
  EXPECT_EQ(broken_limits(found, limits).size(), 1u);
}

}  // namespace
}  // namespace hysteron::experiments
