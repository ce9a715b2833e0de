#include "experiments/workbench/pages/report.h"

#include <nlohmann/json.hpp>

#include "experiments/workbench/app/run.h"
#include "experiments/workbench/pages/page.h"
#include "experiments/workbench/session/record.h"
#include "render/image.h"
#include "sim/base/error.h"
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

int count_of(const std::string& text, const std::string& part) {
  int count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

class Report : public testing::Test {
 protected:
  Report() {
    ExperimentRun run(drape_line(), setup_in(folder_.path()));
    run.metric("drape_coefficient_percent", 49.8);
    run.manifest().energy = {{"bending_friction", 0.25}};
    Record record(run.path("metrics.csv"), {"time [s]", "kinetic [J]"});
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
  std::string html() const { return text_of(write_report(folder_.path())); }
  Folder folder_;
};

TEST_F(Report, NamesTheCommandTheResultsAndTheSources) {
  const std::string page = html();
  for (const char* part :
       {"hysteron drape --quick", "cotton-broad", "drape coefficient", "49.8", "bending friction", "0.25",
        "kinetic [J]", "10.4188/jte.61.69", "assumed", "complete"}) {
    EXPECT_NE(page.find(part), std::string::npos) << part;
  }
}

TEST_F(Report, ShowsTheSheetThePlotOnceAndPlaysItsFrames) {
  const std::string page = html();
  EXPECT_EQ(count_of(page, "alt=\"sheet.png\""), 1);
  EXPECT_EQ(count_of(page, "alt=\"plot_energy\""), 1);
  EXPECT_EQ(count_of(page, "class=\"player\""), 1);
  EXPECT_EQ(count_of(page, "alt=\"frames/"), 24);
  EXPECT_NE(page.find("alt=\"frames/1000.png\""), std::string::npos);
  EXPECT_NE(page.find("alt=\"frames/1049.png\""), std::string::npos);
}

TEST(ReportOfSeveralLaws, HasARowForEachAndAColumnForEachMetric) {
  const Folder folder;
  ExperimentRun run({"kes", "hysteron kes", {}, {}}, setup_in(folder.path()).options, Json::object());
  for (const char* law : {"wong", "pabst"}) run.metric(std::string(law) + ".2HB_N", law[0] == 'w' ? 0.5 : 0);
  run.metric("recovery_cases", 3);
  run.finish();
  const std::string page = text_of(write_report(folder.path()));
  EXPECT_EQ(count_of(page, "2HB [N]"), 1);
  EXPECT_LT(page.find("<td>wong"), page.find("<td>pabst"));
  EXPECT_EQ(count_of(page, "recovery cases"), 1);
}

TEST_F(Report, IsTheSameWhenDrawnAgain) { EXPECT_EQ(html(), html()); }

TEST(ReportOfAFolderWithoutARun, IsAWrongRequest) {
  const Folder folder;
  try {
    write_report(folder.path());
    FAIL() << "a report of nothing";
  } catch (const Error& error) {
    EXPECT_EQ(error.exit_code(), 2);
    EXPECT_NE(std::string(error.what()).find("no manifest.json"), std::string::npos) << error.what();
  }
}

TEST(HtmlText, CannotBreakOutOfThePage) {
  EXPECT_EQ(escaped("<a href=\"x\">&"), "&lt;a href=&quot;x&quot;&gt;&amp;");
}

}  // namespace
}  // namespace hysteron::experiments
