// JUnit files are written as readers of them expect.
#include "experiments/workbench/pages/junit.h"

#include "tests/experiments/folder.h"

namespace hysteron::experiments {
namespace {

using Result = TestCase::Outcome;

const std::vector<TestCase> kCases = {{"a & \"b\"", Result::passed, "", 0.25},
                                      {"c", Result::passed, "1 < 2", 1},
                                      {"d", Result::failed, "flip = 0.2 must be <= 0.1\x01", 0},
                                      {"e", Result::broken, "no file", 0},
                                      {"f", Result::skipped, "ran on a GPU", 0}};

TEST(JUnit, HasACaseForEachComparisonAndCountsThem) {
  EXPECT_EQ(junit_text("diff", "x", kCases),
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
            "<testsuites name=\"x\" tests=\"5\" failures=\"1\" errors=\"1\" time=\"1.250\">\n"
            "  <testsuite name=\"x\" tests=\"5\" failures=\"1\" errors=\"1\" time=\"1.250\" skipped=\"1\">\n"
            "    <testcase name=\"a &amp; &quot;b&quot;\" classname=\"hysteron.diff\" time=\"0.250\"/>\n"
            "    <testcase name=\"c\" classname=\"hysteron.diff\" time=\"1.000\">"
            "<system-out>1 &lt; 2</system-out></testcase>\n"
            "    <testcase name=\"d\" classname=\"hysteron.diff\" time=\"0.000\">"
            "<failure message=\"flip = 0.2 must be &lt;= 0.1 \" type=\"differs\"/></testcase>\n"
            "    <testcase name=\"e\" classname=\"hysteron.diff\" time=\"0.000\">"
            "<error message=\"no file\" type=\"not compared\"/></testcase>\n"
            "    <testcase name=\"f\" classname=\"hysteron.diff\" time=\"0.000\">"
            "<skipped message=\"ran on a GPU\"/></testcase>\n"
            "  </testsuite>\n"
            "</testsuites>\n");
}

}  // namespace
}  // namespace hysteron::experiments
