// Programs that are run without a shell.
#include "sim/base/process.h"

#include <gtest/gtest.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <string>
#include <vector>

#include "sim/base/error.h"

namespace hysteron::render {
namespace {

TEST(Process, GetsItsInputAndGivesItsExitCodeAndFirstLineOfErrors) {
  const std::string say = "read word; echo what was found; echo \"$word!\" >&2; exit 7";
  const ProcessResult result = run_process({"sh", "-c", say}, "said\n");
  EXPECT_TRUE(result.started);
  EXPECT_EQ(result.exit_code, 7);
  EXPECT_EQ(result.first_error_line, "said!");
}

// A run that fails may have warned before.
TEST(Process, FailsForAnotherReasonThanAWarning) {
  const auto first_line = [](const std::string& said) {
    return run_process({"sh", "-c", "printf '" + said + "' >&2"}, "").first_error_line;
  };
  EXPECT_EQ(first_line("\\nwarning: thin\\nwarning: coarse\\n  no room\\nmore\\n"), "no room");
  EXPECT_EQ(first_line("warning: thin\\n"), "warning: thin");
  EXPECT_EQ(first_line("\\n"), "it said nothing");
}

TEST(Process, IsHeardLineByLineAsItSpeaks) {
  std::vector<std::string> heard;
  const std::string say = "echo one; echo two; echo wrong >&2; read word; echo \"$word\"; printf half";
  const ProcessResult result =
      run_process({"sh", "-c", say}, "three\n", [&](const std::string& line) { heard.push_back(line); });
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.first_error_line, "wrong");
  EXPECT_EQ(heard, (std::vector<std::string>{"one", "two", "three"})) << "no half lines";
}

// More than pipes hold, in each direction.
TEST(Process, MayWriteAsMuchAsItReads) {
  std::string input;
  for (int k = 0; k < 50000; ++k) input += std::to_string(k) + "\n";
  int heard = 0;
  bool in_order = true;
  const ProcessResult result = run_process({"tee", "/dev/stderr"}, input, [&](const std::string& line) {
    in_order = in_order && line == std::to_string(heard++);
  });
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(heard, 50000);
  EXPECT_TRUE(in_order);
}

TEST(Process, ThatDoesNotExistIsNotStarted) { EXPECT_FALSE(run_process({"/no/such/program"}, "").started); }

// The one in the middle runs a program that says its number and would last longer than a test may.
TEST(Process, EndsWhenTheOneThatRunsItIsKilled) {
  ASSERT_EQ(prctl(PR_SET_CHILD_SUBREAPER, 1), 0);  // orphans come to this process
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  const std::string say = "echo $$ >&" + std::to_string(ends[1]) + "; exec sleep 60";
  const pid_t middle = fork();
  if (middle == 0) {
    run_process({"sh", "-c", say}, "");
    _exit(0);
  }
  close(ends[1]);
  char text[32] = {};
  ASSERT_GT(read(ends[0], text, sizeof text - 1), 0);
  const pid_t last = static_cast<pid_t>(std::atoi(text));
  kill(middle, SIGKILL);
  ASSERT_EQ(waitpid(middle, nullptr, 0), middle);
  int status = 0;
  ASSERT_EQ(waitpid(last, &status, 0), last);
  EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGTERM);
  close(ends[0]);
}

TEST(AnswerOfChild, IsWhatTheCallReturnsOrThrows) {
  EXPECT_EQ(answer_of_child([] { return std::string("two\nlines"); }), "two\nlines");
  EXPECT_EQ(answer_of_child([] { return std::string(100000, 'x'); }).size(), 100000u)
      << "more than a pipe holds";
  const auto failure = [](const std::function<std::string()>& call, unsigned longest = 10) -> std::string {
    try {
      return "answered " + answer_of_child(call, longest);
    } catch (const Error& error) {
      return error.what();
    }
  };
  EXPECT_EQ(failure([]() -> std::string { throw Error::system("no driver"); }), "no driver");
  EXPECT_EQ(failure([]() -> std::string { std::abort(); }), "it ends by a signal (Aborted)");
  EXPECT_EQ(failure([]() -> std::string { std::_Exit(0); }), "it ends its process");
  EXPECT_EQ(failure(
                [] {
                  ::sleep(30);
                  return std::string();
                },
                1),
            "it takes longer than 1 s");
}

}  // namespace
}  // namespace hysteron::render
