#include "experiments/fold/specimen.h"

#include <algorithm>
#include <cmath>

#include "experiments/specimens/clamped_mesh.h"
#include "sim/base/error.h"
#include "sim/bending/laws/law_parameters.h"
#include "sim/scene/motion.h"

namespace hysteron::experiments {
namespace {

constexpr double kClampPart = 0.1;  // length held in either clamp, over the specimen's
constexpr double kSlack = 0.02;     // slack at the return, over the length between the clamps
constexpr double kHang = 1;         // time of hanging from one clamp after the last return [s]
constexpr double kJaw = 2e-3;       // half the height of a clamp [m]
constexpr double kNoContact = 3;    // gap between cloth and the drawn clamps, in thicknesses

Keyframe shifted(double time, double distance) { return {time, {-distance, 0, 0}}; }

Motion clamp_motion(const FoldParams& choice, double free_length) {
  Motion motion;
  motion.keys = {shifted(0, 0)};
  for (int n = 0; n < choice.cycles; ++n) {
    motion.keys.push_back(shifted((n + 0.5) * choice.period, choice.stroke * free_length));
    motion.keys.push_back(shifted((n + 1) * choice.period, kSlack * free_length));
  }
  return motion;
}

// Returns a clamp that is only drawn: it lies beyond the cloth's end, which is the middle of a clamp's held
// cells.
Obstacle jaw(const Scene& scene, double end, double outwards) {
  const double half = kClampPart * scene.cloth.length / 2;
  Obstacle body;
  body.kind = ObstacleKind::box;
  body.size = {half, 0.6 * scene.cloth.width, kJaw};
  body.rim = kJaw / 4;
  body.center = {end + outwards * (half + kNoContact * scene.fabric.thickness), scene.cloth.width / 2, 0};
  return body;
}

// Returns a named phase around either end of each stroke; their times sum to the scene's seconds to half a
// step.
std::vector<Phase> phases(const FoldParams& choice, const Scene& scene) {
  const double quarter = choice.period / 4;
  std::vector<Phase> all = {{"straight", quarter}};
  for (int n = 1; n <= choice.cycles; ++n) {
    const std::string cycle = "cycle " + std::to_string(n);
    all.push_back({cycle + ", folded", 2 * quarter});
    all.push_back({cycle + ", returned",
                   n < choice.cycles ? 2 * quarter : quarter + std::min(0.01 * quarter, kHang / 10)});
  }
  double rest = scene.seconds;
  for (const Phase& phase : all) rest -= phase.seconds;
  if (rest > 0) all.push_back({"let go", std::abs(rest - kHang) <= scene.step / 2 ? kHang : rest});
  return all;
}

int cycle_decade(int cycle) {
  int decade = 1;
  while (cycle / decade >= 10) decade *= 10;
  return decade;
}

}  // namespace

void give_fatigue(Scene& scene, const FoldParams& choice) {
  const std::vector<std::string> known = law_parameter_names(scene.law);
  const char* const name = "fatigue.dc";
  if (choice.fatigue > 0 && std::find(known.begin(), known.end(), name) != known.end())
    scene.param.try_emplace(name, number_text(choice.fatigue));
}

bool is_chosen(int cycle, int last) {
  const int decade = cycle_decade(cycle);
  return cycle == last || cycle == decade || cycle == 2 * decade || cycle == 5 * decade;
}

bool is_pictured(int cycle, int last) { return cycle == last || cycle == cycle_decade(cycle); }

double stroke_rate(double fps, double period) {
  if (fps <= 0) return 0;
  return std::max(1.0, std::round(period / 2 * fps)) / (period / 2);
}

Fold folded(const Scene& given, const FoldParams& choice, double rate) {
  if (given.element != BendingElement::shape)
    throw Error::invalid_input("element = " + enum_name(given.element) +
                               " must be shape: recovery is read from the curvature tensors of faces")
        .with_key("element", enum_name(given.element))
        .with_experiment("fold");
  Fold fold{given, {}};
  Scene& scene = fold.scene;
  fold.free_length = (1 - 2 * kClampPart) * scene.cloth.length;
  fold.half = std::max(1, static_cast<int>(std::lround(choice.period / 2 * rate)));
  const double apart = choice.period / 2 / fold.half;
  scene.step = apart / std::max(1.0, std::round(apart / scene.step));
  fold.rate = 1 / apart;
  fold.period = choice.period;
  fold.cycles = choice.cycles;
  const double released = choice.cycles * choice.period;  // when the moving clamp lets go [s]
  scene.seconds = released + std::round(kHang / apart) * apart;
  scene.phase = phases(choice, scene);

  ClampedMesh clamped =
      clamped_mesh(scene.mesh, fold.free_length, scene.cloth.width, scene.triangles, 2, scene.seed);
  scene.cloth.shape = ClothOutline::strip;
  scene.triangles = clamped.mesh.faces();
  scene.pin = {held_between(-1, clamped.near()), held_between(clamped.far(), 1)};
  scene.pin[1].motion = clamp_motion(choice, fold.free_length);
  scene.pin[1].until = released + scene.step / 2;
  scene.obstacle = {jaw(scene, 0, -1), jaw(scene, clamped.length, 1)};
  scene.obstacle[1].motion = scene.pin[1].motion;
  fold.cloth = place_cloth(scene, std::move(clamped.mesh));
  return fold;
}

double Fold::distance(double time) const {
  return free_length + placement(scene.pin[1].motion, time).translation.x();
}

FoldGauge::FoldGauge(const Fold& fold) : width_(fold.scene.cloth.width) {
  const ClothMesh& mesh = fold.cloth.mesh;
  double length = 0;
  for (const Eigen::Vector3d& x : mesh.rest) length = std::max(length, x.x());
  spacing_ = length - fold.free_length;  // because either clamp holds half a column
  middle_ = length / 2;
  columns_ = static_cast<int>(std::lround(length / spacing_));
  for (int f = 0; f < mesh.faces(); ++f) {
    const auto& corner = mesh.face[f];
    const auto [warp, weft] = mesh.face_axes(f);
    const double c = warp.x(), s = weft.x();
    component_.emplace_back(c * c, s * s, std::sqrt(2.0) * c * s);
    area_.push_back(mesh.face_area[f]);
    x_.push_back((mesh.rest[corner[0]] + mesh.rest[corner[1]] + mesh.rest[corner[2]]).x() / 3);
    column_.push_back(std::clamp(static_cast<int>(x_.back() / spacing_), 0, columns_ - 1));
  }
}

double FoldGauge::along(int face, const std::vector<double>& curvature) const {
  return area_[face] * component_[face].dot(Eigen::Map<const Eigen::Vector3d>(&curvature[3 * face]));
}

double FoldGauge::crown(const std::vector<double>& curvature) const {
  // Half width of the crown, in columns: the middle one, or the two beside the middle.
  constexpr double kReach = 0.75;
  double sum = 0, area = 0;
  for (std::size_t f = 0; f < area_.size(); ++f) {
    if (std::abs(x_[f] - middle_) > kReach * spacing_) continue;
    sum += along(static_cast<int>(f), curvature);
    area += area_[f];
  }
  return sum / area;
}

double FoldGauge::largest_turn(const std::vector<double>& curvature) const {
  std::vector<double> turn(columns_, 0);
  for (std::size_t f = 0; f < area_.size(); ++f)
    turn[column_[f]] += along(static_cast<int>(f), curvature) / width_;
  const double sense = crown(curvature) < 0 ? -1 : 1;
  double here = 0, largest = 0;  // largest angle of a part that ends here, and of any part [rad]
  for (double t : turn) {
    here = std::max(0.0, here + sense * t);
    largest = std::max(largest, here);
  }
  return largest;
}

}  // namespace hysteron::experiments
