// What was compared as a JUnit file, which continuous integration shows as tests.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace hysteron::experiments {

struct TestCase {
  enum class Outcome { passed, failed, broken, skipped };  // broken: it could not be compared

  std::string name;
  Outcome outcome = Outcome::passed;
  std::string message{};  // one line; "" where it passed without one
  double seconds = 0;     // of wall clock
};

// One <testsuite> of that name within <testsuites>; a case's class is hysteron.<subcommand>.
std::string junit_text(const std::string& subcommand, const std::string& suite,
                       const std::vector<TestCase>& cases);
// Writes it, and the file's folder where it is missing.  Throws Error::system.
// Refuses to replace a file that is no such file of this program.  Throws Error::invalid_input.
void require_own_junit(const std::filesystem::path& file);
void write_junit(const std::filesystem::path& file, const std::string& subcommand, const std::string& suite,
                 const std::vector<TestCase>& cases);

}  // namespace hysteron::experiments
