#include "sim/base/process.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <string_view>

namespace hysteron {
namespace {

class Pipe {
 public:
  Pipe() {
    int ends[2] = {-1, -1};
    if (::pipe2(ends, O_CLOEXEC) == 0) out_ = ends[0], in_ = ends[1];
  }
  ~Pipe() { close_out(), close_in(); }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  int out() const { return out_; }
  int in() const { return in_; }
  void close_out() { close_end(out_); }
  void close_in() { close_end(in_); }

 private:
  static void close_end(int& end) {
    if (end >= 0) ::close(end);
    end = -1;
  }
  int out_ = -1, in_ = -1;
};

// Between fork and exec: our pipes at its stdin and stderr, its stdout joined to stderr so that it stays out
// of ours.  It gets SIGTERM when the thread that started it is gone: we may be killed, and it is not to
// compute for nobody.
[[noreturn]] void become(char* const* arguments, const Pipe& input, const Pipe& errors, const Pipe& failure,
                         pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (::getppid() != parent) ::_exit(EXIT_FAILURE);  // gone before it could be asked for
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (::dup2(input.out(), STDIN_FILENO) >= 0 && ::dup2(nowhere, STDOUT_FILENO) >= 0 &&
      ::dup2(errors.in(), STDERR_FILENO) >= 0)
    ::execvp(arguments[0], arguments);
  const int reason = errno;
  [[maybe_unused]] const ssize_t told = ::write(failure.in(), &reason, sizeof reason);
  ::_exit(EXIT_FAILURE);
}

// False if there is no such program.
bool spawn(const std::vector<std::string>& words, const Pipe& input, const Pipe& errors, pid_t& child) {
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  Pipe failure;  // closed by a successful exec
  const pid_t parent = ::getpid();
  child = ::fork();
  if (child == 0) become(arguments.data(), input, errors, failure, parent);
  if (child < 0) return false;
  failure.close_in();
  int reason = 0;
  ssize_t read;
  while ((read = ::read(failure.out(), &reason, sizeof reason)) < 0 && errno == EINTR) {
  }
  if (read <= 0) return true;
  ::waitpid(child, nullptr, 0);
  return false;
}

// Writes the input while reading the errors: a child that fills one pipe must not wait for us forever.
std::string exchange(Pipe& input, Pipe& errors, std::string_view text) {
  std::string said;
  char buffer[4096];
  ::fcntl(input.in(), F_SETFL, O_NONBLOCK);
  while (true) {
    pollfd ends[2] = {{errors.out(), POLLIN, 0}, {input.in(), POLLOUT, 0}};
    if (::poll(ends, input.in() >= 0 ? 2 : 1, -1) < 0 && errno != EINTR) break;
    if (input.in() >= 0 && ends[1].revents) {
      const ssize_t written = ::write(input.in(), text.data(), text.size());
      if (written > 0) text.remove_prefix(static_cast<size_t>(written));
      if (text.empty() || (written < 0 && errno != EAGAIN && errno != EINTR)) input.close_in();
    }
    if (!ends[0].revents) continue;
    const ssize_t read = ::read(errors.out(), buffer, sizeof buffer);
    if (read == 0 || (read < 0 && errno != EINTR)) break;
    if (read > 0) said.append(buffer, static_cast<size_t>(read));
  }
  return said;
}

std::string first_line_with_text(const std::string& said) {
  const size_t begin = said.find_first_not_of(" \t\r\n");
  return begin == std::string::npos ? "it said nothing" : said.substr(begin, said.find('\n', begin) - begin);
}

// A child that exits before reading its input must not end us.
class IgnoreBrokenPipe {
 public:
  IgnoreBrokenPipe() : before_(std::signal(SIGPIPE, SIG_IGN)) {}
  ~IgnoreBrokenPipe() { std::signal(SIGPIPE, before_); }
  IgnoreBrokenPipe(const IgnoreBrokenPipe&) = delete;
  IgnoreBrokenPipe& operator=(const IgnoreBrokenPipe&) = delete;

 private:
  void (*before_)(int);
};

}  // namespace

ProcessResult run_process(const std::vector<std::string>& words, const std::string& input_text) {
  ProcessResult result;
  Pipe input, errors;
  pid_t child = 0;
  result.started = spawn(words, input, errors, child);
  if (!result.started) return result;
  input.close_out();
  errors.close_in();
  const IgnoreBrokenPipe quiet;
  result.first_error_line = first_line_with_text(exchange(input, errors, input_text));
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status)) result.exit_code = WEXITSTATUS(status);
  return result;
}

}  // namespace hysteron
