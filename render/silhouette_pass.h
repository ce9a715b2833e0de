// The passes that draw the cloth as a shape alone, without light or colours: for a drape meter's shadow, for
// the depth that hides other surfaces, and to count how much of the cloth a picture shows.
#pragma once

#include <cstdint>
#include <optional>

#include "render/cloth_programs.h"
#include "render/gl/handles.h"
#include "render/image.h"
#include "render/picture_parts.h"
#include "render/view_scene.h"

namespace hysteron::render {

class SilhouettePass {
 public:
  explicit SilhouettePass(const GlFunctions& gl);

  // Takes the look of pictures to come: the shape has the thickness of the coloured cloth.
  void set_look(const Look& look, bool figure);
  // Draws the scene's cloth black into the framebuffer that is bound.
  void draw(const ViewScene& scene, const PartView& view) const;

  // Counting: a picture's samples of the cloth are counted before and after obstacles are drawn, in each of
  // its parts.
  void begin_picture() { alone_ = seen_ = 0; }
  void count_alone(const ViewScene& scene, const PartView& view) const { count(scene, view, alone_samples_); }
  void count_seen(const ViewScene& scene, const PartView& view) const { count(scene, view, seen_samples_); }
  // Adds the counts of a part, whose drawing must be finished.
  void add_counts();
  bool shows_cloth() const { return seen_ > 0; }
  // Returns the share of the cloth that obstacles hide.
  double hidden_fraction() const;

 private:
  void count(const ViewScene& scene, const PartView& view, const GlQuery& samples) const;
  std::uint64_t counted(const GlQuery& samples) const;

  const GlFunctions* gl_;
  std::optional<ClothPrograms> programs_;
  Show show_ = Show::cloth;  // what programs_ take the shape of
  GlQuery alone_samples_, seen_samples_;
  std::uint64_t alone_ = 0, seen_ = 0;  // numbers of samples in the picture
};

// Returns the area of the black part of a silhouette seen from above [m^2]; partly covered pixels count by
// their share of light.
double covered_area(const Image& silhouette, double metres_per_pixel);

}  // namespace hysteron::render
