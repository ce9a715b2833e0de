#include "render/color_pass.h"

#include <cstdint>
#include <vector>

#include "render/color_map.h"
#include "render/srgb.h"

namespace hysteron::render {
namespace {

constexpr int kColorMapUnit = 2;
constexpr Rgb8 kPageWhite{255, 255, 255};

Eigen::Vector3f linear_color(const Rgb8& color) {
  const auto& table = linear_of_srgb8();
  return {table[color[0]], table[color[1]], table[color[2]]};
}

void upload_color_map(const GlFunctions& gl, const GlTexture& texture, ColorMap map) {
  std::vector<std::uint8_t> pixels;
  for (int i = 0; i < 256; ++i) {
    const Rgb8 color = map_color8(map, static_cast<float>(i) / 255);
    pixels.insert(pixels.end(), {color[0], color[1], color[2], 255});
  }
  bind_texture(gl, kColorMapUnit, texture);
  gl.TexImage2D(GL_TEXTURE_2D, 0, GL_SRGB8_ALPHA8, 256, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
}

void bind_lit(const Program& program, const PartView& view, const ColorPass::Lit& lit) {
  lit.light.bind(program);
  if (lit.pixels) lit.pixels->bind(program, view.first);
}

}  // namespace

ColorPass::ColorPass(const GlFunctions& gl, bool figure)
    : gl_(&gl),
      is_figure_(figure),
      backdrop_program_(gl, {.vertex = "backdrop.vert", .fragment = "backdrop.frag", .defines = ""}),
      matte_program_(gl, {.vertex = "surface.vert",
                          .fragment = figure ? "figure_matte.frag" : "matte.frag",
                          .defines = figure ? "#define FIGURE\n" : ""}),
      color_map_(gl),
      no_arrays_(gl) {}

void ColorPass::set_look(const Look& look) {
  upload_color_map(*gl_, color_map_, look.map);
  if (look.show == Show::silhouette || (cloth_programs_ && look.show == show_)) return;
  cloth_programs_.emplace(*gl_, look.show, is_figure_, is_figure_ ? "figure_cloth.frag" : "cloth.frag");
  show_ = look.show;
}

void ColorPass::draw_cloth(const ViewScene& scene, const PartView& view, const Lit& lit) const {
  cloth_programs_->draw(scene.cloth->surface(), view, scene.look.thickness,
                        [&](const Program& program) { dress(program, scene.look, view, lit); });
}

void ColorPass::dress(const Program& program, const Look& look, const PartView& view, const Lit& lit) const {
  bind_lit(program, view, lit);
  program.set("front_albedo", linear_color(look.front));
  program.set("back_albedo", linear_color(look.back));
  program.set("sheen", look.sheen);
  const float weft_spacing = look.weft_spacing > 0 ? look.weft_spacing : look.thread_spacing;
  program.set("thread_spacing", Eigen::Vector2f(weft_spacing, look.thread_spacing));
  program.set("weave_kind", static_cast<int>(look.weave_kind));
  program.set("shown", look.shown);
  program.set("grid", look.grid);
  program.set("weave_strength", look.weave);
  program.set("value_range", Eigen::Vector2f(look.value_low, look.value_high));
  program.set("color_map", kColorMapUnit);
  bind_texture(*gl_, kColorMapUnit, color_map_);
}

void ColorPass::draw_obstacles(const ViewScene& scene, const PartView& view, const Lit& lit) const {
  matte_program_.use();
  view.bind(matte_program_);
  matte_program_.set("side", 0.0f);
  matte_program_.set("sheet_half", 0.0f);
  matte_program_.set("least_half", 0.0f);
  bind_lit(matte_program_, view, lit);
  matte_program_.set("albedo", linear_color(scene.look.obstacle));
  scene.obstacles.draw(matte_program_, scene.fit());
}

void ColorPass::draw_ground(const ViewScene& scene, const PartView& view, const Eigen::Vector2i& picture,
                            const Lit& lit) const {
  if (!scene.ground_height) return;
  const Program& program = scene.ground->begin();
  program.set("view_projection", view.view_projection);
  if (is_figure_) lit.light.bind(program);  // another ground has its light in a texture
  set_backdrop(program, scene.look, view, picture);
  scene.ground->draw();
}

bool ColorPass::has_backdrop(const Look& look) const {
  return look.background == Background::studio && !is_figure_ &&
         (look.backdrop_top != kPageWhite || look.backdrop_bottom != kPageWhite);
}

void ColorPass::set_backdrop(const Program& program, const Look& look, const PartView& view,
                             const Eigen::Vector2i& picture) const {
  program.set("backdrop_top", linear_color(has_backdrop(look) ? look.backdrop_top : kPageWhite));
  program.set("backdrop_bottom", linear_color(has_backdrop(look) ? look.backdrop_bottom : kPageWhite));
  program.set("picture_size", Eigen::Vector2f(picture.cast<float>()));
  program.set("origin", view.origin);
}

void ColorPass::draw_backdrop(const ViewScene& scene, const PartView& view,
                              const Eigen::Vector2i& picture) const {
  if (!has_backdrop(scene.look)) return;
  backdrop_program_.use();
  set_backdrop(backdrop_program_, scene.look, view, picture);
  gl_->BindVertexArray(no_arrays_.name());
  gl_->DrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace hysteron::render
