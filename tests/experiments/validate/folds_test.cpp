// These tests compare folds of drapes with those of real cloth.
#include "experiments/validate/folds.h"

#include "tests/experiments/folder.h"

namespace hysteron::experiments {
namespace {

// Gong, Mao, Wang 2024 measured 7 to 10 folds at 48.3 %, 6 to 8 at 57.4, 2 to 3 at 91.2, 10 to 14 at 16.4.
TEST(RealFolds, RangeIsThatOfBothFabricsAround) {
  const FoldRange between = real_folds(50);
  EXPECT_EQ(between.fewest, 6);
  EXPECT_EQ(between.most, 10);
  const FoldRange limpest = real_folds(5), stiffest = real_folds(99);
  EXPECT_EQ(limpest.fewest, 10);
  EXPECT_EQ(limpest.most, 14);
  EXPECT_EQ(stiffest.fewest, 2);
  EXPECT_TRUE(stiffest.has(3));
  EXPECT_FALSE(stiffest.has(7));
}

// Stiffer cloth has fewer folds: no range lies above one of a limper cloth.
TEST(RealFolds, StifferClothHasNoMoreFolds) {
  for (double coefficient = 15; coefficient < 90; coefficient += 5)
    EXPECT_LE(real_folds(coefficient + 10).fewest, real_folds(coefficient).most) << coefficient;
  EXPECT_LT(real_folds(92).most, real_folds(16).fewest);
}

// Eight folds at 50 % are as real, two are not; of a fabric and law each the share of its own drapes.
TEST(ComparedFolds, ShareIsThatOfEachFabricAndLaw) {
  const Folder folder;
  ExperimentRun run({"validate", "hysteron validate", {}, {}}, setup_in(folder.path() / "out"));
  compare_folds(run,
                {{"wool", "prandtl", 50, 8},
                 {"wool", "prandtl", 50, 2},
                 {"wool", "linear", 50, 6},
                 {"silk", "prandtl", 50, 2}},
                false);
  EXPECT_EQ(run.metrics()["wool-prandtl.folds_as_real_percent"].number(), 50);
  EXPECT_EQ(run.metrics()["wool-linear.folds_as_real_percent"].number(), 100);
  EXPECT_EQ(run.metrics()["silk-prandtl.folds_as_real_percent"].number(), 0);
}

// A drape that came to no end has no coefficient.
TEST(ComparedFolds, AreReadFromAStudysTable) {
  const Folder folder;
  const std::vector<CountedDrape> read = read_counted(folder.write(
      "table.csv", "law,fabric,drape_coefficient_percent,node_count\nprandtl,wool,50.5,8\nlinear,wool,,\n"));
  ASSERT_EQ(read.size(), 1u);
  EXPECT_EQ(read[0].fabric, "wool");
  EXPECT_EQ(read[0].coefficient, 50.5);
  EXPECT_EQ(read[0].folds, 8);
  EXPECT_THROW(read_counted(folder.write("table.csv", "law,fabric\nprandtl,wool\n")), Error);
}

}  // namespace
}  // namespace hysteron::experiments
