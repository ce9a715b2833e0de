// The tables of keys in documentation.
#include <fstream>

#include "experiments/report/key_tables.h"

#include "sim/base/error.h"
#include "sim/scene/keys.h"
#include "tests/experiments/folder.h"
#include "tests/experiments/program.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;

const char* const kEmpty = "# Keys\n\n<!-- keys:begin -->\n<!-- keys:end -->\n\nAfter them.\n";

TEST(KeyTables, OfMarkdownHaveAsManyCellsInEveryLine) {
  std::istringstream lines(key_tables());
  int rows = 0;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with('|')) continue;
    int bars = 0;
    for (std::size_t i = 0; i < line.size(); ++i) bars += line[i] == '|' && (i == 0 || line[i - 1] != '\\');
    EXPECT_EQ(bars, 7) << line;
    ++rows;
  }
  EXPECT_GT(rows, 60);
}

TEST(ReportOfDocumentation, WritesTheTablesBetweenTheirCommentsAndChecksThem) {
  const Folder folder;
  const fs::path page = folder.path() / "scenes.md";
  std::ofstream(page) << kEmpty;
  std::ofstream(folder.path() / "laws.md") << "# Laws\n";
  const Outcome stale = program("report --check " + folder.path().string());
  EXPECT_EQ(stale.exit_code, 4);
  EXPECT_EQ(stale.err, "hysteron report: " + page.string() +
                           ":3: these tables are not what --help says now; write it again: hysteron report " +
                           folder.path().string() + "\n");
  EXPECT_EQ(file_content(page), kEmpty) << "--check writes nothing";
  const Outcome written = program("report " + folder.path().string());
  EXPECT_EQ(written.exit_code, 0) << written.err;
  EXPECT_EQ(written.out, page.string() + "\n");
  EXPECT_EQ(file_content(page),
            "# Keys\n\n<!-- keys:begin -->\n" + key_tables() + "<!-- keys:end -->\n\nAfter them.\n");
  EXPECT_EQ(program("report --check " + folder.path().string()).exit_code, 0);
  EXPECT_EQ(file_content(folder.path() / "laws.md"), "# Laws\n");
}

TEST(ReportOfDocumentation, HasTheExitCodesOfHelp) {
  const Folder folder;
  const fs::path page = folder.path() / "start.md";
  std::ofstream(page) << "<!-- exit-codes:begin -->\n<!-- exit-codes:end -->\n";
  ASSERT_EQ(program("report " + folder.path().string()).exit_code, 0);
  const std::string table = file_content(page);
  for (const Experiment& experiment : experiments())
    if (*experiment.differs) {
      EXPECT_NE(table.find("`" + std::string(experiment.name) + "`: " + experiment.differs),
                std::string::npos)
          << table;
    }
  EXPECT_NE(table.find("\n| 2 | the request is wrong |\n"), std::string::npos) << table;
}

TEST(ReportOfDocumentation, TellsOfTablesWithoutTheirEnd) {
  const Folder folder;
  std::ofstream(folder.path() / "scenes.md") << "<!-- keys:begin -->\n";
  const Outcome outcome = program("report " + folder.path().string());
  EXPECT_EQ(outcome.exit_code, 4);
  EXPECT_NE(outcome.err.find("scenes.md:1: <!-- keys:begin --> needs <!-- keys:end --> below it"),
            std::string::npos)
      << outcome.err;
}

}  // namespace
}  // namespace hysteron::experiments
