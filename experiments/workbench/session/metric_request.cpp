#include "experiments/workbench/session/metric_request.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "experiments/workbench/app/json_file.h"
#include "experiments/workbench/session/idle_keys.h"
#include "sim/base/error.h"
#include "sim/scene/assets.h"
#include "sim/scene/cycles.h"
#include "sim/scene/scene_reader.h"
#include "sim/scene/toml_file.h"
#include "sim/time/ledger.h"

namespace hysteron::experiments {
namespace {

using M = MetricRequest;
// clang-format off
const KeyRow<M> kRows[] = {
    {"name", at<&M::name>, "", any(), "of the column in metrics.csv and, with its unit, of the metric: small letters, digits and _"},
    {"kind", at<&M::kind>, "", any(), "distance of point and to; height of point; angle between the mean normals of two parts, 0 when they are parallel; force of a pin on the cloth; of a part: root mean square of its residual curvature over the area, length of the ridges where that exceeds threshold, their height from valley to crest, share of its silhouette that has changed"},
    {"from", at<&M::from>, "s", at_least(-1), "less its value at this time, which may name a phase, and 0 before it; silhouette: against that at this time; negative: the value itself"},
    {"point", at<&M::point>, "m", any(), "distance, height: of the vertex nearest to this on the flat cloth"},
    {"to", at<&M::to>, "m", any(), "distance: to the vertex nearest to this"},
    {"low", at<&M::low>, "m", any(), "corner of the box that contains the part, on the flat cloth"},
    {"high", at<&M::high>, "m", any(), "opposite corner of the box, >= low"},
    {"other-low", at<&M::other_low>, "m", any(), "angle: the same of the other part"},
    {"other-high", at<&M::other_high>, "m", any(), "angle: the same of the other part"},
    {"hand", at<&M::hand>, "", between(1, 1e6), "force: number of the [[pin]], the first is 1"},
    {"direction", at<&M::direction>, "", any(), "force: its component along this; zero: its size; silhouette: seen along this"},
    {"threshold", at<&M::threshold>, "1/m", positive(), "ridge-length: residual curvature from which a place counts as part of a ridge"},
    {"cutoff", at<&M::cutoff>, "m", positive(), "ridge-height: wavelength of which half counts as shape and not as ridges"},
};
// clang-format on

using Kind = MetricKind;
bool is_of(const M& request, std::initializer_list<Kind> kinds) {
  return std::ranges::find(kinds, request.kind) != kinds.end();
}

constexpr ReadKey<M> kRead[] = {
    {"point", "a distance or height",
     [](const M& m) {
       return is_of(m, {Kind::distance, Kind::height});
     }},
    {"to", "a distance", [](const M& m) { return is_of(m, {Kind::distance}); }},
    {"low", "a kind with a part", [](const M& m) { return m.has_part(); }},
    {"high", "a kind with a part", [](const M& m) { return m.has_part(); }},
    {"other-low", "an angle", [](const M& m) { return is_of(m, {Kind::angle}); }},
    {"other-high", "an angle", [](const M& m) { return is_of(m, {Kind::angle}); }},
    {"hand", "a force", [](const M& m) { return is_of(m, {Kind::force}); }},
    {"direction", "a force or silhouette",
     [](const M& m) {
       return is_of(m, {Kind::force, Kind::silhouette});
     }},
    {"threshold", "a ridge-length", [](const M& m) { return is_of(m, {Kind::ridge_length}); }},
    {"cutoff", "a ridge-height", [](const M& m) { return is_of(m, {Kind::ridge_height}); }},
};

// Returns the unit of a kind, and the end of its metrics' keys.
std::pair<const char*, const char*> unit_of(Kind kind) {
  switch (kind) {
    case Kind::distance:
    case Kind::height:
    case Kind::ridge_length:
    case Kind::ridge_height:
      return {"m", "_m"};
    case Kind::angle:
      return {"degree", "_deg"};
    case Kind::force:
      return {"N", "_N"};
    case Kind::residual_curvature:
      return {"1/m", "_per_m"};
    case Kind::silhouette:
      break;
  }
  return {"%", "_percent"};
}

// The results of every run whose names could be those of requests.
const std::set<std::string> kOwnResults = {"hand_lag_m", "residual_curvature_rms_per_m",
                                           "residual_curvature_formula_rms_per_m"};

void check_names(const std::vector<MetricRequest>& requests) {
  // These are the columns of every series, and of crumple's.
  std::set<std::string> seen = {"time", "fastest", "cycle", "ridge_length", "curvature_rms"};
  for (const auto& [name, joules] : Ledger{}.rows()) seen.insert(name);
  for (const MetricRequest& request : requests) {
    const auto allowed = [](const char c) {
      return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
    };
    if (request.name.empty() || !std::all_of(request.name.begin(), request.name.end(), allowed))
      throw Error::invalid_input("metric.name = \"" + request.name +
                                 "\" must be small letters, digits and _ (" + request.origin + ")")
          .with_key("metric.name", request.name);
    if (!seen.insert(request.name).second) throw request.refusal("there is a column of this name already");
    if (kOwnResults.contains(request.metric()))
      throw request.refusal("every run has a result " + request.metric() + " of its own");
  }
}

MetricRequest metric_request(ValueTree table, const std::string& file, const Scene& scene) {
  MetricRequest request;
  request.origin = place(file, table);
  Keys keys = bind_metric(request);
  for (BoundKey& key : keys) key.description.path = "metric." + key.description.path;
  for (ValueTree& child : table.children) {
    if (const auto* text = std::get_if<std::string>(&child.value); text && child.key == "from")
      child.value =
          scene_cycles(scene).first(phase_time(scene.phase, *text, "metric.from, " + place(file, child)));
    assign(keys, child, file, "metric.");
  }
  return request;
}

// Reads [[metric]] of a scene file, or of the manifest of a run that had such requests.
ValueTree metric_tables(const std::string& file) {
  if (file.ends_with(".json"))
    return json_tree(
        read_json(file, "manifest of hysteron").value(Json::json_pointer("/options/metric"), Json::array()),
        file, Lists::refused, "metric");
  const ValueTree root = read_toml(file);
  const ValueTree* tables = root.find("metric");
  return tables ? *tables : ValueTree{ValueTree::Kind::array, "metric", 0, {}, {}};
}

}  // namespace

bool MetricRequest::has_part() const { return !is_of(*this, {Kind::distance, Kind::height, Kind::force}); }

Error MetricRequest::refusal(const std::string& what) const {
  return Error::invalid_input("metric " + name + ": " + what + " (" + origin + ")");
}

std::string MetricRequest::column() const { return name + " [" + unit_of(kind).first + "]"; }
std::string MetricRequest::metric(int cycle) const {
  return name + (cycle > 0 ? "_cycle_" + std::to_string(cycle) : "") + unit_of(kind).second;
}

Keys bind_metric(MetricRequest& request) { return bind(kRows, request); }

Json to_json(const std::vector<MetricRequest>& requests) {
  Json all = Json::array();
  for (MetricRequest request : requests) all.push_back(hysteron::to_json(bind_metric(request)));
  return all;
}

std::vector<MetricRequest> metrics_in(const std::string& name, const Scene& scene) {
  if (name.empty()) return {};
  const std::string file = find_asset("scenes", name, "--scene").string();
  const ValueTree metrics = metric_tables(file);
  std::vector<MetricRequest> requests;
  for (const ValueTree& table : tables(metrics, file)) requests.push_back(metric_request(table, file, scene));
  check_names(requests);
  return requests;
}

std::vector<MetricRequest> take_requests(Setup& setup) {
  const std::vector<MetricRequest> requests = metrics_in(setup.options.scene, setup.scene);
  if (requests.empty()) return requests;
  Json choices = *setup.resolved;
  choices["metric"] = to_json(requests);
  setup.resolved = std::make_shared<const Json>(choices);
  for (const MetricRequest& request : requests) {
    setup.requested_metrics.push_back(request.metric());
    for (int cycle = 1; setup.scene.cycles > 1 && cycle <= setup.scene.cycles; ++cycle)
      setup.requested_metrics.push_back(request.metric(cycle));
  }
  return requests;
}

std::vector<std::string> idle_metric_warnings(const std::vector<MetricRequest>& requests) {
  return idle_keys_of(requests, "metric", bind_metric, kRead);
}

}  // namespace hysteron::experiments
