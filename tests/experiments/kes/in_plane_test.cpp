// `hysteron kes --test shear|tension`: the law and a specimen of cloth.
#include "sim/base/csv.h"
#include "sim/base/error.h"
#include "tests/experiments/folder.h"

namespace hysteron::experiments {
namespace {

constexpr double kReturnedByLaw = 1, kReturnedByCloth = 3;  // [percent], asked of the tester's numbers

class KesInPlane : public testing::Test {
 protected:
  Json metrics(std::vector<Flag> flags) {
    flags.push_back({"quick", true});
    EXPECT_EQ(run_into(folder_.path(), "kes", std::move(flags)), 0);
    return metrics_of(folder_.path());
  }
  Folder folder_;
};

TEST_F(KesInPlane, ReturnsWhatWasPublishedOfADenim) {
  const Json shear = metrics({{"test", "shear"}, {"fabric", "denim-c-friction"}});
  for (const char* key : {"G_N_per_m", "2HG_N_per_m"})
    EXPECT_LT(std::abs(shear[std::string("published_") + key + "_difference_percent"].get<double>()),
              kReturnedByLaw)
        << key;
  const Table table = read_table(folder_.path() / "table.csv");
  EXPECT_NEAR(table.number(0, "published"), table.number(0, "law"),
              kReturnedByLaw / 100 * table.number(0, "law"));
  const Json tension = metrics({{"test", "tension"}, {"fabric", "denim-c-friction"}});
  for (const char* key : {"WT_J_per_m2", "RT_percent"})
    EXPECT_LT(std::abs(tension[std::string("published_") + key + "_difference_percent"].get<double>()),
              kReturnedByLaw)
        << key;
  EXPECT_TRUE(tension["LT"].is_number());
  for (const char* file : {"table.csv", "loops.csv", "report.html"})
    EXPECT_TRUE(fs::exists(folder_.path() / file)) << file;
}

// Free edges bear no shear, and a coarse mesh is stiff: both within what is asked.
TEST_F(KesInPlane, ReadsTheLawsNumbersFromASpecimenOfCloth) {
  for (const char* test : {"shear", "tension"}) {
    const Json read = metrics({{"test", test}, {"fabric", "denim-c-friction"}, {"on", "strip"}});
    const std::vector<std::string> keys = test == std::string("shear")
                                              ? std::vector<std::string>{"G_N_per_m", "2HG_N_per_m"}
                                              : std::vector<std::string>{"LT", "WT_J_per_m2", "RT_percent"};
    for (const std::string& key : keys) {
      EXPECT_LT(std::abs(read["strip_" + key + "_difference_percent"].get<double>()), kReturnedByCloth)
          << key;
      EXPECT_LT(read["strip_" + key + "_mesh_error_percent"].get<double>(), kReturnedByCloth) << key;
    }
  }
}

// A fabric may be softer along weft; stops are keys like any other.
TEST_F(KesInPlane, TestsTheDirectionAndTheStopsThatFlagsName) {
  const std::vector<Flag> weft = {{"test", "tension"}, {"fabric.weft", 2000}, {"along", "weft"}};
  const Json elastic = metrics(weft);
  constexpr double kTrapezium = 1e-4;  // [percent]
  EXPECT_NEAR(elastic["RT_percent"].get<double>(), 100, kTrapezium);
  std::vector<Flag> rubbing = weft;
  rubbing.push_back({"fabric.membrane.stops.weft.thresholds", Numbers{0.002}});
  rubbing.push_back({"fabric.membrane.stops.weft.stiffnesses", Numbers{5000}});
  const Json loses = metrics(rubbing);
  EXPECT_LT(loses["RT_percent"].get<double>(), 95);
  EXPECT_LT(loses["EMT_percent"].get<double>(), elastic["EMT_percent"].get<double>());
  // Springs and stops, at a tenth of the load.
  rubbing.push_back({"load", 49});
  EXPECT_LT(metrics(rubbing)["EMT_percent"].get<double>(), loses["EMT_percent"].get<double>() / 5);
  EXPECT_THROW(metrics({{"test", "tension"}, {"load", 1e5}}), Error);
}

TEST_F(KesInPlane, RefusesFlagsOfAnotherTest) {
  const auto run = [&](std::vector<Flag> flags) {
    experiment_named("kes").run({"kes", "hysteron kes", std::move(flags), {}});
  };
  EXPECT_THROW(run({{"test", "shear"}, {"law", "pabst"}}), Error);
  EXPECT_THROW(run({{"test", "bending"}, {"load", 100}}), Error);
  EXPECT_THROW(run({{"test", "twist"}}), Error);
}

}  // namespace
}  // namespace hysteron::experiments
