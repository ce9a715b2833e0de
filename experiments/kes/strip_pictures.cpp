#include "experiments/kes/strip_pictures.h"

#include <fmt/core.h>

#include "render/look.h"

namespace hysteron::experiments {
namespace {

constexpr double kJawLength = 2.5e-3;                            // [m]
constexpr double kJawOverhang = 0.6e-3, kJawThickness = 0.7e-3;  // beyond either edge; of both halves [m]

constexpr float kFieldOfView = 28;                 // [degree]
constexpr double kReach = 9.5e-3;                  // of clamp and jaw to either side [m]
constexpr double kShown = 5.2e-3, kLift = 3.2e-3;  // half the height shown, its middle at the amplitude [m]

// For the eye: cloth does not touch it, its pins hold it.  Grips a strip along x, `width` wide from y = 0 on,
// from `from` to `to`; bodies are drawn smaller by the look's inset.
Obstacle jaw(double from, double to, double width) {
  const double inset = render::Look{}.obstacle_inset;
  Obstacle box;
  box.kind = ObstacleKind::box;
  box.center = {(from + to) / 2, width / 2, 0};
  box.size = Eigen::Vector3d((to - from) / 2, width / 2 + kJawOverhang, kJawThickness / 2).array() + inset;
  box.rim = 0.3 * inset;
  return box;
}

// From jaw to jaw; `turn` from -1 to 1 moves up and down with the strip.
render::Box framed(double turn, float width, double half_height) {
  const double middle = turn * kLift;
  return {{-2e-3f, 0, static_cast<float>(middle - half_height)},
          {12e-3f, width, static_cast<float>(middle + half_height)}};
}

}  // namespace

StripPictures::StripPictures(const Options& options, const ClampedStrip& strip)
    : setup_{strip.scene, options}, strip_(strip) {
  setup_.options.size = "960x720";
  setup_.options.camera_direction = {0.4, -1.0, 0.3};
  const double width = strip.scene.cloth.width, d = strip.spacing;
  setup_.scene.obstacle = {jaw(-kJawLength, d, width), jaw(kGauge, kGauge + d + kJawLength, width)};
  setup_.scene.obstacle[1].motion = strip.scene.pin[1].motion;
  const std::vector<std::size_t>& turn = strip.walk.start;
  rows_ = {turn[1] / 2, turn[1], (turn[1] + turn[2]) / 2, turn[2]};
}

void StripPictures::watch(std::size_t row, Simulation& simulation) {
  if (taken_.size() == rows_.size() || row != rows_[taken_.size()]) return;
  const float width = static_cast<float>(strip_.scene.cloth.width);
  if (!pictures_) {
    pictures_ =
        std::make_unique<Pictures>(setup_, strip_.cloth, simulation, framed(0, width, kReach), std::nullopt);
    renderer_ = pictures_->renderer();
  }
  StripPicture picture;
  picture.letter = static_cast<char>('a' + taken_.size());
  picture.curvature = strip_.walk.rows[row].curvature;
  const std::string caption =
      fmt::format("{}   {:.0f}/m, {}", picture.letter, picture.curvature, strip_.scene.mesh);
  const double turn = picture.curvature / strip_.walk.rows[rows_[1]].curvature;
  const auto camera = render::Camera::framing(
      framed(turn, width, kShown), setup_.options.camera_direction.cast<float>(), kFieldOfView,
      static_cast<float>(setup_.options.width()) / static_cast<float>(setup_.options.height()));
  picture.image = pictures_->picture("wireframe", camera, caption);
  taken_.push_back(std::move(picture));
  if (taken_.size() == rows_.size()) pictures_.reset();
}

std::vector<StripPicture> StripPictures::taken(const StripTest& test) {
  for (std::size_t i = 0; i < taken_.size(); ++i) taken_[i].moment = test.moment[rows_[i]];
  return std::move(taken_);
}

}  // namespace hysteron::experiments
