#include "render/process.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <string_view>

extern char** environ;

namespace hysteron::render {
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

// The child's side: our pipes at its stdin and stderr, its stdout joined to stderr so that it stays out of
// ours.
bool spawn(const std::vector<std::string>& words, const Pipe& input, const Pipe& errors, pid_t& child) {
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, input.out(), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, errors.in(), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, errors.in(), STDERR_FILENO);
  const int failure = ::posix_spawnp(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  return failure == 0;
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

}  // namespace hysteron::render
