#include "experiments/workbench/session/requested_metrics.h"

#include <fmt/core.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "experiments/workbench/pictures/ridge_metrics.h"
#include "experiments/workbench/pictures/silhouette.h"
#include "sim/base/csv.h"
#include "sim/base/error.h"
#include "sim/bending/vertex_curvature.h"
#include "sim/scene/cycles.h"

namespace hysteron::experiments {
namespace {

int requested_vertex(const ClothMesh& mesh, const MetricRequest& request, const char* key,
                     const Eigen::Vector3d& point) {
  const auto [vertex, beside] = nearest_vertex(mesh, point);
  const Eigen::Vector3d& nearest = mesh.rest[vertex];
  if (beside > 0)
    throw request.refusal(std::string(key) + " lies " + number_text(beside, 3) +
                          " m beside the flat cloth, whose nearest vertex is at " +
                          number_text(nearest.x(), 4) + ", " + number_text(nearest.y(), 4) + ", " +
                          number_text(nearest.z(), 4) + " m");
  return vertex;
}

// Returns the mean normal of the faces, weighted by area.
Eigen::Vector3d mean_normal(const ClothMesh& mesh, const std::vector<int>& faces,
                            const std::vector<Eigen::Vector3d>& x) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const int f : faces) {
    const Eigen::Vector3i& t = mesh.face[f];
    sum += (x[t[1]] - x[t[0]]).cross(x[t[2]] - x[t[0]]);
  }
  return sum;
}

// Returns the mean length of the edges at these vertices [m].
double mean_edge_at(const ClothMesh& mesh, const std::vector<int>& vertices) {
  std::vector<char> chosen(mesh.vertices(), 0);
  for (const int v : vertices) chosen[v] = 1;
  double sum = 0;
  int count = 0;
  for (int e = 0; e < static_cast<int>(mesh.edge.size()); ++e) {
    if (!chosen[mesh.edge[e].p2] && !chosen[mesh.edge[e].p3]) continue;
    sum += mesh.edge_length(e);
    ++count;
  }
  return sum / count;
}

constexpr double kEdgesOfAWave = 4;
constexpr const char* kCyclesFile = "cycles.csv";

}  // namespace

RequestedMetric::RequestedMetric(const MetricRequest& request, const Scene& scene, const Cloth& cloth,
                                 int dimension)
    : request_(request), scene_(scene), cloth_(cloth) {
  const MetricKind kind = request.kind;
  const MetricRequest& r = request;
  if (kind == MetricKind::force) {
    check_force();
    return;
  }
  if (kind == MetricKind::distance || kind == MetricKind::height) {
    items_ = {requested_vertex(cloth.mesh, request, "point", request.point)};
    if (kind == MetricKind::height) return;
    others_ = {requested_vertex(cloth.mesh, request, "to", request.to)};
    if (items_ == others_) throw request.refusal("the same vertex is nearest to point and to to");
    return;
  }
  if (kind == MetricKind::silhouette && (r.from < 0 || r.direction.isZero(0)))
    throw request.refusal(r.from < 0 ? "kind = silhouette needs from, the instant to compare with"
                                     : "kind = silhouette needs the direction that it is seen along");
  if (kind == MetricKind::ridge_height)
    choose("low", "high", r.low, r.high, cloth.mesh.rest, items_);
  else
    choose("low", "high", r.low, r.high,
           cloth.element_centers(kind == MetricKind::residual_curvature ? dimension : 3), items_);
  if (kind == MetricKind::angle)
    choose("other-low", "other-high", r.other_low, r.other_high, cloth.element_centers(3), others_);
}

void RequestedMetric::choose(const char* low, const char* high, const Eigen::Vector3d& from,
                             const Eigen::Vector3d& to, const std::vector<Eigen::Vector3d>& places,
                             std::vector<int>& items) const {
  for (std::size_t i = 0; i < places.size(); ++i)
    if (is_in_box(places[i], from, to)) items.push_back(static_cast<int>(i));
  if (items.empty())
    throw request_.refusal(std::string("no element of the cloth lies between ") + low + " and " + high);
}

void RequestedMetric::check_force() const {
  if (request_.hand > static_cast<int>(scene_.pin.size()))
    throw request_.refusal("hand = " + std::to_string(request_.hand) + " must be <= " +
                           std::to_string(scene_.pin.size()) + ", the number of [[pin]] tables");
  if (!scene_.is_implicit())
    throw request_.refusal("integrator = " + enum_name(scene_.integrator) +
                           " does not tell the forces of pins; implicit, bdf2, tr-bdf2 and quasi-static do");
}

std::string RequestedMetric::warning(double seconds) const {
  if (request_.from >= seconds)
    return "it is not measured, since from = " + number_text(request_.from) + " s is not before the end, " +
           number_text(seconds) + " s";
  if (request_.kind != MetricKind::ridge_height) return "";
  const double edge = mean_edge_at(cloth_.mesh, items_);
  if (edge * kEdgesOfAWave <= request_.cutoff) return "";
  return "edges of " + number_text(edge, 2) +
         " m are more than a quarter of cutoff = " + number_text(request_.cutoff) +
         " m: ridges are not told from shape; take more triangles or a larger one";
}

void RequestedMetric::begin(Simulation& simulation, const std::vector<Eigen::Vector3d>& x) {
  has_begun_ = true;
  if (request_.kind == MetricKind::silhouette)
    x_before_ = x;
  else
    before_ = absolute(simulation, x);
}

double RequestedMetric::value(Simulation& simulation, const std::vector<Eigen::Vector3d>& x) const {
  if (request_.from < 0) return absolute(simulation, x);
  return has_begun_ ? absolute(simulation, x) - before_ : 0;
}

double RequestedMetric::absolute(Simulation& simulation, const std::vector<Eigen::Vector3d>& x) const {
  const MetricKind kind = request_.kind;
  if (kind == MetricKind::distance) return (x[items_[0]] - x[others_[0]]).norm();
  if (kind == MetricKind::height) return x[items_[0]].z();
  if (kind == MetricKind::angle) return angle(x);
  if (kind == MetricKind::force) return force(simulation);
  if (kind == MetricKind::ridge_length) return ridge_length(simulation);
  if (kind == MetricKind::ridge_height) return ridge_height(cloth_.mesh, x, items_, request_.cutoff);
  if (kind == MetricKind::silhouette) return silhouette(x);
  return residual_curvature(simulation);
}

double RequestedMetric::angle(const std::vector<Eigen::Vector3d>& x) const {
  const Eigen::Vector3d a = mean_normal(cloth_.mesh, items_, x), b = mean_normal(cloth_.mesh, others_, x);
  return std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / std::numbers::pi;
}

double RequestedMetric::force(Simulation& simulation) const {
  const std::vector<Eigen::Vector3d> forces = simulation.pin_forces();
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

double RequestedMetric::ridge_length(Simulation& simulation) const {
  const int d = simulation.dimension();
  const std::vector<double> size = curvature_size(simulation.residual_curvature(), d);
  return experiments::ridge_length(cloth_.mesh, vertex_average(cloth_.mesh, size, d), request_.threshold,
                                   items_);
}

double RequestedMetric::silhouette(const std::vector<Eigen::Vector3d>& x) const {
  std::vector<Eigen::Vector3i> part;
  for (const int f : items_) part.push_back(cloth_.mesh.face[f]);
  return 100 * silhouette_change(part, x_before_, x, request_.direction);
}

void RequestedMetric::serialise(Archive& archive) {
  archive(has_begun_, before_);
  x_before_.resize(archive.size(x_before_.size()));
  archive.bytes(x_before_.data(), x_before_.size() * sizeof(Eigen::Vector3d));
}

RequestedMetrics::RequestedMetrics(const std::vector<MetricRequest>& requests, Session& session)
    : session_(session) {
  Run& run = session.run();
  if (session.scene().cycles > 1) session.reserve({kCyclesFile});
  for (const std::string& warning : idle_metric_warnings(requests)) run.warn(warning);
  for (const MetricRequest& request : requests) {
    session.reserve({}, {"plot_" + request.name});
    metrics_.emplace_back(request, session.scene(), session.cloth(), session.simulation().dimension());
    if (const std::string warning = metrics_.back().warning(session.scene().seconds); !warning.empty())
      run.warn("metric " + request.name + ": " + warning + " (" + request.origin + ")");
  }
}

std::vector<double> RequestedMetrics::values(const Snapshot& instant) {
  last_.clear();
  for (const RequestedMetric& metric : metrics_)
    last_.push_back(metric.value(session_.simulation(), instant.x));
  return last_;
}

void RequestedMetrics::join(RunPlan& plan) {
  for (const RequestedMetric& metric : metrics_) plan.columns.push_back(metric.request().column());
  for (RequestedMetric& metric : metrics_)
    if (metric.request().from >= 0 && metric.request().from < session_.scene().seconds)
      plan.instants.push_back({metric.request().from, [this, &metric](const Snapshot& instant) {
                                 metric.begin(session_.simulation(), instant.x);
                               }});
  if (!plan.measure)  // what it measures is all that its progress can tell
    plan.progress = [this, own = plan.progress](const Snapshot& instant) { return own(instant) + words(); };
  plan.measure = [this, own = plan.measure](const Snapshot& instant) {
    std::vector<double> row = own ? own(instant) : std::vector<double>();
    for (const double value : values(instant)) row.push_back(value);
    return row;
  };
  if (session_.scene().cycles > 1) join_cycles(plan);
  plan.serialise = [this, own = plan.serialise](Archive& archive) {
    own(archive);
    for (RequestedMetric& metric : metrics_) metric.serialise(archive);
    archive(cycles_);
  };
}

void RequestedMetrics::join_cycles(RunPlan& plan) {
  columns_ = plan.columns;
  plan.columns.emplace_back("cycle");
  const Cycles cycles = scene_cycles(session_.scene());
  for (int cycle = 1; cycle <= cycles.count; ++cycle)
    plan.instants.push_back({cycles.end_of(cycle), [this, measure = plan.measure](const Snapshot& instant) {
                               std::vector<double> row = measure(instant);
                               row.insert(row.begin(), instant.time);
                               cycles_.push_back(row);
                             }});
  plan.measure = [this, measure = plan.measure](const Snapshot& instant) {
    std::vector<double> row = measure(instant);
    row.push_back(cycle_at(session_.scene(), instant.time));
    return row;
  };
}

// Writes cycles.csv; the requested metrics are the last columns of each row.
void RequestedMetrics::write_cycles() {
  std::vector<std::string> head = {"cycle", "time [s]"};
  head.insert(head.end(), columns_.begin(), columns_.end());
  Table table(head);
  for (std::size_t c = 0; c < cycles_.size(); ++c) {
    std::vector<Cell> cells = {c + 1};
    cells.insert(cells.end(), cycles_[c].begin(), cycles_[c].end());
    table.row(cells);
    for (std::size_t i = 0; i < metrics_.size(); ++i) {
      const RequestedMetric& metric = metrics_[i];
      if (metric.request().from >= 0 && metric.request().from > cycles_[c].front()) continue;
      session_.run().metric(metric.request().metric(static_cast<int>(c) + 1),
                            cycles_[c][cycles_[c].size() - metrics_.size() + i]);
    }
  }
  table.write(session_.run().path(kCyclesFile));
}

std::string RequestedMetrics::words() const {
  std::string text;
  for (std::size_t i = 0; i < last_.size(); ++i)
    text += fmt::format("  {} = {:.4g}", metrics_[i].request().column(), last_[i]);
  return text;
}

void RequestedMetrics::finish() {
  Simulation& simulation = session_.simulation();
  const std::vector<Eigen::Vector3d> x = simulation.positions();
  if (session_.scene().cycles > 1) write_cycles();
  for (const RequestedMetric& metric : metrics_) {
    const MetricRequest& request = metric.request();
    if (request.from < 0 || metric.has_begun())
      session_.run().metric(request.metric(), metric.value(simulation, x));
    if (!session_.pictures()) continue;
    render::Plot plot{request.name + ", " + session_.scene().fabric.name + ", law " + session_.scene().law,
                      {"time [s]"},
                      {request.column()}};
    plot.series = {
        render::series_from_csv(session_.run().path("metrics.csv"), "time", request.name, "simulated")};
    plot.series[0].color = session_.law_color();
    session_.plot("plot_" + request.name, plot);
  }
}

}  // namespace hysteron::experiments
