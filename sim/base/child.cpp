#include "sim/base/process.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <string_view>

#include "sim/base/error.h"

namespace hysteron {
namespace {

constexpr char kAnswer = 'a', kFailure = 'f';  // a child's first byte says which one follows

void write_all(int end, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(end, text.data(), text.size());
    if (written < 0 && errno != EINTR) return;
    if (written > 0) text.remove_prefix(static_cast<std::size_t>(written));
  }
}

std::string read_all(int end) {
  std::string text;
  char buffer[4096];
  for (ssize_t count; (count = ::read(end, buffer, sizeof buffer)) != 0;) {
    if (count > 0) text.append(buffer, static_cast<std::size_t>(count));
    if (count < 0 && errno != EINTR) break;
  }
  return text;
}

std::string outcome_of(const std::function<std::string()>& call) {
  try {
    return kAnswer + call();
  } catch (const std::exception& error) {
    return kFailure + std::string(error.what());
  } catch (...) {
    return std::string(1, kFailure) + "unexpected failure";
  }
}

// Runs in the child, with none of the parent's signal handlers.
[[noreturn]] void call_and_end(const std::function<std::string()>& call, int answers, unsigned longest) {
  for (const int signal : {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGALRM}) std::signal(signal, SIG_DFL);
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO}) ::dup2(nowhere, stream);
  ::alarm(longest);
  write_all(answers, outcome_of(call));
  ::_exit(EXIT_SUCCESS);
}

void refuse_signal(int status, unsigned longest) {
  if (!WIFSIGNALED(status)) return;
  if (WTERMSIG(status) == SIGALRM)
    throw Error::system("it takes longer than " + std::to_string(longest) + " s");
  throw Error::system(std::string("it ends by a signal (") + strsignal(WTERMSIG(status)) + ")");
}

}  // namespace

std::string answer_of_child(const std::function<std::string()>& call, unsigned longest) {
  const auto refuse = [] {
    throw Error::system(std::string("cannot start a process to try it: ") + std::strerror(errno));
  };
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) refuse();
  const pid_t child = ::fork();
  if (child == 0) {
    ::close(ends[0]);
    call_and_end(call, ends[1], longest);
  }
  ::close(ends[1]);
  const std::string outcome = child > 0 ? read_all(ends[0]) : "";
  ::close(ends[0]);
  if (child < 0) refuse();
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  refuse_signal(status, longest);
  if (outcome.empty()) throw Error::system("it ends its process");
  if (outcome.front() == kFailure) throw Error::system(outcome.substr(1));
  return outcome.substr(1);
}

}  // namespace hysteron
