#include "experiments/workbench/session/probes.h"

#include <fmt/core.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/plot.h"
#include "sim/base/comma_list.h"
#include "sim/base/error.h"
#include "sim/base/number_in.h"

namespace hysteron::experiments {
namespace {

constexpr const char* kNone = "none";
constexpr const char* kSeriesFile = "probes.csv";
constexpr const char *kHeight = "plot_probe_height", *kCurvature = "plot_probe_curvature",
                     *kMoment = "plot_probe_moment";

Error refusal(const std::string& text, const std::string& what) {
  return Error::invalid_input("probe = " + text + " " + what + " (--probe)").with_key("probe", text);
}

Eigen::Vector2d parsed_point(const std::string& text) {
  const std::vector<std::string> words = split(text);
  if (words.size() == 2) {
    const std::optional<double> x = number_in(words[0]), y = number_in(words[1]);
    if (x && y) return {*x, *y};
  }
  throw refusal(text, "must be x,y[;x,y...], numbers in m");
}

std::vector<Eigen::Vector2d> parsed_points(const std::string& text) {
  std::vector<Eigen::Vector2d> places;
  for (const std::string& one : split(text, ';')) places.push_back(parsed_point(one));
  return places;
}

// Returns "x in [0, 0.3] and y in [0, 0.2] m".
std::string flat_extent(const ClothMesh& mesh) {
  Eigen::AlignedBox2d box;
  for (int f = 0; f < mesh.faces(); ++f)
    for (const Eigen::Vector3d& corner : mesh.corners(f)) box.extend(corner.head<2>());
  const auto& low = box.min();
  const auto& high = box.max();
  return fmt::format("x in [{:.6g}, {:.6g}] and y in [{:.6g}, {:.6g}] m", low.x(), high.x(), low.y(),
                     high.y());
}

// Appends the values of one element for its columns: (S_xx, S_yy, sqrt2 S_xy) of a face become its tensor's
// components.
void append(std::vector<double>& row, const std::vector<double>& values, int element, int dimension) {
  for (int c = 0; c < dimension; ++c)
    row.push_back(values[element * dimension + c] / (c == 2 ? std::numbers::sqrt2 : 1));
}

}  // namespace

void probe_unless_told(Options& options, const Eigen::Vector2d& at) {
  if (options.probe.empty()) options.probe = fmt::format("{:.6g},{:.6g}", at.x(), at.y());
}

Probes::Probes(const std::string& text, const ClothMesh& mesh, int dimension)
    : mesh_(mesh), dimension_(dimension) {
  if (text.empty() || text == kNone) return;
  const std::vector<Eigen::Vector2d> places = parsed_points(text);
  if (!is_flat(mesh)) throw refusal(text, "needs a cloth that is flat at rest, in planes z = constant");
  for (const Eigen::Vector2d& at : places) {
    const std::optional<MaterialPoint> point = material_point(mesh, at);
    if (!point)
      throw refusal(fmt::format("{:g},{:g}", at.x(), at.y()),
                    "is beside the cloth, which at rest has " + flat_extent(mesh));
    const int element = dimension == 1 ? nearest_hinge(mesh, *point) : point->face;
    if (element < 0) throw refusal(text, "needs a hinge at the triangle of each point");
    all_.push_back({"probe" + std::to_string(all_.size() + 1), at, *point, element});
  }
}

std::string Probes::text() const {
  std::string lines;
  for (const Probe& probe : all_)
    lines += fmt::format("{} at ({:g}, {:g}) m: {} {}\n", probe.name, probe.at.x(), probe.at.y(),
                         dimension_ == 1 ? "hinge" : "triangle", probe.element);
  return lines;
}

std::vector<std::string> Probes::columns() const {
  std::vector<std::string> names = {"time [s]"};
  const std::vector<std::string> components =
      dimension_ == 1 ? std::vector<std::string>{""} : std::vector<std::string>{"_warp", "_weft", "_twist"};
  for (const Probe& probe : all_) {
    for (const char* axis : {"_x [m]", "_y [m]", "_z [m]"}) names.push_back(probe.name + axis);
    for (const auto& [quantity, unit] :
         {std::pair{"_curvature", " [1/m]"}, {"_moment", " [N]"}, {"_residual_curvature", " [1/m]"}})
      for (const std::string& component : components)
        names.push_back(probe.name + quantity + component + unit);
    names.push_back(probe.name + "_friction_share");
  }
  return names;
}

std::vector<std::string> Probes::directions() const {
  return dimension_ == 1 ? std::vector<std::string>{""} : std::vector<std::string>{"_warp", "_weft"};
}

std::vector<std::string> Probes::files() const {
  return empty() ? std::vector<std::string>{} : std::vector<std::string>{kSeriesFile};
}

std::vector<std::string> Probes::plots() const {
  return empty() ? std::vector<std::string>{} : std::vector<std::string>{kHeight, kCurvature, kMoment};
}

void Probes::begin(Session& session) {
  if (!empty()) series_.emplace(session.run().path(kSeriesFile), columns());
}

void Probes::record(Session& session, const Snapshot& instant) {
  if (empty()) return;
  Simulation& simulation = session.simulation();
  const std::vector<double> curvature = simulation.curvature(), moment = simulation.moment(),
                            residual = simulation.residual_curvature(),
                            fraction = simulation.friction_share();
  std::vector<double> row = {instant.time};
  for (const Probe& probe : all_) {
    const Eigen::Vector3d at = probe.point.among(mesh_, instant.x);
    row.insert(row.end(), at.begin(), at.end());
    for (const auto* values : {&curvature, &moment, &residual})
      append(row, *values, probe.element, dimension_);
    row.push_back(fraction[probe.element]);
  }
  series_->row(row);
  const Probe& first = all_.front();
  loops_.resize(directions().size());
  for (std::size_t c = 0; c < loops_.size(); ++c) {
    const std::size_t at = static_cast<std::size_t>(first.element) * dimension_ + c;
    loops_[c].curvature.push_back(curvature[at]);
    loops_[c].moment.push_back(moment[at]);
  }
}

render::Path Probes::loop() const {
  const auto bent = [](const render::Path& path) {
    double most = 0;
    for (double k : path.curvature) most = std::max(most, std::abs(k));
    return most;
  };
  const auto most = std::max_element(loops_.begin(), loops_.end(),
                                     [&](const auto& a, const auto& b) { return bent(a) < bent(b); });
  return most == loops_.end() ? render::Path{} : *most;
}

void Probes::close() {
  if (!empty()) series_->finish();
}

void Probes::serialise(Archive& archive) {
  if (empty()) return;
  series_->serialise(archive);
  loops_.resize(archive.size(loops_.size()));
  for (render::Path& path : loops_) {
    archive(path.curvature);
    archive(path.moment);
  }
}

void Probes::finish(Session& session, const std::string&) {
  std::vector<Curve>& curves = session.run().manifest().curves;
  for (const Probe& probe : all_) {
    const std::string plot = "plot_" + probe.name,
                      where = fmt::format("at the material point ({:g}, {:g}) m", probe.at.x(), probe.at.y());
    curves.push_back({plot + "_z", kSeriesFile, "time [s]", probe.name + "_z [m]", false,
                      "Height z " + where + " against time."});
    for (const std::string& direction : directions()) {
      const std::string curvature = probe.name + "_curvature" + direction + " [1/m]",
                        along = (direction.empty() ? "" : " along " + direction.substr(1)) + " " + where;
      curves.push_back({plot + "_curvature" + direction, kSeriesFile, "time [s]", curvature, false,
                        "Curvature" + along + " against time."});
      curves.push_back({plot + "_moment" + direction, kSeriesFile, curvature,
                        probe.name + "_moment" + direction + " [N]", false,
                        "Moment per width" + along + " against curvature."});
    }
  }
}

void Probes::plot(Run& run, const std::string& what) const {
  if (empty()) return;
  const std::filesystem::path csv = run.folder() / kSeriesFile;
  const std::string points = (all_.size() > 1 ? " at probes, " : " at the probe, ") + what;
  render::Plot height{"Height" + points, {"time [s]"}, {"height z [m]"}},
      curvature{"Curvature" + points, {"time [s]"}, {"curvature [1/m]"}},
      moment{"Moment and curvature" + points, {"curvature [1/m]"}, {"moment [N]"}};
  for (const Probe& probe : all_) {
    height.series.push_back(render::series_from_csv(csv, "time", probe.name + "_z", probe.name));
    for (const std::string& direction : directions()) {
      const std::string label = probe.name + (direction.empty() ? "" : " " + direction.substr(1)),
                        k = probe.name + "_curvature" + direction, m = probe.name + "_moment" + direction;
      curvature.series.push_back(render::series_from_csv(csv, "time", k, label));
      moment.series.push_back(render::series_from_csv(csv, k, m, label));
    }
  }
  run.plot(kHeight, height);
  run.plot(kCurvature, curvature);
  run.plot(kMoment, moment);
}

}  // namespace hysteron::experiments
