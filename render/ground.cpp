#include "render/ground.h"

#include <algorithm>
#include <string>

#include "render/shadow_maps.h"

namespace hysteron::render {
namespace {

constexpr int kSkySide = 64;        // texels of the sky light's texture
constexpr int kSide = 224;          // texels of the light texture: its shadows are soft
constexpr float kFigureReach = 12;  // half side of a figure's patch in radii of the scene: shadows end within
constexpr float kReach = 2.6f;      // half side of the patch in radii of the scene
constexpr int kLightUnit = 7;
constexpr int kSkyTextureUnit = 9;
constexpr float kSkyBlur = 4.0f;  // radius of a lookup in the sky maps [texels]

TriangleMesh ground_square() {
  TriangleMesh mesh;
  mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  mesh.normals.assign(4, Eigen::Vector3f::UnitZ());
  mesh.triangles = {0, 1, 2, 0, 2, 3};
  return mesh;
}

GlTexture light_texture(const GlFunctions& gl, int side) {
  return filtered_texture(gl, GL_RGBA16F, GL_RGBA, side, side);
}

GlFramebuffer texture_target(const GlFunctions& gl, const GlTexture& texture) {
  GlFramebuffer target(gl);
  gl.BindFramebuffer(GL_FRAMEBUFFER, target.name());
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture.name(), 0);
  return target;
}

}  // namespace

Ground::Ground(const GlFunctions& gl, bool figure)
    : gl_(&gl),
      is_figure_(figure),
      sky_program_(gl,
                   {.vertex = "backdrop.vert", .fragment = "ground_sky.frag", .defines = "#define GROUND\n"}),
      light_program_(
          gl, {.vertex = "backdrop.vert", .fragment = "ground_light.frag", .defines = "#define GROUND\n"}),
      mesh_(gl, ground_square()),
      no_arrays_(gl),
      sky_(light_texture(gl, kSkySide)),
      light_(light_texture(gl, kSide)),
      sky_target_(texture_target(gl, sky_)),
      light_target_(texture_target(gl, light_)) {
  check_gl(gl, "making the ground");
}

void Ground::be_layer(bool layer) {
  if (program_ && layer == is_layer_) return;
  is_layer_ = layer;
  const std::string defines =
      std::string(is_figure_ ? "#define FIGURE\n" : "") + (layer ? "#define LAYER\n" : "");
  program_.emplace(*gl_, ProgramFiles{.vertex = "ground.vert",
                                      .fragment = is_figure_ ? "figure_ground.frag" : "ground.frag",
                                      .defines = defines});
}

void Ground::place(const Box& box, float height) {
  const float reach = kFigureReach * box.radius();
  placement_ = Eigen::Matrix4f::Identity();
  placement_.diagonal() << reach, reach, 1, 1;
  placement_.topRightCorner<3, 1>() << box.center().x(), box.center().y(), height;
}

void Ground::update(const ShadowMaps& shadows, const Box& box, float height) {
  const float reach = kReach * box.radius();
  const Eigen::Vector3f center = box.center(), to_light = shadows.to_light();
  // The patch's middle is between the scene and its shadow.
  const float shift = 0.5f * (center.z() - height) / std::max(to_light.z(), 0.3f);
  placement_ = Eigen::Matrix4f::Identity();
  placement_.diagonal() << reach, reach, 1, 1;
  placement_.topRightCorner<3, 1>() << center.x() - shift * to_light.x(), center.y() - shift * to_light.y(),
      height;
  gl_->Disable(GL_DEPTH_TEST);
  sky_program_.use();
  shadows.bind(sky_program_, kSkyBlur);
  fill(sky_program_, sky_target_, kSkySide);
  light_program_.use();
  shadows.bind(light_program_, kSkyBlur);
  light_program_.set("ground_sky", kSkyTextureUnit);
  bind_texture(*gl_, kSkyTextureUnit, sky_);
  fill(light_program_, light_target_, kSide);
  gl_->Enable(GL_DEPTH_TEST);
}

void Ground::fill(const Program& program, const GlFramebuffer& target, int side) const {
  gl_->BindFramebuffer(GL_FRAMEBUFFER, target.name());
  gl_->Viewport(0, 0, side, side);
  program.set("model", placement_);
  program.set("texture_size", Eigen::Vector2f(static_cast<float>(side), static_cast<float>(side)));
  gl_->BindVertexArray(no_arrays_.name());
  gl_->DrawArrays(GL_TRIANGLES, 0, 3);
}

const Program& Ground::begin() const {
  program_->use();
  program_->set("model", placement_);
  program_->set("ground_light", kLightUnit);
  bind_texture(*gl_, kLightUnit, light_);
  return *program_;
}

void Ground::draw() const { mesh_.draw(); }

}  // namespace hysteron::render
