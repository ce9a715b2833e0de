// What shells offer behind `hysteron`.
#include <algorithm>

#include "experiments/complete/candidates.h"
#include "experiments/workbench/app/command_line.h"
#include "sim/scene/assets.h"
#include "tests/experiments/program.h"

namespace hysteron::experiments {
namespace {

using Words = std::vector<std::string>;

Words offered(const Words& words) {
  Words found;
  for (const Candidate& candidate : candidates(words)) found.push_back(candidate.word);
  return found;
}

TEST(Completion, OffersSubcommandsThatBeginSo) {
  EXPECT_EQ(offered({"dra"}), Words{"drape"});
  EXPECT_EQ(offered({"re"}), (Words{"render", "report", "rerun"}));
  const Words all = offered({""});
  EXPECT_EQ(std::count(all.begin(), all.end(), "complete"), 0) << "not for people";
}

TEST(Completion, OffersEveryOptionThatHelpLists) {
  for (const Experiment& experiment : experiments()) {
    if (experiment.hidden) continue;
    const Words words = offered({experiment.name, "--"});
    for (const KeyDescription& key : options_of(experiment, Defaults::left_out))
      EXPECT_TRUE(std::count(words.begin(), words.end(), option_name(key)))
          << experiment.name << " " << key.path;
    EXPECT_TRUE(std::count(words.begin(), words.end(), "--version")) << experiment.name;
  }
}

TEST(Completion, OffersTheValuesOfAnOptionHoweverItIsTyped) {
  EXPECT_EQ(offered({"drape", "--fabric", ""}), list_assets("fabrics"));
  EXPECT_EQ(offered({"drape", "--fabric", "pink"}), Words{"pink-ribbon-brown"});
  EXPECT_EQ(offered({"drape", "--fabric", "=", "pink"}), Words{"pink-ribbon-brown"}) << "as bash has it";
  EXPECT_EQ(offered({"drape", "--fabric", "="}), list_assets("fabrics"));
  EXPECT_EQ(offered({"drape", "--fabric=pink"}), Words{"--fabric=pink-ribbon-brown"});
  EXPECT_EQ(offered({"swing", "--element", "h"}), Words{"hinge"});
  EXPECT_EQ(offered({"swing", "--law", "prand"}), Words{"prandtl"});
  EXPECT_EQ(offered({"swing", "--quick", ""}), Words{}) << "no value";
  EXPECT_EQ(offered({"swing", "--out", ""}), Words{}) << "a file";
  EXPECT_EQ(offered({"drape", "--help", "s"}), (Words{"scene", "solver"}));
}

TEST(Completion, OffersArgumentsThatAreWords) {
  EXPECT_EQ(offered({"list", ""}), (Words{"fabrics", "laws", "scenes", "devices"}));
  EXPECT_EQ(offered({"run", ""}), list_assets("scenes"));
  EXPECT_EQ(offered({"compare", "fol"}), Words{"fold"});
  EXPECT_EQ(offered({"nonsense", ""}), Words{});
}

// In a shell without any configuration, whose completion is called as the shell itself calls it.
TEST(Completion, WorksInBash) {
  const auto replies = [](const std::string& words, int last) {
    const Folder folder;
    const std::string script = folder.path() / "script", out = folder.path() / "out";
    std::ofstream(script) << "source " HYSTERON_COMPLETION "/hysteron.bash || exit 1\n"
                          << "complete -p hysteron >/dev/null || exit 2\n"
                          << "COMP_WORDS=(" HYSTERON_PROGRAM " " << words << ")\nCOMP_CWORD=" << last
                          << "\n_hysteron\nprintf '%s\\n' \"${COMPREPLY[@]}\"\n";
    EXPECT_EQ(std::system(("bash --norc --noprofile " + script + " >" + out).c_str()), 0);
    return text_of(out);
  };
  EXPECT_EQ(replies("dra", 1), "drape\n");
  EXPECT_EQ(replies("drape --fab", 2).substr(0, 9), "--fabric\n");
  EXPECT_EQ(replies("drape --fabric pink", 3), "pink-ribbon-brown\n");
  EXPECT_EQ(replies("drape --fabric = pink", 4), "pink-ribbon-brown\n");
  EXPECT_EQ(replies("law ''", 2), "\n") << "files";
}

// What it hands to zsh's own functions, which print it here.
TEST(Completion, WorksInZsh) {
  if (std::system("command -v zsh >/dev/null") != 0) GTEST_SKIP() << "no zsh";
  const auto offered_for = [](const std::string& words, int last) {
    const Folder folder;
    const std::string script = folder.path() / "script", out = folder.path() / "out";
    std::ofstream(script) << "_describe() { print -rl -- \"${(@P)2}\" }\n_files() { print files }\n"
                          << "words=(" HYSTERON_PROGRAM " " << words << ")\nCURRENT=" << last
                          << "\ncompleted() { source " HYSTERON_COMPLETION "/_hysteron }\ncompleted\n";
    EXPECT_EQ(std::system(("zsh -f " + script + " >" + out).c_str()), 0);
    return text_of(out);
  };
  EXPECT_TRUE(offered_for("dra", 2).starts_with("drape:Cusick's drape test\\: a disc"));
  EXPECT_EQ(offered_for("drape --fabric pink", 4), "pink-ribbon-brown\n");
  EXPECT_EQ(offered_for("law ''", 3), "files\n");
}

}  // namespace
}  // namespace hysteron::experiments
