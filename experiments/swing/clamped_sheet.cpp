#include "experiments/swing/clamped_sheet.h"

#include <fmt/core.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <utility>

#include "sim/base/error.h"
#include "sim/scene/mesh_files.h"
#include "sim/scene/shown_key.h"

namespace hysteron::experiments {
namespace {

constexpr double kFlat = 0.01;   // thickness of a box around a flat sheet over its longest side
constexpr double kLevel = 1e-3;  // cosine between gravity and the normal below which gravity is in the plane
constexpr double kAside = 0.1;   // offset of the first guess of the pins' line from a symmetry of the sheet
constexpr int kPowers = 200;     // iterations that distinguish sides of 10 and 9
constexpr double kParallel = 1e-6;  // sine of the angle between directions that count as parallel

// The flat cloth's sheet, with x along it.
struct RestSheet {
  Eigen::AlignedBox3d box;
  int across = 1, normal = 2;  // indices of axes

  bool is_flat() const { return box.sizes()[normal] < kFlat * box.sizes().maxCoeff(); }
};

RestSheet rest_sheet(const Scene& scene, const ClothMesh& mesh) {
  RestSheet sheet;
  for (const Eigen::Vector3d& x : mesh.rest) sheet.box.extend(x);
  if (sheet.box.sizes().z() > sheet.box.sizes().y()) std::swap(sheet.across, sheet.normal);
  // A generated strip ends where the scene says, though its clamp is a little longer.
  if (is_flat_rectangle(scene)) {
    const double width = scene.cloth.side_along_weft();
    sheet.box = Eigen::AlignedBox3d(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(scene.cloth.length, width, 0));
  }
  return sheet;
}

Eigen::Matrix3d cloth_rotation(const Scene& scene) {
  const Eigen::Vector3d angle = scene.cloth.rotation * std::numbers::pi / 180;
  return (Eigen::AngleAxisd(angle.z(), Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd(angle.y(), Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(angle.x(), Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

std::string sheet_name(const Scene& scene) {
  const std::string file = rest_file(scene);
  return file.empty() ? "the " + enum_name(scene.cloth.shape) : "mesh " + file;
}

// Formats "0 90 0".
std::string rotation_text(const Eigen::Vector3d& degrees) {
  return fmt::format("{:g} {:g} {:g}", degrees.x(), degrees.y(), degrees.z());
}

}  // namespace

bool is_flat_rectangle(const Scene& scene) { return scene.cloth.is_rectangle() && rest_file(scene).empty(); }

void throw_if_gravity_bends_nothing(const Scene& scene, const ClothMesh& mesh) {
  const RestSheet sheet = rest_sheet(scene, mesh);
  if (!sheet.is_flat() || scene.gravity.isZero(0)) return;
  const Eigen::Vector3d down = scene.gravity.stableNormalized();
  const Eigen::Vector3d normal = cloth_rotation(scene) * Eigen::Vector3d::Unit(sheet.normal);
  if (std::abs(down.dot(normal)) > kLevel) return;
  const Eigen::Vector3d level{sheet.normal == 1 ? 90.0 : 0.0, 0, 0};
  const std::string given = rotation_text(scene.cloth.rotation);
  throw Error::invalid_input(
      fmt::format(
          "{} is flat in the plane of {}, and with {} gravity acts in that plane: nothing would swing; "
          "--cloth.rotation \"{}\" lays it level",
          sheet_name(scene), sheet.normal == 1 ? "x and z" : "x and y",
          shown(scene, "cloth.rotation", given, "degree"), rotation_text(level)))
      .with_key("cloth.rotation", given)
      .with_experiment("swing");
}

std::string long_side_warning(const Scene& scene, const ClothMesh& mesh) {
  constexpr double kLong = 2;
  const RestSheet sheet = rest_sheet(scene, mesh);
  const double along = sheet.box.sizes().x(), across = sheet.box.sizes()[sheet.across];
  if (rest_file(scene).empty() || across < kLong * along) return "";
  return fmt::format(
      "{} is {:.4g} m long in x and {:.4g} m in {}: its long side is clamped, and it swings across; a strip "
      "lies along x",
      sheet_name(scene), along, across, sheet.across == 1 ? "y" : "z");
}

void clamp_low_end(Scene& scene) {
  const Cloth cloth = make_cloth(scene);
  const Eigen::AlignedBox3d box = rest_sheet(scene, cloth.mesh).box;
  if (!(box.sizes().x() > kClampedLength))
    throw Error::invalid_input(
        fmt::format("{} is {:.4g} m long in x, which must be more than the {:g} m that "
                    "are clamped: the sheet has to lie along x",
                    sheet_name(scene), box.sizes().x(), kClampedLength))
        .with_key("cloth.file", scene.cloth.file)
        .with_experiment("swing");
  throw_if_gravity_bends_nothing(scene, cloth.mesh);
  Pin pin;
  pin.low = box.min() - Eigen::Vector3d::Ones();
  pin.high = box.max() + Eigen::Vector3d::Ones();
  pin.high.x() = box.min().x() + kClampedLength;
  scene.pin = {pin};
}

namespace {

// Returns the horizontal direction at right angles to `across`, or `other` if `across` is vertical.  It
// points to the side of `outwards`.
Eigen::Vector3d swing_direction(const Eigen::Vector3d& across, const Eigen::Vector3d& up,
                                const Eigen::Vector3d& other, const Eigen::Vector3d& outwards) {
  Eigen::Vector3d along = across.cross(up);
  if (along.norm() < kParallel) along = other;
  along.normalize();
  return along.dot(outwards) < 0 ? Eigen::Vector3d(-along) : along;
}

// Returns the vertices that pins hold at the start, or all of the first pin's if it closes later.
std::vector<Eigen::Vector3d> held_points(const Cloth& cloth) {
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < cloth.start.size(); ++i)
    if (cloth.pin[i] >= 0) points.push_back(cloth.start[i]);
  if (points.empty())
    for (const int i : cloth.pin_vertices.front()) points.push_back(cloth.start[i]);
  return points;
}

// Returns the direction of the line through the held points; for a single point, one at right angles to
// `outwards`.
Eigen::Vector3d line_of_pins(const std::vector<Eigen::Vector3d>& held, const Eigen::Vector3d& middle,
                             const Eigen::Vector3d& up, const Eigen::Vector3d& outwards) {
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& x : held) spread += (x - middle) * (x - middle).transpose();
  if (spread.trace() < kParallel * outwards.squaredNorm()) return up.cross(outwards).stableNormalized();
  // The power method is used because Eigen's solver would be compiled here with other flags than in the
  // simulation, and the linker keeps one of the two.
  Eigen::Vector3d line = up.cross(outwards) + kAside * outwards;
  for (int i = 0; i < kPowers; ++i) line = (spread * line).stableNormalized();
  return line;
}

void hang_from_pins(const Cloth& cloth, SheetPlacement& placed) {
  const std::vector<Eigen::Vector3d> held = held_points(cloth);
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& x : held) middle += x / static_cast<double>(held.size());
  Eigen::Vector3d outwards = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& x : cloth.start)
    if ((x - middle).norm() > outwards.norm()) outwards = x - middle;
  placed.corner = middle;
  placed.reach = outwards.norm();
  placed.across = line_of_pins(held, middle, placed.up, outwards);
  placed.along = swing_direction(placed.across, placed.up, outwards, outwards);
  outwards -= placed.across * placed.across.dot(outwards);
  outwards.stableNormalize();
  const auto tip_merit = [&](const Eigen::Vector3d& x) {
    return (x - middle).dot(outwards) - std::abs((x - middle).dot(placed.across));
  };
  for (std::size_t i = 0; i < cloth.start.size(); ++i)
    if (tip_merit(cloth.start[i]) > tip_merit(cloth.start[placed.tip])) placed.tip = static_cast<int>(i);
}

}  // namespace

SheetPlacement sheet_placement(const Scene& scene, const Cloth& cloth, bool clamped) {
  const RestSheet sheet = rest_sheet(scene, cloth.mesh);
  const Eigen::Matrix3d rotation = cloth_rotation(scene);
  SheetPlacement placed;
  placed.length = sheet.box.sizes().x();
  placed.width = sheet.box.sizes()[sheet.across];
  placed.corner = rotation * sheet.box.min() + scene.cloth.position;
  placed.across = rotation * Eigen::Vector3d::Unit(sheet.across);
  placed.up = scene.gravity.isZero(0) ? Eigen::Vector3d(0, 0, 1) : -scene.gravity.stableNormalized();
  placed.clamp = cloth.pin_vertices.empty() ? 0 : cloth.pin_vertices.front().front();
  if (!clamped && !cloth.pin_vertices.empty()) {
    hang_from_pins(cloth, placed);
    return placed;
  }
  placed.along = swing_direction(placed.across, placed.up, rotation * Eigen::Vector3d::Unit(sheet.normal),
                                 rotation.col(0));
  const auto& rest = cloth.mesh.rest;
  const auto tip_merit = [&](const Eigen::Vector3d& x) {
    const Eigen::Vector3d from_corner = x - sheet.box.min();
    return from_corner.x() - std::abs(from_corner[sheet.across] - placed.width / 2);
  };
  for (std::size_t i = 0; i < rest.size(); ++i)
    if (tip_merit(rest[i]) > tip_merit(rest[placed.tip])) placed.tip = static_cast<int>(i);
  return placed;
}

render::Box SheetPlacement::bounds() const {
  const float l = static_cast<float>(length), w = static_cast<float>(width);
  const Eigen::Vector3f begin = corner.cast<float>();
  const float r = static_cast<float>(reach);
  if (r > 0) return {begin.array() - r, begin.array() + r};
  render::Box box{begin, begin};
  for (const float a : {-0.7f * l, l})
    for (const float b : {0.0f, w})
      for (const float c : {-l, 0.15f * l}) {
        const Eigen::Vector3f at =
            begin + a * along.cast<float>() + b * across.cast<float>() + c * up.cast<float>();
        box = box.merged({at, at});
      }
  return box;
}

}  // namespace hysteron::experiments
