// Writes a comparison as a JUnit file, which continuous integration shows as tests.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace hysteron::experiments {

struct TestCase {
  enum class Outcome { passed, failed, broken, skipped };  // `broken`: it could not be compared

  std::string name;
  Outcome outcome = Outcome::passed;
  std::string message{};  // one line; "" if there is nothing to say
  double seconds = 0;     // wall clock [s]
};

// Returns one <testsuite> of that name within <testsuites>; a case's class is hysteron.<subcommand>.
std::string junit_text(const std::string& subcommand, const std::string& suite,
                       const std::vector<TestCase>& cases);
// `require_own_junit` throws Error::invalid_input for an existing file that is no such file of this program.
// `write_junit` writes it, and the file's folder if it is missing; it throws Error::system.
void require_own_junit(const std::filesystem::path& file);
void write_junit(const std::filesystem::path& file, const std::string& subcommand, const std::string& suite,
                 const std::vector<TestCase>& cases);

}  // namespace hysteron::experiments
