#include "experiments/workbench/session/mesh_export.h"

#include <fmt/core.h>

#include "experiments/workbench/pictures/drawing.h"
#include "experiments/workbench/pictures/ridge_metrics.h"
#include "experiments/workbench/pictures/scene_renderer.h"
#include "render/inset.h"
#include "render/key_light.h"
#include "sim/base/atomic_file.h"
#include "sim/bending/vertex_curvature.h"
#include "sim/mesh/mesh_export.h"
#include "sim/scene/body.h"

namespace hysteron::experiments {
namespace {

constexpr const char* kInstants = "mesh/cloth.pvd";
constexpr const char *kCacheMesh = "mesh/cloth.obj", *kCache = "mesh/cloth.pc2";

std::string mesh_name(std::size_t number, MeshFormat format) {
  const std::string ending = format == MeshFormat::vtk       ? "vtp"
                             : format == MeshFormat::mitsuba ? "ply"
                                                             : enum_name(format);
  return fmt::format("{:04}.{}", number, ending);
}

std::string mesh_file(std::size_t number, MeshFormat format) { return "mesh/" + mesh_name(number, format); }

std::string scene_file(std::size_t number) { return fmt::format("mesh/{:04}.xml", number); }
// Returns the name of a body's file; a body that changes its shape has one for each instant.
std::string body_file(std::size_t number, std::optional<std::size_t> instant = {}) {
  return instant ? fmt::format("bodies/{:04}-{:04}.ply", number, *instant)
                 : fmt::format("bodies/{:04}.ply", number);
}

VtkField velocities(Simulation& simulation) {
  VtkField field{"velocity", 3, {}};
  for (const Eigen::Vector3d& v : simulation.velocities())
    field.values.insert(field.values.end(), v.begin(), v.end());
  return field;
}

// Returns at each vertex the mean of the norms around it.
VtkField mean_size(const char* name, const ClothMesh& mesh, const std::vector<double>& element,
                   int dimension) {
  const std::vector<float> mean = vertex_average(mesh, curvature_size(element, dimension), dimension);
  return {name, 1, {mean.begin(), mean.end()}};
}

void write_fields(const std::string& file, const ClothMesh& mesh, Simulation& simulation,
                  const std::vector<Eigen::Vector3d>& x) {
  const int d = simulation.dimension();
  const std::vector<double> curvature = simulation.curvature(), moment = simulation.moment(),
                            residual = simulation.residual_curvature(),
                            fraction = simulation.friction_share();
  const std::vector<float> trace = vertex_curvature(mesh, curvature, d),
                           mean = vertex_average(mesh, fraction, d);
  std::vector<VtkField> of_faces;
  if (d == 3)
    of_faces = {{"curvature_tensor", d, curvature},
                {"moment_tensor", d, moment},
                {"residual_curvature_tensor", d, residual},
                {"friction_share_of_face", 1, fraction}};
  write_vtp(file, mesh, x,
            {velocities(simulation),
             {"curvature", 1, {trace.begin(), trace.end()}},
             mean_size("moment", mesh, moment, d),
             mean_size("residual_curvature", mesh, residual, d),
             {"friction_share", 1, {mean.begin(), mean.end()}}},
            of_faces);
}

}  // namespace

std::vector<std::string> MeshExport::files(MeshFormat format) {
  if (format == MeshFormat::none) return {};
  if (format == MeshFormat::pc2) return {kCacheMesh, kCache};
  if (format == MeshFormat::vtk) return {mesh_file(0, format), kInstants};
  if (format == MeshFormat::mitsuba) return {mesh_file(0, format), scene_file(0), "mesh/" + body_file(0)};
  return {mesh_file(0, format)};
}

// Prepares the pictures' view for format mitsuba.
void MeshExport::begin(Session& session) {
  if (session.setup().options.export_format == MeshFormat::mitsuba)
    view_ = picture_view(session.setup(), session.bounds(), session.plan().floor);
}

// Writes a Mitsuba scene; bodies that keep their shape are written with the first one only.
void MeshExport::write_scene(Session& session, std::size_t number, const Snapshot& instant) {
  Run& run = session.run();
  const std::vector<Obstacle>& obstacles = session.scene().obstacle;
  std::vector<std::string> bodies;
  for (std::size_t i = 0; i < obstacles.size(); ++i) {
    const Obstacle& o = obstacles[i];
    const bool changes = is_body(o) && o.mesh && o.mesh->moves();
    const auto body = o.visible ? obstacle_mesh(o, render::kSeen, instant.time) : std::nullopt;
    bodies.push_back(body ? body_file(i, changes ? std::optional(number) : std::nullopt) : "");
    if (body && (changes || number == 0))
      write_body(run.path("mesh/" + bodies[i]).string(), *body, view_->look, side_);
  }
  PictureView view = *view_;
  view.look.to_light =
      render::key_direction(view.look, view.camera, render::plane_normal(flat_points(instant.x)));
  write_text(run.path(scene_file(number)),
             mitsuba_scene(view, session.scene(), instant.time, mesh_name(number, MeshFormat::ply), bodies));
}

void MeshExport::record(Session& session, const Snapshot& instant) {
  const MeshFormat format = session.setup().options.export_format;
  if (format == MeshFormat::none || !session.is_pictured(instant)) return;
  Run& run = session.run();
  Simulation& simulation = session.simulation();
  const ClothMesh& mesh = session.cloth().mesh;
  const std::vector<Eigen::Vector3d>& x = instant.x;
  const auto stage = run.stage("io");
  const std::size_t number = times_.size();
  times_.push_back(instant.time);
  if (format == MeshFormat::pc2) {
    if (number == 0) write_obj(run.path(kCacheMesh).string(), mesh, x);
    return write_to_point_cache(run.path(kCache).string(), number, x);
  }
  const std::string file = run.path(mesh_file(number, format)).string();
  if (format == MeshFormat::obj) return write_obj(file, mesh, x);
  if (view_ && number == 0) side_ = render::long_side(flat_triangles(mesh.face), flat_points(mesh.rest), 3);
  if (view_) write_scene(session, number, instant);
  if (format == MeshFormat::ply || format == MeshFormat::mitsuba) {
    const std::vector<float> k = vertex_curvature(mesh, simulation.curvature(), simulation.dimension());
    return write_ply(file, mesh, x, {k.begin(), k.end()});
  }
  write_fields(file, mesh, simulation, x);
  std::vector<std::pair<double, std::string>> instants;
  for (std::size_t k = 0; k < times_.size(); ++k) instants.emplace_back(times_[k], mesh_name(k, format));
  write_pvd(run.path(kInstants).string(), instants);
}

}  // namespace hysteron::experiments
