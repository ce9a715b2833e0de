#include "render/figure_light.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "render/exposure.h"
#include "render/shadow_maps.h"
#include "sim/base/rotation.h"

namespace hysteron::render {
namespace {

constexpr int kKeyUnit = 0, kRoomUnit = 1;
constexpr int kKeySide = 1024, kRoomSide = 512;     // texels of one direction's tile
constexpr int kKeyColumns = 2, kRoomColumns = 4;    // columns of tiles, as in figure_light.glsl
constexpr float kKeyRadius = 0.15f;                 // radius of the key light over its distance: 8.5 degrees
constexpr float kBorder = 1.04f;                    // keeps the maps' border empty: outside is light
const Eigen::Vector3f kKey{4.1f, 4.0f, 3.87f};      // light on a surface that faces the key light
const Eigen::Vector3f kSky{0.96f, 1.0f, 1.06f};     // light on a surface that faces up
const Eigen::Vector3f kFloor{0.91f, 0.90f, 0.88f};  // light on a surface that faces down

constexpr float kOpenLight = 3;      // light of the studio on open ground: half the key's, and the sky's
constexpr float kMinExposed = 0.3f;  // a dim room is exposed longer, for its key light alone

float u(int index, int base) { return static_cast<float>(radical_inverse(index, base)); }

// Returns the transform from world to clip space of a parallel light that sees the box; `texel` becomes the
// size of a texel in a map of `side` texels [m].
Eigen::Matrix4f light_matrix(const Eigen::Vector3f& to_light, const Box& box, int side, float& texel) {
  const Eigen::Matrix3f turn = rotation_between(to_light, Eigen::Vector3f::UnitZ());
  const Eigen::Vector3f half = 0.5f * (box.high - box.low);
  const Eigen::Vector3f reach =
      kBorder * (turn.cwiseAbs() * half).cwiseMax(1e-3f * box.radius()).cwiseMax(1e-6f);
  texel = 2 * std::max(reach.x(), reach.y()) / static_cast<float>(side);
  Eigen::Matrix4f matrix = Eigen::Matrix4f::Identity();
  // The light's own z axis points to it; depth grows away from it.
  const Eigen::Matrix3f scaled = Eigen::Vector3f(1, 1, -1).cwiseQuotient(reach).asDiagonal() * turn;
  matrix.topLeftCorner<3, 3>() = scaled;
  matrix.topRightCorner<3, 1>() = -scaled * box.center();
  return matrix;
}

}  // namespace

StudioLight studio_light(float room) {
  return {kKey, room * kSky, room * kFloor, kKeyRadius,
          1 / (kOpenLight * (kMinExposed + (1 - kMinExposed) * room))};
}

FigureLight::FigureLight(const GlFunctions& gl, int passes)
    : gl_(&gl),
      passes_(passes),
      depth_program_(gl, {.vertex = "depth.vert", .fragment = "depth.frag", .defines = ""}),
      key_map_(depth_map(gl, kKeySide * kKeyColumns, kKeySide * kPassKeys / kKeyColumns)),
      room_map_(
          depth_map(gl, kRoomSide * kRoomColumns, kRoomSide * (kPassSkies + kPassFloors) / kRoomColumns)),
      key_target_(depth_target(gl, key_map_)),
      room_target_(depth_target(gl, room_map_)) {
  check_gl(gl, "making a figure's shadow maps");
}

// Directions cover discs and hemispheres evenly, in an order of which every beginning is spread as well
// (Halton 1960).
FigureLight::Direction FigureLight::direction(int pass, int light) const {
  const auto angle = [](float turn) { return 2 * std::numbers::pi_v<float> * turn; };
  if (light < kPassKeys) {
    const int i = kPassKeys * pass + light, count = kPassKeys * passes_;
    const float radius = kKeyRadius * std::sqrt(u(i, 2) + 0.5f / static_cast<float>(count));
    const Eigen::Vector3f across = to_light_.unitOrthogonal(), along = to_light_.cross(across);
    const float a = angle(u(i, 3));
    return {(to_light_ + radius * (std::cos(a) * across + std::sin(a) * along)).normalized(),
            kKey / static_cast<float>(count)};
  }
  const bool is_sky = light < kPassKeys + kPassSkies;
  const int first = is_sky ? kPassKeys : kPassKeys + kPassSkies, a_pass = is_sky ? kPassSkies : kPassFloors;
  const int i = a_pass * pass + light - first, count = a_pass * passes_;
  const float z = u(i, 2) + 0.5f / static_cast<float>(count), across = std::sqrt(1 - z * z);
  const float a = angle(u(i, 3));
  const Eigen::Vector3f& light_there = is_sky ? kSky : kFloor;
  return {{across * std::cos(a), across * std::sin(a), is_sky ? z : -z},
          2 * room_ / static_cast<float>(count) * light_there};
}

void FigureLight::aim(const Box& casters, const Eigen::Vector3f& to_light, float room) {
  casters_ = casters;
  to_light_ = to_light.normalized();
  room_ = room;
  open_.setZero();
  for (int pass = 0; pass < passes_; ++pass)
    for (int k = 0; k < kPassKeys + kPassSkies; ++k) {
      const Direction from = direction(pass, k);
      open_ += std::max(from.to_light.z(), 0.0f) * from.weight;
    }
}

void FigureLight::draw(int pass, const std::function<void(const Program&)>& draw_casters) {
  depth_program_.use();
  gl_->Enable(GL_DEPTH_TEST);
  gl_->DepthMask(GL_TRUE);
  for (int k = 0; k < kPassLights; ++k) {
    const bool is_key = k < kPassKeys;
    const int tile = is_key ? k : k - kPassKeys, side = is_key ? kKeySide : kRoomSide;
    const int columns = is_key ? kKeyColumns : kRoomColumns;
    if (tile == 0) {
      gl_->BindFramebuffer(GL_FRAMEBUFFER, (is_key ? key_target_ : room_target_).name());
      gl_->Clear(GL_DEPTH_BUFFER_BIT);
    }
    directions_[k] = direction(pass, k);
    matrices_[k] = light_matrix(directions_[k].to_light, casters_, side, texels_[k]);
    gl_->Viewport(tile % columns * side, tile / columns * side, side, side);
    depth_program_.set("light", matrices_[k]);
    draw_casters(depth_program_);
  }
}

void FigureLight::bind(const Program& program) const {
  bind_texture(*gl_, kKeyUnit, key_map_);
  bind_texture(*gl_, kRoomUnit, room_map_);
  program.set("key_map", kKeyUnit);
  program.set("room_map", kRoomUnit);
  const auto passes = static_cast<float>(passes_);  // each pass draws the whole light of its directions
  program.set("open_ground", open_);
  program.set("exposure", studio_light(room_).exposure);
  for (int k = 0; k < kPassLights; ++k) {
    const std::string index = "[" + std::to_string(k) + "]";
    program.set(("light_matrix" + index).c_str(), matrices_[k]);
    program.set(("light_direction" + index).c_str(), directions_[k].to_light);
    program.set(("light_weight" + index).c_str(), Eigen::Vector3f(passes * directions_[k].weight));
    program.set(("light_texel" + index).c_str(), texels_[k]);
  }
}

}  // namespace hysteron::render
