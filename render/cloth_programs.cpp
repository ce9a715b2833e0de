#include "render/cloth_programs.h"

#include "render/drawn_cloth.h"

namespace hysteron::render {
namespace {

constexpr float kMinThickness = 1.2f;  // least thickness of cloth as it is drawn [pixels]

std::string_view cloth_defines(Show show, bool figure) {
  switch (show) {
    case Show::curvature:
    case Show::friction:
      return figure ? "#define FIELD\n#define FIGURE\n" : "#define FIELD\n";
    case Show::wireframe:
      return figure ? "#define WIREFRAME\n#define FIGURE\n" : "#define WIREFRAME\n";
    default:
      return figure ? "#define FIGURE\n" : "";
  }
}

}  // namespace

ClothPrograms::ClothPrograms(const GlFunctions& gl, Show show, bool figure, std::string_view fragment)
    : gl_(&gl),
      sides_(gl, {.vertex = "surface.vert", .fragment = fragment, .defines = cloth_defines(show, figure)}) {
  if (has_thickness(show))
    rim_.emplace(gl, ProgramFiles{.vertex = "surface.vert",
                                  .fragment = fragment,
                                  .defines = cloth_defines(show, figure),
                                  .geometry = "rim.geom"});
}

void ClothPrograms::begin(const Program& program, const PartView& view, float thickness,
                          const std::function<void(const Program&)>& dress) const {
  program.use();
  view.bind(program);
  place_cloth(program);
  program.set("side", 0.0f);
  program.set("sheet_half", 0.5f * thickness);
  program.set("least_half", 0.5f * kMinThickness * view.pixel);
  program.set("position", kPositionUnit);
  program.set("corner_index", kIndexUnit);
  if (dress) dress(program);
}

void ClothPrograms::draw(const ClothSurface& cloth, const PartView& view, float thickness,
                         const std::function<void(const Program&)>& dress) const {
  begin(sides_, view, thickness, dress);
  if (!rim_) return cloth.draw();
  gl_->Enable(GL_CULL_FACE);
  for (const float side : {1.0f, -1.0f}) {
    sides_.set("side", side);
    gl_->CullFace(side > 0 ? GL_BACK : GL_FRONT);
    cloth.draw();
  }
  gl_->Disable(GL_CULL_FACE);
  begin(*rim_, view, thickness, dress);
  cloth.draw_boundary();
}

}  // namespace hysteron::render
