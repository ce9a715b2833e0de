// Numbers in Markdown that come from runs.
#include "experiments/report/marked_numbers.h"

#include <nlohmann/json.hpp>

#include "experiments/report/number_source.h"
#include "sim/base/error.h"
#include "tests/experiments/folder.h"
#include "tests/experiments/program.h"
#include "tests/sim/base/refusal.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;

void write_text(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream(file) << text;
}

class MarkedNumbers : public testing::Test {
 protected:
  MarkedNumbers() {
    Options options;
    options.out = (results_ / "crease").string();
    options.quiet = true;
    ExperimentRun run({"crease", "hysteron crease", {}, {}}, options, Json::object());
    run.manifest().steps = 12345;
    run.metric("recovery_angle_deg", 127.768);
    run.metric("recovery_angle_deg_step_error", 0.114);
    run.metric("recovery_angle_deg_mesh_error", MetricValue());
    run.metric("recovery_angle_deg_draw_error", 2.3e-7);
    run.metric("set_m", 0);
    run.finish();
    write_text(results_ / "crease/cycles.csv",
               "cycle,law,M0 [N],note\n1,wong,5.9e-4,\"bent, flat\"\n10,wong,4.9e-4,\n10,dahl,-4e-4,\n");
    write_text(results_ / "bench.json", R"([{"ms": 2.5}, {"ms": 5}])");
  }
  std::string number(const std::string& source) const { return number_from(source, root_.path()); }
  // The message of the error that the source ends in.
  std::string refusal(const std::string& source) const {
    return test::refusal([&] { number(source); });
  }
  fs::path page() const { return root_.path() / "docs/angles.md"; }
  void write_page(const std::string& source, const std::string& value) const {
    write_text(page(), "# Angles\n\nIt opens to <!-- n: " + source + " -->" + value + "<!-- /n -->.\n");
  }

  Folder root_;
  fs::path results_ = root_.path() / "results";
};

TEST_F(MarkedNumbers, AreMetricsPointersAndCells) {
  EXPECT_EQ(number("results/crease recovery_angle_deg .1f°"), "127.8°");
  EXPECT_EQ(number("results/crease recovery_angle_deg \".0f %\""), "128 %");
  EXPECT_EQ(number("results/crease /steps ,"), "12,345");
  EXPECT_EQ(number("results/bench.json /1/ms .2f"), "5.00");
  EXPECT_EQ(number("results/crease/cycles.csv 1 \"M0 [N]\" times 1e3 .2f"), "0.59");
  EXPECT_EQ(number("results/crease/cycles.csv cycle=10&law=dahl \"M0 [N]\" .1g"), "-0.0004");
  EXPECT_EQ(number("results/crease/cycles.csv 1 note text"), "bent, flat");
  EXPECT_EQ(number("results/crease set_m .3f"), "0");
}

TEST_F(MarkedNumbers, AreSubtractedAndDivided) {
  EXPECT_EQ(number("results/crease recovery_angle_deg minus results/crease /steps .1f"), "-12217.2");
  EXPECT_EQ(number("results/bench.json /1/ms over results/bench.json /0/ms times 100 +.0f"), "+200");
  EXPECT_NE(refusal("results/bench.json /1/ms over results/crease set_m .1f").find("no finite number"),
            std::string::npos);
}

TEST_F(MarkedNumbers, CarryTheErrorsOfTheirMetricThatAreKnown) {
  EXPECT_EQ(number("results/crease recovery_angle_deg .1f° +-.1g"), "127.8° ± 0.1 ± 2e-7");
  EXPECT_EQ(number("results/crease recovery_angle_deg times 10 .0f +-.2g"), "1278 ± 1.1 ± 2.3e-6");
  EXPECT_NE(refusal("results/crease set_m .1f +-.1g").find("has no errors"), std::string::npos);
  EXPECT_NE(refusal("results/crease /steps , +-.1g").find("only a metric has errors"), std::string::npos);
}

TEST_F(MarkedNumbers, AreRefusedInOneLineThatSaysWhatIsMissing) {
  EXPECT_EQ(
      refusal("results/crease recovery_angel_deg .1f"),
      "results/crease/manifest.json has no metric recovery_angel_deg; did you mean recovery_angle_deg?");
  EXPECT_EQ(refusal("results/crease /stepz ,"), "results/crease has no /stepz");
  EXPECT_EQ(refusal("results/crease/cycles.csv 2 law .1f"), "results/crease/cycles.csv has no row 2");
  EXPECT_EQ(refusal("results/crease/cycles.csv 10 \"M0 [N]\" .1f"),
            "results/crease/cycles.csv has several rows 10");
  EXPECT_EQ(refusal("results/crease/cycles.csv 1 \"M1 [N]\" .1f"),
            "results/crease/cycles.csv has no column M1 [N]; did you mean M0 [N]?");
  EXPECT_EQ(refusal("results/crease recovery_angle_deg 1f"),
            "format 1f must be like .1f, .2g, +.1f or , for a count");
  EXPECT_EQ(refusal("results/crease recovery_angle_deg"), "needs a format");
  EXPECT_EQ(refusal("results/crease recovery_angle_deg .1f more"), "\"more\" is one word too many");
  EXPECT_EQ(refusal("results/crease/cycles.csv 1 \"M0 [N] .1f"), "a quote is not closed");
}

TEST_F(MarkedNumbers, OfReadmeAndDocsAreWrittenAndCheckedByReport) {
  write_page("results/crease recovery_angle_deg .1f°", "90°");
  const std::string readme = "<p>One of <!-- n: elsewhere/x y .1f -->7<!-- /n -->\n";
  write_text(root_.path() / "README.md", readme);
  ASSERT_EQ(program("report " + results_.string()).exit_code, 0);
  EXPECT_EQ(text_of(page()),
            "# Angles\n\nIt opens to <!-- n: results/crease recovery_angle_deg .1f° -->127.8°<!-- /n -->.\n");
  EXPECT_EQ(text_of(root_.path() / "README.md"), readme) << "from another folder";
  EXPECT_EQ(program("report --check " + results_.string()).exit_code, 0);

  write_page("results/crease recovery_angle_deg .1f°", "127.9°");
  const Outcome stale = program("report --check " + results_.string());
  EXPECT_EQ(stale.exit_code, 4);
  EXPECT_EQ(stale.err, "hysteron report: " + page().string() +
                           ":3: \"127.9°\" must be \"127.8°\"; write it again: hysteron report " +
                           results_.string() + "\n");
}

TEST_F(MarkedNumbers, NameFileAndLineOfAMarkerThatIsWrong) {
  const auto message = [&] {
    try {
      stale_numbers(results_);
      return std::string("no error");
    } catch (const Error& error) {
      return std::string(error.what());
    }
  };
  write_page("results/crumple ridge_length_m .1f", "1");
  EXPECT_NE(message().find(page().string() + ":3: results/crumple ridge_length_m .1f: cannot read "),
            std::string::npos)
      << message();
  write_text(page(), "It is <!-- n: results/crease set_m .1f -->0\n<!-- /n -->\n");
  EXPECT_EQ(message(), page().string() +
                           ":1: a number that opens with <!-- n: must end with <!-- /n --> in the same line");
  write_text(page(), "It is\n  <!-- n: results/crease set_m .1f -->0<!-- /n -->\n");
  EXPECT_EQ(message(),
            page().string() + ":2: a line must not begin with <!--, which ends a paragraph of Markdown");
}

}  // namespace
}  // namespace hysteron::experiments
