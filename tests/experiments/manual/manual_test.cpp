// The manual page.
#include <tuple>

#include "experiments/workbench/app/command_line.h"
#include "tests/experiments/program.h"

namespace hysteron::experiments {
namespace {

std::string escaped_hyphens(const std::string& text) {
  std::string safe;
  for (const char c : text) safe += c == '-' ? std::string("\\-") : std::string(1, c);
  return safe;
}

TEST(Manual, HasEverySubcommandAndEveryOption) {
  const std::string page = program("manual").out;
  for (const Experiment& experiment : experiments()) {
    if (experiment.hidden) continue;
    EXPECT_NE(page.find(std::string(".SS \"") + experiment.name), std::string::npos) << experiment.name;
    for (const KeyDescription& key : options_of(experiment, Defaults::left_out))
      EXPECT_NE(page.find("\\fB" + escaped_hyphens(option_name(key)) + "\\fR"), std::string::npos)
          << key.path;
  }
  EXPECT_NE(page.find(".SH EXIT STATUS\n"), std::string::npos);
}

// By mandoc, or by groff with every warning.  A page has no date, since the same program writes the same
// page.
TEST(Manual, IsWellFormed) {
  const Folder folder;
  const std::string page = folder.path() / "hysteron.1", complaints = folder.path() / "complaints";
  std::ofstream(page) << program("manual").out;
  if (std::system("command -v mandoc >/dev/null") == 0)
    std::ignore = std::system(
        ("mandoc -T lint -W warning " + page + " | grep -v 'missing date' >" + complaints).c_str());
  else if (std::system("command -v groff >/dev/null") == 0)
    EXPECT_EQ(
        std::system(("groff -man -ww -K utf8 -T utf8 " + page + " 2>" + complaints + " >/dev/null").c_str()),
        0);
  else
    GTEST_SKIP() << "neither mandoc nor groff";
  EXPECT_EQ(text_of(complaints), "");
}

}  // namespace
}  // namespace hysteron::experiments
