#include "experiments/run/metrics.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>
#include <utility>

#include "experiments/workbench/app/json_file.h"
#include "experiments/workbench/session/idle_keys.h"
#include "sim/base/error.h"
#include "sim/bending/vertex_curvature.h"
#include "sim/scene/assets.h"
#include "sim/scene/toml_file.h"

namespace hysteron::experiments {
namespace {

using M = MetricRequest;
// clang-format off
const KeyRow<M> kRows[] = {
    {"name", at<&M::name>, "", any(), "", "of the column in metrics.csv and, with its unit, of the metric: small letters, digits and _"},
    {"kind", at<&M::kind>, "", any(), "distance | height | angle | force | residual-curvature", "distance of point and to; height of point; angle between the mean normals of two parts, 0 when they are parallel; force of a hand on the cloth; root mean square over the area of a part"},
    {"point", at<&M::point>, "m", any(), "", "distance, height: of the vertex nearest to this on the flat cloth"},
    {"to", at<&M::to>, "m", any(), "", "distance: to the vertex nearest to this"},
    {"low", at<&M::low>, "m", any(), "", "angle, residual-curvature: corner of the box that contains the part, on the flat cloth"},
    {"high", at<&M::high>, "m", any(), "", "opposite corner of the box, >= low"},
    {"other-low", at<&M::other_low>, "m", any(), "", "angle: the same of the other part"},
    {"other-high", at<&M::other_high>, "m", any(), "", "angle: the same of the other part"},
    {"hand", at<&M::hand>, "", between(1, 1e6), "", "force: number of the [[pin]], the first is 1"},
    {"direction", at<&M::direction>, "", any(), "", "force: its component along this; zero: its size"},
};
// clang-format on

bool is_of(const M& request, std::initializer_list<const char*> kinds) {
  return std::ranges::find(kinds, request.kind) != kinds.end();
}

constexpr ReadKey<M> kRead[] = {
    {"point", "a distance or height",
     [](const M& m) {
       return is_of(m, {"distance", "height"});
     }},
    {"to", "a distance", [](const M& m) { return is_of(m, {"distance"}); }},
    {"low", "an angle or residual-curvature",
     [](const M& m) {
       return is_of(m, {"angle", "residual-curvature"});
     }},
    {"high", "an angle or residual-curvature",
     [](const M& m) {
       return is_of(m, {"angle", "residual-curvature"});
     }},
    {"other-low", "an angle", [](const M& m) { return is_of(m, {"angle"}); }},
    {"other-high", "an angle", [](const M& m) { return is_of(m, {"angle"}); }},
    {"hand", "a force", [](const M& m) { return is_of(m, {"force"}); }},
    {"direction", "a force", [](const M& m) { return is_of(m, {"force"}); }},
};

const std::map<std::string, std::pair<const char*, const char*>> kUnits = {
    {"distance", {"m", "_m"}},
    {"height", {"m", "_m"}},
    {"angle", {"degree", "_deg"}},
    {"force", {"N", "_N"}},
    {"residual-curvature", {"1/m", "_per_m"}}};

Error refusal(const MetricRequest& request, const std::string& what) {
  return Error::invalid_input("metric " + request.name + ": " + what + " (" + request.origin + ")");
}

// Results of every run whose names end as those of requests do.
const std::set<std::string> kOwnResults = {"hand_lag_m", "residual_curvature_rms_per_m",
                                           "residual_curvature_formula_rms_per_m"};

void check_names(const std::vector<MetricRequest>& requests) {
  std::set<std::string> seen = {"time", "fastest"};  // columns that every series has
  for (const auto& [name, joules] : Ledger{}.rows()) seen.insert(name);
  for (const MetricRequest& request : requests) {
    const auto allowed = [](const char c) {
      return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
    };
    if (request.name.empty() || !std::all_of(request.name.begin(), request.name.end(), allowed))
      throw Error::invalid_input("metric.name = \"" + request.name +
                                 "\" must be small letters, digits and _ (" + request.origin + ")")
          .with_key("metric.name", request.name);
    if (!seen.insert(request.name).second) throw refusal(request, "there is a column of this name already");
    if (kOwnResults.contains(request.metric()))
      throw refusal(request, "every run has a result " + request.metric() + " of its own");
  }
}

MetricRequest metric_request(const ValueTree& table, const std::string& file) {
  MetricRequest request;
  request.origin = place(file, table);
  Keys keys = bind_metric(request);
  for (BoundKey& key : keys) key.description.path = "metric." + key.description.path;
  for (const ValueTree& child : table.children) assign(keys, child, file, "metric.");
  return request;
}

// [[metric]] of a scene file, or of the manifest of a run that was asked for them.
ValueTree metric_tables(const std::string& file) {
  if (file.ends_with(".json"))
    return json_tree(
        read_json(file, "manifest of hysteron").value(Json::json_pointer("/options/metric"), Json::array()),
        file, Lists::refused, "metric");
  const ValueTree root = read_toml(file);
  const ValueTree* tables = root.find("metric");
  return tables ? *tables : ValueTree{ValueTree::Kind::array, "metric", 0, {}, {}};
}

int requested_vertex(const ClothMesh& mesh, const MetricRequest& request, const char* key,
                     const Eigen::Vector3d& point) {
  const auto [vertex, beside] = nearest_vertex(mesh, point);
  const Eigen::Vector3d& nearest = mesh.rest[vertex];
  if (beside > 0)
    throw refusal(request, std::string(key) + " lies " + number_text(beside, 3) +
                               " m beside the flat cloth, whose nearest vertex is at " +
                               number_text(nearest.x(), 4) + ", " + number_text(nearest.y(), 4) + ", " +
                               number_text(nearest.z(), 4) + " m");
  return vertex;
}

std::vector<int> in_box(const std::vector<Eigen::Vector3d>& centers, const Eigen::Vector3d& low,
                        const Eigen::Vector3d& high) {
  std::vector<int> items;
  for (std::size_t i = 0; i < centers.size(); ++i)
    if (is_in_box(centers[i], low, high)) items.push_back(static_cast<int>(i));
  return items;
}

// Of the faces, by their areas.
Eigen::Vector3d mean_normal(const ClothMesh& mesh, const std::vector<int>& faces,
                            const std::vector<Eigen::Vector3d>& x) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const int f : faces) {
    const Eigen::Vector3i& t = mesh.face[f];
    sum += (x[t[1]] - x[t[0]]).cross(x[t[2]] - x[t[0]]);
  }
  return sum;
}

}  // namespace

std::string MetricRequest::column() const { return name + " [" + kUnits.at(kind).first + "]"; }
std::string MetricRequest::metric() const { return name + kUnits.at(kind).second; }

Keys bind_metric(MetricRequest& request) { return bind(kRows, request); }

Json to_json(const std::vector<MetricRequest>& requests) {
  Json all = Json::array();
  for (MetricRequest request : requests) all.push_back(hysteron::to_json(bind_metric(request)));
  return all;
}

std::vector<MetricRequest> metrics_in(const std::string& scene) {
  if (scene.empty()) return {};
  const std::string file = find_asset("scenes", scene, "--scene").string();
  const ValueTree metrics = metric_tables(file);
  std::vector<MetricRequest> requests;
  for (const ValueTree& table : tables(metrics, file)) requests.push_back(metric_request(table, file));
  check_names(requests);
  return requests;
}

RequestedMetric::RequestedMetric(const MetricRequest& request, const Scene& scene, const Cloth& cloth,
                                 int dimension)
    : request_(request), scene_(scene), cloth_(cloth) {
  const std::string& kind = request.kind;
  if (kind == "distance" || kind == "height")
    items_ = {requested_vertex(cloth.mesh, request, "point", request.point)};
  if (kind == "distance") {
    others_ = {requested_vertex(cloth.mesh, request, "to", request.to)};
    if (items_ == others_) throw refusal(request, "the same vertex is nearest to point and to to");
  }
  if (kind == "angle" || kind == "residual-curvature")
    items_ = in_box(cloth.element_centers(kind == "angle" ? 3 : dimension), request.low, request.high);
  if (kind == "angle") others_ = in_box(cloth.element_centers(3), request.other_low, request.other_high);
  if (kind != "force" && items_.empty())
    throw refusal(request, "no element of the cloth lies between low and high");
  if (kind == "angle" && others_.empty())
    throw refusal(request, "no face of the cloth lies between other-low and other-high");
  if (kind != "force") return;
  if (request.hand > static_cast<int>(scene.pin.size()))
    throw refusal(request, "hand = " + std::to_string(request.hand) + " must be <= " +
                               std::to_string(scene.pin.size()) + ", the number of [[pin]] tables");
  if (!scene.is_implicit())
    throw refusal(request,
                  "integrator = " + enum_name(scene.integrator) +
                      " does not tell the forces of hands; implicit, bdf2, tr-bdf2 and quasi-static do");
}

double RequestedMetric::value(Simulation& simulation, const std::vector<Eigen::Vector3d>& x) const {
  if (request_.kind == "distance") return (x[items_[0]] - x[others_[0]]).norm();
  if (request_.kind == "height") return x[items_[0]].z();
  if (request_.kind == "angle") return angle(x);
  if (request_.kind == "force") return force(simulation);
  return residual_curvature(simulation);
}

double RequestedMetric::angle(const std::vector<Eigen::Vector3d>& x) const {
  const Eigen::Vector3d a = mean_normal(cloth_.mesh, items_, x), b = mean_normal(cloth_.mesh, others_, x);
  return std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / std::numbers::pi;
}

double RequestedMetric::force(Simulation& simulation) const {
  const std::vector<Eigen::Vector3d> forces = simulation.handle_forces();
  const std::vector<int> pins = cloth_.pins(scene_, simulation.time());
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < forces.size(); ++i)
    if (pins[i] == request_.hand - 1) sum += forces[i];
  return request_.direction.isZero(0) ? sum.norm() : sum.dot(request_.direction.normalized());
}

double RequestedMetric::residual_curvature(Simulation& simulation) const {
  const std::vector<double> k = simulation.residual_curvature();
  const int d = simulation.dimension();
  const std::vector<double> all = element_areas(cloth_.mesh, d);
  std::vector<double> part, area;
  for (const int i : items_) {
    part.insert(part.end(), &k[i * d], &k[i * d] + d);
    area.push_back(all[i]);
  }
  return curvature_rms(part, area, d);
}

std::vector<std::string> idle_metric_warnings(const std::vector<MetricRequest>& requests) {
  return idle_keys_of(requests, "metric", bind_metric, kRead);
}

}  // namespace hysteron::experiments
