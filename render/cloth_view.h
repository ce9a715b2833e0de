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
#include "render/cloth_surface.h"
#include "render/exposure.h"
#include "render/figure_light.h"
#include "render/frame_target.h"
#include "render/ground.h"
#include "render/image.h"
#include "render/inset.h"
#include "render/lit_pixels.h"
#include "render/look.h"
#include "render/offscreen.h"
#include "render/shadow_maps.h"
#include "render/static_mesh.h"
#include "sim/device/gl_positions.h"

namespace hysteron::render {

struct PictureSize {
  int width = 1280, height = 720;
  // Samples per pixel.  Four are drawn at a time, which every driver puts at the same places; the picture is
  // drawn again, shifted by a fraction of a pixel, until there are as many.
  int samples = 8;
  int supersample = 1;  // factor by which pictures are drawn larger and averaged; 2 to compare drivers
  // Largest side drawn at once [pixels]; larger pictures are drawn in parts, which bounds the driver's
  // memory.
  int tile = 2048;
  // Passes of a figure, each lit from 12 directions of its own (figure_light.h) in place of the few that a
  // sequence has time for; 0: no figure.
  int figure_passes = 0;
};

// Returns the unit normal of the plane that lies nearest to the points, given as x, y, z each.
Eigen::Vector3f plane_normal(std::span<const float> xyz);

// Returns the direction to a look's key light, of any length: the look's own, else from the left of the
// picture. A raking light grazes the cloth, whose plane has the given normal (none: the picture's plane).
Eigen::Vector3f key_direction(const Look& look, const Camera& camera,
                              const std::optional<Eigen::Vector3f>& cloth_normal);

class ClothView {
 public:
  // `offscreen` must outlive the view.  Error::invalid_input for a side below 1 or above 65536 pixels.
  ClothView(Offscreen& offscreen, const PictureSize& size);
  ~ClothView();
  ClothView(const ClothView&) = delete;
  ClothView& operator=(const ClothView&) = delete;

  bool is_figure() const { return figure_light_.has_value(); }
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
  void set_bounds(const Box& bounds);
  void set_look(const Look& look);

  // Returns RGB, or RGBA with colours not multiplied by alpha if the look's background is transparent.
  Image draw(const Camera& camera);
  // Returns true if the last picture shows some of the cloth, inside its border and not behind obstacles.
  bool shows_cloth() const { return cloth_seen_ > 0; }
  // Returns the share of the cloth in the last picture that obstacles hide.
  double hidden_fraction() const;

 private:
  struct Obstacle {
    StaticMesh mesh, caster;  // `mesh` is drawn, fine enough for the room's light; `caster` casts shadows
    Box box;                  // bounds of the mesh before its placement [m]
    BodyMeasure measure;
    bool closed;
    Eigen::Matrix4f placement;
    bool visible = true;
    int shapes = 1;  // number of shapes so far
  };

  // The programs that draw a sheet's two sides and, where it has thickness, its rim.
  struct ClothPrograms {
    ClothPrograms(const GlFunctions& gl, ProgramFiles files, bool has_rim) : sides(gl, files) {
      files.geometry = "rim.geom";
      if (has_rim) rim.emplace(gl, files);
    }
    Program sides;
    std::optional<Program> rim;
  };

  // The view of one pass over one part of the picture.
  struct View {
    Eigen::Matrix4f view_projection;
    Eigen::Vector3f eye, forward;
    bool orthographic;
    Eigen::Vector2f origin;  // lower left corner of the part in the picture [drawn pixels]
    float pixel;             // width of a drawn pixel where clip space's w is 1 [m]
    bool first = true;       // true in the first of a picture's passes
  };

  Obstacle& obstacle(int number);
  Obstacle made_obstacle(const TriangleMesh& mesh, const Eigen::Matrix4f& placement,
                         const TriangleMesh* caster) const;
  // Sets the placement of a body in the program in use: an obstacle is smaller by its inset, the cloth as it
  // is.
  void place_body(const Program& program, const Obstacle& obstacle) const;
  Eigen::Matrix4f standing(const Obstacle& obstacle, float inset) const;
  static void place_cloth(const Program& program);
  Box bounds() const;
  void prepare(const Camera& camera);
  std::vector<float> what_lights(const Camera& camera) const;
  void update_body_sky() const;  // computes the light of the room on the obstacles
  Image draw_part(const Camera& camera, int left, int top);
  View camera_view(const Camera& camera, int left, int top, const Shift& shift) const;
  void draw_casters(const Program& program) const;
  void draw_bodies(const Program& program, StaticMesh Obstacle::*mesh) const;
  // Draws the whole scene; with `counts` the samples of the cloth are counted.
  void draw_scene(const View& view, bool counts) const;
  void count_cloth(const View& view, const GlQuery& samples) const;
  std::uint64_t counted(const GlQuery& samples) const;
  bool is_transparent() const;
  bool has_backdrop() const;  // true if the backdrop is not as white as the page
  void draw_backdrop(const View& view) const;
  void draw_ground(const View& view) const;
  void draw_obstacles(const View& view) const;
  void draw_cloth(const View& view, const ClothPrograms& programs) const;
  void begin_cloth(const Program& program, const View& view) const;
  void begin_lit(const Program& program, const View& view) const;
  void set_backdrop(const Program& program, const View& view) const;

  Offscreen& offscreen_;
  const GlFunctions& gl_;
  PictureSize size_;
  int part_width_, part_height_;  // size of the part drawn at once [pixels]
  FrameTarget target_;
  ShadowMaps shadows_;
  std::optional<FigureLight> figure_light_;
  std::optional<LitPixels> lit_pixels_;  // none for a figure, whose pixels have one sample
  Program backdrop_program_, matte_program_, body_sky_program_;
  std::optional<ClothPrograms> cloth_programs_, count_programs_;
  GlTexture color_map_;
  GlVertexArray no_arrays_;
  GlQuery alone_samples_, seen_samples_;  // samples of the cloth before and after obstacles are drawn
  std::uint64_t cloth_alone_ = 0, cloth_seen_ = 0;  // numbers of samples in the last picture
  std::optional<Ground> ground_;
  std::optional<ClothSurface> cloth_;
  std::unique_ptr<GlPositions> shared_positions_;  // writer into cloth_, declared below it to be closed first
  std::vector<Obstacle> obstacles_;
  std::vector<float> positions_;  // positions of the cloth; empty unless they were given
  std::vector<float> lighting_;   // what_lights() of the present shadows and sky light; empty: outdated
  std::vector<int> triangles_;    // triangles of the cloth, kept until positions tell its sides
  float cloth_side_ = 0;          // long_side() of the cloth [m]
  std::optional<float> ground_height_;
  std::optional<Box> given_bounds_, position_bounds_;
  std::optional<Eigen::Vector3f> cloth_normal_;  // the cloth plane's, if a figure's positions are known
  Look look_;
};

// Returns the area of the black part of a silhouette seen from above [m^2]; partly covered pixels count by
// their share of light.
double covered_area(const Image& silhouette, double metres_per_pixel);

}  // namespace hysteron::render
