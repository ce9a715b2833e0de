#include "sim/base/process.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
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

struct Pipes {
  Pipe input, output, errors;
};

// Runs between fork and exec.  The child gets our pipes as stdin and stderr, and as stdout if there is one
// for it; else its stdout goes to /dev/null, so that it stays out of ours.  It gets SIGTERM when the thread
// that started it is gone, so that it does not compute for nobody when we are killed.
[[noreturn]] void become(char* const* arguments, const Pipes& pipes, const Pipe& failure, pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (::getppid() != parent) ::_exit(EXIT_FAILURE);  // the parent ended before prctl()
  const int output = pipes.output.in() >= 0 ? pipes.output.in() : ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (::dup2(pipes.input.out(), STDIN_FILENO) >= 0 && ::dup2(output, STDOUT_FILENO) >= 0 &&
      ::dup2(pipes.errors.in(), STDERR_FILENO) >= 0)
    ::execvp(arguments[0], arguments);
  const int reason = errno;
  [[maybe_unused]] const ssize_t told = ::write(failure.in(), &reason, sizeof reason);
  ::_exit(EXIT_FAILURE);
}

// Returns false if there is no such program.
bool spawn(const std::vector<std::string>& words, const Pipes& pipes, pid_t& child) {
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  Pipe failure;  // closed by a successful exec
  const pid_t parent = ::getpid();
  child = ::fork();
  if (child == 0) become(arguments.data(), pipes, failure, parent);
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

// Reads what has arrived; closes a pipe at its end.
void read_more(Pipe& pipe, std::string& text) {
  char buffer[4096];
  const ssize_t read = ::read(pipe.out(), buffer, sizeof buffer);
  if (read > 0) text.append(buffer, static_cast<size_t>(read));
  if (read == 0 || (read < 0 && errno != EINTR)) pipe.close_out();
}

void write_more(Pipe& pipe, std::string_view& text) {
  const ssize_t written = ::write(pipe.in(), text.data(), text.size());
  if (written > 0) text.remove_prefix(static_cast<size_t>(written));
  if (text.empty() || (written < 0 && errno != EAGAIN && errno != EINTR)) pipe.close_in();
}

// Removes whole lines from the text and passes each to `said`.
void take_lines(std::string& text, const std::function<void(const std::string&)>& said) {
  std::size_t begin = 0;
  for (std::size_t end; (end = text.find('\n', begin)) != text.npos; begin = end + 1)
    said(text.substr(begin, end - begin));
  text.erase(0, begin);
}

// Writes the input while reading the child's output: a child that fills one pipe must not wait for us
// forever.  Returns what it wrote to stderr.
std::string exchange(Pipes& pipes, std::string_view text,
                     const std::function<void(const std::string&)>& said) {
  std::string errors, output;
  ::fcntl(pipes.input.in(), F_SETFL, O_NONBLOCK);
  while (pipes.errors.out() >= 0 || pipes.output.out() >= 0) {
    // Closed pipes have the number -1, which poll() passes over.
    pollfd ends[3] = {
        {pipes.errors.out(), POLLIN, 0}, {pipes.output.out(), POLLIN, 0}, {pipes.input.in(), POLLOUT, 0}};
    if (::poll(ends, 3, -1) < 0) {
      if (errno != EINTR) break;
      continue;
    }
    if (ends[2].revents) write_more(pipes.input, text);
    if (ends[0].revents) read_more(pipes.errors, errors);
    if (ends[1].revents) {
      read_more(pipes.output, output);
      take_lines(output, said);
    }
  }
  return errors;
}

// Returns the first line that is not blank and no warning: warnings do not say why a program failed.
std::string first_line_with_text(const std::string& said) {
  std::string first;
  for (size_t begin = 0; (begin = said.find_first_not_of(" \t\r\n", begin)) != said.npos;) {
    const size_t end = std::min(said.find('\n', begin), said.size());
    const std::string line = said.substr(begin, end - begin);
    if (!line.starts_with("warning: ")) return line;
    if (first.empty()) first = line;
    begin = end;
  }
  return first.empty() ? "it said nothing" : first;
}

// Ignores SIGPIPE: a child that exits before reading its input must not end us.
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

ProcessResult run_process(const std::vector<std::string>& words, const std::string& input,
                          const std::function<void(const std::string&)>& said) {
  ProcessResult result;
  Pipes pipes;
  if (!said) pipes.output.close_out(), pipes.output.close_in();
  pid_t child = 0;
  result.started = spawn(words, pipes, child);
  if (!result.started) return result;
  pipes.input.close_out();
  pipes.output.close_in();
  pipes.errors.close_in();
  const IgnoreBrokenPipe quiet;
  result.first_error_line = first_line_with_text(exchange(pipes, input, said));
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status)) result.exit_code = WEXITSTATUS(status);
  return result;
}

}  // namespace hysteron
