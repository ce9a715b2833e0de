// Numbers in Markdown that come from runs.
#include "experiments/report/number_source.h"
#include "tests/experiments/report/recorded_results.h"
#include "tests/sim/base/refusal.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;

class LinkedNumbers : public RecordedResults {
 protected:
  std::string number(const std::string& file, const std::string& title) const {
    return number_from({"results/" + file, title}, root_.path());
  }
  // The message of the error that the source ends in.
  std::string refusal(const std::string& file, const std::string& title) const {
    return test::refusal([&] { number(file, title); });
  }
};

TEST_F(LinkedNumbers, AreMetricsPointersAndCells) {
  EXPECT_EQ(number("crease/manifest.json", "recovery_angle_deg .1f°"), "127.8°");
  EXPECT_EQ(number("crease/errors.csv", "recovery_angle_deg '.0f %'"), "128 %");
  EXPECT_EQ(number("crease/manifest.json", "/steps ,"), "12,345");
  EXPECT_EQ(number("crease/manifest.json", "set_m .3f"), "0");
  EXPECT_EQ(number("bench.json", "/1/ms .2f"), "5.00");
  EXPECT_EQ(number("bench.json", "law=dahl cloths=4 ms .2f"), "5.00");
  EXPECT_EQ(number("cycles.csv", "1 'M0 [N]' times 1e3 .2f"), "0.59");
  EXPECT_EQ(number("cycles.csv", "cycle=10&law=dahl 'M0 [N]' .1g"), "-0.0004");
  EXPECT_EQ(number("cycles.csv", "cycle=10 law=dahl 'M0 [N]' .1g"), "-0.0004");
  EXPECT_EQ(number("cycles.csv", "1 note text"), "bent, flat");
  EXPECT_EQ(number("cycles.csv", "cycle=10&law=dahl note .1f"), "–") << "an empty cell";
  EXPECT_EQ(number("means.csv", "'fabric=the chapter's, wool' area_mean .0f"), "52");
}

TEST_F(LinkedNumbers, AreSubtractedAndDivided) {
  EXPECT_EQ(number("crease/manifest.json", "recovery_angle_deg minus /steps .1f"), "-12217.2");
  EXPECT_EQ(number("bench.json", "law=dahl ms over law=wong ms times 100 +.0f"), "+200");
  EXPECT_EQ(number("bench.json", "/1/ms minus results/cycles.csv 1 'M0 [N]' .4f"), "4.9994");
  EXPECT_NE(
      refusal("bench.json", "/1/ms over results/crease/manifest.json set_m .1f").find("no finite number"),
      std::string::npos);
}

TEST_F(LinkedNumbers, CarryTheErrorsThatStandBesideThem) {
  EXPECT_EQ(number("crease/errors.csv", "recovery_angle_deg .1f° +-.1g"), "127.8° ± 0.1 ± 2e-7");
  EXPECT_EQ(number("crease/errors.csv", "recovery_angle_deg times 10 .0f +-.2g"), "1278 ± 1.1 ± 2.3e-6");
  EXPECT_EQ(number("crease/errors.csv", "recovery_angle_deg_mean .1f +-.2f°"), "126.2 ± 0.11° ± 0.25°");
  EXPECT_EQ(number("means.csv", "fabric=cotton law=wong area_mean .1f +-.1f"), "80.1 ± 0.6");
  EXPECT_EQ(refusal("crease/errors.csv", "set_m .1f +-.1g"), "set_m has no errors: leave +- out");
  EXPECT_EQ(refusal("crease/manifest.json", "/steps , +-.1g"), "this number has no errors: leave +- out");
  EXPECT_EQ(refusal("means.csv",
                    "fabric=cotton law=wong area_mean over fabric=cotton law=dahl area_mean .1f +-.1f"),
            "this number has no errors: leave +- out");
}

TEST_F(LinkedNumbers, AreRefusedInOneLineThatSaysWhatIsMissing) {
  EXPECT_EQ(refusal("crease/errors.csv", "recovery_angel_deg .1f"),
            "results/crease/errors.csv has no metric recovery_angel_deg; did you mean recovery_angle_deg?");
  EXPECT_EQ(refusal("crease/manifest.json", "/stepz ,"), "results/crease/manifest.json has no /stepz");
  EXPECT_EQ(refusal("cycles.csv", "2 law .1f"), "results/cycles.csv has no row 2");
  EXPECT_EQ(refusal("cycles.csv", "10 'M0 [N]' .1f"), "results/cycles.csv has several rows 10");
  EXPECT_EQ(refusal("cycles.csv", "1 'M1 [N]' .1f"),
            "results/cycles.csv has no column M1 [N]; did you mean M0 [N]?");
  EXPECT_EQ(refusal("bench.json", "1f"), "needs a column");
  EXPECT_EQ(refusal("crease/errors.csv", "set_m 1f"),
            "format 1f must be like .1f, .2g, +.1f or , for a count");
  EXPECT_EQ(refusal("crease/errors.csv", "set_m"), "needs a format");
  EXPECT_EQ(refusal("crease/errors.csv", "set_m .1f more"), "\"more\" is one word too many");
  EXPECT_EQ(refusal("cycles.csv", "1 'M0 [N] .1f"), "a quote is not closed");
}

TEST_F(LinkedNumbers, AreWrittenIntoTheBracketsAndCheckedByReport) {
  const std::string foot =
      "\n[crease-angle]: ../results/crease/errors.csv \"recovery_angle_deg .1f° +-.1g\"\n"
      "[run]: ../results/crease/manifest.json\n";
  write_page("It opens to [90°][crease-angle]\n(the [run][run]; `[7][code]`).\n\n```\na[1][2]\n```\n" + foot);
  write_text(root_.path() / "README.md",
             "Again [1][steps].\n\n[steps]: results/crease/manifest.json \"/steps ,\"\n");
  EXPECT_EQ(faults(), "hysteron report: " + (root_.path() / "README.md").string() +
                          ":1: \"1\" must be \"12,345\"\n1: \"90°\" must be \"127.8° ± 0.1 ± 2e-7\"\n");
  const Outcome outcome = program("report " + docs());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(file_content(page()),
            "It opens to [127.8° ± 0.1 ± 2e-7][crease-angle]\n(the [run][run]; `[7][code]`).\n\n"
            "```\na[1][2]\n```\n" +
                foot);
  EXPECT_EQ(file_content(root_.path() / "README.md"),
            "Again [12,345][steps].\n\n[steps]: results/crease/manifest.json \"/steps ,\"\n");
  EXPECT_EQ(faults(), "");
  write_page("It opens to [127.8° ±\n  0.1 ± 2e-7][crease-angle] (the [run][run]).\n" + foot);
  EXPECT_EQ(faults(), "") << "a paragraph may be broken at any blank";
}

TEST_F(LinkedNumbers, MustHaveADefinitionThatIsUsedAndLeadsToAFile) {
  write_page("See [1][nowhere].\n\n[idle]: ../results/bench.json \"/1/ms .2f\"\n");
  EXPECT_EQ(faults(), "1: [nowhere] is not defined\n3: [idle] is defined and never used\n");
  write_page(
      "See [a][gone] and\n[b](../gone.md#part), [c](#part), [d](https://example.org).\n\n[gone]: gone.md\n");
  EXPECT_EQ(faults(), "2: no file ../gone.md\n4: no file gone.md\n");
  write_page(
      "See [5][x].\n\n[x]: ../results/bench.json \"/1/ms .0f\"\n[x]: ../results/bench.json \"/0/ms .0f\"\n");
  EXPECT_NE(faults().find("4: [x] is defined twice\n"), std::string::npos);
  write_page("See [5][x].\n\n[x]: ../results/bench.json \"/7/ms .0f\"\n");
  EXPECT_EQ(faults(), "3: [x]: ../results/bench.json has no /7/ms\n");
  EXPECT_EQ(program("report " + docs()).exit_code, 4) << "writing does not mend it";
}

}  // namespace
}  // namespace hysteron::experiments
