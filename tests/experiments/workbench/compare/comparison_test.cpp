// The page has the warnings of its columns.
#include "experiments/workbench/compare/comparison.h"

#include "tests/experiments/folder.h"

namespace hysteron::experiments {
namespace {

std::vector<std::string> said(const ColumnWarnings& warnings) {
  const Folder folder;
  ExperimentRun run(drape_line(), setup_in(folder.path()));
  warnings.emit(run);
  run.finish();
  return run.manifest().warnings;
}

ChildRun column(const std::string& name, const std::vector<std::string>& texts,
                const std::string& stopped = "") {
  ChildRun column{name, drape_line(), {}};
  column.stopped = stopped;
  column.manifest.emplace();
  column.manifest->warnings = texts;
  return column;
}

TEST(ColumnWarnings, AreSaidOnceWithTheColumnsThatGiveThem) {
  ColumnWarnings warnings;
  warnings.add(column("linear", {"coarse", "thin"}));
  warnings.add(column("dahl", {"thin"}, "no convergence"));
  warnings.add(column("prandtl", {}));
  EXPECT_EQ(said(warnings),
            (std::vector<std::string>{"linear: coarse", "linear, dahl: thin", "dahl: no convergence"}));
}

TEST(ColumnWarnings, OfManyRunsAreCounted) {
  ColumnWarnings warnings;
  for (int i = 1; i <= 30; ++i)
    warnings.add("run-" + std::to_string(i), {"thin", "of run " + std::to_string(i)});
  const std::vector<std::string> all = said(warnings);
  ASSERT_EQ(all.size(), 21u);
  EXPECT_EQ(all.front(), "run-1, run-2, run-3, run-4 and 26 others: thin");
  EXPECT_EQ(all.back(), "the runs give 11 more warnings, each in the manifest of its run");
}

}  // namespace
}  // namespace hysteron::experiments
