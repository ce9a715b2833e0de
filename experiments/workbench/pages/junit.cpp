#include "experiments/workbench/pages/junit.h"

#include <fmt/core.h>

#include <algorithm>

#include "experiments/workbench/app/run_files.h"
#include "experiments/workbench/pages/page.h"
#include "sim/base/atomic_file.h"

namespace hysteron::experiments {
namespace {

using Outcome = TestCase::Outcome;

constexpr const char* kOwnClasses = "hysteron.";  // prefix of the subcommand

// Returns an XML attribute; XML 1.0 allows no control characters but white space, not even escaped.
std::string attribute(const std::string& name, std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c == 0x7F; }, ' ');
  return " " + name + "=\"" + escaped(text) + "\"";
}

std::string case_text(const std::string& class_name, const TestCase& c) {
  const std::string head = "    <testcase" + attribute("name", c.name) + attribute("classname", class_name) +
                           fmt::format(" time=\"{:.3f}\"", c.seconds);
  const std::string message = attribute("message", c.message);
  std::string inside;
  if (c.outcome == Outcome::failed) inside = "<failure" + message + attribute("type", "differs") + "/>";
  if (c.outcome == Outcome::broken) inside = "<error" + message + attribute("type", "not compared") + "/>";
  if (c.outcome == Outcome::skipped) inside = "<skipped" + message + "/>";
  if (inside.empty() && !c.message.empty()) inside = "<system-out>" + escaped(c.message) + "</system-out>";
  return inside.empty() ? head + "/>\n" : head + ">" + inside + "</testcase>\n";
}

}  // namespace

std::string junit_text(const std::string& subcommand, const std::string& suite,
                       const std::vector<TestCase>& cases) {
  const auto count = [&](Outcome outcome) {
    return std::count_if(cases.begin(), cases.end(), [&](const TestCase& c) { return c.outcome == outcome; });
  };
  double seconds = 0;
  for (const TestCase& c : cases) seconds += c.seconds;
  const std::string numbers =
      fmt::format(" tests=\"{}\" failures=\"{}\" errors=\"{}\" time=\"{:.3f}\"", cases.size(),
                  count(Outcome::failed), count(Outcome::broken), seconds);
  const std::string name = attribute("name", suite);
  std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites" + name + numbers +
                     ">\n  <testsuite" + name + numbers +
                     fmt::format(" skipped=\"{}\">\n", count(Outcome::skipped));
  for (const TestCase& c : cases) text += case_text(kOwnClasses + subcommand, c);
  return text + "  </testsuite>\n</testsuites>\n";
}

void require_own_junit(const std::filesystem::path& file) {
  require_own_file(file, std::string(" classname=\"") + kOwnClasses, "a JUnit file", "junit");
}

void write_junit(const std::filesystem::path& file, const std::string& subcommand, const std::string& suite,
                 const std::vector<TestCase>& cases) {
  if (file.has_parent_path()) make_folders(file.parent_path());
  write_text(file, junit_text(subcommand, suite, cases));
}

}  // namespace hysteron::experiments
