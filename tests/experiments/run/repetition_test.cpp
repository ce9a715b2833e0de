// Two runs are compared: numbers, energies, tables and files.
#include <fstream>

#include "experiments/verify/recorded_tables.h"
#include "experiments/verify/repetition.h"
#include "experiments/workbench/app/same_request.h"
#include "tests/experiments/program.h"

namespace hysteron::experiments {
namespace {

Manifest with_steps(const std::string& integrator, double newton_residual) {
  Manifest run;
  run.keys = std::make_shared<const nlohmann::ordered_json>(nlohmann::ordered_json{
      {"integrator", integrator}, {"newton-residual", newton_residual}, {"solver-tolerance", 1e-4}});
  return run;
}

TEST(RoundOff, IsATenthOfTheToleranceThatStepsWereSolvedToAndAtLeastAMillionth) {
  EXPECT_DOUBLE_EQ(round_off_bound(with_steps("tr-bdf2", 1e-3)), 1e-4);
  EXPECT_DOUBLE_EQ(round_off_bound(with_steps("tr-bdf2", 1e-8)), 1e-6);
  EXPECT_DOUBLE_EQ(round_off_bound(with_steps("semi-implicit", 1e-3)), 1e-5);
  EXPECT_DOUBLE_EQ(round_off_bound(with_steps("explicit", 1e-3)), 1e-6);
  EXPECT_DOUBLE_EQ(round_off_bound({}), 1e-6) << "a law without steps";
}

TEST(RoundOff, IsAShareOfTheNumberOrOfTheWhole) {
  Manifest before = with_steps("bdf2", 1e-6), now = before;
  before.metrics = {
      {"energy_J", 1e-7}, {"share_percent", 0.1}, {"node_count", 7}, {"newton_iterations_per_step", 3.5}};
  const auto agreement = [&](const char* name, MetricValue value) {
    now.metrics = before.metrics;
    now.metrics.set(name, value);
    return compare_runs(before, now, {}, false).agreement();
  };
  EXPECT_EQ(agreement("energy_J", 1e-7), Agreement::bits);
  EXPECT_EQ(agreement("energy_J", 1e-7 * (1 + 0.9e-6)), Agreement::errors);
  EXPECT_EQ(agreement("energy_J", 1e-7 * (1 + 1.1e-6)), Agreement::none);
  EXPECT_EQ(agreement("share_percent", 0.1 + 0.9e-4), Agreement::errors);
  EXPECT_EQ(agreement("share_percent", 0.1 + 1.1e-4), Agreement::none);
  EXPECT_EQ(agreement("node_count", 8), Agreement::none) << "counts are exact";
  EXPECT_EQ(agreement("newton_iterations_per_step", 4.5), Agreement::errors) << "work of the solver";
}

TEST(Repetition, HasNamesOfASolversWorkAndOfErrorsAsTheyAreNotAsTheyBegin) {
  Manifest before = with_steps("bdf2", 1e-6), now = before;
  const auto agreement = [&](const Metrics& recorded, const Metrics& repeated) {
    before.metrics = recorded, now.metrics = repeated;
    return compare_runs(before, now, {}, false).agreement();
  };
  for (const char* own :
       {"newton_tip_m", "my_iterations_m", "a_draw_b_m", "tip_m_error", "falls_steps_count"})
    EXPECT_EQ(agreement({{own, -0.07}}, {{own, 12.0}}), Agreement::none) << own;
  EXPECT_EQ(
      agreement({{"prandtl.newton_residual_largest", 1e-7}}, {{"prandtl.newton_residual_largest", 2e-7}}),
      Agreement::errors)
      << "a column's";
  EXPECT_EQ(agreement({{"tip_m", 0.1}, {"tip_m_step_error", 0.01}, {"tip_m_path_difference", 0.2}},
                      {{"tip_m", 0.1}}),
            Agreement::bits)
      << "errors are not repeated";
}

TEST(Repetition, DiffersWhereOneOfThemHasANumberThatTheOtherHasNot) {
  Manifest before = with_steps("bdf2", 1e-6), now = before;
  before.metrics = {{"tip_m", 0.1}};
  now.metrics = {{"tip_m", 0.1}, {"drape_coefficient_percent", 60}, {"energy_J", 1}};
  before.commit = "1", now.commit = "2";
  EXPECT_EQ(compare_runs(before, now, {}, false).unrecorded,
            (std::vector<std::string>{"drape_coefficient_percent"}))
      << "a newer program may measure more, but a headline is found by all";
  before.commit = now.commit;
  EXPECT_EQ(compare_runs(before, now, {}, false).unrecorded.size(), 2u);
  EXPECT_EQ(compare_runs(now, before, {}, false).missing.size(), 2u);
  EXPECT_EQ(compare_runs(now, before, {}, false).agreement(), Agreement::none);
  now.state_hash = "1";
  EXPECT_EQ(compare_runs(before, now, {}, false).unrecorded.front(), "the state");
}

// Which settings of `accuracy` no other beats goes by their durations.
TEST(Repetition, PassesOverWhatGoesByDurations) {
  Manifest before = with_steps("bdf2", 1e-6), now = before;
  before.metrics = {{"bend.base_error_percent", 0.5}, {"bend.front_count", 6}, {"bend.computing_s", 1.5}};
  now.metrics = {{"bend.base_error_percent", 0.5}, {"bend.front_count", 5}, {"bend.computing_s", 2.5}};
  EXPECT_EQ(compare_runs(before, now, {}, false).agreement(), Agreement::bits);
  now.metrics = {{"bend.base_error_percent", 0.6}, {"bend.front_count", 6}, {"bend.computing_s", 1.5}};
  EXPECT_EQ(compare_runs(before, now, {}, false).agreement(), Agreement::none);
}

TEST(Repetition, HoldsTheClosingEnergiesToRoundOffOfTheirLargest) {
  Manifest before = with_steps("bdf2", 1e-6), now = before;
  before.energy = {{"kinetic", 1e-9}, {"bending", 1e-3}, {"remainder", 1e-18}};
  const auto agreement = [&](const std::string& term, double joules) {
    now.energy = before.energy;
    for (auto& [name, value] : now.energy)
      if (name == term) value = joules;
    return compare_runs(before, now, {}, false).agreement();
  };
  EXPECT_EQ(agreement("bending", 1e-3), Agreement::bits);
  EXPECT_EQ(agreement("kinetic", 1e-9 + 0.9e-9), Agreement::errors) << "1e-6 of 1 mJ is 1 nJ";
  EXPECT_EQ(agreement("kinetic", 1e-9 + 1.1e-9), Agreement::none);
  EXPECT_EQ(agreement("remainder", 1e-6), Agreement::errors) << "what the solver left over";
  now.energy = {{"kinetic", 1e-9}};
  EXPECT_EQ(compare_runs(before, now, {}, false).missing,
            (std::vector<std::string>{"energy.bending", "energy.remainder"}));
  EXPECT_EQ(compare_runs({}, before, {}, false).unrecorded, (std::vector<std::string>{"the energy balance"}));
}

TEST(Repetition, HoldsEveryColumnOfATableToItsLimitOrToRoundOff) {
  const Folder folder;
  for (const char* name : {"before", "now"}) fs::create_directories(folder.path() / name);
  Manifest run = with_steps("bdf2", 1e-6);
  run.metrics = {{"tip_m", 0.5}, {"tip_m_step_error", 0.01}};
  const auto compared = [&](const std::string& before, const std::string& now, const Limits& limits = {}) {
    folder.write("before/metrics.csv", before);
    folder.write("now/metrics.csv", now);
    Repetition repetition;
    repetition.round_off = round_off_bound(run);
    compare_tables({"metrics.csv"}, folder.file("before"), folder.file("now"), run, run, limits, repetition);
    return repetition;
  };
  const std::string head = "time [s],width [m],wall [s]\n0,2.0000000,1\n";
  EXPECT_EQ(compared(head, head).series.same(), 2u) << "durations are passed over";
  EXPECT_TRUE(compared(head, "time [s],width [m],wall [s]\n0,2.0000000,7\n").series.all_same());
  EXPECT_EQ(compared(head, "time [s],width [m],wall [s]\n0,2.0000019,1\n").series.rounded.size(), 1u);
  const std::string other = "time [s],width [m],wall [s]\n0,2.0000021,1\n";
  EXPECT_EQ(compared(head, other).series.beyond.size(), 1u);
  Limits limits;
  limits.metrics = {{"metrics.csv:width*", 1e-5}};
  EXPECT_EQ(compared(head, other, limits).series.within.size(), 1u);
  EXPECT_EQ(compared(head, head + "1,2,1\n").series.beyond,
            (std::vector<std::string>{"metrics.csv with 1 rows, now 2"}));
  EXPECT_EQ(compared(head, "time [s]\n0\n").missing, (std::vector<std::string>{"metrics.csv:width [m]"}));
  EXPECT_EQ(compared("time [s]\n0\n", head).unrecorded, (std::vector<std::string>{"metrics.csv:width [m]"}));
  for (const char* own : {"wall [m]", "memory [m]", "computing [N]", "remainder [deg]"}) {
    const std::string before = std::string(own) + "\n0.5\n", now = std::string(own) + "\n9\n";
    EXPECT_EQ(compared(before, now).series.beyond.size(), 1u) << "a scene's own " << own;
  }
  EXPECT_EQ(compared("remainder [J]\n0\n", "remainder [J]\n1e-9\n").series.effort.size(), 1u);
  // The stated error of the metric whose history it is.
  EXPECT_EQ(compared("tip [m]\n0.5000000\n", "tip [m]\n0.5090000\n").series.within.size(), 1u);
  EXPECT_EQ(compared("tip [m]\n0.5000000\n", "tip [m]\n0.5110000\n").series.beyond.size(), 1u);
  // Six digits of a table may end in another one.
  EXPECT_EQ(compared("width [m]\n0.300001\n", "width [m]\n0.300002\n").series.rounded.size(), 1u);
}

// A later program may write more, but not less of what the scene asks for.
TEST(Repetition, MissesAColumnOfALaterProgramOnlyIfTheSceneAsksForIt) {
  const Folder folder;
  for (const char* name : {"before", "now"}) fs::create_directories(folder.path() / name);
  folder.write("before/metrics.csv", "time [s]\n0\n");
  folder.write("now/metrics.csv", "time [s],tip [m],more [m]\n0,1,1\n");
  Manifest run, later;
  later.commit = "of another day";
  later.metrics = {{"tip_m", 1.0}, {"more_m", 1.0}};
  later.requested_metrics = {"tip_m"};
  Repetition repetition;
  compare_tables({"metrics.csv"}, folder.file("before"), folder.file("now"), run, later, {}, repetition);
  EXPECT_EQ(repetition.unrecorded, (std::vector<std::string>{"metrics.csv:tip [m]"}));
}

// How often a solver iterates is counted, unless it has a limit; the limit is printed as it stands in its
// file.
TEST(Repetition, HoldsTheSolversWorkToALimitThatIsSetOnIt) {
  Manifest before = with_steps("bdf2", 1e-6), now = before;
  before.metrics = {{"newton_iterations_per_step", 3.5}};
  now.metrics = {{"newton_iterations_per_step", 4.5}};
  before.energy = {{"remainder", 1e-9}};
  now.energy = {{"remainder", 2e-9}};
  Limits limits;
  EXPECT_EQ(compare_runs(before, now, limits, false).agreement(), Agreement::errors);
  limits.metrics = {{"newton_iterations_per_step", 0.999}};
  EXPECT_EQ(compare_runs(before, now, limits, false).metrics.beyond,
            (std::vector<std::string>{"newton_iterations_per_step 3.5 -> 4.5 (limit 0.999)"}));
  limits.metrics = {{"energy.remainder", 0}};
  EXPECT_EQ(compare_runs(before, now, limits, false).energies.beyond.size(), 1u);
}

// A folder that its page stands in has all that its manifest lists; without it a part, which is compared.
TEST(Repetition, MissesPicturesAndTablesThatOneOfTheTwoHasNot) {
  const Folder folder;
  Manifest run;
  run.files = {"report.html", "metrics.csv",   "errors.csv",     "frames/0000.png",
               "sheet.png",   "plot_time.png", "frames/0001.png"};
  fs::create_directories(folder.path() / "frames");
  for (const char* file : {"report.html", "metrics.csv", "errors.csv", "frames/0000.png", "sheet.png"})
    folder.write(file, "");
  run.tables = written_tables(run.files, folder.path());
  const ComparableFiles whole = comparable_files(run, folder.path(), true);
  EXPECT_EQ(whole.tables, (std::vector<std::string>{"metrics.csv"}));
  EXPECT_EQ(whole.pictures, (std::vector<std::string>{"frames/0000.png", "sheet.png"}));
  EXPECT_EQ(whole.lost, (std::vector<std::string>{"frames/0001.png"}));
  EXPECT_TRUE(whole.edited.empty());
  EXPECT_TRUE(comparable_files(run, folder.path(), false).lost.empty());
  folder.write("errors.csv", "repeat\n");
  const ComparableFiles edited = comparable_files(run, folder.path(), true);
  EXPECT_EQ(edited.edited, (std::vector<std::string>{"errors.csv"}));
  fs::remove(folder.path() / "errors.csv");
  EXPECT_EQ(comparable_files(run, folder.path(), true).lost,
            (std::vector<std::string>{"errors.csv", "frames/0001.png"}));
  fs::remove(folder.path() / "report.html");
  const ComparableFiles part = comparable_files(run, folder.path(), true);
  EXPECT_TRUE(part.lost.empty());
  EXPECT_EQ(part.trimmed, 2);

  Repetition repetition;
  Manifest now = run;
  now.files.insert(now.files.end(), {"frames/0002.png", "probes.csv", "plot_more.png"});
  add_unlisted_files(run, now, true, repetition);
  EXPECT_EQ(repetition.unrecorded, (std::vector<std::string>{"frames/0002.png", "probes.csv"}));
  repetition.lost = whole.lost;
  EXPECT_EQ(repetition.agreement(), Agreement::none);
  Repetition of_edited;
  EXPECT_EQ(of_edited.agreement(), Agreement::bits);
  of_edited.edited = edited.edited;
  EXPECT_EQ(of_edited.agreement(), Agreement::none);
}

}  // namespace
}  // namespace hysteron::experiments
