// Pictures of a cloth, its obstacles and their shadows.
//
// The view keeps everything on the GPU and changes nothing it is given.  Equal calls give equal pictures on
// one driver; drivers differ by the last bits of their arithmetic, mostly along edges.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "render/camera.h"
#include "render/color_pass.h"
#include "render/frame_target.h"
#include "render/image.h"
#include "render/light_pass.h"
#include "render/lit_pixels.h"
#include "render/look.h"
#include "render/offscreen.h"
#include "render/picture_parts.h"
#include "render/silhouette_pass.h"
#include "render/view_scene.h"
#include "sim/device/gl_positions.h"

namespace hysteron::render {

class ClothView {
 public:
  // `offscreen` must outlive the view.  Error::invalid_input for a side below 1 or above 65536 pixels.
  ClothView(Offscreen& offscreen, const PictureSize& size);
  ~ClothView();
  ClothView(const ClothView&) = delete;
  ClothView& operator=(const ClothView&) = delete;

  bool is_figure() const { return scene_.is_figure; }
  // Sets the size of pictures to come.  Error::invalid_input if the view is a figure or would become one.
  void resize(const PictureSize& size);
  // Replaces the cloth; positions are zero until set.
  void set_cloth(const ClothTopology& topology);
  // Takes x, y, z of each vertex [m].
  void set_positions(std::span<const float> xyz);
  // The side of the cloth's triangles at the first positions given [m], none before; it sets how much smaller
  // obstacles are drawn in all pictures.  A view that continues another one takes it from there.
  std::optional<float> first_side() const;
  void set_first_side(float side);
  // Takes one value per vertex, for the looks that show a value.
  void set_values(std::span<const float> values);
  // The buffer object of the positions (x, y, z floats) for a writer on the same GPU; each set_cloth() makes
  // a new one.
  GLuint position_buffer() const;
  // Takes the writer of position_buffer(), or null for none.  It is closed before that buffer is deleted: by
  // the next set_cloth(), or with the view.
  void share_positions(std::unique_ptr<GlPositions> positions);
  // Makes the shared writer write the present positions.  Returns false if there is none, or if writing
  // failed, which ends sharing and sets `reason`: call set_positions() then.
  bool write_positions(std::string& reason);

  // Adds a mesh whose triangles face outward and returns the obstacle's number.  `caster` is the same surface
  // in fewer triangles, for its shadows.
  int add_obstacle(const TriangleMesh& mesh, const Eigen::Matrix4f& placement,
                   const TriangleMesh* caster = nullptr);
  // Replaces an obstacle's shape and keeps its placement.
  void reshape_obstacle(int obstacle, const TriangleMesh& mesh, const TriangleMesh* caster = nullptr);
  void move_obstacle(int obstacle, const Eigen::Matrix4f& placement);
  void show_obstacle(int obstacle, bool visible);
  // Sets the height of a ground that catches shadows [m]; by default there is none.
  void set_ground(std::optional<float> height);

  // Sets the box of all that casts a shadow in the whole sequence, so that shadows keep their sharpness.
  // Without it each picture uses the box of its positions and placed obstacles; positions written on the GPU
  // are unknown here and need set_bounds().
  void set_bounds(const Box& bounds) { scene_.given_bounds = bounds; }
  void set_look(const Look& look);

  // Returns RGB, or RGBA with colours not multiplied by alpha if the look's background is transparent.
  Image draw(const Camera& camera);
  // Returns true if the last picture shows some of the cloth, inside its border and not behind obstacles.
  bool shows_cloth() const { return silhouette_.shows_cloth(); }
  // Returns the share of the cloth in the last picture that obstacles hide.
  double hidden_fraction() const { return silhouette_.hidden_fraction(); }

 private:
  DrawnCloth& cloth(const char* given);  // Error::invalid_input if there is none yet
  FrameTarget new_target() const;
  // Updates all that the picture's parts share: normals, shadows and light.
  void prepare(const Camera& camera);
  // Draws the part of the picture whose upper left pixel is at (left, top).
  Image draw_part(const Camera& camera, int left, int top);
  // Draws one pass and returns its pixels: RGBA rows from the bottom, linear light.
  std::vector<float>& draw_pass(const PartView& view, bool counts);

  Offscreen& offscreen_;
  const GlFunctions& gl_;
  PictureParts parts_;
  FrameTarget target_;
  ViewScene scene_;
  LightPass light_;
  SilhouettePass silhouette_;
  ColorPass colors_;
  std::optional<LitPixels> lit_pixels_;  // none for a figure, whose pixels have one sample
};

}  // namespace hysteron::render
