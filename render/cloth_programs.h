// The programs that draw a sheet of cloth: its two sides and, where it has thickness, its rim.
#pragma once

#include <functional>
#include <optional>
#include <string_view>

#include "render/cloth_surface.h"
#include "render/gl/program.h"
#include "render/look.h"
#include "render/picture_parts.h"

namespace hysteron::render {

class ClothPrograms {
 public:
  // `fragment` is the shader that colours the sheet.
  ClothPrograms(const GlFunctions& gl, Show show, bool figure, std::string_view fragment);

  // Draws the sheet as thick as the look says; where it has no thickness, its middle.  `dress`, if any, sets
  // what the fragment shader takes, in the program in use.
  void draw(const ClothSurface& cloth, const PartView& view, float thickness,
            const std::function<void(const Program&)>& dress = {}) const;

 private:
  void begin(const Program& program, const PartView& view, float thickness,
             const std::function<void(const Program&)>& dress) const;

  const GlFunctions* gl_;
  Program sides_;
  std::optional<Program> rim_;
};

}  // namespace hysteron::render
