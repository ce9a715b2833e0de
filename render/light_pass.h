// The pass that finds the light on a scene before its pixels are drawn.  A sequence has maps of shadows, and
// the light of the room at every vertex; a figure has the maps of a few directions in each of its passes.
#pragma once

#include <optional>
#include <vector>

#include "render/camera.h"
#include "render/figure_light.h"
#include "render/gl/program.h"
#include "render/shadow_maps.h"
#include "render/view_scene.h"

namespace hysteron::render {

class LightPass {
 public:
  // `figure_passes` is the number of a figure's passes; 0: no figure.
  LightPass(const GlFunctions& gl, int figure_passes);

  bool is_figure() const { return figure_light_.has_value(); }
  // Says that the light has changed in ways that a scene does not tell: with the cloth's positions.
  void outdate() { known_.clear(); }
  // Updates what all passes and parts of a picture share, if it is outdated.
  void update(ViewScene& scene, const Camera& camera);
  // Draws the maps of a figure's pass; a sequence's are the same in all passes.
  void begin_pass(int pass, const ViewScene& scene);
  // Gives the program in use the light.
  void bind(const Program& program) const;

 private:
  ShadowMaps shadows_;
  std::optional<FigureLight> figure_light_;
  std::vector<float> known_;  // all that the present light depends on but positions; empty: outdated
};

}  // namespace hysteron::render
