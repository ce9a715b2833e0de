#include "render/obstacles.h"

#include <cmath>
#include <string>
#include <utility>

#include "sim/base/error.h"

namespace hysteron::render {
namespace {

// Longest side of an obstacle's triangles over its diagonal: their corners carry the room's soft shadows.
constexpr float kSkySpacing = 1.0f / 12;
constexpr float kBodySkyBlur = 3.2f, kBodySkyLift = 2.4f;  // [texels]; neighbouring directions blend

Box mesh_box(const TriangleMesh& mesh) {
  if (mesh.positions.empty()) throw Error::invalid_input("drawing an obstacle: it has no triangles");
  Box box{mesh.positions.front(), mesh.positions.front()};
  for (const Eigen::Vector3f& p : mesh.positions) box = box.merged({p, p});
  return box;
}

Box placed_box(const Box& box, const Eigen::Matrix4f& placement) {
  const Eigen::Vector3f half = 0.5f * (box.high - box.low);
  const Eigen::Vector3f center =
      placement.topLeftCorner<3, 3>() * box.center() + placement.topRightCorner<3, 1>();
  const Eigen::Vector3f reach = placement.topLeftCorner<3, 3>().cwiseAbs() * half;
  return {center - reach, center + reach};
}

}  // namespace

Obstacles::Obstacles(const GlFunctions& gl)
    : gl_(&gl),
      sky_program_(gl, {.vertex = "sky.vert", .fragment = "", .defines = "", .captured = {"vertex_sky"}}) {}

int Obstacles::add(const TriangleMesh& mesh, const Eigen::Matrix4f& placement, const TriangleMesh* caster) {
  obstacles_.push_back(made(mesh, placement, caster));
  return static_cast<int>(obstacles_.size()) - 1;
}

Obstacles::Obstacle Obstacles::made(const TriangleMesh& mesh, const Eigen::Matrix4f& placement,
                                    const TriangleMesh* caster) const {
  const Box box = mesh_box(mesh);
  const TriangleMesh fine = refined(mesh, 2 * kSkySpacing * box.radius());
  return {StaticMesh(*gl_, fine),
          StaticMesh(*gl_, caster ? *caster : mesh),
          box,
          BodyMeasure(mesh),
          mesh.closed,
          placement};
}

void Obstacles::reshape(int number, const TriangleMesh& mesh, const TriangleMesh* caster) {
  Obstacle& old = at(number);
  Obstacle reshaped = made(mesh, old.placement, caster);
  reshaped.visible = old.visible;
  reshaped.shapes = old.shapes + 1;
  old = std::move(reshaped);
}

Obstacles::Obstacle& Obstacles::at(int number) {
  if (number < 0 || number >= static_cast<int>(obstacles_.size()))
    throw Error::invalid_input("obstacle " + std::to_string(number) + " is not among the " +
                               std::to_string(obstacles_.size()) + " drawn");
  return obstacles_[number];
}

void Obstacles::move(int number, const Eigen::Matrix4f& placement) { at(number).placement = placement; }
void Obstacles::show(int number, bool visible) { at(number).visible = visible; }

std::optional<Box> Obstacles::merged(std::optional<Box> box) const {
  for (const Obstacle& obstacle : obstacles_) {
    if (!obstacle.visible) continue;
    const Box here = placed_box(obstacle.box, obstacle.placement);
    box = box ? box->merged(here) : here;
  }
  return box;
}

std::vector<float> Obstacles::state() const {
  std::vector<float> all;
  for (const Obstacle& obstacle : obstacles_) {
    all.push_back(obstacle.visible ? static_cast<float>(obstacle.shapes) : 0);
    all.insert(all.end(), obstacle.placement.data(), obstacle.placement.data() + obstacle.placement.size());
  }
  return all;
}

void Obstacles::draw(const Program& program, const ObstacleFit& fit) const {
  draw_meshes(&Obstacle::mesh, program, fit);
}

void Obstacles::draw_casters(const Program& program, const ObstacleFit& fit) const {
  draw_meshes(&Obstacle::caster, program, fit);
}

// Far sides of closed bodies are never seen, and where no graphics hardware draws, they would cost
// most.
void Obstacles::draw_meshes(StaticMesh Obstacle::*mesh, const Program& program,
                            const ObstacleFit& fit) const {
  gl_->CullFace(GL_BACK);
  for (const Obstacle& obstacle : obstacles_) {
    if (!obstacle.visible) continue;
    obstacle.closed ? gl_->Enable(GL_CULL_FACE) : gl_->Disable(GL_CULL_FACE);
    place(program, obstacle, fit);
    (obstacle.*mesh).draw();
  }
  gl_->Disable(GL_CULL_FACE);
}

void Obstacles::update_sky(const ShadowMaps& shadows, const ObstacleFit& fit) const {
  sky_program_.use();
  shadows.bind(sky_program_, kBodySkyBlur, kBodySkyLift);
  for (const Obstacle& obstacle : obstacles_) {
    if (!obstacle.visible) continue;
    place(sky_program_, obstacle, fit);
    obstacle.mesh.update_sky();
  }
}

void Obstacles::place(const Program& program, const Obstacle& obstacle, const ObstacleFit& fit) {
  const float scale = obstacle.placement.topLeftCorner<3, 1>().norm();  // a motion may swell the body
  const BodyMeasure& body = obstacle.measure;
  const float inset = body_inset(body, fit.cloth_side / scale, fit.least_inset / scale);
  Eigen::Vector3f keep = Eigen::Vector3f::Ones();
  if (body.centred) keep -= inset * body.half_extent.cwiseInverse();
  program.set("keep", keep);
  program.set("inset", body.centred ? 0 : inset);
  program.set("model", standing(obstacle, inset * scale, fit.ground_height));
}

Eigen::Matrix4f Obstacles::standing(const Obstacle& obstacle, float inset,
                                    const std::optional<float>& ground_height) {
  const Box box = placed_box(obstacle.box, obstacle.placement);
  const float low = box.low.z(), height = box.high.z() - low;
  if (!ground_height || std::abs(low - *ground_height) > inset) return obstacle.placement;
  Eigen::Matrix4f stretch = Eigen::Matrix4f::Identity();
  stretch(2, 2) = (height - inset) / (height - 2 * inset);
  stretch(2, 3) = low - stretch(2, 2) * (low + inset);
  return stretch * obstacle.placement;
}

}  // namespace hysteron::render
