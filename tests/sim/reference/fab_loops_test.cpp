// Loops of a FAB tester: what is read, what is refused, and what is read off them.
#include "sim/reference/fab_loops.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "sim/reference/fab_test.h"
#include "tests/sim/base/folder.h"
#include "tests/sim/base/refusal.h"

namespace hysteron {
namespace {

using test::Folder;
using test::refusal;
using test::says;

constexpr const char* kHeadSi = "direction,test,branch,clamp_distance_m,force_N,gauge_length_m,width_m\n";
constexpr const char* kHeadFab =
    "direction;test;branch;clamp_distance_cm;force_gf;gauge_length_cm;width_cm\n";

// Returns a parallelogram between 18 and 16 mm: forces are 1 N/m apart over 2 mm.
std::string si_rows() {
  std::string text = kHeadSi;
  for (const char* row : {"0,0.018,-0.01", "0,0.0175,-0.01", "0,0.0165,-0.01", "0,0.016,-0.01",
                          "1,0.016,0.03", "1,0.0165,0.03", "1,0.0175,0.03", "1,0.018,0.03"})
    text += std::string("L,D1,") + row + ",0.021,0.04\n";
  return text;
}

std::string fab_rows(const std::string& before) {
  std::string text = before + kHeadFab;
  for (const char* row : {"0;1,8;-1,0197162", "0;1,75;-1,0197162", "0;1,65;-1,0197162", "0;1,6;-1,0197162",
                          "1;1,6;3,0591486", "1;1,65;3,0591486", "1;1,75;3,0591486", "1;1,8;3,0591486"})
    text += std::string("L;D1;") + row + ";2,1;4\n";
  return text;
}

TEST(FabLoops, OfAParallelogramEncloseBaseTimesHeight) {
  const Folder folder;
  const FabLoops loops =
      find_loops(read_fab(folder.write("a.csv", si_rows()), TesterUnits::si, "t"), "L", "D1");
  ASSERT_EQ(loops.cycles(), 1);
  EXPECT_NEAR(loop_area(loops, branch_forces(loops), 0), 2e-3 * 1, 1e-12);
  EXPECT_NEAR(force_range(branch_forces(loops), 0), 1, 1e-12);
}

// 1 gf = 9.80665e-3 N by definition.
TEST(FabLoops, InTheTestersUnitsAreTheSameLoops) {
  const Folder folder;
  const auto si = read_fab(folder.write("a.csv", si_rows()), TesterUnits::si, "t");
  const auto fab =
      read_fab(folder.write("b.csv", fab_rows("FAB 2.1\nfabric; Shirley\n\n")), TesterUnits::fab, "t");
  ASSERT_EQ(fab.size(), 1u);
  for (int b = 0; b < 2; ++b)
    for (int i = 0; i < 4; ++i) {
      EXPECT_NEAR(fab[0].branches[b].distance[i], si[0].branches[b].distance[i], 1e-12);
      EXPECT_NEAR(fab[0].branches[b].force[i], si[0].branches[b].force[i], 1e-7);
    }
}

TEST(FabLoops, AreRefusedInOtherUnitsThanSaid) {
  const Folder folder;
  const std::string si = folder.write("a.csv", si_rows()), fab = folder.write("b.csv", fab_rows(""));
  EXPECT_TRUE(says(refusal([&] { read_fab(si, TesterUnits::fab, "t"); }),
                   "clamp_distance is in m: give --units si, which reads it"));
  EXPECT_TRUE(says(refusal([&] { read_fab(fab, TesterUnits::si, "t"); }),
                   "clamp_distance is in cm: give --units fab, which reads it"));
}

// Which of the two was measured is not known; brackets and capitals make no other column.
TEST(FabLoops, AreRefusedWithAColumnTwice) {
  const Folder folder;
  for (const char* second : {"force_N", "Force [N]"}) {
    std::string text = si_rows();
    for (std::size_t at = 0, line = 0; (at = text.find('\n', at)) != text.npos; ++line) {
      const std::string cell = "," + (line == 0 ? std::string(second) : "0.05");
      text.insert(at, cell);
      at += cell.size() + 1;
    }
    EXPECT_TRUE(says(refusal([&] { read_fab(folder.write("a.csv", text), TesterUnits::si, "t"); }),
                     "a.csv: column 'force_N' stands twice"));
  }
}

TEST(FabLoops, AreRefusedWhereLengthsAreNoStrips) {
  const Folder folder;
  std::string text = si_rows();
  for (std::size_t at; (at = text.find("0.021,0.04")) != std::string::npos;) text.replace(at, 10, "2.1,4");
  EXPECT_TRUE(says(refusal([&] { read_fab(folder.write("a.csv", text), TesterUnits::si, "t"); }), "2.1"));
}

TEST(FabLoops, AreRefusedWithARowThatIsNoNumber) {
  const Folder folder;
  std::string text = si_rows();
  text.replace(text.find("-0.01"), 5, "-0,01");
  EXPECT_TRUE(says(refusal([&] { read_fab(folder.write("a.csv", text), TesterUnits::si, "t"); }), "a.csv:2"));
}

TEST(FabLoops, AreRefusedInAnotherOrderThanThatOfTheirBranches) {
  const Folder folder;
  const std::string begins = std::string(kHeadSi) + "L,D1,1,0.02,-0.01,0.021,0.04\n",
                    skips =
                        std::string(kHeadSi) + "L,D1,0,0.02,-0.01,0.021,0.04\nL,D1,2,0.02,-0.01,0.021,0.04\n";
  const auto refused = [&](const std::string& text) {
    return refusal([&] { read_fab(folder.write("a.csv", text), TesterUnits::si, "t"); });
  };
  EXPECT_EQ(
      refused(begins),
      "t: a.csv:2: branch 1 must be 0: the rows of a test stand in the order of its branches, 0, 1, 2 ...");
  EXPECT_EQ(
      refused(skips),
      "t: a.csv:3: branch 2 must be 0 or 1: the rows of a test stand in the order of its branches, 0, 1, "
      "2 ...");
}

TEST(FabLoops, ThatAreNotThereAreNamed) {
  const Folder folder;
  const auto all = read_fab(folder.write("a.csv", si_rows()), TesterUnits::si, "t");
  EXPECT_TRUE(says(refusal([&] { find_loops(all, "B", "D1"); }), "L D1"));
}

TEST(FabLoops, OfAFileThatIsNotThereSayWhichFile) {
  const Folder folder;
  const std::string missing = folder.file("missing.csv");
  EXPECT_EQ(refusal([&] { read_fab(missing, TesterUnits::si, "t"); }, 1),
            "cannot read " + missing + ": No such file or directory");
}

// The record has a spring of 1 N/mm and friction of 0.2 N, both per metre, along the clamps' way.
class FabRecord : public testing::Test {
 protected:
  FabRecord() : loops_(made_up_loops("D1", 0.021, 0.0015, {0.004, 0.006}, 20)) {
    loops_.direction = "L";
    loops_.width = 0.04;
    for (std::size_t b = 0; b < loops_.branches.size(); ++b)
      for (std::size_t i = 0; i < loops_.branches[b].distance.size(); ++i)
        loops_.branches[b].force[i] = 1e3 * (loops_.branches[b].distance[i] - 0.021) + (b % 2 ? 0.2 : -0.2);
  }
  // Returns the message of reading the file with these loops.
  std::string said() const {
    return refusal([&] { read_fab(folder_.write("a.csv", text()), TesterUnits::si, "t"); });
  }
  std::string text() const {
    std::string text = kHeadSi;
    for (std::size_t b = 0; b < loops_.branches.size(); ++b)
      for (std::size_t i = 0; i < loops_.branches[b].distance.size(); ++i)
        text += loops_.direction + "," + loops_.test + "," + std::to_string(b) + "," +
                std::to_string(loops_.branches[b].distance[i]) + "," +
                std::to_string(loops_.branches[b].force[i] * loops_.width) + "," +
                std::to_string(loops_.gauge) + "," + std::to_string(loops_.width) + "\n";
    return text;
  }
  template <class Change>
  void change_forces(const Change& change) {
    for (FabBranch& branch : loops_.branches)
      for (double& force : branch.force) force = change(force);
  }

  Folder folder_;
  FabLoops loops_;
};

TEST_F(FabRecord, IsReadWhereverTheZeroOfForceIs) {
  for (const double zero : {0.0, 3.0, -10.0}) {
    change_forces([&](double force) { return force + zero; });
    EXPECT_EQ(said(), test::kAccepted) << zero;
  }
}

TEST_F(FabRecord, OfForcesThatDoNotVaryIsRefused) {
  change_forces([](double) { return 0; });
  EXPECT_TRUE(says(said(), "t: a.csv:2: L D1: the force is 0 N in all rows of cycle 1, and must vary"));
}

TEST_F(FabRecord, WithTheSignOfForceTurnedIsRefused) {
  change_forces([](double force) { return -force; });
  EXPECT_TRUE(says(said(), "turn the sign of the forces"));
}

// Light fabrics: the zero of force drifts in the first cycle by more than the strip pushes.
TEST_F(FabRecord, WhoseZeroDriftsIsReadWithADoubtAndOnlyWhereItIsAskedFor) {
  double drift = 0;
  for (double& force : loops_.branches[0].force) force += (drift += 0.5);
  for (std::size_t b = 1; b < loops_.branches.size(); ++b)
    for (double& force : loops_.branches[b].force) force += drift;
  const std::string file = folder_.write("drift.csv", text());
  const auto read = [&](const FabRequest& request) { return read_fab(file, TesterUnits::si, "t", request); };
  ASSERT_EQ(read({}).size(), 1u);
  ASSERT_EQ(read({})[0].warnings.size(), 1u);
  EXPECT_TRUE(says(read({})[0].warnings[0], "L D1: in cycle 1 forces fall as the clamps part, by no more"));
  EXPECT_TRUE(read({{}, {2}, 0})[0].warnings.empty());
  change_forces([](double force) { return -force; });
  const FabRequest another{[](const FabLoops& one) { return one.direction == "W"; }, {}, 0};
  const std::string turned = folder_.write("turned.csv", text());
  EXPECT_EQ(refusal([&] { read_fab(turned, TesterUnits::si, "t", another); }), test::kAccepted);
}

// Branches in their order, but each from its end to its beginning and the last first.
TEST_F(FabRecord, ThatRunsBackwardsInTimeIsRefused) {
  std::reverse(loops_.branches.begin(), loops_.branches.end());
  for (FabBranch& branch : loops_.branches) {
    std::reverse(branch.distance.begin(), branch.distance.end());
    std::reverse(branch.force.begin(), branch.force.end());
  }
  EXPECT_TRUE(says(said(), "gives back more work than it takes"));
}

TEST_F(FabRecord, WithBranchesFromTheirEndToTheirBeginningIsRefused) {
  for (FabBranch& branch : loops_.branches) {
    std::reverse(branch.distance.begin(), branch.distance.end());
    std::reverse(branch.force.begin(), branch.force.end());
  }
  EXPECT_TRUE(says(said(), "branch 0 goes the wrong way: it must bring the clamps together"));
}

TEST_F(FabRecord, WithRowsOutOfOrderIsRefused) {
  FabBranch& branch = loops_.branches[1];
  std::swap(branch.distance[4], branch.distance[9]);
  std::swap(branch.force[4], branch.force[9]);
  EXPECT_TRUE(
      says(said(), "a.csv:28: L D1: clamps at 0.017625 m lie back by more than 5 % of the way of branch 1"));
}

// Testers turn late: the first rows of a branch may still go the way of the last one.
TEST_F(FabRecord, WhoseClampsTurnLateIsRead) {
  for (FabBranch& branch : loops_.branches) {
    const double turn = branch.distance[0], step = branch.distance[1] - turn;
    branch.distance[0] = turn + 0.5 * step;
    branch.distance[1] = turn;
  }
  EXPECT_EQ(said(), test::kAccepted);
}

TEST_F(FabRecord, ThatJumpsBetweenBranchesIsRefused) {
  for (double& distance : loops_.branches[2].distance) distance -= 0.003;
  EXPECT_TRUE(
      says(said(),
           "a.csv:44: L D1: branch 2 begins at 0.0165 m, far from where the one before it ends, 0.0195 m"));
}

// 0.0195 m of 0.03 m: that strip would hang in a deep bow before the test begins.
TEST_F(FabRecord, OfAnotherGaugeIsRefused) {
  loops_.gauge = 0.03;
  EXPECT_TRUE(says(said(), "the clamps begin 0.0195 m apart, must be within 25 % of the gauge, 0.03 m"));
}

TEST_F(FabRecord, WhoseStripChangesWithinATestIsRefused) {
  std::string text = si_rows();
  text.replace(text.rfind("0.04"), 4, "0.05");
  EXPECT_TRUE(says(refusal([&] { read_fab(folder_.write("b.csv", text), TesterUnits::si, "t"); }),
                   "b.csv:9: width_m = 0.05 differs"));
}

TEST_F(FabRecord, OfADirectionThatThereIsNotIsRefused) {
  loops_.direction = "X";
  EXPECT_TRUE(says(said(), "a direction is L (warp), W (weft) or B (bias)"));
}

// The clamps' work is what the strip stores and loses.
TEST(FabRun, BalancesTheWorkOfTheClamps) {
  const FabStrip strip{{2e-6, {4, 32, 128}, {2e-5, 1e-6, 4e-7}}, {30, {0.01, 0.05}, {100, 20}}, 0.3};
  for (const char* name : {"U1", "D1", "S1"}) {
    const FabLoops loops = made_up_loops(name, 0.021, 0.0015, {0.0035, 0.006}, 400);
    const FabRun run = run_fab(loops, strip);
    EXPECT_GT(run.dissipated, 0) << name;
    EXPECT_NEAR((run.work - run.stored) / run.dissipated, 1, 1e-3) << name;
  }
}

}  // namespace
}  // namespace hysteron
