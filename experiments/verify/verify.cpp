// Runs repeated and compared with what their manifests hold: one of them, or a folder of many.
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <iostream>
#include <set>

#include "experiments/verify/repetition.h"
#include "experiments/workbench/app/exit_codes.h"
#include "experiments/workbench/app/manifest_file.h"
#include "experiments/workbench/app/recorded_command.h"
#include "experiments/workbench/app/run.h"
#include "experiments/workbench/pages/junit.h"
#include "sim/base/error.h"
#include "sim/base/process.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;

struct VerifyChoice {
  double at_most = 0;
  std::string device;
  int threads = 0;
  bool exact = false;
  std::string limits = "pictures", junit;
};
using V = VerifyChoice;
// clang-format off
const KeyRow<V> kRows[] = {
    {"at-most", at<&V::at_most>, "s", at_least(0), "", "only runs that have taken this wall clock time or less, and no GPU; 0: all; with --quick 4 s unless given"},
    {"device", at<&V::device>, "", any(), "", "auto | cpu | cuda | cuda:N: where to repeat them in place of where they ran"},
    {"threads", at<&V::threads>, "", between(0, 1024), "", "CPU threads; 0: as many as they had"},
    {"exact", at<&V::exact>, "", any(), "", "the same bits are required of runs by another build or device, too"},
    {"limits", at<&V::limits>, "", any(), "", "a TOML file of limits on pictures and metrics, or one of assets/limits by its name"},
    {"junit", at<&V::junit>, "", any(), "", "a JUnit XML file, with a test case for each run"},
};
// clang-format on

constexpr double kQuickSeconds = 4;

Keys bind_verify(VerifyChoice& choice, Options& options) {
  Keys keys = with_output_options(bind(kRows, choice), options);
  std::erase_if(keys, [](const BoundKey& key) { return key.description.path == "json"; });
  return keys;
}

std::vector<KeyDescription> own_keys() {
  VerifyChoice choice;
  Options options;
  return descriptions(bind_verify(choice, options));
}

enum class Outcome { same, within, differs, skipped, failed };

struct Line {
  Outcome outcome;
  std::string words;
};

// Every folder below that holds a manifest, in the order of their names.
std::vector<fs::path> folders_below(const fs::path& folder) {
  std::set<fs::path> found;
  std::error_code failure;
  for (const auto& entry : fs::recursive_directory_iterator(folder, failure))
    if (entry.path().filename() == "manifest.json") found.insert(entry.path().parent_path());
  if (failure) throw Error::system("cannot read the folder " + folder.string() + ": " + failure.message());
  if (found.empty())
    throw Error::invalid_input("there is no manifest.json in " + folder.string() + " or below");
  return {found.begin(), found.end()};
}

bool has_runs_inside(const fs::path& folder) {
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored))
    if (has_manifest(entry.path())) return true;
  return false;
}

// Why there is nothing to repeat, or not now; "" if there is.
std::string why_skipped(const Manifest& m, const fs::path& folder, const VerifyChoice& choice) {
  static const std::set<std::string> kTimings = {"bench"};
  if (!m.complete) return "is not complete";
  if (kTimings.contains(m.experiment)) return "measures durations, which no two runs share";
  if (!m.state_hash && has_runs_inside(folder)) return "a page of several runs, each of which has a line";
  if (choice.at_most <= 0) return "";
  if (m.device && m.device->starts_with("cuda")) return "ran on a GPU";
  if (m.total_seconds() > choice.at_most)
    return fmt::format("took {:.3g} s, more than {:.3g} s", m.total_seconds(), choice.at_most);
  return "";
}

std::vector<std::string> command_for(const fs::path& folder, const fs::path& out, bool with_pictures,
                                     const VerifyChoice& choice) {
  std::vector<std::string> words = {fs::read_symlink("/proc/self/exe").string(),
                                    "rerun",
                                    folder.string(),
                                    "--out=" + out.string(),
                                    "--quiet",
                                    "--no-errors"};
  if (!with_pictures) words.push_back("--no-images");
  if (!choice.device.empty()) words.push_back("--device=" + choice.device);
  if (choice.threads > 0) words.push_back("--threads=" + std::to_string(choice.threads));
  return words;
}

std::string words_of(const Repetition& r, const std::string& reasons) {
  std::vector<std::string> parts;
  const std::string state = r.same_state ? "same state" : r.has_state ? "state differs" : "no state is kept";
  parts.push_back(fmt::format(
      "{}; {} of {} metrics the same", state,
      r.metrics - r.rounded.size() - r.effort.size() - r.within.size() - r.beyond.size(), r.metrics));
  if (!r.rounded.empty())
    parts.push_back(fmt::format("{} within round-off, {:.0e} of their size", r.rounded.size(), r.round_off));
  if (!r.effort.empty()) parts.push_back(fmt::format("{} of the solver's work", r.effort.size()));
  if (!r.within.empty()) parts.push_back("within their errors: " + join(r.within, ", "));
  if (!r.beyond.empty()) parts.push_back("beyond: " + join(r.beyond, ", "));
  if (!r.missing.empty()) parts.push_back("no longer measured: " + join(r.missing, ", "));
  if (r.pictures > 0 && r.pictures_beyond.empty())
    parts.push_back(fmt::format("{} picture{} the same", r.pictures, r.pictures == 1 ? "" : "s"));
  if (!r.pictures_beyond.empty()) parts.push_back("pictures differ: " + join(r.pictures_beyond, ", "));
  if (r.agreement() != Agreement::bits && !reasons.empty())
    parts.push_back("recorded by another: " + reasons);
  return join(parts, "; ");
}

Outcome outcome_of(Agreement agreement) {
  if (agreement == Agreement::bits) return Outcome::same;
  return agreement == Agreement::errors ? Outcome::within : Outcome::differs;
}

Line verified(const fs::path& folder, const fs::path& out, const VerifyChoice& choice, const Limits& limits,
              bool no_images) {
  const Manifest recorded = read_manifest(folder / "manifest.json");
  if (const std::string why = why_skipped(recorded, folder, choice); !why.empty())
    return {Outcome::skipped, "skipped: " + why};
  const std::vector<std::string> pictures =
      no_images ? std::vector<std::string>() : pictures_in(recorded, folder);
  const ProcessResult result = run_process(command_for(folder, out, !pictures.empty(), choice), "");
  if (result.exit_code != 0) {
    const std::string why = result.first_error_line.empty() ? "ended by a signal" : result.first_error_line;
    return {Outcome::failed, "could not be repeated: " + why};
  }
  const Manifest now = read_manifest(out / "manifest.json");
  Repetition repetition = compare_runs(recorded, now, limits, choice.exact);
  compare_pictures(pictures, folder, out, limits, repetition);
  if (!repetition.has_state && repetition.metrics + repetition.pictures == 0)
    return {Outcome::skipped, "skipped: it holds nothing that could be compared"};
  return {outcome_of(repetition.agreement()), words_of(repetition, reasons_between(recorded, now))};
}

const char* word_of(Outcome outcome) {
  constexpr const char* kWords[] = {"same", "within", "DIFFERS", "-", "failed"};
  return kWords[static_cast<int>(outcome)];
}

TestCase case_of(const std::string& name, const Line& said, double seconds) {
  using Case = TestCase::Outcome;
  constexpr Case kCases[] = {Case::passed, Case::passed, Case::failed, Case::skipped, Case::broken};
  return {name, kCases[static_cast<int>(said.outcome)], said.words, seconds};
}

int run_verify(const CommandLine& line) {
  if (line.names.size() != 1) throw Error::invalid_input("needs a run's folder, or a folder of many runs");
  VerifyChoice choice;
  Options options;
  options.out = "out/verify";
  set_keys(line, bind_verify(choice, options), [&] { choice.at_most = kQuickSeconds; });
  const fs::path root = line.names.front();
  const Limits limits = read_limits(choice.limits);
  const std::vector<fs::path> folders = folders_below(root);
  int count[5] = {};
  std::vector<TestCase> cases;
  for (const fs::path& folder : folders) {
    const std::string name = fs::relative(folder, root).string();
    const auto start = std::chrono::steady_clock::now();
    const Line said = verified(folder, fs::path(options.out) / name, choice, limits, options.no_images);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    cases.push_back(case_of(name, said, took.count()));
    ++count[static_cast<int>(said.outcome)];
    if (said.outcome == Outcome::skipped && options.quiet) continue;
    std::cout << fmt::format("{:<8}{:<36} {}", word_of(said.outcome), name, said.words) << std::endl;
  }
  const auto [same, within, differs, skipped, failed] = std::to_array(count);
  std::cout
      << fmt::format(
             "{} of {} runs repeated: {} the same, {} within errors, {} differ; {} could not be, {} skipped",
             same + within + differs, folders.size(), same, within, differs, failed, skipped)
      << std::endl;
  if (!choice.junit.empty()) write_junit(choice.junit, "verify", root.string(), cases);
  if (differs > 0) return kDiffers;
  if (same + within == 0)
    throw Error::invalid_input("nothing was compared: no run in " + root.string() + " could be repeated");
  return 0;
}

}  // namespace

Experiment verify() {
  return {.name = "verify",
          .question = "runs repeated and compared with their manifests: state, metrics, pictures",
          .run = run_verify,
          .own_keys = own_keys,
          .names = "DIR",
          .differs = "a run is not what its manifest says"};
}

}  // namespace hysteron::experiments
