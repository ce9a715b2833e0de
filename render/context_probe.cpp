#include "render/context_probe.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>

#include "render/contexts.h"
#include "sim/base/error.h"

namespace hysteron::render {
namespace {

constexpr unsigned kLongest = 10;  // [s] that a context takes, on a slow machine

// The child's end: without the parent's handlers of signals, and without words.
[[noreturn]] void call_and_end(const std::function<void()>& call) {
  for (const int signal : {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGALRM}) std::signal(signal, SIG_DFL);
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO}) ::dup2(nowhere, stream);
  ::alarm(kLongest);
  try {
    call();
  } catch (...) {  // the parent meets the same, and says it
  }
  ::_exit(EXIT_SUCCESS);
}

}  // namespace

void try_in_child(const std::function<void()>& call) {
  const pid_t child = ::fork();
  if (child < 0)
    throw Error::system(std::string("cannot start a process to try it: ") + std::strerror(errno));
  if (child == 0) call_and_end(call);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFSIGNALED(status))
    throw Error::system(std::string("it ends by a signal (") + strsignal(WTERMSIG(status)) + ")");
}

std::string named_driver() {
  for (const char* variable : {"GALLIUM_DRIVER", "MESA_LOADER_DRIVER_OVERRIDE", "LIBGL_DRIVERS_PATH"}) {
    const char* value = std::getenv(variable);
    const std::string driver = value ? value : "";
    if (!driver.empty() && driver != "llvmpipe" && driver != "softpipe" && driver != "swrast")
      return std::string(variable) + " = " + driver;
  }
  return "";
}

void require_no_crash(const Candidate& candidate) {
  const std::string driver = named_driver();
  if (driver.empty() || candidate.hardware) return;
  try {
    try_in_child([&] {
      if (candidate.kind == Candidate::Kind::osmesa)
        create_osmesa_context(candidate);
      else
        create_egl_context(candidate);
    });
  } catch (const Error& error) {
    throw Error::system(error.what() + (" with " + driver));
  }
}

}  // namespace hysteron::render
