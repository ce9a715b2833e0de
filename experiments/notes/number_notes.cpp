// Notes on virtual testers, fits, and pages of several runs.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "experiments/notes/notes.h"
#include "experiments/workbench/pages/error_notes.h"
#include "experiments/workbench/pages/metrics.h"
#include "sim/scene/key_table.h"

namespace hysteron::experiments {
namespace {

constexpr double kGramForceCentimetre2 = 9.80665e-5;  // [N m] in 1 gf cm^2/cm
constexpr double kGramForceCentimetre = 9.80665e-3;   // [N] in 1 gf cm/cm

using Columns = std::vector<std::pair<std::string, Metrics>>;

// Notes laws whose B and 2HB agree with another one's within 1 %: the tester cannot distinguish them.
std::string alike_note(const Columns& columns) {
  constexpr double kAlike = 0.01;
  const auto is_near = [](double a, double b) { return std::abs(a - b) <= kAlike * std::abs(b); };
  std::vector<std::string> most;
  for (const auto& [name, own] : columns) {
    const double b = own.number("B_N_m"), width = own.number("2HB_N");
    std::vector<std::string> alike;
    for (const auto& [other, metrics] : columns)
      if (width > 0 && is_near(metrics.number("B_N_m"), b) && is_near(metrics.number("2HB_N"), width))
        alike.push_back(other);
    if (alike.size() > most.size()) most = alike;
  }
  if (most.size() < 2) return "";
  return "the tester reads the same B and 2HB of " + enumerated(most) + ": `hysteron compare swing --laws " +
         join(most, ",") + "` tells them apart";
}

std::string printed_pair_note(const Manifest& manifest) {
  const double b = manifest.metrics.number("B_N_m"), width = manifest.metrics.number("2HB_N");
  if (!std::isfinite(b) || !std::isfinite(width)) return "";
  return fmt::format("a laboratory's sheet has these as B = {:.3g} gf cm2/cm and 2HB = {:.3g} gf cm/cm",
                     b / kGramForceCentimetre2, width / kGramForceCentimetre);
}

// Notes friction that saturates before the tester begins to read.
std::string hidden_k0_note(const Manifest& manifest) {
  const double k0 = manifest.number("fabric.k0"), from = manifest.number("slope-from");
  if (manifest.text("test") != "bending" || !(k0 > 0) || k0 >= from) return "";
  const bool is_assumed = !assumed_of(manifest, {"k0"}).empty();
  return fmt::format(
      "k0 = {:g}/m{} does not show here, the tester reads from {:g}/m on: small loops or a swing tell it "
      "(fit --loop, fit --decay)",
      k0, is_assumed ? ", assumed," : "", from);
}

// Notes the number with the largest relative standard error.
std::string uncertain_note(const Manifest& manifest) {
  constexpr double kLarge = 0.2;
  std::string worst;
  double largest = kLarge;
  for (const auto& [name, value] : manifest.metrics) {
    const double relative =
        std::abs(manifest.metrics.number(name + kStandardError) / manifest.metrics.number(name));
    if (!std::isfinite(relative) || relative <= largest) continue;
    largest = relative;
    worst = split_unit(name).name;
  }
  if (worst.empty()) return "";
  return fmt::format(
      "{} is known within {:.0f} % only (standard error): what is made of it should hold at both ends", worst,
      100 * largest);
}

// Returns the undetermined numbers; a list among a manifest's metrics is read as its JSON text.
std::vector<std::string> undetermined(const Manifest& manifest) {
  const MetricValue& list = manifest.metrics["undetermined"];
  if (!list.is_text()) return {};
  std::vector<std::string> names;
  for (const Json& name : Json::parse(list.text(), nullptr, false))
    if (name.is_string()) names.push_back(name.get<std::string>());
  return names;
}

// Splits "cotton-broad.bias-bending=0.54.change_percent" into its parts; other metrics are skipped.
struct Change {
  std::string fabric, number, value;
  double points = 0;  // change of the drape coefficient [%]
};
std::vector<Change> changes_in(const Metrics& metrics) {
  const std::string ending = ".change_percent";
  std::vector<Change> changes;
  for (const auto& [name, value] : metrics) {
    const std::size_t dot = name.find('.'), equals = name.find('=');
    if (!name.ends_with(ending) || equals == name.npos || dot > equals || !value.is_number()) continue;
    changes.push_back({name.substr(0, dot), name.substr(dot + 1, equals - dot - 1),
                       name.substr(equals + 1, name.size() - ending.size() - equals - 1), value.number()});
  }
  return changes;
}

std::string intervals_note(const Metrics& metrics) {
  int all = 0, inside = 0;
  for (const auto& [name, value] : metrics) {
    if (!name.ends_with(".spread_has_measured") || !value.is_known()) continue;
    all += 1;
    inside += value.is(true);
  }
  if (all == 0) return "";
  return fmt::format(
      "{} of {} measured drapes lie where the uncertain numbers allow one{}", inside, all,
      inside < all ? ": of the others `--parts budget` says which number to measure first" : "");
}

struct Extremes {
  std::string lowest, highest;  // names of columns
  double low = INFINITY, high = -INFINITY, error = 0;
  int count = 0;
  bool has_errors = false;
};
Extremes extremes_of(const Columns& columns, const std::string& metric) {
  Extremes found;
  for (const auto& [name, own] : columns) {
    const double value = own.number(metric);
    if (!std::isfinite(value)) continue;
    found.count += 1;
    if (value < found.low) {
      found.low = value;
      found.lowest = name;
    }
    if (value > found.high) {
      found.high = value;
      found.highest = name;
    }
    for (const char* ending : {kStepError, kMeshError, kDrawError}) {
      found.has_errors = found.has_errors || own.contains(metric + ending);
      const double error = own.number(metric + ending);
      if (std::isfinite(error)) found.error = std::max(found.error, error);
    }
  }
  return found;
}

std::string difference_note(const Manifest& manifest, const Columns& columns) {
  for (const Headline& headline : column_headlines(manifest)) {
    const Extremes found = extremes_of(columns, headline.metric);
    if (!headline.has_errors || found.count < 2 || found.low == found.high) continue;
    const double difference = headline.scale * (found.high - found.low), error = headline.scale * found.error;
    const std::string unit = headline.unit == std::string("%") ? "points" : headline.unit;
    const std::string text =
        fmt::format("the {} is {:.3g}{} more in {} than in {}", headline.words, difference,
                    unit.empty() ? unit : " " + unit, found.highest, found.lowest);
    if (!found.has_errors)
      return text + "; whether that is the mesh's doing is not known: --errors measures it";
    if (difference <= 2 * error)
      return text + fmt::format(", no more than the errors allow (± {:.2g})", error);
    return text +
           fmt::format(", {:.0f} times the largest error", difference / std::max(error, 1e-3 * difference));
  }
  return "";
}

std::string matching_note(const Manifest& manifest) {
  const std::string match = manifest.text("match");
  if (match.empty() || match == "fabric" || manifest.names("law").size() < 2) return "";
  return "laws were made equally stiff first (--compare.match " + match +
         "), so that most have other numbers than the fabric: --compare.match fabric leaves them";
}

}  // namespace

Notes kes_notes(const Manifest& manifest) {
  const Columns columns = columns_in(manifest.metrics);
  std::string alone;
  if (manifest.text("on") == "law")
    alone = "this is the law alone: --on strip tests a strip of triangles, with what the mesh adds";
  return {printed_pair_note(manifest), alike_note(columns), hidden_k0_note(manifest), alone};
}

Notes fit_notes(const Manifest& manifest) {
  const std::vector<std::string> open = undetermined(manifest);
  std::string assumed;
  if (!open.empty())
    assumed = "the data do not determine " + enumerated(open) +
              ": small loops (fit --loop) or a swing (fit --decay) would";
  return {assumed, uncertain_note(manifest)};
}

Notes validate_notes(const Manifest& manifest) {
  Change most, mesh;
  for (const Change& change : changes_in(manifest.metrics)) {
    Change& largest = change.number == "mesh" ? mesh : most;
    if (change.number != "tester" && std::abs(change.points) > std::abs(largest.points)) largest = change;
  }
  std::string number, size;
  if (!most.fabric.empty())
    number = fmt::format(
        "of what is uncertain {} = {} moves the drape of {} most, by {:+.1f} points: measure it first",
        most.number, most.value, most.fabric, most.points);
  if (!mesh.fabric.empty())
    size = fmt::format(
        "{} triangles move it by {:+.1f} points: numbers that move it less are not told from the mesh",
        mesh.value, mesh.points);
  return {number, size, intervals_note(manifest.metrics)};
}

Notes compare_notes(const Manifest& manifest) {
  return {difference_note(manifest, columns_in(manifest.metrics)), matching_note(manifest)};
}

Notes sweep_notes(const Manifest& manifest) {
  const double failed = manifest.metrics.number("failed_count"), all = manifest.metrics.number("runs_count");
  if (failed > 0)
    return {
        fmt::format("{:.0f} of {:.0f} runs have no result, table.csv says why: --resume repeats them alone",
                    failed, all)};
  const std::vector<std::string>& files = manifest.files;
  if (std::find(files.begin(), files.end(), "means.csv") != files.end())
    return {
        "means.csv has means over the seeds with their standard errors: differences below twice those are "
        "chance"};
  return {"each point is one mesh: seeds = 8 in the study gives means with standard errors"};
}

}  // namespace hysteron::experiments
