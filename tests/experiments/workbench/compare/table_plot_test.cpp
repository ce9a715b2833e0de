#include "experiments/workbench/compare/table_plot.h"

#include <fstream>

#include "tests/experiments/program.h"

namespace hysteron::experiments {
namespace {

// Six columns, five of which have the same table.
class Plots : public testing::Test {
 protected:
  Plots() {
    for (const char* law : {"linear", "pabst", "bridson", "spring", "grinspun-edit", "prandtl"}) {
      ChildRun& column = columns_.emplace_back();
      column.name = law;
      column.folder = folder_.path() / law;
      column.manifest.emplace().keys = std::make_shared<const Json>(Json{{"law", law}});
      column.manifest->metrics = {{"integrator_share_percent", 63.0}};
      fs::create_directories(column.folder);
      std::ofstream(column.folder / "cycles.csv")
          << "cycle,angle\n1,180\n2," << (column.name == "prandtl" ? 150 : 180) << "\n";
    }
  }
  std::string drawn(std::size_t count) {
    ExperimentRun run({"compare", "hysteron compare", {}, {}}, setup_in(folder_.path() / "out"));
    const TablePlot plot{"plot_angle", {"Fold", {"cycle"}, {"angle"}}, "cycles.csv", "cycle", "angle"};
    draw(run, plot, std::vector(columns_.end() - static_cast<std::ptrdiff_t>(count), columns_.end()));
    run.finish();
    return file_content(folder_.path() / "out/plot_angle.svg");
  }

  Folder folder_;
  std::vector<ChildRun> columns_;
};

TEST_F(Plots, UniteLinesThatLieOnEachOtherAndNameThemAll) {
  const std::string svg = drawn(2);
  EXPECT_TRUE(says(svg, "grinspun-edit (integrator 63 %)"));
  EXPECT_TRUE(says(svg, "prandtl (integrator 63 %)"));
  EXPECT_TRUE(says(drawn(3), "spring, grinspun-edit"));
}

// A name as long as five would leave no room for the plot.
TEST_F(Plots, NameManyUnitedLinesBelowTheTitle) {
  const std::string svg = drawn(6);
  EXPECT_TRUE(says(svg, "linear and 4 more"));
  EXPECT_TRUE(says(svg, "as linear: pabst, bridson, spring, grinspun-edit"));
}

// Amplitudes fall to a quarter at t = 3; at half the step they are 2 higher there.
TEST_F(Plots, HaveBandsOfHalfTheStepAndAMarkAtTheKnee) {
  ChildRun& column = columns_.back();
  column.manifest->metrics.set("decay_knee_fraction", 0.5);
  std::ofstream(column.folder / "turns.csv") << "time,amplitude\n1,40\n2,30\n3,10\n";
  fs::create_directories(column.folder / "errors/step");
  std::ofstream(column.folder / "errors/step/turns.csv") << "time,amplitude\n1,40\n2,30\n3,12\n";
  ExperimentRun run({"compare", "hysteron compare", {}, {}}, setup_in(folder_.path() / "out"));
  draw(run,
       TablePlot{"plot_decay",
                 {"Swing", {"time"}, {"amplitude"}},
                 "turns.csv",
                 "time",
                 "amplitude",
                 render::Series::Style::line,
                 1,
                 "decay_knee_fraction"},
       {column});
  run.finish();
  const std::string svg = file_content(folder_.path() / "out/plot_decay.svg");
  EXPECT_TRUE(says(svg, "bands: the change by half the step"));
  EXPECT_TRUE(says(svg, ">knee<"));
}

}  // namespace
}  // namespace hysteron::experiments
