#include <fstream>

#include "experiments/workbench/pages/report.h"

#include "experiments/workbench/pages/manifest.h"
#include "experiments/workbench/pages/page.h"
#include "experiments/workbench/session/record.h"
#include "render/image.h"
#include "tests/experiments/folder.h"

namespace hysteron::experiments {
namespace {

std::string encoded(const std::string& text) {
  return base64({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

TEST(Base64, GivesTheVectorsOfRfc4648) {
  EXPECT_EQ(encoded(""), "");
  EXPECT_EQ(encoded("f"), "Zg==");
  EXPECT_EQ(encoded("fo"), "Zm8=");
  EXPECT_EQ(encoded("foo"), "Zm9v");
  EXPECT_EQ(encoded("foobar"), "Zm9vYmFy");
  EXPECT_EQ(encoded("\xff\xfe\x80 bar"), "//6AIGJhcg==");
}

class Report : public testing::Test {
 protected:
  Report() {
    ExperimentRun run(drape_line(), setup_in(folder_.path()));
    run.metric("drape_coefficient_percent", 49.8);
    run.metric("energy_remainder_relative", 2.60106e-16);
    run.manifest().energy = {{"bending_friction", 0.25}};
    TimeSeriesWriter record(run.path("metrics.csv"), {"time [s]", "kinetic [J]"});
    for (int i = 0; i < 5; ++i) record.row({0.1 * i, 1.0 - 0.1 * i});
    record.finish();
    render::write_png(run.path("sheet.png"), render::Image(64, 32, render::Rgb8{200, 10, 10}));
    for (int i = 0; i < 50; ++i) {
      render::write_png(run.path("frames/" + std::to_string(1000 + i) + ".png"),
                        render::Image(400, 100, render::Rgb8{10, 200, 10}));
    }
    std::ofstream(run.path("plot_energy.svg")) << "<svg xmlns=\"http://www.w3.org/2000/svg\"/>";
    render::write_png(run.path("plot_energy.png"), render::Image(64, 32, render::Rgb8{10, 10, 200}));
    run.finish();
  }
  std::string html() const { return file_content(write_report(folder_.path())); }
  Folder folder_;
};

TEST_F(Report, ShowsTheSheetThePlotOnceAndPlaysItsFrames) {
  const std::string page = html();
  EXPECT_EQ(occurrences(page, "alt=\"contact sheet\""), 1);
  EXPECT_EQ(occurrences(page, "alt=\"plot_energy\""), 1);
  EXPECT_EQ(occurrences(page, "class=\"player\""), 1);
  EXPECT_EQ(occurrences(page, "alt=\"frames/"), 24);
  EXPECT_TRUE(says(page, "alt=\"frames/1000.png\""));
  EXPECT_TRUE(says(page, "alt=\"frames/1049.png\""));
}

TEST_F(Report, OpensWithTheQuestionTheNumberAndThePictureThatAnswerIt) {
  const std::string page = html();
  std::size_t at = 0;
  for (const char* part :
       {"Cusick", ">49.8 <small>%</small>", "src=\"sheet.png\"", "src=\"plot_energy.svg\""}) {
    const std::size_t found = page.find(part);
    ASSERT_NE(found, std::string::npos) << part;
    EXPECT_GT(found, at) << part;
    at = found;
  }
}

TEST_F(Report, FoldsTheSolversFiguresAway) {
  const std::string page = html(), fold = "<details><summary>Numerics";
  ASSERT_EQ(occurrences(page, fold), 1);
  EXPECT_GT(page.find("energy remainder relative"), page.find(fold));
  EXPECT_GT(page.find("kinetic [J]"), page.find(fold));
  EXPECT_LT(page.find("drape coefficient"), page.find(fold));
  EXPECT_EQ(occurrences(page, "2.60106e-16"), 0);
}

// Pictures and plots that lie in the folder and that the manifest does not list are another's.
TEST_F(Report, ShowsNoPictureThatIsNotTheRuns) {
  const std::string own = html();
  render::write_png(folder_.path() / "holiday.png", render::Image(64, 32));
  render::write_png(folder_.path() / "plot_holiday.png", render::Image(64, 32));
  std::ofstream(folder_.path() / "plot_journey.svg") << "<svg xmlns=\"http://www.w3.org/2000/svg\"/>";
  EXPECT_EQ(html(), own);
  // Files of the same names are shown if they are listed as pictures of the run.
  Json manifest = manifest_in(folder_.path());
  for (const char* name : {"holiday.png", "plot_holiday.png", "plot_journey.svg"})
    manifest["files"].push_back(name);
  std::ofstream(folder_.path() / "manifest.json") << manifest.dump();
  const std::string page = html();
  for (const char* alt : {"alt=\"holiday.png\"", "alt=\"plot_holiday\"", "alt=\"plot_journey\""})
    EXPECT_EQ(occurrences(page, alt), 1) << alt;
}

TEST_F(Report, HasTheClothInItThatTheRunKept) {
  EXPECT_EQ(occurrences(html(), "class=\"turn\""), 0);
  std::ofstream(folder_.path() / "sheet.hyg") << "foobar";
  const std::string page = html();
  EXPECT_EQ(occurrences(page, "<script type=\"text/plain\">Zm9vYmFy</script>"), 1);
  EXPECT_EQ(occurrences(page, "DecompressionStream"), 1);
}

TEST(ShownQuantity, HasThePrefixThatLeavesOneToThreeDigits) {
  const auto text = [](double value, const char* unit) {
    const ShownQuantity shown = shown_quantity(value, unit);
    return shown.value + " " + shown.unit;
  };
  EXPECT_EQ(text(0.0009377, "N"), "937.7 µN");
  EXPECT_EQ(text(-0.0123456, "m"), "-12.35 mm");
  EXPECT_EQ(text(3.5e-5, "N m"), "35 µN m");
  EXPECT_EQ(text(1500, "J"), "1.5 kJ");
  EXPECT_EQ(text(0, "J"), "0 J");
  EXPECT_EQ(text(2.6e-16, "J"), "0 J");
  EXPECT_EQ(text(31.02345, "1/m"), "31.02 1/m");
  EXPECT_EQ(text(86.03, "%"), "86.03 %");
}

TEST(ReportOfSeveralLaws, HasARowForEachAndAColumnForEachMetric) {
  const Folder folder;
  ExperimentRun run({"kes", "hysteron kes", {}, {}}, setup_in(folder.path()).options, Json::object());
  for (const char* law : {"wong", "pabst"}) run.metric(std::string(law) + ".2HB_N", law[0] == 'w' ? 0.5 : 0);
  run.metric("recovery_cases", 3);
  run.finish();
  const std::string page = file_content(write_report(folder.path()));
  EXPECT_EQ(occurrences(page, "2HB [N]"), 1);
  EXPECT_LT(page.find("<td>wong"), page.find("<td>pabst"));
  EXPECT_EQ(occurrences(page, "recovery cases"), 1);
}

TEST(ReportOfSeveralLaws, OpensWithWhatEachAnswers) {
  const Folder folder;
  ExperimentRun run({"fold", "hysteron fold", {}, {}}, setup_in(folder.path()).options, Json::object());
  run.metric("linear.recovery_angle_deg", 180.0);
  run.metric("prandtl.recovery_angle_deg", 116.04);
  run.finish();
  const std::string page = file_content(write_report(folder.path()));
  EXPECT_EQ(occurrences(page, "<b>116.0 <small>degree</small></b><span>prandtl: recovery angle</span>"), 1);
  EXPECT_LT(page.find("linear: recovery angle"), page.find("prandtl: recovery angle"));
}

TEST(ReportOfAFolderWithoutARun, IsAWrongRequest) {
  const Folder folder;
  EXPECT_TRUE(says(test::refusal([&] { write_report(folder.path()); }), "no manifest.json"));
}

TEST(ReportOfAFolder, IsNotPutInPlaceOfAnothersPage) {
  const FinishedRun run("swing --quick --no-images --quiet --triangles 60 --seconds 0.05");
  finished("report " + run.out.string());
  const fs::path page = run.out / "report.html";
  std::ofstream(page) << "<html>my notes</html>";
  EXPECT_TRUE(
      says(refused("report " + run.out.string()), "is a file that is there already and is not a page"));
  EXPECT_EQ(file_content(page), "<html>my notes</html>");
}

TEST(HtmlText, CannotBreakOutOfThePage) {
  EXPECT_EQ(escaped("<a href=\"x\">&"), "&lt;a href=&quot;x&quot;&gt;&amp;");
}

}  // namespace
}  // namespace hysteron::experiments
