#include "render/ground.h"

#include <Eigen/LU>
#include <algorithm>

namespace hysteron::render {
namespace {

constexpr int kSide = 448;      // texels of the light texture
constexpr float kReach = 2.6f;  // half side of the patch in radii of the scene
constexpr int kLightUnit = 7;
constexpr float kSkyBlur = 7.0f;  // texels of the sky maps

// Square grid from -1 to 1 in the plane z = 0, finer toward the middle, where shadows lie.
TriangleMesh ground_grid() {
  constexpr int kVertices = 49;
  const auto place = [](std::uint32_t i) {
    const float t = 2.0f * static_cast<float>(i) / (kVertices - 1) - 1;
    return 0.6f * t + 0.4f * t * t * t;
  };
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < kVertices; ++i)
    for (std::uint32_t j = 0; j < kVertices; ++j) mesh.positions.emplace_back(place(i), place(j), 0.0f);
  mesh.normals.assign(mesh.positions.size(), Eigen::Vector3f::UnitZ());
  for (std::uint32_t i = 0; i + 1 < kVertices; ++i)
    for (std::uint32_t j = 0; j + 1 < kVertices; ++j) {
      const std::uint32_t a = i * kVertices + j, b = a + kVertices;
      mesh.triangles.insert(mesh.triangles.end(), {a, b, b + 1, a, b + 1, a + 1});
    }
  return mesh;
}

GlTexture light_texture(const GlFunctions& gl) {
  GlTexture texture(gl);
  gl.BindTexture(GL_TEXTURE_2D, texture.name());
  gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, kSide, kSide, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  return texture;
}

}  // namespace

Ground::Ground(const GlFunctions& gl)
    : gl_(&gl),
      light_program_(
          gl, {.vertex = "surface.vert", .fragment = "ground_light.frag", .defines = "#define GROUND\n"}),
      program_(gl, {.vertex = "ground.vert", .fragment = "ground.frag", .defines = ""}),
      mesh_(gl, ground_grid()),
      light_(light_texture(gl)),
      target_(gl) {
  gl.BindFramebuffer(GL_FRAMEBUFFER, target_.name());
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, light_.name(), 0);
  check_gl(gl, "making the ground");
}

void Ground::update(const ShadowMaps& shadows, const Box& box, float height) {
  const float reach = kReach * box.radius();
  const Eigen::Vector3f center = box.center(), to_light = shadows.to_light();
  // Between the scene and its shadow.
  const float shift = 0.5f * (center.z() - height) / std::max(to_light.z(), 0.3f);
  placement_ = Eigen::Matrix4f::Identity();
  placement_.diagonal() << reach, reach, 1, 1;
  placement_.topRightCorner<3, 1>() << center.x() - shift * to_light.x(), center.y() - shift * to_light.y(),
      height;
  Eigen::Matrix4f from_above = placement_.inverse();
  from_above.row(2).setZero();

  gl_->BindFramebuffer(GL_FRAMEBUFFER, target_.name());
  gl_->Viewport(0, 0, kSide, kSide);
  gl_->Disable(GL_DEPTH_TEST);
  light_program_.use();
  light_program_.set("model", placement_);
  light_program_.set("view_projection", from_above);
  light_program_.set("inset", 0.0f);
  shadows.bind(light_program_, kSkyBlur);
  mesh_.draw();
  gl_->Enable(GL_DEPTH_TEST);
}

const Program& Ground::begin() const {
  program_.use();
  program_.set("model", placement_);
  program_.set("ground_light", kLightUnit);
  gl_->ActiveTexture(GL_TEXTURE0 + kLightUnit);
  gl_->BindTexture(GL_TEXTURE_2D, light_.name());
  return program_;
}

void Ground::draw() const { mesh_.draw(); }

}  // namespace hysteron::render
