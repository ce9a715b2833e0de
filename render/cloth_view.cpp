#include "render/cloth_view.h"

#include <algorithm>
#include <string>
#include <utility>

#include "render/exposure.h"
#include "sim/base/error.h"

namespace hysteron::render {
namespace {

// Samples per pixel drawn at once, in the standard pattern of D3D 11 and Vulkan.  Eight lie elsewhere on
// every driver, which shows along every edge when pictures are compared.
constexpr int kSamplesAtOnce = 4;
constexpr int kFigureSamples = 1;  // a figure has passes enough

}  // namespace

ClothView::ClothView(Offscreen& offscreen, const PictureSize& size)
    : offscreen_(offscreen),
      gl_(offscreen.gl()),
      parts_(offscreen, size),
      target_(new_target()),
      scene_(gl_, size.figure_passes > 0),
      light_(gl_, size.figure_passes),
      silhouette_(gl_),
      colors_(gl_, is_figure()) {
  if (!is_figure()) lit_pixels_.emplace(gl_, parts_.drawn_width(), parts_.drawn_height());
  set_look({});
}

// The members' GL names must be deleted in their own context.
ClothView::~ClothView() { offscreen_.make_current(); }

FrameTarget ClothView::new_target() const {
  const PictureSize& size = parts_.size();
  return {gl_, parts_.drawn_width(), parts_.drawn_height(),
          size.figure_passes > 0 ? kFigureSamples : std::min(size.samples, kSamplesAtOnce)};
}

void ClothView::resize(const PictureSize& size) {
  if (is_figure() || size.figure_passes > 0)
    throw Error::invalid_input("resizing a view: it and what it becomes must not be figures");
  parts_ = PictureParts(offscreen_, size);
  target_ = new_target();
  lit_pixels_.emplace(gl_, parts_.drawn_width(), parts_.drawn_height());
}

DrawnCloth& ClothView::cloth(const char* given) {
  if (!scene_.cloth)
    throw Error::invalid_input("drawing a cloth: " + std::string(given) + " were given before its triangles");
  return *scene_.cloth;
}

void ClothView::set_cloth(const ClothTopology& topology) {
  offscreen_.make_current();
  light_.outdate();
  scene_.cloth.emplace(gl_, topology);
}

void ClothView::set_positions(std::span<const float> xyz) {
  DrawnCloth& drawn = cloth("positions");
  if (drawn.has(xyz)) return;
  offscreen_.make_current();
  drawn.set_positions(xyz);
  light_.outdate();
  if (!scene_.given_bounds || is_figure()) drawn.measure_box();
}

std::optional<float> ClothView::first_side() const {
  if (!scene_.cloth || !scene_.cloth->knows_side()) return {};
  return scene_.cloth->side();
}

void ClothView::set_first_side(float side) {
  cloth("sides").set_side(side);
  light_.outdate();
}

void ClothView::set_values(std::span<const float> values) {
  DrawnCloth& drawn = cloth("values");
  offscreen_.make_current();
  drawn.surface().set_values(values);
}

GLuint ClothView::position_buffer() const {
  return scene_.cloth ? scene_.cloth->surface().position_buffer() : 0;
}

void ClothView::share_positions(std::unique_ptr<GlPositions> positions) {
  offscreen_.make_current();
  cloth("positions").share_positions(std::move(positions));
}

bool ClothView::write_positions(std::string& reason) {
  if (!scene_.cloth || !scene_.cloth->shares_positions()) return false;
  offscreen_.make_current();
  light_.outdate();
  return scene_.cloth->write_positions(reason);
}

int ClothView::add_obstacle(const TriangleMesh& mesh, const Eigen::Matrix4f& placement,
                            const TriangleMesh* caster) {
  offscreen_.make_current();
  return scene_.obstacles.add(mesh, placement, caster);
}

void ClothView::reshape_obstacle(int obstacle, const TriangleMesh& mesh, const TriangleMesh* caster) {
  offscreen_.make_current();
  scene_.obstacles.reshape(obstacle, mesh, caster);
}

void ClothView::move_obstacle(int obstacle, const Eigen::Matrix4f& placement) {
  scene_.obstacles.move(obstacle, placement);
}

void ClothView::show_obstacle(int obstacle, bool visible) { scene_.obstacles.show(obstacle, visible); }

void ClothView::set_ground(std::optional<float> height) {
  offscreen_.make_current();
  scene_.ground_height = height;
  if (height && !scene_.ground) scene_.ground.emplace(gl_, is_figure());
}

void ClothView::set_look(const Look& look) {
  offscreen_.make_current();
  scene_.look = look;
  silhouette_.set_look(look, is_figure());
  colors_.set_look(look);
}

Image ClothView::draw(const Camera& camera) {
  prepare(camera);
  silhouette_.begin_picture();
  return parts_.assembled(scene_.is_transparent() ? 4 : 3,
                          [&](int left, int top) { return draw_part(camera, left, top); });
}

void ClothView::prepare(const Camera& camera) {
  offscreen_.make_current();
  gl_.Enable(GL_DEPTH_TEST);
  gl_.DepthFunc(GL_LEQUAL);
  // Even passes that draw no pixels need a whole framebuffer, and another view may have taken it away.
  target_.bind();
  if (scene_.cloth) scene_.cloth->surface().update_normals();
  if (!scene_.is_silhouette()) light_.update(scene_, camera);
}

Image ClothView::draw_part(const Camera& camera, int left, int top) {
  const PictureSize& size = parts_.size();
  Exposure exposure(parts_.width(), parts_.height(), size.supersample);
  const int passes =
      is_figure() ? size.figure_passes : (size.samples + target_.samples() - 1) / target_.samples();
  for (int pass = 0; pass < passes; ++pass) {
    if (!scene_.is_silhouette()) light_.begin_pass(pass, scene_);
    PartView view =
        parts_.view(camera, left, top,
                    is_figure() ? bell_shift(pass, passes) : pass_shift(pass, passes, target_.samples()));
    view.first = pass == 0;
    const bool counts = scene_.cloth && (pass == 0 || !silhouette_.shows_cloth());
    std::vector<float>& drawn = draw_pass(view, counts);
    if (lit_pixels_ && passes > 1) view.first ? lit_pixels_->take_first(drawn) : lit_pixels_->complete(drawn);
    exposure.add(drawn);
    if (counts) silhouette_.add_counts();
  }
  return exposure.image(scene_.is_transparent(), left, top);
}

// Draws from front to back, as far as that is known: hidden pixels cost a software renderer most.
std::vector<float>& ClothView::draw_pass(const PartView& view, bool counts) {
  if (lit_pixels_ && scene_.cloth && view.first && !scene_.is_silhouette()) {
    lit_pixels_->begin_cloth();
    silhouette_.draw(scene_, view);
  }
  target_.begin(scene_.is_transparent() ? 0 : 1,
                lit_pixels_ && !view.first ? lit_pixels_->uneven_area() : target_.whole());
  const ColorPass::Lit lit{light_, lit_pixels_ ? &*lit_pixels_ : nullptr};
  const Eigen::Vector2i picture = parts_.drawn_picture();
  if (scene_.cloth && scene_.is_silhouette()) silhouette_.draw(scene_, view);
  if (scene_.cloth && !scene_.is_silhouette()) colors_.draw_cloth(scene_, view, lit);
  if (counts) silhouette_.count_alone(scene_, view);
  if (!scene_.is_silhouette()) {
    colors_.draw_obstacles(scene_, view, lit);
    colors_.draw_ground(scene_, view, picture, lit);
  }
  if (counts) silhouette_.count_seen(scene_, view);
  colors_.draw_backdrop(scene_, view, picture);
  return target_.finish();
}

}  // namespace hysteron::render
