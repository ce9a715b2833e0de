#include "render/shadow_maps.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <string>

#include "sim/base/rotation.h"

namespace hysteron::render {

GlTexture filtered_texture(const GlFunctions& gl, GLint stored, GLenum channels, int width, int height) {
  GlTexture texture(gl);
  gl.BindTexture(GL_TEXTURE_2D, texture.name());
  gl.TexImage2D(GL_TEXTURE_2D, 0, stored, width, height, 0, channels, GL_FLOAT, nullptr);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  return texture;
}

GlTexture depth_map(const GlFunctions& gl, int width, int height) {
  GlTexture texture = filtered_texture(gl, GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, width, height);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
  return texture;
}

GlFramebuffer depth_target(const GlFunctions& gl, const GlTexture& map) {
  GlFramebuffer target(gl);
  gl.BindFramebuffer(GL_FRAMEBUFFER, target.name());
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, map.name(), 0);
  gl.DrawBuffer(GL_NONE);
  gl.ReadBuffer(GL_NONE);
  return target;
}

namespace {

constexpr int kKeyUnit = 0;
constexpr int kSkyUnit = 1;
constexpr int kDepthUnit = 8;
constexpr int kKeySide = 1024;  // texels of the key map; 0.5 mm each for a 0.5 m scene
constexpr int kSkySide = 256;   // texels of one direction's tile
constexpr int kSkyColumns = 6;  // columns of tiles, as in sky.glsl
constexpr int kSkyRows = kSkyLights / kSkyColumns;
// Casters fill the map but for this border, which stays empty, so that a clamped lookup outside finds light.
constexpr float kBorder = 1.05f;

// Returns the transform from world to clip space of a parallel light that sees the sphere around the casters.
Eigen::Matrix4f light_matrix(const Eigen::Vector3f& to_light, const Eigen::Vector3f& center, float radius) {
  Eigen::Matrix4f matrix = Eigen::Matrix4f::Identity();
  const Eigen::Matrix3f turn = rotation_between(to_light.normalized(), Eigen::Vector3f::UnitZ());
  // The light's own z axis points to it; depth grows away from it.
  const Eigen::Matrix3f scaled = Eigen::Vector3f(1, 1, -1).asDiagonal() * turn / (kBorder * radius);
  matrix.topLeftCorner<3, 3>() = scaled;
  matrix.topRightCorner<3, 1>() = -scaled * center;
  return matrix;
}

// Returns directions for equal shares of the upper hemisphere, along a spiral of golden angles (Vogel 1979;
// Swinbank & Purser 2006).
std::array<Eigen::Vector3f, kSkyLights> sky_directions() {
  std::array<Eigen::Vector3f, kSkyLights> directions;
  for (int k = 0; k < kSkyLights; ++k) {
    const float z = (static_cast<float>(k) + 0.5f) / kSkyLights, across = std::sqrt(1 - z * z);
    const float angle = static_cast<float>(k) * std::numbers::pi_v<float> * (3 - std::sqrt(5.0f));
    directions[k] = {across * std::cos(angle), across * std::sin(angle), z};
  }
  return directions;
}

}  // namespace

ShadowMaps::ShadowMaps(const GlFunctions& gl)
    : gl_(&gl),
      depth_program_(gl, {.vertex = "depth.vert", .fragment = "depth.frag", .defines = ""}),
      key_map_(depth_map(gl, kKeySide, kKeySide)),
      sky_map_(depth_map(gl, kSkySide * kSkyColumns, kSkySide * kSkyRows)),
      depth_sampler_(gl),
      key_target_(depth_target(gl, key_map_)),
      sky_target_(depth_target(gl, sky_map_)),
      sky_directions_(sky_directions()) {
  gl.SamplerParameteri(depth_sampler_.name(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl.SamplerParameteri(depth_sampler_.name(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  gl.SamplerParameteri(depth_sampler_.name(), GL_TEXTURE_COMPARE_MODE, GL_NONE);
  gl.SamplerParameteri(depth_sampler_.name(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl.SamplerParameteri(depth_sampler_.name(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  aim({{-1, -1, -1}, {1, 1, 1}}, to_light_, room_);
  check_gl(gl, "making shadow maps");
}

void ShadowMaps::aim(const Box& casters, const Eigen::Vector3f& to_light, float room) {
  room_ = room;
  to_light_ = to_light.normalized();
  radius_ = std::max(casters.radius(), 1e-6f);
  key_matrix_ = light_matrix(to_light_, casters.center(), radius_);
  for (int k = 0; k < kSkyLights; ++k)
    sky_matrices_[k] = light_matrix(sky_directions_[k], casters.center(), radius_);
}

void ShadowMaps::draw(const std::function<void(const Program&)>& draw_casters) const {
  depth_program_.use();
  gl_->Enable(GL_DEPTH_TEST);
  gl_->DepthMask(GL_TRUE);
  gl_->Enable(GL_POLYGON_OFFSET_FILL);
  gl_->PolygonOffset(1.0f, 2.0f);

  gl_->BindFramebuffer(GL_FRAMEBUFFER, key_target_.name());
  gl_->Viewport(0, 0, kKeySide, kKeySide);
  gl_->Clear(GL_DEPTH_BUFFER_BIT);
  depth_program_.set("light", key_matrix_);
  draw_casters(depth_program_);

  gl_->BindFramebuffer(GL_FRAMEBUFFER, sky_target_.name());
  gl_->Clear(GL_DEPTH_BUFFER_BIT);
  for (int k = 0; k < kSkyLights; ++k) {
    gl_->Viewport(k % kSkyColumns * kSkySide, k / kSkyColumns * kSkySide, kSkySide, kSkySide);
    depth_program_.set("light", sky_matrices_[k]);
    draw_casters(depth_program_);
  }
  gl_->Disable(GL_POLYGON_OFFSET_FILL);
}

void ShadowMaps::bind(const Program& program, float sky_blur, float sky_lift) const {
  bind_texture(*gl_, kKeyUnit, key_map_);
  bind_texture(*gl_, kSkyUnit, sky_map_);
  program.set("key_map", kKeyUnit);
  program.set("sky_map", kSkyUnit);
  program.set("to_light", to_light_);
  program.set("room", room_);
  program.set("key_matrix", key_matrix_);
  program.set("key_texel", 2 * kBorder * radius_ / kKeySide);
  bind_texture(*gl_, kDepthUnit, key_map_);
  gl_->BindSampler(kDepthUnit, depth_sampler_.name());
  program.set("key_depth", kDepthUnit);
  program.set("sky_blur", sky_blur);
  program.set("sky_lift", sky_lift);
  program.set("sky_texel", 2 * kBorder * radius_ / kSkySide);
  for (int k = 0; k < kSkyLights; ++k) {
    const std::string index = "[" + std::to_string(k) + "]";
    program.set(("sky_matrix" + index).c_str(), sky_matrices_[k]);
    program.set(("sky_direction" + index).c_str(), sky_directions_[k]);
  }
}

}  // namespace hysteron::render
