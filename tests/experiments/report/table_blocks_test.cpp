// Tables in Markdown that mirror recorded files.
#include "tests/experiments/report/recorded_results.h"

namespace hysteron::experiments {
namespace {

class TableBlocks : public RecordedResults {
 protected:
  // The table that `report` writes below the opening comment.
  std::string table(const std::string& words) const {
    const std::string open = "# Areas\n\n<!-- table " + words + " -->\n",
                      close = "<!-- /table -->\n\nAfter it.\n";
    write_page(open + "stale\n" + close);
    EXPECT_EQ(faults(), "3: this table is not what its files say\n");
    const Outcome outcome = program("report " + docs());
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(faults(), "");
    const std::string text = file_content(page());
    EXPECT_TRUE(text.starts_with(open) && text.ends_with(close)) << text;
    return text.substr(open.size(), text.size() - open.size() - close.size());
  }
  std::string fault(const std::string& words) const {
    write_page("Like `<!-- table`:\n<!-- table " + words + " -->\n<!-- /table -->\n");
    return faults();
  }
};

TEST_F(TableBlocks, HaveRowsByNameAndCellsOfTheirColumns) {
  EXPECT_EQ(table("../results/means.csv 'fabric={}' | fabric / of = cotton as cotton broad / thread; the "
                  "chapter's, wool\n| area [%] = law=wong area_mean .1f +-.1f | times = law=wong area_mean "
                  "over ../results/bench.json law=wong ms .0f"),
            "| [fabric](../results/means.csv) | of     |   area [%] | times |\n"
            "|--------------------------------|--------|-----------:|------:|\n"
            "| cotton broad                   | thread | 80.1 ± 0.6 |    32 |\n"
            "| the chapter's, wool            |        | 51.8 ± 0.1 |    21 |\n");
}

TEST_F(TableBlocks, HaveARowForEachValueOfAColumnAndForEachFile) {
  EXPECT_EQ(table("../results/bench.json law={} | law = each law | ms = ms .1f | name = law text"),
            "| [law](../results/bench.json) |  ms | name |\n"
            "|------------------------------|----:|------|\n"
            "| wong                         | 2.5 | wong |\n"
            "| dahl                         | 5.0 | dahl |\n");
  EXPECT_EQ(
      table("../results/{}/manifest.json | run = crease as a crease | angle = recovery_angle_deg .1f° | "
            "M0 [mN] = ../results/cycles.csv 1 'M0 [N]' times 1e3 .2f"),
      "| run                                         |  angle | M0 [mN] |\n"
      "|---------------------------------------------|-------:|--------:|\n"
      "| [a crease](../results/crease/manifest.json) | 127.8° |    0.59 |\n");
}

TEST_F(TableBlocks, SayWhichRowOrColumnIsMissing) {
  EXPECT_EQ(fault("../results/bench.json law={} | law = wong; prandtl | ms = ms .1f"),
            "2: prandtl, ms: ../results/bench.json has no row law=prandtl\n");
  EXPECT_EQ(fault("../results/bench.json law={} | law = each element | ms = ms .1f"),
            "2: ../results/bench.json has no column element\n");
  EXPECT_EQ(fault("../results/bench.json law={} | law = wong | ms"),
            "2: \"ms\" must be HEAD = what stands below it\n");
  EXPECT_EQ(fault("../results/bench.json"),
            "2: a table needs a file, its rows and a column, with | between them\n");
  write_page("\n<!-- table ../results/bench.json | law = wong | ms = ms .1f -->\n");
  EXPECT_EQ(faults(), "2: a table must end with <!-- /table --> below it\n");
}

}  // namespace
}  // namespace hysteron::experiments
