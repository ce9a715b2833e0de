// The figure of a validation: from recorded tables to plots, and nothing recorded is missing.
#include "experiments/validate/figure.h"

#include <algorithm>
#include <fstream>

#include "tests/experiments/folder.h"

namespace hysteron::experiments {
namespace {

// Tables as a study and a validation write them.
class RecordedDrapes : public testing::Test {
 protected:
  RecordedDrapes() {
    fs::create_directories(spread() / "wool");
    std::ofstream(means())
        << "law,fabric,drape_coefficient_percent_mean\nprandtl,wool,48.5\nlinear,wool,43\npabst,wool,51\n";
    std::ofstream(spread() / "wool/predictions.csv")
        << "predicted quantity,low,high,measured\ndrape of wool,40,54,49.8\nfolds of wool,3,6,5\n";
  }
  fs::path means() const { return folder_.path() / "means.csv"; }
  fs::path spread() const { return folder_.path() / "spread"; }

  Folder folder_;
};

TEST_F(RecordedDrapes, HaveTheirMeansIntervalsAndMeasuredCoefficient) {
  const std::vector<PredictedDrape> drapes = read_drapes(means(), spread());
  ASSERT_EQ(drapes.size(), 1u);
  EXPECT_EQ(drapes[0].fabric, "wool");
  EXPECT_EQ(drapes[0].mean, 48.5);
  EXPECT_EQ(drapes[0].elastic, 43);
  EXPECT_EQ(drapes[0].low, 40);
  EXPECT_EQ(drapes[0].high, 54);
  EXPECT_EQ(drapes[0].measured, 49.8);
}

TEST_F(RecordedDrapes, WithoutAnIntervalAreRefused) {
  fs::remove(spread() / "wool/predictions.csv");
  EXPECT_THROW(read_drapes(means(), spread()), Error);
}

// Each panel has its data: loops measured and simulated row by row, a decay that falls to its
// knee and beyond, every fabric's drapes and folds.
TEST(ValidationPage, IsDrawnFromWhatIsRecorded) {
  const render::PlotPage page = validation_page(HYSTERON_RESULTS, recorded_drapes(HYSTERON_RESULTS));
  ASSERT_EQ(page.plots.size(), 4u);
  const auto& loops = page.plots[0].plot.series;
  ASSERT_EQ(loops.size(), 2u);
  EXPECT_GT(loops[0].x.size(), 50u);
  EXPECT_EQ(loops[0].x, loops[1].x);
  const auto& decay = page.plots[1].plot.series;
  ASSERT_EQ(decay.size(), 4u);
  EXPECT_NEAR(decay[1].y[0], decay[0].y[0], 0.02 * decay[0].y[0])
      << "the curve begins at the first amplitude";
  EXPECT_TRUE(std::is_sorted(decay[1].y.rbegin(), decay[1].y.rend()));
  EXPECT_GT(decay[2].y[0], decay[3].y[0]) << "a knee above a fifth";
  const auto& drapes = page.plots[2].plot.series;
  EXPECT_EQ(drapes.back().x.size(), 4u) << "fabrics";
  EXPECT_EQ(page.plots[3].plot.series.size(), 10u + 4u) << "real fabrics and ours";
}

}  // namespace
}  // namespace hysteron::experiments
