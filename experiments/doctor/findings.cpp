#include "experiments/doctor/findings.h"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "experiments/workbench/app/this_program.h"
#include "render/gnuplot.h"
#include "sim/base/csv.h"
#include "sim/base/error.h"
#include "sim/base/process.h"
#include "sim/device/visible_gpus.h"
#include "sim/scene/assets.h"
#include "sim/scene/keys.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;

constexpr const char* kRenderer = "renderer";
constexpr double kGibibyte = 1 << 30;  // [byte]
// Free disk space [byte] several times that of a small run with its pictures.
constexpr std::uintmax_t kLeastRoom = 64 << 20;
constexpr unsigned kLongest = 20;  // timeout [s] for another program to state its version

Finding program_finding() {
  const Manifest program = this_program();
  const char* missing = missing_instructions();
  const std::string built =
      "hysteron " + program_version(program) + ", compiled by " + program.compiler + " for " + program.isa;
  return {.part = "program",
          .found = !missing,
          .text = missing ? built + ", and this CPU lacks " + missing : built + ", which this CPU has",
          .cost = "it may end by an illegal instruction",
          .remedy = "build it here, or with -DHYSTERON_ARCH=x86-64-v2",
          .needed = true};
}

// Parses "MemAvailable:   12345 kB" and returns it in bytes; 0 if the system does not state it.
double available_memory() {
  std::ifstream lines("/proc/meminfo");
  for (std::string name, unit; lines >> name;) {
    double amount = 0;
    lines >> amount;
    std::getline(lines, unit);
    if (name == "MemAvailable:") return 1024 * amount;
  }
  return 0;
}

Finding memory_finding() {
  const double all =
      static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
  return {
      .part = "memory",
      .found = true,
      .text = fmt::format("{} cores, {:.1f} GiB of memory, {:.1f} GiB of it available",
                          sysconf(_SC_NPROCESSORS_ONLN), all / kGibibyte, available_memory() / kGibibyte)};
}

// Returns "580.159.04" of "NVRM version: NVIDIA UNIX Open Kernel Module for x86_64  580.159.04  Release
// Build"; "" if there is no such file.
std::string nvidia_driver() {
  std::ifstream in("/proc/driver/nvidia/version");
  bool is_behind_module = false;
  for (std::string word; in >> word;) {
    const bool is_number = word.front() >= '0' && word.front() <= '9';
    if (is_behind_module && is_number) return word;
    is_behind_module = is_behind_module || word == "Module";
  }
  return "";
}

std::string gpu_remedy() {
  const bool has_gpus = gpus_of_machine() > 0;
  if (!is_built_with_cuda())
    return has_gpus ? "apt install nvidia-cuda-toolkit, from non-free, and build again" : "";
  if (std::getenv(kVisibleGpus)) return std::string("unset ") + kVisibleGpus;
  return nvidia_driver().empty() ? "where there is an NVIDIA GPU, apt install nvidia-driver, from non-free"
                                 : "";
}

Finding gpu_finding(const TriedDevice& device) {
  Finding finding{.part = device.kind, .found = device.failure.empty(), .text = device.name};
  if (finding.found) {
    const std::string driver = nvidia_driver();
    const char* const visible = std::getenv(kVisibleGpus);
    if (!driver.empty()) finding.text += ", driver " + driver;
    if (visible) finding.text += std::string(", ") + kVisibleGpus + " = " + visible;
    return finding;
  }
  finding.text = device.name == "none" ? device.failure : device.name + ": " + device.failure;
  if (!is_built_with_cuda() && gpus_of_machine() > 0)
    finding.text += ", and this machine has " + gpus_text(gpus_of_machine());
  finding.cost = "runs are computed on the CPU";
  finding.remedy = gpu_remedy();
  return finding;
}

Finding renderer_finding(const TriedDevice& device, const std::string& other) {
  Finding finding{.part = kRenderer, .found = device.failure.empty(), .text = device.name, .needed = true};
  if (finding.found) return finding;
  finding.text += ": " + device.failure;
  finding.cost =
      other.empty() ? "no pictures are drawn: runs take --no-images" : "nothing is lost, " + other + " draws";
  if (other.empty())
    finding.remedy = device.id == "OSMesa" ? "apt install libosmesa6, which Debian 13 no longer has"
                                           : "apt install libegl1 libgl1-mesa-dri";
  return finding;
}

Finding gnuplot_finding(const render::gnuplot::Trial& trial) {
  Finding finding{.part = "gnuplot",
                  .found = trial.failure.empty(),
                  .text = trial.version + ", draws PNG, SVG" + (trial.writes_pdf ? " and PDF" : ", no PDF"),
                  .cost = "plots are not drawn, their tables are written",
                  .remedy = "apt install gnuplot-nox"};
  if (!finding.found) finding.text = trial.failure;
  return finding;
}

Finding fonts_finding(const render::gnuplot::Trial& trial) {
  const std::string captions = "captions of pictures have DejaVu Sans in the program";
  if (!trial.failure.empty()) return {.part = "fonts", .found = true, .text = captions};
  return {.part = "fonts",
          .found = trial.has_letters,
          .text = trial.has_letters ? captions + ", plots find theirs" : "gnuplot finds none",
          .cost = "plots are not drawn, their tables are written",
          .remedy = "apt install fontconfig fonts-dejavu-core"};
}

// Tries gnuplot in a child of a child, so that a hanging gnuplot ends with its parent.
render::gnuplot::Trial tried_gnuplot() {
  try {
    const Json answer = Json::parse(answer_of_child(
        [] {
          const render::gnuplot::Trial trial = render::gnuplot::try_gnuplot();
          return Json{trial.version, trial.writes_pdf, trial.failure, trial.has_letters}.dump(
              -1, ' ', false, Json::error_handler_t::replace);
        },
        kLongest));
    return {answer[0], answer[1], answer[2], answer[3]};
  } catch (const Error& error) {
    return {.failure = std::string("gnuplot fails: ") + error.what()};
  }
}

// Returns the first line that a program writes to stdout.  Throws Error::system if it cannot be started or
// fails.
std::string first_line_of(const std::vector<std::string>& words) {
  return answer_of_child(
      [&] {
        std::string first;
        const auto read = [&](const std::string& line) {
          if (first.empty()) first = line;
        };
        const ProcessResult result = run_process(words, "", read);
        if (!result.started) throw Error::system(words.front() + " cannot be started");
        if (result.exit_code != 0)
          throw Error::system(words.front() + " fails: " + (first.empty() ? result.first_error_line : first));
        return first;
      },
      kLongest);
}

Finding tried_program(Finding finding, const std::vector<std::string>& words) {
  try {
    finding.text = first_line_of(words);
    finding.found = true;
  } catch (const Error& error) {
    finding.text = error.what();
  }
  return finding;
}

Finding ffmpeg_finding() {
  Finding finding = tried_program({.part = "ffmpeg",
                                   .cost = "compare.video writes no film, pictures are drawn",
                                   .remedy = "apt install ffmpeg"},
                                  {"ffmpeg", "-version"});
  if (finding.found) finding.text = finding.text.substr(0, finding.text.find(" Copyright"));
  return finding;
}

Finding assets_finding() {
  Finding finding{.part = "assets", .cost = "no fabric and no scene is found by its name", .needed = true};
  try {
    finding.text = fmt::format("{}: {} fabrics, {} scenes", assets_folder().string(),
                               list_assets("fabrics").size(), list_assets("scenes").size());
    finding.found = !list_assets("fabrics").empty() && !list_assets("scenes").empty();
    finding.remedy = "set HYSTERON_ASSETS to the folder assets of hysteron's sources";
  } catch (const Error& error) {
    finding.text = error.what();
  }
  return finding;
}

Finding python_finding() {
  std::error_code none;
  const fs::path package = fs::read_symlink("/proc/self/exe", none).parent_path() / "python";
  Finding finding{.part = "python",
                  .text = "no package hysteron_cloth beside the program",
                  .cost = "Python imports none but an installed one",
                  .remedy = "apt install python3-dev pybind11-dev python3-numpy, and build again"};
  if (!fs::is_directory(package / "hysteron_cloth", none)) return finding;
  constexpr const char* kImport =
      "import sys\n"
      "try:\n"
      "  sys.path.insert(0, sys.argv[1]); import hysteron_cloth\n"
      "  print('hysteron_cloth', hysteron_cloth.__version__, 'of Python', sys.version.split()[0])\n"
      "except BaseException as error:\n"
      "  print(type(error).__name__ + ':', error); sys.exit(1)\n";
  finding = tried_program(finding, {"python3", "-B", "-c", kImport, package.string()});
  if (finding.found) finding.text += ", PYTHONPATH=" + package.string();
  return finding;
}

}  // namespace

std::vector<Finding> device_findings(const std::vector<TriedDevice>& devices) {
  std::string drawing;  // the first renderer that works
  for (const TriedDevice& device : devices)
    if (drawing.empty() && device.kind == kRenderer && device.failure.empty()) drawing = device.id;
  std::vector<Finding> findings;
  for (const TriedDevice& device : devices) {
    if (device.kind == kRenderer)
      findings.push_back(renderer_finding(device, drawing));
    else if (device.kind == "cuda")
      findings.push_back(gpu_finding(device));
    else
      findings.push_back({.part = device.kind, .found = true, .text = device.name});
  }
  return findings;
}

Finding disk_finding(const fs::path& out) {
  std::error_code failure;
  fs::path place = fs::absolute(out).lexically_normal();
  while (place.has_relative_path() && !fs::exists(place, failure)) place = place.parent_path();
  Finding finding{.part = "disk", .cost = "runs have no place for what they write", .needed = true};
  finding.remedy = "name another folder by --out";
  if (!fs::is_directory(place, failure) || ::access(place.c_str(), W_OK | X_OK) != 0) {
    finding.text = out.string() + ": nothing can be written into " + place.string();
    return finding;
  }
  const auto room = fs::space(place, failure);
  if (failure) {
    finding.text = out.string() + ": " + failure.message();
    return finding;
  }
  finding.found = room.available >= kLeastRoom;
  finding.text =
      fmt::format("{}: {:.1f} GiB are free", out.string(), static_cast<double>(room.available) / kGibibyte);
  return finding;
}

std::vector<Finding> findings(const std::vector<TriedDevice>& devices, const fs::path& out) {
  const render::gnuplot::Trial gnuplot = tried_gnuplot();
  std::vector<Finding> all = {program_finding(), memory_finding()};
  for (const Finding& device : device_findings(devices)) all.push_back(device);
  for (const Finding& finding : {gnuplot_finding(gnuplot), fonts_finding(gnuplot), ffmpeg_finding(),
                                 disk_finding(out), assets_finding(), python_finding()})
    all.push_back(finding);
  return all;
}

std::string finding_line(const Finding& finding) {
  std::string text = finding.text;
  if (!finding.found) text = "lacking: " + text + "; " + finding.cost;
  if (!finding.found && !finding.remedy.empty()) text += " (" + finding.remedy + ")";
  return aligned({finding.part, text}, {-10});
}

std::vector<std::string> lacking_parts(const std::vector<Finding>& findings) {
  std::vector<std::string> parts;
  for (const Finding& finding : findings) {
    const bool is_there = std::any_of(findings.begin(), findings.end(), [&](const Finding& other) {
      return other.part == finding.part && other.found;
    });
    if (finding.needed && !is_there && !std::count(parts.begin(), parts.end(), finding.part))
      parts.push_back(finding.part);
  }
  return parts;
}

}  // namespace hysteron::experiments
