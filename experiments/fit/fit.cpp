// `hysteron fit` identifies a fabric from measurements, with standard errors and with what they leave
// undetermined.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>

#include "experiments/fit/fab_predictions.h"
#include "experiments/fit/from_fab.h"
#include "experiments/fit/from_sheet.h"
#include "experiments/fit/report.h"
#include "experiments/workbench/app/experiment.h"
#include "experiments/workbench/app/key_conditions.h"
#include "experiments/workbench/pages/report.h"
#include "render/plot.h"
#include "sim/base/csv.h"
#include "sim/base/error.h"
#include "sim/identification/curve.h"
#include "sim/identification/decay_friction.h"
#include "sim/identification/loop_warnings.h"
#include "sim/identification/published.h"
#include "sim/identification/series.h"
#include "sim/scene/fabric_limits.h"
#include "sim/scene/fabric_reader.h"

namespace hysteron::experiments {
namespace {

struct DecayFlags {
  std::string file;
  double length = 0;    // free length of the strip below the clamp [m]
  double noise = 5e-4;  // standard deviation of the amplitudes [m]
};

// Units of the data: SI, or those of the tester that they are from.
enum class FitUnits { si, kes, fab };
constexpr std::array<const char*, 3> names(FitUnits) { return {"si", "kes", "fab"}; }

struct FitFlags {
  std::string loop, virgin_file, sheet, fast_sheet;
  bool wants_template = false;
  VirginNumbers virgin;
  KesNumbers kes;
  std::string law = "prandtl";
  Parameters param;
  bool offset = false, curvature_offset = false;
  double ripple = 0.05;
  Assumptions assume;
  std::string name = "fitted";
  double density = kNone, thickness = kNone;
  FabFlags fab;
  DecayFlags decay;
  FitUnits units = FitUnits::si;
  Options options;
};

constexpr double kSameResidual = 1e-4;  // relative error left by numerical differences
constexpr double kNoResidual = 1e-9;    // residuals below this share of the largest moment count as zero

using F = FitFlags;
using M = Measured;
// clang-format off
const KeyRow<FitFlags> kRows[] = {
    {"loop", at<&F::loop>, "", any(), "measured curve: CSV with `curvature [1/m]`, `moment [N]`, optional `time [s]`"},
    {"law", at<&F::law>, "", any(), "of the loop: a name, names separated by commas, or all, to compare"},
    {"param", at<&F::param>, "", any(), "parameters of that law"},
    {"offset", at<&F::offset>, "", any(), "find the zero of the measured moments, too"},
    {"curvature-offset", at<&F::curvature_offset>, "", any(), "find the zero of the measured curvatures, too"},
    {"ripple", at<&F::ripple>, "", between(0, 0.5), "curvature that comes back by less than this share of its range is noise"},
    {"fab", at<&F::fab, &FabFlags::file>, "", any(), "loops of a FAB tester, strips buckled between clamps: CSV with direction, test, branch, clamp_distance_m, force_N, gauge_length_m, width_m; needs fabric.density"},
    {"fab.directions", at<&F::fab, &FabFlags::directions>, "", any(), "of these loops, separated by commas: the first is warp, the second weft; none: all"},
    {"fab.tests", at<&F::fab, &FabFlags::tests>, "", any(), "that are fitted, separated by commas; others are predicted. U1 D1 bend, S1 stretches"},
    {"fab.cycles", at<&F::fab, &FabFlags::cycles>, "", any(), "that are fitted, separated by commas, the first being 1"},
    {"fab.friction", at<&F::fab, &FabFlags::friction>, "", any(), "what is sought: the curvature k0 at which friction saturates; median and spread of a lognormal distribution of curvatures at which it slips; or a stiffness at each of fab.thresholds"},
    {"fab.thresholds", at<&F::fab, &FabFlags::thresholds>, "", any(), "of stops, separated by commas [1/m]"},
    {"fab.noise", at<&F::fab, &FabFlags::noise>, "N", positive(), "of the measured forces, standard deviation; a fit that misses them by more than three times as much (rms) is refused"},
    {"decay", at<&F::decay, &DecayFlags::file>, "", any(), "amplitudes of the free end of a hanging strip that was let go, turn by turn: CSV with `time [s]`, `amplitude [m]`; needs decay.length, fabric.density and kes.b"},
    {"decay.length", at<&F::decay, &DecayFlags::length>, "m", at_least(0), "of the strip below the clamp"},
    {"decay.noise", at<&F::decay, &DecayFlags::noise>, "m", positive(), "of the amplitudes, standard deviation"},
    {"units", at<&F::units>, "", any(), "of the loop (kes: 1/cm and gf cm/cm) or of the FAB data (fab: cm and gf, columns _cm, _gf)"},
    {"kes-sheet", at<&F::sheet>, "", any(), "the sheet of a KES-F laboratory, CSV or TOML: sixteen numbers along warp and weft as they are printed"},
    {"fast-sheet", at<&F::fast_sheet>, "", any(), "the sheet of a FAST laboratory or of a cantilever alone (ASTM D1388), CSV or TOML: bending lengths and weight, and what else there is"},
    {"template", at<&F::wants_template>, "", any(), "print such a sheet to fill in, and nothing else"},
    {"virgin.b1", at<&F::virgin, &VirginNumbers::b1, &M::value>, "N m", any(), "M = b1 K + c1 K^2 on loading"},
    {"virgin.c1", at<&F::virgin, &VirginNumbers::c1, &M::value>, "N m^2", any(), "< 0"},
    {"virgin.b1-stderr", at<&F::virgin, &VirginNumbers::b1, &M::standard_error>, "N m", at_least(0), "standard error"},
    {"virgin.c1-stderr", at<&F::virgin, &VirginNumbers::c1, &M::standard_error>, "N m^2", at_least(0), "standard error"},
    {"virgin.file", at<&F::virgin_file>, "", any(), "specimens of a fabric: CSV with `b1 [N m]`, `c1 [N m2]`"},
    {"kes.b", at<&F::kes, &KesNumbers::b, &M::value>, "N m", any(), "B of KES-FB2 (1 gf cm^2/cm = 9.80665e-5 N m)"},
    {"kes.2hb", at<&F::kes, &KesNumbers::two_hb, &M::value>, "N", any(), "2HB of KES-FB2 (1 gf cm/cm = 9.80665e-3 N)"},
    {"kes.k0", at<&F::kes, &KesNumbers::k0, &M::value>, "1/m", positive(), "where friction saturates, if known"},
    {"kes.b-stderr", at<&F::kes, &KesNumbers::b, &M::standard_error>, "N m", at_least(0), "standard error"},
    {"kes.2hb-stderr", at<&F::kes, &KesNumbers::two_hb, &M::standard_error>, "N", at_least(0), "standard error"},
    {"kes.k0-stderr", at<&F::kes, &KesNumbers::k0, &M::standard_error>, "1/m", at_least(0), "standard error"},
    {"assume.ratio", at<&F::assume, &Assumptions::ratio>, "", between(0.01, 0.99), "b2/b1 where the data leave b2 and k0 open"},
    {"assume.k0", at<&F::assume, &Assumptions::k0>, "1/m", positive(), "k0 where the data leave only that open"},
    {"name", at<&F::name>, "", any(), "of the fabric"},
    {"fabric.density", at<&F::density>, "kg/m^2", positive(), "for fabric.toml, and the weight of a strip"},
    {"fabric.thickness", at<&F::thickness>, "m", positive(), "for fabric.toml"},
};
// clang-format on

Keys bind_flags(FitFlags& flags) {
  Keys keys = bind(kRows, flags);
  for (BoundKey& key : bind_options_of(Takers::all, flags.options)) keys.push_back(std::move(key));
  return keys;
}

std::string file_name(const std::string& path) { return std::filesystem::path(path).filename().string(); }

// The result of a fit, with the kind of data it is from.
struct Answer {
  std::vector<Identification> fits;  // by residual, the best first
  std::string from;
  std::vector<std::string> warnings = {};  // about the data and the request
};

// Sorts the best first; laws that the data cannot distinguish stay in the requested order.
void rank(std::vector<Identification>& fits) {
  const auto digits = [](const Identification& fit) {
    return std::lround(std::log(fit.residual_rms() / fit.largest_moment() + kNoResidual) / kSameResidual);
  };
  std::stable_sort(fits.begin(), fits.end(),
                   [&](const auto& a, const auto& b) { return digits(a) < digits(b); });
  const Identification& best = fits[0];
  const auto rows = static_cast<double>(best.moment.size());
  std::vector<std::string> alike;
  for (std::size_t i = 1; i < fits.size(); ++i) {
    const double ratio =
        fits[i].residual_rms() / std::max(best.residual_rms(), kNoResidual * best.largest_moment());
    if (2 * rows * std::log(ratio) <= kLikelihoodFall) alike.push_back(fits[i].law);
  }
  if (!alike.empty()) {
    fits[0].statements.push_back("these data do not tell " + best.law + " from " + join(alike, ", ") +
                                 " (95 %)");
  }
}

Answer from_loop(const FitFlags& flags) {
  const MomentSeries series = flags.units == FitUnits::kes ? read_kes_series(flags.loop, flags.ripple, "fit")
                                                           : read_series(flags.loop, flags.ripple, "fit");
  Answer answer{{}, series.name};
  std::vector<LawRequest> laws;
  for (const std::string& name : listed_names("law", flags.law, law_names())) {
    laws.push_back({name, {}, {}});
    for (const auto& [parameter, value] : flags.param) laws.back().parameters[parameter] = value;
    CurveQuestion question;
    question.law = laws.back();
    question.offset = flags.offset;
    question.curvature_offset = flags.curvature_offset;
    question.assumptions = flags.assume;
    answer.fits.push_back(identify_curve(series, question));
  }
  rank(answer.fits);
  answer.warnings = loop_warnings(series, laws, flags.curvature_offset);
  return answer;
}

Answer from_virgin(const FitFlags& flags) {
  if (!flags.virgin_file.empty()) {
    if (flags.virgin.b1.given() || flags.virgin.c1.given())
      throw Error::invalid_input("takes virgin.file or virgin.b1 with virgin.c1, not both")
          .with_key("virgin.file", flags.virgin_file);
    return {{identify_virgin(read_virgin(flags.virgin_file, "fit"), flags.assume)},
            file_name(flags.virgin_file)};
  }
  if (!flags.virgin.b1.given() || !flags.virgin.c1.given())
    throw Error::invalid_input("a virgin curve needs both --virgin.b1 and --virgin.c1")
        .with_key("virgin.b1", "");
  return {{identify_virgin(flags.virgin, flags.assume)}, "b1 and c1 of its virgin curve"};
}

Answer from_kes(const FitFlags& flags) {
  if (!flags.kes.b.given() || !flags.kes.two_hb.given())
    throw Error::invalid_input("KES-FB2 needs both --kes.b and --kes.2hb").with_key("kes.b", "");
  Answer answer{{identify_kes(flags.kes, flags.assume)}, "B and 2HB of KES-FB2"};
  if (const std::string warning = kes_warning(flags.kes); !warning.empty()) answer.warnings = {warning};
  return answer;
}

// Throws unless the tester's own units go with its data: kes with a loop of bending, fab with buckled strips.
void check_units(const FitFlags& flags) {
  const FitUnits other = flags.loop.empty() ? FitUnits::kes : FitUnits::fab;
  if (flags.units == other)
    throw Error::invalid_input("units = " + enum_name(flags.units) +
                               " must be si or the tester's own: kes goes with --loop (1/cm, gf cm/cm), fab "
                               "with --fab (cm, gf)")
        .with_key("units", enum_name(flags.units));
}

using WayIn = void (*)(const CommandLine&, const FitFlags&, const Keys&);

std::optional<double> if_given(double x) { return std::isnan(x) ? std::nullopt : std::optional(x); }

// Returns the manifest's `scene`, where the flag --fab becomes fab.file among the keys fab.*, and --decay
// likewise.
Json resolved(Keys keys) {
  for (BoundKey& key : keys)
    if (key.description.path == "fab" || key.description.path == "decay") key.description.path += ".file";
  return to_json(keys);
}

void finish(Run& run, const FitFlags& flags, const std::string& summary, const FabricNotes& notes) {
  for (const std::string& warning : borrowed_warnings(notes)) run.warn(warning);
  Scene written;
  written.fabric = read_fabric((run.folder() / "fabric.toml").string(), "fit").fabric;
  for (const auto& [parameter, from] : written.fabric.provenance)
    written.origin["fabric." + parameter] = from.confidence == "given" ? "--fabric." + parameter : "found";
  for (const std::string& warning : fabric_warnings(written)) run.warn(warning);
  finish_with_report(run);
  if (flags.options.json) return;
  std::cout << summary;
  std::cout << "written: " << (run.folder() / "fabric.toml").string() << std::endl;
}

void fit_loops_of_fab(const CommandLine& line, const FitFlags& flags, const Keys& keys) {
  if (std::isnan(flags.density))
    throw Error::invalid_input("--fab needs --fabric.density: the strip's weight bears on it")
        .with_key("fabric.density", "");
  const FabAnswer answer =
      fit_fab(flags.fab, flags.units == FitUnits::fab ? TesterUnits::fab : TesterUnits::si, flags.density);
  Run run(line, flags.options, resolved(keys));
  const FabricNotes notes{flags.name, answer.found.from, if_given(flags.density), if_given(flags.thickness)};
  report_fab(run, answer, notes);
  finish(run, flags, summary(answer), notes);
}

void draw_decay(Run& run, const DecaySeries& series, const std::vector<double>& found,
                const std::vector<double>& saturated) {
  render::Plot plot{"Amplitude against time", {"time [s]"}, {"amplitude of the free end [mm]"}};
  const auto add = [&](const std::string& label, std::vector<double> values, render::Series::Style style) {
    for (double& a : values) a *= 1e3;
    plot.series.push_back({label, series.time, values, style});
  };
  add("measured", series.amplitude, render::Series::Style::points);
  add("fitted", found, render::Series::Style::line);
  if (!saturated.empty()) add("k0 = 50/m", saturated, render::Series::Style::dashed);
  run.plot("plot_decay", plot);
}

// A free vibration and what was identified from it.
struct DecayAnswer {
  DecaySeries series;
  std::string large;  // warning of too large amplitudes, or ""
  DecayQuestion question;
  FabAnswer found;
};

DecayAnswer identify_vibration(const FitFlags& flags, const std::string& from) {
  check_rigidity(flags.kes.b.value, "kes.b");
  DecayAnswer answer{read_decay(flags.decay.file, "fit"),
                     "",
                     {flags.decay.length, flags.density, flags.kes.b.value, flags.decay.noise},
                     {}};
  check_decay(answer.series, answer.question, flags.decay.file);
  answer.large = large_amplitudes_warning(answer.series, flags.decay.length);
  answer.series = without_large_amplitudes(answer.series, flags.decay.length);
  FabBending found = identify_decay(answer.series, answer.question);
  if (!(found.law.spring > 0))
    throw Error::invalid_input(
        "decay: the friction that is found is steeper than kes.b = " + number_text(flags.kes.b.value) +
        " N m where a tester reads it: check kes.b, fabric.density and decay.length")
        .with_key("kes.b", number_text(flags.kes.b.value));
  answer.found.forms = {even_forms(answer.series, answer.question)};
  answer.found.repeats.resize(1);
  answer.found.found = {{found}, {}, from};
  return answer;
}

// Returns b1, b2 and k0 from the friction that was found and the rigidity that was given.
Identification three_numbers(const FabBending& found, double rigidity, const std::string& from) {
  Identification numbers;
  const double k0 = saturation_curvature(found.form), stiffness = 2 * found.law.friction() / k0;
  const std::vector<std::string> open = found.undetermined();
  const auto is_open = [&](const char* name) { return std::count(open.begin(), open.end(), name) > 0; };
  numbers.law = "prandtl";
  numbers.b2 = {rigidity, kNone, true, "B, given to the fit as --kes.b", "given"};
  numbers.k0 = {k0, found.form_errors[1] * k0, !is_open("k0"), from};
  numbers.b1 = {rigidity + stiffness, found.stiffness_errors[0] / found.law.stiffnesses[0] * stiffness,
                open.empty(), "B + 2 HB/k0 of " + from};
  numbers.statements.push_back(fmt::format(
      "HB = {:.3g} +- {:.2g} N, k0 = {:.3g} +- {:.2g} 1/m; rms {:.2g} of the noise", found.law.friction(),
      found.friction_error, k0, numbers.k0.standard_error, found.residual_rms));
  return numbers;
}

// Writes fabric.toml, forms.csv, decay.csv (measured and fitted), a plot and metrics; returns the summary.
std::string report_decay(Run& run, const DecayAnswer& answer, const FabricNotes& notes) {
  const FabBending& b = answer.found.found.bending[0];
  std::vector<std::string> warnings = decay_warnings(answer.series, answer.question);
  if (warnings.empty()) warnings.push_back(pace_warning(answer.series, answer.question, b));
  warnings.push_back(answer.large);
  std::erase(warnings, "");
  for (const std::string& warning : warnings) run.warn(warning);
  for (const std::string& warning : decay_fit_warnings(b, answer.found.forms[0], answer.found.repeats[0]))
    run.warn(warning);
  const Identification numbers = three_numbers(b, answer.question.rigidity, answer.found.found.from);
  write_fabric(run.path("fabric.toml"), numbers, notes);
  write_forms(run, answer.found);
  run.metric("k0_per_m", numbers.k0.value);
  run.metric("k0_per_m_stderr", numbers.k0.standard_error);
  run.metric("HB_N", b.law.friction());
  run.metric("HB_N_stderr", b.friction_error);
  run.metric("b1_N_m", numbers.b1.value);
  run.metric("b1_N_m_stderr", numbers.b1.standard_error);
  run.metric("b2_N_m", numbers.b2.value);
  run.metric("residual_over_noise", b.residual_rms);
  run.metric("iterations", b.iterations);
  run.metric("undetermined", b.undetermined());

  const auto by = [&](const FabBending& form) {
    return decay_by(answer.series, answer.question, {form.law.thresholds, form.law.stiffnesses}, form.first);
  };
  const std::vector<double> fitted = by(b);
  std::vector<double> saturated;
  for (const FabForm& form : answer.found.forms[0])
    if (form.name == "k0 = 50/m") saturated = by(form.found);
  Table(
      {{"time [s]", answer.series.time}, {"amplitude [m]", answer.series.amplitude}, {"fitted [m]", fitted}})
      .write(run.path("decay.csv"));
  draw_decay(run, answer.series, fitted, saturated);
  return numbers.statements[0] + "\n" + summary(answer.found);
}

void fit_decay(const CommandLine& line, const FitFlags& flags, const Keys& keys) {
  const double given[] = {flags.decay.length > 0 ? flags.decay.length : NAN, flags.density,
                          flags.kes.b.value};
  const char* const names[] = {"decay.length", "fabric.density", "kes.b"};
  for (int i = 0; i < 3; ++i)
    if (!(given[i] > 0))
      throw Error::invalid_input(std::string("--decay needs --") + names[i]).with_key(names[i], "");
  const std::string from = "a free vibration in " + file_name(flags.decay.file);
  const DecayAnswer answer = identify_vibration(flags, from);
  Run run(line, flags.options, resolved(keys));
  const FabricNotes notes{flags.name, from, if_given(flags.density), if_given(flags.thickness)};
  finish(run, flags, report_decay(run, answer, notes), notes);
}

template <Answer (*identified)(const FitFlags&)>
void fit_curve(const CommandLine& line, const FitFlags& flags, const Keys& keys) {
  const Answer answer = identified(flags);
  Run run(line, flags.options, resolved(keys));
  const FabricNotes notes{flags.name, answer.from, if_given(flags.density), if_given(flags.thickness)};
  report_fits(run, answer.fits, notes);
  for (const std::string& warning : answer.warnings) run.warn(warning);
  if (const std::string warning = misses_warning(answer.fits[0]); !warning.empty()) run.warn(warning);
  finish(run, flags, summary(answer.fits), notes);
}

// Fits the fabric of a sheet, writes its file, and compares what virtual testers read of it.  Values from the
// laboratory override those given by hand; `thickness` names its row.
void fit_sheet(const CommandLine& line, const FitFlags& flags, const Keys& keys, LaboratorySheet sheet,
               const std::string& thickness,
               SheetFabric (*fabric_of)(const LaboratorySheet&, const Assumptions&),
               std::vector<SheetReading> (*read_back)(const LaboratorySheet&, const Fabric&)) {
  const bool is_named =
      std::any_of(line.flags.begin(), line.flags.end(), [](const Flag& flag) { return flag.path == "name"; });
  if (is_named) sheet.name = flags.name;
  const auto add_given = [&](const std::string& row, double value, const char* flag) {
    if (std::isnan(value)) return;
    if (sheet.has(row))
      throw Error::invalid_input(std::string("--") + flag + " is not used: the sheet has " + row)
          .with_key(flag, "");
    sheet.row[row] = {{kNone, kNone, value}, "", std::string("--") + flag};
  };
  add_given("W", flags.density, "fabric.density");
  add_given(thickness, flags.thickness, "fabric.thickness");
  const SheetFabric found = fabric_of(sheet, flags.assume);
  Run run(line, flags.options, resolved(keys));
  for (const std::string& warning : sheet.warnings) run.warn(warning);
  const std::string file = run.path("fabric.toml").string();
  write_fabric_text(file, found.text);
  const std::string text = report_sheet(run, sheet, found, read_back(sheet, read_fabric(file, "fit").fabric));
  finish_with_report(run);
  if (!flags.options.json) std::cout << text;
}

void fit_kes_sheet(const CommandLine& line, const FitFlags& flags, const Keys& keys) {
  fit_sheet(
      line, flags, keys, read_kes_sheet(flags.sheet), "T0", fabric_of_sheet,
      [](const LaboratorySheet& sheet, const Fabric& fabric) { return read_by_testers(sheet, fabric); });
}

void fit_fast_sheet(const CommandLine& line, const FitFlags& flags, const Keys& keys) {
  fit_sheet(line, flags, keys, read_fast_sheet(flags.fast_sheet), "T2", fabric_of_fast_sheet,
            read_by_cantilever);
}

// Returns the kind of fit that the flags request.
WayIn way_in(const FitFlags& flags) {
  std::vector<WayIn> requested;
  const auto add = [&](bool is_requested, WayIn way) {
    if (is_requested) requested.push_back(way);
  };
  add(!flags.loop.empty(), fit_curve<from_loop>);
  add(flags.virgin.b1.given() || flags.virgin.c1.given() || !flags.virgin_file.empty(),
      fit_curve<from_virgin>);
  const bool with_decay = !flags.decay.file.empty();  // decay itself takes a rigidity from kes.b
  add(flags.kes.two_hb.given() || (flags.kes.b.given() && !with_decay), fit_curve<from_kes>);
  add(!flags.fab.file.empty(), fit_loops_of_fab);
  add(with_decay, fit_decay);
  add(!flags.sheet.empty(), fit_kes_sheet);
  add(!flags.fast_sheet.empty(), fit_fast_sheet);
  if (requested.size() == 1) return requested[0];
  throw Error::invalid_input(
      "needs one of --loop FILE.csv, --virgin.b1 with --virgin.c1, --kes.b with --kes.2hb, --kes-sheet FILE, "
      "--fast-sheet FILE, --fab FILE.csv, --decay FILE.csv" +
      std::string(requested.empty() ? "" : ", not several"));
}

// Prints the template of the sheet whose flag stands beside --template.
void print_template(const CommandLine& line, const FitFlags& flags) {
  for (const auto& [path, file] : {std::pair{"kes-sheet", flags.sheet}, {"fast-sheet", flags.fast_sheet}})
    if (!file.empty())
      throw Error::invalid_input("--" + std::string(path) + " " + file +
                                 " is not read beside --template, which prints an empty sheet")
          .with_key(path, file);
  const bool is_fast = std::any_of(line.flags.begin(), line.flags.end(),
                                   [](const Flag& flag) { return flag.path == "fast-sheet"; });
  std::cout << (is_fast ? fast_sheet_template() : kes_sheet_template());
}

int run_fit(const CommandLine& line) {
  FitFlags flags;
  flags.options.out = "out/" + line.experiment;
  const Keys keys = bind_flags(flags);
  for (const Flag& flag : line.flags) assign_flag(keys, flag);
  if (flags.wants_template) {
    print_template(line, flags);
    return 0;
  }
  if (flags.name.empty())
    throw Error::invalid_input("name = \"\" must be the fabric's (--name)").with_key("name", "");
  refuse_unread_flags(line, key_values(keys));
  if (!std::isnan(flags.density))
    check_fabric_number("density", flags.density, "fabric.density", "--fabric.density");
  if (!std::isnan(flags.thickness))
    check_fabric_number("thickness", flags.thickness, "fabric.thickness", "--fabric.thickness");
  check_units(flags);
  way_in(flags)(line, flags, keys);
  return 0;
}

}  // namespace

Experiment fit() {
  return {.name = "fit",
          .question = "identify a fabric from a measured loop, virgin curve, KES pair or free vibration",
          .run = run_fit,
          .own_keys = own_key_descriptions<bind_flags>,
          .conditions = {{"law | param | offset | curvature-offset | ripple", "loop"},
                         {"units", "loop or fab"},
                         {"fab.", "fab"},
                         {"decay.", "decay"},
                         {"virgin.b1-stderr", "virgin.b1"},
                         {"virgin.c1-stderr", "virgin.c1"},
                         {"kes.b-stderr | kes.2hb-stderr | kes.k0", "kes.2hb"},
                         {"kes.k0-stderr", "kes.k0"},
                         {"assume.ratio", "loop or virgin.b1 or virgin.file"},
                         {"assume.k0", "loop or kes-sheet or fast-sheet or kes.2hb and not kes.k0"}}};
}

}  // namespace hysteron::experiments
