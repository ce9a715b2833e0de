// `hysteron verify` repeats runs and compares them with their manifests: one of them, or a folder of many.
#include <fmt/core.h>

#include <algorithm>
#include <iostream>
#include <optional>
#include <set>

#include "experiments/verify/recorded_tables.h"
#include "experiments/verify/repetition.h"
#include "experiments/workbench/app/exit_status.h"
#include "experiments/workbench/app/manifest_file.h"
#include "experiments/workbench/app/recorded_command.h"
#include "experiments/workbench/app/run.h"
#include "experiments/workbench/app/set_aside.h"
#include "experiments/workbench/compare/sweep_columns.h"
#include "experiments/workbench/pages/junit.h"
#include "sim/base/error.h"
#include "sim/base/whole_file.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;

struct VerifyParams {
  double at_most = 0;
  std::string device;
  int threads = 0;
  bool exact = false;
  std::string limits = "pictures", junit;
};
using V = VerifyParams;
// clang-format off
const KeyRow<V> kRows[] = {
    {"at-most", at<&V::at_most>, "s", at_least(0), "only runs that have taken this wall clock time or less, and no GPU; 0: all; with --quick 4 s unless given"},
    {"device", at<&V::device>, "", any(), "auto | cpu | cuda | cuda:N: where to repeat them in place of where they ran"},
    {"threads", at<&V::threads>, "", between(0, 1024), "CPU threads of each run; 0: its share of the cores"},
    {"exact", at<&V::exact>, "", any(), "the same bits are required of runs by another build or device, too"},
    {"limits", at<&V::limits>, "", any(), "a TOML file of limits on pictures and metrics, or one of assets/limits by its name"},
    {"junit", at<&V::junit>, "", any(), "a JUnit XML file, with a test case for each run"},
};
// clang-format on

constexpr double kQuickSeconds = 4;
constexpr const char* kRunsSeconds = "runs_wall_s";  // sum over all runs of a sweep

Keys bind_verify(VerifyParams& choice, Options& options) {
  Keys keys = with_output_options(bind(kRows, choice), options);
  std::erase_if(keys, [](const BoundKey& key) { return key.description.path == "json"; });
  return keys;
}

std::vector<KeyDescription> own_keys() {
  VerifyParams choice;
  Options options;
  return descriptions(bind_verify(choice, options));
}

enum class Outcome { same, within, differs, skipped, failed };

struct Line {
  Outcome outcome;
  std::string words;
};

// Returns every folder below that holds a manifest, in the order of their names.
std::vector<fs::path> folders_below(const fs::path& folder) {
  std::set<fs::path> found;
  std::error_code failure;
  for (const auto& entry : fs::recursive_directory_iterator(folder, failure))
    if (const fs::path inner = entry.path().parent_path();
        entry.path().filename() == "manifest.json" && (inner == folder || !is_set_aside(inner)))
      found.insert(inner);
  if (failure) throw unreadable(folder, failure);
  if (found.empty())
    throw Error::invalid_input("there is no manifest.json in " + folder.string() + " or below");
  return {found.begin(), found.end()};
}

// True if the folder holds columns of a comparison, or runs of a sweep in its folder `runs`.
bool has_runs_inside(const fs::path& folder) {
  std::error_code ignored;
  for (const fs::path& inner : {folder, folder / "runs"})
    for (const auto& entry : fs::directory_iterator(inner, ignored))
      if (has_manifest(entry.path()) && !is_set_aside(entry.path())) return true;
  return false;
}

// Returns why the run is not repeated, or "" if it is.
std::string why_skipped(const Manifest& m, const fs::path& folder, const VerifyParams& choice) {
  if (!m.complete) return "is not complete";
  if (experiment_named(m.experiment).timed) return "measures durations, which no two runs share";
  if (!m.state_hash && has_runs_inside(folder)) return "a page of several runs, each of which has a line";
  if (choice.at_most <= 0) return "";
  if (m.device && m.device->starts_with("cuda")) return "ran on a GPU";
  if (m.experiment == "sweep" && !m.metrics.contains(kRunsSeconds))
    return "was collected from runs that are not here, and does not say how long they took";
  const MetricValue& of_runs = m.metrics[kRunsSeconds];
  const double seconds = std::max(m.total_seconds(), of_runs.is_number() ? of_runs.number() : 0.0);
  if (seconds > choice.at_most)
    return fmt::format("took {:.3g} s, more than {:.3g} s", seconds, choice.at_most);
  return "";
}

// Joins one of the lists over the three kinds of numbers.
std::vector<std::string> listed(const Repetition& r, std::vector<std::string> ComparedNumbers::*list) {
  std::vector<std::string> all;
  for (const ComparedNumbers* numbers : {&r.metrics, &r.energies, &r.series})
    all.insert(all.end(), (numbers->*list).begin(), (numbers->*list).end());
  return all;
}

// Returns "3 pictures the same" if there are any and all are.
std::string all_same_text(int count, bool all_same, const std::string& thing) {
  return count > 0 && all_same ? fmt::format("{} {} the same", count, thing + (count == 1 ? "" : "s")) : "";
}

// Returns "remainder, newton_residual_largest and 3 others".
std::string first_names(const std::vector<std::string>& names) {
  constexpr std::size_t kMost = 4;
  if (names.size() <= kMost) return join(names, ", ");
  const std::vector<std::string> first(names.begin(), names.begin() + kMost - 1);
  return fmt::format("{} and {} others", join(first, ", "), names.size() - first.size());
}

std::string repetition_text(const Repetition& r, const std::string& reasons) {
  using N = ComparedNumbers;
  std::vector<std::string> parts;
  const auto add = [&](const std::string& before, const std::vector<std::string>& list) {
    if (!list.empty()) parts.push_back(before + join(list, ", "));
  };
  const std::string state = r.same_state ? "same state" : r.has_state ? "state differs" : "no state is kept";
  parts.push_back(fmt::format("{}; {} of {} metrics the same", state, r.metrics.same(), r.metrics.count));
  if (const auto rounded = listed(r, &N::rounded); !rounded.empty())
    parts.push_back(fmt::format("{} within round-off, {:.0e} of their size", rounded.size(), r.round_off));
  if (const auto effort = listed(r, &N::effort); !effort.empty())
    parts.push_back(fmt::format("{} of the solver's work: {}", effort.size(), first_names(effort)));
  add("within their errors: ", listed(r, &N::within));
  add("beyond: ", listed(r, &N::beyond));
  add("no longer measured: ", r.missing);
  add("not in the manifest: ", r.unrecorded);
  add("no longer in the folder: ", r.lost);
  add("not as they were written: ", r.edited);
  for (const std::string& text :
       {all_same_text(r.energies.count, r.energies.all_same(), "energy term"),
        all_same_text(r.series.count, r.series.all_same(), "table column"),
        all_same_text(r.pictures, r.pictures_beyond.empty(), "picture"),
        all_same_text(r.data_files, r.data_beyond.empty() && r.data_otherwise.empty(), "data file"),
        r.trimmed_files > 0 ? fmt::format("files not kept: {}", r.trimmed_files) : ""})
    if (!text.empty()) parts.push_back(text);
  add("pictures differ: ", r.pictures_beyond);
  add("files differ: ", r.data_beyond);
  add("files that another program has written otherwise: ", r.data_otherwise);
  if (r.agreement() != Agreement::bits && !reasons.empty())
    parts.push_back("recorded by another: " + reasons);
  return join(parts, "; ");
}

Outcome verified_outcome(Agreement agreement) {
  if (agreement == Agreement::bits) return Outcome::same;
  return agreement == Agreement::errors ? Outcome::within : Outcome::differs;
}

// A folder's run, and the result of its repetition.
struct RepeatedRun {
  std::string name;
  RecordedRun recorded;
  ComparableFiles files;
  std::optional<Line> said{};
  double seconds = 0;
};

// Reads the run of a folder; a damaged manifest is a failure, and the others are repeated.
RepeatedRun run_in(const fs::path& folder, const std::string& name) {
  try {
    return {name, recorded_run(folder.string()), {}};
  } catch (const Error& error) {
    RepeatedRun damaged{name, {folder / "manifest.json", {}}, {}};
    damaged.said = {Outcome::failed, error.what()};
    return damaged;
  }
}

Line compared(const RepeatedRun& run, const ChildRun& now, const VerifyParams& choice, const Limits& limits) {
  if (!now.stopped.empty()) return {Outcome::failed, "could not be repeated: " + now.stopped};
  const Manifest& before = run.recorded.manifest;
  Repetition repetition = compare_runs(before, now.manifest.value(), limits, choice.exact);
  const fs::path folder = run.recorded.file.parent_path();
  const bool with_pictures = !run.files.pictures.empty();
  compare_tables(run.files.tables, folder, now.folder, before, *now.manifest, limits, repetition);
  compare_data(run.files.data, folder, now.folder, before.commit == now.manifest->commit, repetition);
  compare_pictures(run.files.pictures, folder, now.folder, limits, repetition);
  add_unlisted_files(before, *now.manifest, with_pictures, repetition);
  repetition.lost = run.files.lost;
  repetition.edited = run.files.edited;
  repetition.trimmed_files = run.files.trimmed;
  if (!repetition.has_state &&
      repetition.metrics.count + repetition.series.count + repetition.pictures + repetition.data_files == 0 &&
      repetition.agreement() != Agreement::none)
    return {Outcome::skipped, "skipped: it holds nothing that could be compared"};
  return {verified_outcome(repetition.agreement()),
          repetition_text(repetition, reasons_between(before, *now.manifest))};
}

// Returns the runs that are repeated as columns below OUT, and reports why the others are not.
std::vector<ChildRun> repeated_columns(std::vector<RepeatedRun>& runs, const VerifyParams& choice,
                                       const Options& options) {
  std::vector<ChildRun> columns;
  for (RepeatedRun& run : runs) {
    if (run.said) continue;
    const fs::path folder = run.recorded.file.parent_path();
    if (const std::string why = why_skipped(run.recorded.manifest, folder, choice); !why.empty()) {
      run.said = {Outcome::skipped, "skipped: " + why};
      continue;
    }
    if (fs::weakly_canonical(fs::path(options.out) / run.name) == fs::weakly_canonical(folder))
      throw Error::invalid_input("out = " + options.out +
                                 " is where the recorded run lies: its repetition would "
                                 "take its place")
          .with_key("out", options.out);
    run.files = comparable_files(run.recorded.manifest, folder, !options.no_images);
    std::vector<Flag> later;
    if (run.files.pictures.empty()) later.push_back({"no-images", true});
    if (!choice.device.empty()) later.push_back({"device", choice.device});
    try {
      const CommandLine line = line_that_repeats(run.recorded, later, false);
      if (const std::string input = missing_input(line); !input.empty()) {
        run.said = {Outcome::skipped, "skipped: needs " + input + ", which is not here"};
        continue;
      }
      columns.push_back(child_run(run.name, line, {}, options.out));
    } catch (const Error& error) {
      run.said = {Outcome::failed, std::string("could not be repeated: ") + error.what()};
    }
  }
  return columns;
}

const char* outcome_word(Outcome outcome) {
  constexpr const char* kWords[] = {"same", "within", "DIFFERS", "-", "failed"};
  return kWords[static_cast<int>(outcome)];
}

TestCase test_case(const std::string& name, const Line& said, double seconds) {
  using Case = TestCase::Outcome;
  constexpr Case kCases[] = {Case::passed, Case::passed, Case::failed, Case::skipped, Case::broken};
  return {name, kCases[static_cast<int>(said.outcome)], said.words, seconds};
}

// Throws for a limit that matches nothing in any run below the folder: it was meant for something else.
void refuse_unused_limits(const Limits& limits, const std::vector<RepeatedRun>& runs) {
  std::vector<std::string> metrics, pictures;
  NotCompared others{{}, "durations depend on the machine, and stated errors are not repeated"};
  NotCompared plots{{}, "plots depend on gnuplot"};
  for (const RepeatedRun& run : runs) {
    const Manifest& manifest = run.recorded.manifest;
    for (const std::string& name : manifest.files)
      if (name.ends_with(".png")) (is_picture(name) ? pictures : plots.names).push_back(name);
    if (limits.metrics.empty()) continue;
    for (const auto& [name, value] : manifest.metrics)
      (is_compared(name, manifest.metrics) ? metrics : others.names).push_back(name);
    for (const auto& [term, joules] : manifest.energy) metrics.push_back(energy_name(term));
    const fs::path folder = run.recorded.file.parent_path();
    for (const std::string& name : comparable_files(manifest, folder, false).tables) {
      const TableColumns columns = table_columns(name, folder);
      metrics.insert(metrics.end(), columns.compared.begin(), columns.compared.end());
      others.names.insert(others.names.end(), columns.durations.begin(), columns.durations.end());
    }
  }
  limits.refuse_unused_metrics(metrics, others);
  limits.refuse_unused_pictures(pictures, plots);
}

// Warns if limits on pictures are given and no picture is drawn.
void warn_of_idle_limits(const CommandLine& line, const Limits& limits, const Options& options) {
  if (!options.no_images || !limits.has_pictures()) return;
  if (const std::string file = last_text(line.flags, "limits", ""); !file.empty())
    std::cerr << "warning: no picture is held to the limits of " << file << ": none is drawn (--no-images)"
              << std::endl;
}

// Throws one line with the first reason.
[[noreturn]] void throw_first_failure(const std::vector<RepeatedRun>& runs, int count) {
  const RepeatedRun& first = *std::find_if(runs.begin(), runs.end(), [](const RepeatedRun& run) {
    return run.said && run.said->outcome == Outcome::failed;
  });
  throw Error::simulation(fmt::format("{} of {} runs could not be repeated, the first {}: {}", count,
                                      runs.size(), first.name, first.said->words));
}

int run_verify(const CommandLine& line) {
  if (line.positionals.size() != 1)
    throw Error::invalid_input("needs a run's folder, or a folder of many runs");
  VerifyParams choice;
  Options options;
  options.out = "out/verify";
  set_keys(line, bind_verify(choice, options), [&] { choice.at_most = kQuickSeconds; });
  require_own_junit(choice.junit);
  const fs::path root = line.positionals.front();
  const Limits limits = read_limits(choice.limits);
  std::vector<RepeatedRun> runs;
  for (const fs::path& folder : folders_below(root))
    runs.push_back(run_in(folder, fs::relative(folder, root).string()));
  refuse_unused_limits(limits, runs);
  warn_of_idle_limits(line, limits, options);
  int count[5] = {};
  std::vector<TestCase> cases;
  const auto say = [&] {  // in the order of their names, as far as they are finished
    for (std::size_t next = cases.size(); next < runs.size() && runs[next].said; ++next) {
      const auto& [outcome, words] = *runs[next].said;
      cases.push_back(test_case(runs[next].name, *runs[next].said, runs[next].seconds));
      ++count[static_cast<int>(outcome)];
      if (outcome == Outcome::skipped && options.quiet) continue;
      std::cout << fmt::format("{:<8}{:<36} {}", outcome_word(outcome), runs[next].name, words) << std::endl;
    }
  };
  std::vector<ChildRun> columns = repeated_columns(runs, choice, options);
  say();
  if (!columns.empty())
    run_columns(
        columns, {.threads = choice.threads, .gpu = choice.device != "cpu", .tolerates_failures = true},
        [&](const ChildRun& column) {
          RepeatedRun& run = *std::find_if(
              runs.begin(), runs.end(), [&](const RepeatedRun& other) { return other.name == column.name; });
          run.said = compared(run, column, choice, limits);
          run.seconds = column.seconds;
          say();
        },
        [](const std::string&) {});
  const auto [same, within, differs, skipped, failed] = std::to_array(count);
  std::cout
      << fmt::format(
             "{} of {} runs repeated: {} the same, {} within errors, {} differ; {} could not be, {} skipped",
             same + within + differs, runs.size(), same, within, differs, failed, skipped)
      << std::endl;
  if (!choice.junit.empty()) write_junit(choice.junit, "verify", root.string(), cases);
  if (differs > 0) return kDiffers;
  if (failed > 0) throw_first_failure(runs, failed);
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
          .positionals = "DIR",
          .differs = "a run is not what its manifest says"};
}

}  // namespace hysteron::experiments
