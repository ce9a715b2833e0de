#include "render/cloth_view.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "render/shapes.h"
#include "render/srgb.h"
#include "sim/base/error.h"

namespace hysteron::render {
namespace {

// Samples per pixel drawn at once, in the standard pattern of D3D 11 and Vulkan.  Eight lie elsewhere on
// every driver, which shows along every edge when pictures are compared.
constexpr int kSamplesAtOnce = 4;
constexpr int kFigureSamples = 1;  // a figure has passes enough
constexpr int kColorMapUnit = 2;
constexpr Rgb8 kPageWhite{255, 255, 255};
constexpr float kMinThickness = 1.2f;  // least thickness of cloth as it is drawn [pixels]
// The direction of the key light beside the camera [degree].
constexpr float kKeyAzimuth = 100, kKeyElevation = 30;
constexpr float kRaking = 0.2f;    // elevation of a raking light above the cloth's plane [rad]
constexpr float kMinAlong = 0.2f;  // least part of a light's direction that lies in that plane
// Longest side of an obstacle's triangles over its diagonal: their corners carry the room's soft shadows.
constexpr float kSkySpacing = 1.0f / 12;
constexpr float kBodySkyBlur = 3.2f, kBodySkyLift = 2.4f;  // [texels]; neighbouring directions blend
constexpr int kLargestSide = 65536;  // largest side of a picture [pixels]; more is a mistake

Eigen::Vector3f linear(const Rgb8& color) {
  const auto& table = linear_of_srgb8();
  return {table[color[0]], table[color[1]], table[color[2]]};
}

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

ProgramFiles cloth_files(Show show, bool figure) {
  const char* const fragment = show == Show::silhouette ? "silhouette.frag"
                               : figure                 ? "figure_cloth.frag"
                                                        : "cloth.frag";
  return {.vertex = "surface.vert", .fragment = fragment, .defines = cloth_defines(show, figure)};
}

// Returns true if the cloth is drawn as thick as it is.  A drape meter's shadow and a mesh's lines are those
// of its middle.
bool has_thickness(Show show) { return show != Show::silhouette && show != Show::wireframe; }

// The middle of a sheet on the ground rests a thickness above it, its lower side half of that.
float pictured_ground(float height, const Look& look) {
  return has_thickness(look.show) ? height + 0.5f * look.thickness : height;
}

Box mesh_box(const TriangleMesh& mesh) {
  if (mesh.positions.empty()) throw Error::invalid_input("drawing an obstacle: it has no triangles");
  Box box{mesh.positions.front(), mesh.positions.front()};
  for (const Eigen::Vector3f& p : mesh.positions) box = box.merged({p, p});
  return box;
}

Box placed_box(const Box& box, const Eigen::Matrix4f& placement) {
  const Eigen::Vector3f half = 0.5f * (box.high - box.low);
  const Eigen::Vector3f center =
      placement.topLeftCorner<3, 3>() * box.center() + placement.topRightCorner<3, 1>();
  const Eigen::Vector3f reach = placement.topLeftCorner<3, 3>().cwiseAbs() * half;
  return {center - reach, center + reach};
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

// Returns the size with parts that the driver can hold.
PictureSize checked(Offscreen& offscreen, PictureSize size) {
  const int largest = std::min(size.width, size.height) < 1 ? 0 : std::max(size.width, size.height);
  if (largest < 1 || largest > kLargestSide || size.samples < 1 || size.supersample < 1 || size.tile < 2)
    throw Error::invalid_input("picture of " + std::to_string(size.width) + " x " +
                               std::to_string(size.height) + " pixels: 1 to " + std::to_string(kLargestSide) +
                               " a side are allowed");
  offscreen.make_current();
  GLint most = 0;
  offscreen.gl().GetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &most);
  size.tile = std::clamp(most / size.supersample, 2, size.tile);
  return size;
}

// Returns the side of the equal parts of a picture; even, so that drivers group the same pixels for
// derivatives.
int part_side(int side, int most) {
  if (side <= most) return side;
  const int parts = (side + most - 1) / most;
  return ((side + parts - 1) / parts + 1) / 2 * 2;
}

void place(Image& picture, const Image& part, int left, int top) {
  const int columns = std::min(part.width(), picture.width() - left), channels = picture.channels();
  for (int y = 0; y < std::min(part.height(), picture.height() - top); ++y)
    std::copy_n(part.at(0, y), columns * channels, picture.at(left, top + y));
}

}  // namespace

Eigen::Vector3f plane_normal(std::span<const float> xyz) {
  const auto count = static_cast<Eigen::Index>(xyz.size() / 3);
  const Eigen::Map<const Eigen::Matrix3Xf> points(xyz.data(), 3, count);
  const Eigen::Matrix3Xf from_middle = points.colwise() - points.rowwise().mean();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> axes(from_middle * from_middle.transpose());
  return axes.eigenvectors().col(0);
}

ClothView::ClothView(Offscreen& offscreen, const PictureSize& size)
    : offscreen_(offscreen),
      gl_(offscreen.gl()),
      size_(checked(offscreen, size)),
      part_width_(part_side(size.width, size_.tile)),
      part_height_(part_side(size.height, size_.tile)),
      target_(gl_, part_width_ * size.supersample, part_height_ * size.supersample,
              size.figure_passes > 0 ? kFigureSamples : std::min(size.samples, kSamplesAtOnce)),
      shadows_(gl_),
      figure_light_(size.figure_passes > 0
                        ? std::optional<FigureLight>(std::in_place, gl_, size.figure_passes)
                        : std::nullopt),
      lit_pixels_(size.figure_passes == 0
                      ? std::optional<LitPixels>(std::in_place, gl_, part_width_ * size.supersample,
                                                 part_height_ * size.supersample)
                      : std::nullopt),
      backdrop_program_(gl_, {.vertex = "backdrop.vert", .fragment = "backdrop.frag", .defines = ""}),
      matte_program_(gl_, {.vertex = "surface.vert",
                           .fragment = is_figure() ? "figure_matte.frag" : "matte.frag",
                           .defines = cloth_defines(Show::cloth, is_figure())}),
      body_sky_program_(gl_,
                        {.vertex = "sky.vert", .fragment = "", .defines = "", .captured = {"vertex_sky"}}),
      color_map_(gl_),
      no_arrays_(gl_),
      alone_samples_(gl_),
      seen_samples_(gl_) {
  set_look(look_);
}

void ClothView::resize(const PictureSize& size) {
  if (is_figure() || size.figure_passes > 0)
    throw Error::invalid_input("resizing a view: it and what it becomes must not be figures");
  size_ = checked(offscreen_, size);
  part_width_ = part_side(size.width, size_.tile);
  part_height_ = part_side(size.height, size_.tile);
  const int across = part_width_ * size_.supersample, up = part_height_ * size_.supersample;
  target_ = FrameTarget(gl_, across, up, std::min(size.samples, kSamplesAtOnce));
  lit_pixels_.emplace(gl_, across, up);
}

// The members' GL names must be deleted in their own context.
ClothView::~ClothView() { offscreen_.make_current(); }

void ClothView::set_cloth(const ClothTopology& topology) {
  offscreen_.make_current();
  shared_positions_.reset();
  positions_.clear();
  lighting_.clear();
  cloth_.emplace(gl_, topology);
  position_bounds_.reset();
  triangles_.assign(topology.triangles.begin(), topology.triangles.end());
  cloth_side_ = topology.pattern.empty() ? 0 : long_side(triangles_, topology.pattern, 2);
}

void ClothView::set_positions(std::span<const float> xyz) {
  if (!cloth_) throw Error::invalid_input("drawing a cloth: positions were given before its triangles");
  if (std::ranges::equal(xyz, positions_)) return;
  offscreen_.make_current();
  cloth_->set_positions(xyz);
  positions_.assign(xyz.begin(), xyz.end());
  lighting_.clear();
  if (!triangles_.empty()) cloth_side_ = long_side(std::exchange(triangles_, {}), xyz, 3);
  if (!given_bounds_ || is_figure()) position_bounds_ = bounding_box(xyz);
  if (is_figure()) cloth_normal_ = plane_normal(xyz);
}

std::optional<float> ClothView::first_side() const {
  if (!cloth_ || !triangles_.empty()) return {};
  return cloth_side_;
}

void ClothView::set_first_side(float side) {
  cloth_side_ = side;
  triangles_.clear();
  lighting_.clear();
}

void ClothView::set_values(std::span<const float> values) {
  if (!cloth_) throw Error::invalid_input("drawing a cloth: values were given before its triangles");
  offscreen_.make_current();
  cloth_->set_values(values);
}

GLuint ClothView::position_buffer() const { return cloth_ ? cloth_->position_buffer() : 0; }

void ClothView::share_positions(std::unique_ptr<GlPositions> positions) {
  offscreen_.make_current();
  shared_positions_ = std::move(positions);
}

bool ClothView::write_positions(std::string& reason) {
  if (!shared_positions_) return false;
  offscreen_.make_current();
  positions_.clear();
  lighting_.clear();
  position_bounds_.reset();
  cloth_normal_.reset();
  if (shared_positions_->write(reason)) return true;
  shared_positions_.reset();
  return false;
}

int ClothView::add_obstacle(const TriangleMesh& mesh, const Eigen::Matrix4f& placement,
                            const TriangleMesh* caster) {
  obstacles_.push_back(made_obstacle(mesh, placement, caster));
  return static_cast<int>(obstacles_.size()) - 1;
}

ClothView::Obstacle ClothView::made_obstacle(const TriangleMesh& mesh, const Eigen::Matrix4f& placement,
                                             const TriangleMesh* caster) const {
  offscreen_.make_current();
  const Box box = mesh_box(mesh);
  const TriangleMesh fine = refined(mesh, 2 * kSkySpacing * box.radius());
  return {StaticMesh(gl_, fine),
          StaticMesh(gl_, caster ? *caster : mesh),
          box,
          BodyMeasure(mesh),
          mesh.closed,
          placement};
}

void ClothView::reshape_obstacle(int number, const TriangleMesh& mesh, const TriangleMesh* caster) {
  Obstacle& old = obstacle(number);
  Obstacle reshaped = made_obstacle(mesh, old.placement, caster);
  reshaped.visible = old.visible;
  reshaped.shapes = old.shapes + 1;
  old = std::move(reshaped);
}

ClothView::Obstacle& ClothView::obstacle(int number) {
  if (number < 0 || number >= static_cast<int>(obstacles_.size()))
    throw Error::invalid_input("obstacle " + std::to_string(number) + " is not among the " +
                               std::to_string(obstacles_.size()) + " drawn");
  return obstacles_[number];
}

void ClothView::move_obstacle(int number, const Eigen::Matrix4f& placement) {
  obstacle(number).placement = placement;
}
void ClothView::show_obstacle(int number, bool visible) { obstacle(number).visible = visible; }

void ClothView::set_ground(std::optional<float> height) {
  offscreen_.make_current();
  ground_height_ = height;
  if (height && !ground_) ground_.emplace(gl_, is_figure());
}

void ClothView::set_bounds(const Box& bounds) { given_bounds_ = bounds; }

void ClothView::set_look(const Look& look) {
  offscreen_.make_current();
  if (!cloth_programs_ || look.show != look_.show) {
    ProgramFiles files = cloth_files(look.show, is_figure());
    const bool has_rim = has_thickness(look.show);
    cloth_programs_.emplace(gl_, files, has_rim);
    files.fragment = "silhouette.frag";
    count_programs_.emplace(gl_, files, has_rim);
  }
  look_ = look;
  upload_color_map(gl_, color_map_, look.map);
}

// A figure has the box of its own instant, if known: the tighter, the sharper its shadows.
Box ClothView::bounds() const {
  if (given_bounds_ && !(is_figure() && position_bounds_)) return *given_bounds_;
  std::optional<Box> box = position_bounds_;
  for (const Obstacle& obstacle : obstacles_) {
    if (!obstacle.visible) continue;
    const Box here = placed_box(obstacle.box, obstacle.placement);
    box = box ? box->merged(here) : here;
  }
  return box.value_or(Box{{-1, -1, -1}, {1, 1, 1}});
}

Image ClothView::draw(const Camera& camera) {
  prepare(camera);
  cloth_alone_ = cloth_seen_ = 0;
  Image image(size_.width, size_.height, is_transparent() ? 4 : 3);
  for (int top = 0; top < size_.height; top += part_height_)
    for (int left = 0; left < size_.width; left += part_width_)
      place(image, draw_part(camera, left, top), left, top);
  return image;
}

// Updates everything that the picture's parts share: normals, shadows and light.
void ClothView::prepare(const Camera& camera) {
  offscreen_.make_current();
  gl_.Enable(GL_DEPTH_TEST);
  gl_.DepthFunc(GL_LEQUAL);
  // Even passes that draw no pixels need a whole framebuffer, and another view may have taken it away.
  target_.bind();
  if (cloth_) cloth_->update_normals();
  if (look_.show == Show::silhouette) return;
  if (ground_height_) ground_->be_layer(is_transparent());
  if (is_figure()) {
    figure_light_->aim(bounds(), key_direction(look_, camera, cloth_normal_), look_.room);
    if (ground_height_) ground_->place(bounds(), pictured_ground(*ground_height_, look_));
    return;
  }
  const std::vector<float> lighting = what_lights(camera);
  if (lighting == lighting_) return;
  lighting_ = lighting;
  shadows_.aim(bounds(), key_direction(look_, camera, cloth_normal_), look_.room);
  shadows_.draw([this](const Program& program) { draw_casters(program); });
  if (cloth_) cloth_->update_sky(shadows_);
  update_body_sky();
  if (ground_height_) ground_->update(shadows_, bounds(), pictured_ground(*ground_height_, look_));
}

// Returns all that shadows and the room's light depend on, but for the cloth's positions.
std::vector<float> ClothView::what_lights(const Camera& camera) const {
  const Box box = bounds();
  const Eigen::Vector3f key = key_direction(look_, camera, cloth_normal_);
  std::vector<float> all = {look_.room, look_.obstacle_inset, ground_height_.has_value() ? 1.0f : 0.0f,
                            pictured_ground(ground_height_.value_or(0), look_)};
  for (const Eigen::Vector3f& v : {box.low, box.high, key}) all.insert(all.end(), v.begin(), v.end());
  for (const Obstacle& obstacle : obstacles_) {
    all.push_back(obstacle.visible ? static_cast<float>(obstacle.shapes) : 0);
    all.insert(all.end(), obstacle.placement.data(), obstacle.placement.data() + obstacle.placement.size());
  }
  return all;
}

Eigen::Vector3f key_direction(const Look& look, const Camera& camera,
                              const std::optional<Eigen::Vector3f>& cloth_normal) {
  if (look.to_light) return *look.to_light;
  if (!look.raking) return camera.beside(kKeyAzimuth, kKeyElevation);
  const Eigen::Vector3f side = camera.beside(kKeyAzimuth, 0), eye = -camera.forward();
  Eigen::Vector3f normal = cloth_normal.value_or(eye);
  if (normal.dot(eye) < 0) normal = -normal;
  Eigen::Vector3f along = side - side.dot(normal) * normal;
  if (along.norm() < kMinAlong) along = Eigen::Vector3f::UnitZ() - normal.z() * normal;
  Eigen::Vector3f light = std::cos(kRaking) * along.normalized() + std::sin(kRaking) * normal;
  light.z() = std::max(light.z(), std::sin(kRaking));  // a ground, or the room's floor, hides what is lower
  return light;
}

void ClothView::update_body_sky() const {
  body_sky_program_.use();
  shadows_.bind(body_sky_program_, kBodySkyBlur, kBodySkyLift);
  for (const Obstacle& obstacle : obstacles_) {
    if (!obstacle.visible) continue;
    place_body(body_sky_program_, obstacle);
    obstacle.mesh.update_sky();
  }
}

// Draws the part of the picture whose upper left pixel is at (left, top).
Image ClothView::draw_part(const Camera& camera, int left, int top) {
  Exposure exposure(part_width_, part_height_, size_.supersample);
  const bool lit = is_figure() && look_.show != Show::silhouette;
  const int passes =
      is_figure() ? figure_light_->passes() : (size_.samples + target_.samples() - 1) / target_.samples();
  for (int pass = 0; pass < passes; ++pass) {
    if (lit) figure_light_->draw(pass, [this](const Program& program) { draw_casters(program); });
    View view =
        camera_view(camera, left, top,
                    is_figure() ? bell_shift(pass, passes) : pass_shift(pass, passes, target_.samples()));
    view.first = pass == 0;
    if (lit_pixels_ && cloth_ && view.first && look_.show != Show::silhouette) {
      lit_pixels_->begin_cloth();
      draw_cloth(view, *count_programs_);
    }
    target_.begin(is_transparent() ? 0 : 1,
                  lit_pixels_ && !view.first ? lit_pixels_->uneven_area() : target_.whole());
    const bool counts = cloth_ && (pass == 0 || cloth_seen_ == 0);
    draw_scene(view, counts);
    std::vector<float>& drawn = target_.finish();
    if (lit_pixels_ && passes > 1) view.first ? lit_pixels_->take_first(drawn) : lit_pixels_->complete(drawn);
    exposure.add(drawn);
    if (!counts) continue;
    cloth_alone_ += counted(alone_samples_);
    cloth_seen_ += counted(seen_samples_);
  }
  return exposure.image(is_transparent(), left, top);
}

ClothView::View ClothView::camera_view(const Camera& camera, int left, int top, const Shift& shift) const {
  const double width = size_.width, height = size_.height, bottom = height - top - part_height_;
  const double dx = shift.x / size_.supersample, dy = shift.y / size_.supersample;
  const Window window{(left + dx) / width, (bottom + dy) / height, (left + part_width_ + dx) / width,
                      (bottom + part_height_ + dy) / height};
  const auto scale = static_cast<float>(size_.supersample);
  return {camera.projection(static_cast<float>(width / height), window) * camera.view(),
          camera.eye(),
          camera.forward(),
          camera.is_orthographic(),
          scale * Eigen::Vector2f(static_cast<float>(left), static_cast<float>(bottom)),
          camera.metres_per_pixel(size_.height * size_.supersample)};
}

// Returns the placement of a body that is drawn smaller by `inset` [m] on all sides, stretched upright so
// that one that stands on the ground keeps standing.
Eigen::Matrix4f ClothView::standing(const Obstacle& obstacle, float inset) const {
  const Box box = placed_box(obstacle.box, obstacle.placement);
  const float low = box.low.z(), height = box.high.z() - low;
  if (!ground_height_ || std::abs(low - *ground_height_) > inset) return obstacle.placement;
  Eigen::Matrix4f stretch = Eigen::Matrix4f::Identity();
  stretch(2, 2) = (height - inset) / (height - 2 * inset);
  stretch(2, 3) = low - stretch(2, 2) * (low + inset);
  return stretch * obstacle.placement;
}

void ClothView::place_body(const Program& program, const Obstacle& obstacle) const {
  const float scale = obstacle.placement.topLeftCorner<3, 1>().norm();  // a motion may swell the body
  const BodyMeasure& body = obstacle.measure;
  const float inset = body_inset(body, cloth_side_ / scale, look_.obstacle_inset / scale);
  Eigen::Vector3f keep = Eigen::Vector3f::Ones();
  if (body.centred) keep -= inset * body.half_extent.cwiseInverse();
  program.set("keep", keep);
  program.set("inset", body.centred ? 0 : inset);
  program.set("model", standing(obstacle, inset * scale));
}

void ClothView::place_cloth(const Program& program) {
  program.set("keep", Eigen::Vector3f(1, 1, 1));
  program.set("inset", 0.0f);
  program.set("model", Eigen::Matrix4f(Eigen::Matrix4f::Identity()));
}

void ClothView::draw_casters(const Program& program) const {
  draw_bodies(program, &Obstacle::caster);
  place_cloth(program);
  if (cloth_) cloth_->draw();
}

// Draws from front to back, as far as that is known: hidden pixels cost a software renderer most.
void ClothView::draw_scene(const View& view, bool counts) const {
  if (cloth_) draw_cloth(view, *cloth_programs_);
  if (counts) count_cloth(view, alone_samples_);
  if (look_.show != Show::silhouette) {
    draw_obstacles(view);
    if (ground_height_) draw_ground(view);
  }
  if (counts) count_cloth(view, seen_samples_);
  if (has_backdrop()) draw_backdrop(view);
}

// Drawn once more, without light or colours, the cloth passes the test of depth where nothing stands before
// it.
void ClothView::count_cloth(const View& view, const GlQuery& samples) const {
  gl_.ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  gl_.BeginQuery(GL_SAMPLES_PASSED, samples.name());
  draw_cloth(view, *count_programs_);
  gl_.EndQuery(GL_SAMPLES_PASSED);
  gl_.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

std::uint64_t ClothView::counted(const GlQuery& samples) const {
  GLuint count = 0;
  gl_.GetQueryObjectuiv(samples.name(), GL_QUERY_RESULT, &count);
  return count;
}

double ClothView::hidden_fraction() const {
  if (cloth_alone_ == 0) return 0;
  return 1 - static_cast<double>(cloth_seen_) / static_cast<double>(cloth_alone_);
}

bool ClothView::is_transparent() const {
  return look_.background == Background::transparent && look_.show != Show::silhouette;
}

bool ClothView::has_backdrop() const {
  return look_.background == Background::studio && !is_figure() &&
         (look_.backdrop_top != kPageWhite || look_.backdrop_bottom != kPageWhite);
}

void ClothView::set_backdrop(const Program& program, const View& view) const {
  program.set("backdrop_top", linear(has_backdrop() ? look_.backdrop_top : kPageWhite));
  program.set("backdrop_bottom", linear(has_backdrop() ? look_.backdrop_bottom : kPageWhite));
  const Eigen::Vector2i drawn = size_.supersample * Eigen::Vector2i(size_.width, size_.height);
  program.set("picture_size", Eigen::Vector2f(drawn.cast<float>()));
  program.set("origin", view.origin);
}

void ClothView::begin_lit(const Program& program, const View& view) const {
  program.use();
  program.set("view_projection", view.view_projection);
  place_cloth(program);
  program.set("eye", view.eye);
  program.set("view_forward", view.forward);
  program.set("orthographic", view.orthographic ? 1.0f : 0.0f);
  program.set("side", 0.0f);
  program.set("sheet_half", 0.0f);
  program.set("least_half", 0.0f);
  if (is_figure())
    figure_light_->bind(program);
  else
    shadows_.bind(program);
  if (lit_pixels_) lit_pixels_->bind(program, view.first);
}

void ClothView::draw_backdrop(const View& view) const {
  backdrop_program_.use();
  set_backdrop(backdrop_program_, view);
  gl_.BindVertexArray(no_arrays_.name());
  gl_.DrawArrays(GL_TRIANGLES, 0, 3);
}

void ClothView::draw_ground(const View& view) const {
  const Program& program = ground_->begin();
  program.set("view_projection", view.view_projection);
  if (is_figure()) figure_light_->bind(program);
  set_backdrop(program, view);
  ground_->draw();
}

void ClothView::draw_obstacles(const View& view) const {
  begin_lit(matte_program_, view);
  matte_program_.set("albedo", linear(look_.obstacle));
  draw_bodies(matte_program_, &Obstacle::mesh);
}

// Far sides of closed bodies are never seen, and where no graphics hardware draws, they would cost
// most.
void ClothView::draw_bodies(const Program& program, StaticMesh Obstacle::*mesh) const {
  gl_.CullFace(GL_BACK);
  for (const Obstacle& obstacle : obstacles_) {
    if (!obstacle.visible) continue;
    obstacle.closed ? gl_.Enable(GL_CULL_FACE) : gl_.Disable(GL_CULL_FACE);
    place_body(program, obstacle);
    (obstacle.*mesh).draw();
  }
  gl_.Disable(GL_CULL_FACE);
}

void ClothView::begin_cloth(const Program& program, const View& view) const {
  begin_lit(program, view);
  program.set("front_albedo", linear(look_.front));
  program.set("back_albedo", linear(look_.back));
  program.set("sheen", look_.sheen);
  const float weft_spacing = look_.weft_spacing > 0 ? look_.weft_spacing : look_.thread_spacing;
  program.set("thread_spacing", Eigen::Vector2f(weft_spacing, look_.thread_spacing));
  program.set("weave_kind", static_cast<int>(look_.weave_kind));
  program.set("shown", look_.shown);
  program.set("grid", look_.grid);
  program.set("weave_strength", look_.weave);
  program.set("value_range", Eigen::Vector2f(look_.value_low, look_.value_high));
  program.set("color_map", kColorMapUnit);
  program.set("position", kPositionUnit);
  program.set("corner_index", kIndexUnit);
  program.set("sheet_half", 0.5f * look_.thickness);
  program.set("least_half", 0.5f * kMinThickness * view.pixel);
  bind_texture(gl_, kColorMapUnit, color_map_);
}

// Draws a sheet's two sides and its rim; where it has no thickness, its middle.
void ClothView::draw_cloth(const View& view, const ClothPrograms& programs) const {
  begin_cloth(programs.sides, view);
  if (!has_thickness(look_.show)) return cloth_->draw();
  gl_.Enable(GL_CULL_FACE);
  for (const float side : {1.0f, -1.0f}) {
    programs.sides.set("side", side);
    gl_.CullFace(side > 0 ? GL_BACK : GL_FRONT);
    cloth_->draw();
  }
  gl_.Disable(GL_CULL_FACE);
  begin_cloth(*programs.rim, view);
  cloth_->draw_boundary();
}

double covered_area(const Image& silhouette, double metres_per_pixel) {
  const auto& linear_light = linear_of_srgb8();
  double covered = 0;
  for (int y = 0; y < silhouette.height(); ++y)
    for (int x = 0; x < silhouette.width(); ++x) covered += 1 - linear_light[silhouette.at(x, y)[1]];
  return covered * metres_per_pixel * metres_per_pixel;
}

}  // namespace hysteron::render
