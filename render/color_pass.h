// The pass that gives pixels their colours: the cloth, obstacles, the ground and the backdrop.
#pragma once

#include <optional>

#include "render/cloth_programs.h"
#include "render/gl/handles.h"
#include "render/gl/program.h"
#include "render/light_pass.h"
#include "render/lit_pixels.h"
#include "render/picture_parts.h"
#include "render/view_scene.h"

namespace hysteron::render {

class ColorPass {
 public:
  ColorPass(const GlFunctions& gl, bool figure);

  // Takes the look of pictures to come.
  void set_look(const Look& look);

  // The light on surfaces, and the pixels that it is computed for.
  struct Lit {
    const LightPass& light;
    const LitPixels* pixels;  // null: all
  };
  // Draw with the target's framebuffer bound.
  void draw_cloth(const ViewScene& scene, const PartView& view, const Lit& lit) const;
  void draw_obstacles(const ViewScene& scene, const PartView& view, const Lit& lit) const;
  void draw_ground(const ViewScene& scene, const PartView& view, const Eigen::Vector2i& picture,
                   const Lit& lit) const;
  // Draws the backdrop unless it is as white as the page; `picture` is the whole picture's size [drawn
  // pixels].
  void draw_backdrop(const ViewScene& scene, const PartView& view, const Eigen::Vector2i& picture) const;

 private:
  bool has_backdrop(const Look& look) const;
  void set_backdrop(const Program& program, const Look& look, const PartView& view,
                    const Eigen::Vector2i& picture) const;
  void dress(const Program& program, const Look& look, const PartView& view, const Lit& lit) const;

  const GlFunctions* gl_;
  bool is_figure_;
  Program backdrop_program_, matte_program_;
  std::optional<ClothPrograms> cloth_programs_;
  Show show_ = Show::cloth;  // what cloth_programs_ show
  GlTexture color_map_;
  GlVertexArray no_arrays_;
};

}  // namespace hysteron::render
