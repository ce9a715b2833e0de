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
  // Of every edge, a pixel.  They are drawn four at a time, which every driver puts at the same places; the
  // picture is drawn again, shifted by a fraction of a pixel, until there are as many.
  int samples = 8;
  int supersample = 1;  // 2: drawn twice as large and averaged, where pictures of two drivers are compared
  // Largest side drawn at once [pixels]; larger pictures are drawn in parts, which bounds the driver's
  // memory.
  int tile = 2048;
  // Of a figure: that many passes, each lit from 12 directions of its own (figure_light.h) in place of the
  // few that a sequence has time for; 0: no figure.
  int figure_passes = 0;
};

// Of the plane that lies nearest to the points, given as x, y, z each.
Eigen::Vector3f plane_normal(std::span<const float> xyz);

// Direction to a look's key light, of any length: the look's own, else from the left of the picture, raking
// along the cloth whose plane has that normal (none: that of the picture).
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
  // Pictures to come have that size; neither they nor those before are figures.
  void resize(const PictureSize& size);
  // Replaces the cloth; positions are zero until set.
  void set_cloth(const ClothTopology& topology);
  // x, y, z each [m].
  void set_positions(std::span<const float> xyz);
  // Side of the cloth's triangles by the first positions that were given, which says how much smaller
  // obstacles are drawn in all pictures [m]; none before.  A view that goes on where another one ended takes
  // it from there.
  std::optional<float> first_side() const;
  void set_first_side(float side);
  // One a vertex, for the looks that show a value.
  void set_values(std::span<const float> values);
  // Buffer object of the positions (x, y, z floats), for a writer on the same GPU; a new one with each
  // set_cloth().
  GLuint position_buffer() const;
  // Takes what was opened to write position_buffer(), null for nothing.  It is closed before that buffer
  // goes: by the next set_cloth(), or with the view.
  void share_positions(std::unique_ptr<GlPositions> positions);
  // Has it write the present positions.  False where nothing is shared, or no longer, because writing failed
  // (then `reason` says why): set_positions() is the way then.
  bool write_positions(std::string& reason);

  // Of a mesh whose triangles face outward; returns the obstacle's number.  `caster`: the same surface
  // in fewer triangles, for its shadows.
  int add_obstacle(const TriangleMesh& mesh, const Eigen::Matrix4f& placement,
                   const TriangleMesh* caster = nullptr);
  // Gives it another shape; where it is stays.
  void reshape_obstacle(int obstacle, const TriangleMesh& mesh, const TriangleMesh* caster = nullptr);
  void move_obstacle(int obstacle, const Eigen::Matrix4f& placement);
  void show_obstacle(int obstacle, bool visible);
  // Height of a ground that catches shadows [m]; none by default.
  void set_ground(std::optional<float> height);

  // Box of all that will cast a shadow in the whole sequence, so that shadows keep their sharpness; without
  // it the box of each picture's positions and of the obstacles' placements at that time is used (positions
  // written on the GPU are unknown here: then it is needed).
  void set_bounds(const Box& bounds);
  void set_look(const Look& look);

  // RGB; RGBA, colours not multiplied by alpha, if the look's background is transparent.
  Image draw(const Camera& camera);
  // Whether the last picture shows some of the cloth: neither beside the picture nor behind obstacles.
  bool shows_cloth() const { return cloth_seen_ > 0; }
  // Share of the cloth in the last picture that obstacles hide.
  double hidden_fraction() const;

 private:
  struct Obstacle {
    StaticMesh mesh, caster;  // what is seen, fine enough for the room's light, and what hides light
    Box box;                  // of the mesh, before it is placed
    BodyMeasure measure;
    bool closed;
    Eigen::Matrix4f placement;
    bool visible = true;
    int shapes = 1;  // that it has had
  };

  // What draws a sheet's two sides, and, where it has thickness, its rim.
  struct ClothPrograms {
    ClothPrograms(const GlFunctions& gl, ProgramFiles files, bool has_rim) : sides(gl, files) {
      files.geometry = "rim.geom";
      if (has_rim) rim.emplace(gl, files);
    }
    Program sides;
    std::optional<Program> rim;
  };

  // What one pass over one part of the picture sees.
  struct View {
    Eigen::Matrix4f view_projection;
    Eigen::Vector3f eye, forward;
    bool orthographic;
    Eigen::Vector2f origin;  // lower left corner of the part in the picture [drawn pixels]
    float pixel;             // metres across a drawn one, where clip space's w is 1
    bool first = true;       // of a picture's passes
  };

  Obstacle& obstacle(int number);
  Obstacle made_obstacle(const TriangleMesh& mesh, const Eigen::Matrix4f& placement,
                         const TriangleMesh* caster) const;
  // Places what the program in use draws: an obstacle, smaller by its inset, or the cloth as it is.
  void place_body(const Program& program, const Obstacle& obstacle) const;
  Eigen::Matrix4f standing(const Obstacle& obstacle, float inset) const;
  static void place_cloth(const Program& program);
  Box bounds() const;
  void prepare(const Camera& camera);
  std::vector<float> what_lights(const Camera& camera) const;
  void update_body_sky() const;  // light of the room on the obstacles
  Image draw_part(const Camera& camera, int left, int top);
  View camera_view(const Camera& camera, int left, int top, const Shift& shift) const;
  void draw_casters(const Program& program) const;
  void draw_bodies(const Program& program, StaticMesh Obstacle::*mesh) const;
  // `counts`: samples of the cloth, too.
  void draw_scene(const View& view, bool counts) const;
  void count_cloth(const View& view, const GlQuery& samples) const;
  std::uint64_t counted(const GlQuery& samples) const;
  bool is_transparent() const;
  bool has_backdrop() const;  // that is not as white as the page
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
  int part_width_, part_height_;  // of the picture drawn at once [pixels]
  FrameTarget target_;
  ShadowMaps shadows_;
  std::optional<FigureLight> figure_light_;
  std::optional<LitPixels> lit_pixels_;  // but of a figure, whose pixels have one sample
  Program backdrop_program_, matte_program_, body_sky_program_;
  std::optional<ClothPrograms> cloth_programs_, count_programs_;
  GlTexture color_map_;
  GlVertexArray no_arrays_;
  GlQuery alone_samples_, seen_samples_;            // of the cloth, before and after obstacles are drawn
  std::uint64_t cloth_alone_ = 0, cloth_seen_ = 0;  // in the last picture
  std::optional<Ground> ground_;
  std::optional<ClothSurface> cloth_;
  std::unique_ptr<GlPositions> shared_positions_;  // of cloth_: below it, so that it is closed first
  std::vector<Obstacle> obstacles_;
  std::vector<float> positions_;  // of the cloth, where they were given
  std::vector<float> lighting_;   // what_lights() the textures as they are; empty: unknown
  std::vector<int> triangles_;    // of the cloth, until positions tell its sides
  float cloth_side_ = 0;          // long_side() of the cloth [m]
  std::optional<float> ground_height_;
  std::optional<Box> given_bounds_, position_bounds_;
  std::optional<Eigen::Vector3f> cloth_normal_;  // of its own plane, of a figure whose positions are known
  Look look_;
};

// Area of what is black in a silhouette seen from above [m^2]; partly covered pixels count by their share of
// light.
double covered_area(const Image& silhouette, double metres_per_pixel);

}  // namespace hysteron::render
