// `hysteron batch` runs one command line or several in one process, so that on a GPU they share launches.
// Sweeps, comparisons and all other subcommands that run simulations side by side start it.
//
//   stdin: one list of words a line -> runs, each as if started alone -> stdout: one
//   {"run", "exit_code", "error"} a line, as runs end
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>

#include "experiments/workbench/app/command_line.h"
#include "experiments/workbench/app/exit_status.h"
#include "experiments/workbench/app/gpu_choice.h"
#include "experiments/workbench/app/json_file.h"
#include "experiments/workbench/app/manifest.h"
#include "experiments/workbench/session/driver.h"
#include "experiments/workbench/session/interrupts.h"
#include "sim/base/error.h"
#include "sim/time/back_end.h"
#include "sim/time/together.h"

namespace hysteron::experiments {
namespace {

struct Member {
  std::string experiment;           // empty until it is known
  std::optional<CommandLine> line;  // empty once the run has ended, as `ending` says
  ExitStatus ending;
};

// Keeps the stdout of the process for reports alone: what the runs print is discarded, as if each were a
// process of its own.
class Reports {
 public:
  Reports() : out_(::dup(STDOUT_FILENO)) {
    const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (out_ < 0 || nowhere < 0 || ::dup2(nowhere, STDOUT_FILENO) < 0)
      throw Error::system(std::string("cannot set standard output apart: ") + std::strerror(errno));
    ::fcntl(out_, F_SETFD, FD_CLOEXEC);
    ::close(nowhere);
  }
  ~Reports() {
    ::dup2(out_, STDOUT_FILENO);
    ::close(out_);
  }
  Reports(const Reports&) = delete;
  Reports& operator=(const Reports&) = delete;

  void say(int run, const ExitStatus& ending) const {
    const Json report = {{"run", run}, {"exit_code", ending.exit_code}, {"error", ending.error}};
    const std::string line = report.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
    for (std::size_t done = 0; done < line.size();) {
      const ssize_t written = ::write(out_, line.data() + done, line.size() - done);
      if (written < 0 && errno != EINTR) throw Error::system("cannot write to standard output");
      done += static_cast<std::size_t>(std::max<ssize_t>(written, 0));
    }
  }

 private:
  int out_;
};

// Parses the words as the program would if it were started with them.
Member parsed(std::vector<std::string> words) {
  Member member;
  const std::string name = words.empty() ? "" : words.front();
  std::vector<Experiment> known = experiments();
  if (std::any_of(known.begin(), known.end(), [&](const Experiment& e) { return e.name == name; }))
    known = {experiment_named(name)};
  words.insert(words.begin(), std::filesystem::read_symlink("/proc/self/exe").string());
  member.ending = run_guarded(member.experiment, [&] {
    member.line = parse_command_line(words, known);
    if (!member.line) return 0;
    member.experiment = member.line->experiment;
    choose_gpu(*member.line);
    return 0;
  });
  if (!member.ending.error.empty()) member.line.reset();
  return member;
}

std::vector<Member> members_in(std::istream& lines) {
  std::vector<Member> members;
  for (std::string line; std::getline(lines, line);) {
    const Json words = parsed_json(line);
    const auto is_text = [](const Json& word) { return word.is_string(); };
    if (!words.is_array() || !std::all_of(words.begin(), words.end(), is_text))
      throw Error::invalid_input("line " + std::to_string(members.size() + 1) +
                                 " of stdin is no list of words");
    members.push_back(parsed(words.get<std::vector<std::string>>()));
  }
  return members;
}

bool any(const std::vector<Member>& members, const std::function<bool(const CommandLine&)>& is_such) {
  return std::any_of(members.begin(), members.end(),
                     [&](const Member& member) { return member.line && is_such(*member.line); });
}

int run_batch(const CommandLine&) {
  std::vector<Member> members = members_in(std::cin);
  const Reports reports;
  std::string reason;  // why not; a single run has no other to share a GPU's launches with
  const bool on_gpu = members.size() > 1 && any(members, may_use_gpu) && gpu_count(reason) > 0;
  // One signal stops all of the runs, also those that have not begun.
  std::optional<Interrupts> interrupts;
  if (any(members, [](const CommandLine& line) { return last_text(line.flags, "checkpoint", "0") != "0"; }))
    interrupts.emplace();
  run_batched_scenes(on_gpu, static_cast<int>(members.size()), [&](int i) {
    Member& member = members[static_cast<std::size_t>(i)];
    if (member.line)
      member.ending = run_guarded(member.experiment, [&] { return run_experiment(*member.line); });
    reports.say(i, member.ending);
  });
  return 0;
}

}  // namespace

Experiment batch() {
  return {.name = "batch",
          .question = "command lines from stdin in one process, for sweeps and comparisons",
          .run = run_batch,
          .hidden = true};
}

}  // namespace hysteron::experiments
