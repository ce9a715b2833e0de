#include "sim/scene/start_shape.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/base/error.h"
#include "sim/base/rotation.h"
#include "sim/mesh/file_extension.h"
#include "sim/mesh/garment.h"
#include "sim/mesh/random_points.h"
#include "sim/scene/shown_key.h"

namespace hysteron {
namespace {

using Eigen::Vector3d;
constexpr double kPi = std::numbers::pi;

// Proportions of a knot.
constexpr double kMinRadius = 5;  // in widths: a smaller one stretches the strip by more than 1 % in torsion
constexpr double kSway = 0.15;    // in radii: how far loops swing in and out
constexpr double kRise = 0.9;     // in widths: how far loops swing up and down, which parts their crossings
constexpr double kDrift = 1.2;    // in widths: the rise from beginning to end, which parts the tails
constexpr double kEnd = 4 * kPi;  // two loops [rad]
constexpr int kPieces = 4000;     // into which its length is divided

// The middle line of a knot at angle u, 0 to kEnd [rad], and its derivatives.
struct KnotCurve {
  double width, radius;  // [m]

  double rise(double u) const { return width * (kRise * std::sin(1.5 * u) + kDrift * (u / kEnd - 0.5)); }
  double reach(double u) const { return radius * (1 + kSway * std::cos(1.5 * u)); }
  Vector3d at(double u) const { return {reach(u) * std::sin(u), reach(u) * std::cos(u), rise(u)}; }
  Vector3d first(double u) const {
    const double r = reach(u), dr = -1.5 * radius * kSway * std::sin(1.5 * u);
    return {dr * std::sin(u) + r * std::cos(u), dr * std::cos(u) - r * std::sin(u),
            width * (1.5 * kRise * std::cos(1.5 * u) + kDrift / kEnd)};
  }
  Vector3d second(double u) const {
    const double r = reach(u), dr = -1.5 * radius * kSway * std::sin(1.5 * u),
                 d2r = -2.25 * radius * kSway * std::cos(1.5 * u);
    return {(d2r - r) * std::sin(u) + 2 * dr * std::cos(u), (d2r - r) * std::cos(u) - 2 * dr * std::sin(u),
            -2.25 * width * kRise * std::sin(1.5 * u)};
  }
};

// The knot by the arc length of its middle line, with tails along -x and +x.
class Knot {
 public:
  Knot(double width, double radius) : curve_{width, radius} {
    arc_length_.push_back(0);
    for (int i = 1; i <= kPieces; ++i) {
      const double u = kEnd * i / kPieces, h = kEnd / kPieces;  // Simpson's rule
      arc_length_.push_back(
          arc_length_.back() +
          h / 6 * (curve_.first(u - h).norm() + 4 * curve_.first(u - h / 2).norm() + curve_.first(u).norm()));
    }
    // Both ends have the same direction, in the plane of x and z; this rotation turns it to x.
    level_ = rotation_between(curve_.first(0), Vector3d::UnitX());
  }

  double length() const { return arc_length_.back(); }

  // Returns the point at arc length `s` [m] from the knot's beginning and `v` [m] beside the middle line.
  Vector3d at(double s, double v) const {
    const double inside = std::clamp(s, 0.0, length()), u = angle_at(inside);
    const Vector3d along = curve_.first(u).normalized(),
                   beside = curve_.first(u).cross(curve_.second(u)).normalized();
    return level_ * (curve_.at(u) + (s - inside) * along + v * beside);
  }

 private:
  double angle_at(double s) const {
    const auto after = std::upper_bound(arc_length_.begin() + 1, arc_length_.end() - 1, s);
    const double part = (s - *(after - 1)) / (*after - *(after - 1));
    return kEnd * (static_cast<double>(after - 1 - arc_length_.begin()) + part) / kPieces;
  }

  KnotCurve curve_;
  std::vector<double> arc_length_;  // [m], up to each piece's beginning
  Eigen::Matrix3d level_;
};

// Returns the length of a flat run [m].
double flat_run_length(const ClothShape& c) {
  return (c.length - (c.pleats - 1) * kPi * c.radius) / c.pleats;
}

// Returns where the point at `s` [m] along the cloth lies, in the plane of the pleats.
Vector3d pleated(const ClothShape& c, double s, double y) {
  const double run = flat_run_length(c), period = run + kPi * c.radius;
  const int layer = std::clamp(static_cast<int>(s / period), 0, c.pleats - 1);
  const double on = s - layer * period, turn = std::max(0.0, on - run) / c.radius;
  const double along = std::min(on, run) + c.radius * std::sin(turn);
  return {layer % 2 ? run - along : along, y, c.radius * (2 * layer + 1 - std::cos(turn))};
}

// Turns and moves each copy by its random draw.
void draw_copies(const Scene& scene, std::vector<Vector3d>& x) {
  const ClothShape& c = scene.cloth;
  if (c.copy_turn == 0 && c.copy_scatter == 0) return;
  Uniform uniform(scene.seed);
  const std::size_t each = x.size() / c.copies;
  for (int k = 0; k < c.copies; ++k) {
    Eigen::AlignedBox3d box;
    for (std::size_t i = k * each; i < (k + 1) * each; ++i) box.extend(x[i]);
    const Vector3d middle = (box.min() + box.max()) / 2;
    const double angle = kPi / 180 * uniform(-c.copy_turn, c.copy_turn);
    const double dx = uniform(-c.copy_scatter, c.copy_scatter), dy = uniform(-c.copy_scatter, c.copy_scatter);
    const Eigen::AngleAxisd turn(angle, Vector3d::UnitZ());
    for (std::size_t i = k * each; i < (k + 1) * each; ++i)
      x[i] = middle + turn * (x[i] - middle) + Vector3d(dx, dy, 0);
  }
}

void check_knot(const Scene& scene) {
  const ClothShape& c = scene.cloth;
  if (c.radius < kMinRadius * c.width)
    throw Error::invalid_input(shown(scene, "cloth.radius", c.radius, "m") +
                               " must be >= " + number_text(kMinRadius * c.width) + " m, " +
                               number_text(kMinRadius) + " times " +
                               shown(scene, "cloth.width", c.width, "m") + ", for cloth.start = knot");
  const double least = knot_length(c.width, c.radius);
  if (c.length < least)
    throw Error::invalid_input(shown(scene, "cloth.length", c.length, "m") +
                               " must be >= " + number_text(least) + " m for a knot with loops of " +
                               shown(scene, "cloth.radius", c.radius, "m"));
}

void check_pleats(const Scene& scene) {
  const ClothShape& c = scene.cloth;
  if (c.radius < scene.fabric.thickness)
    throw Error::invalid_input(shown(scene, "cloth.radius", c.radius, "m") +
                               " must be >= " + number_text(scene.fabric.thickness) +
                               " m, fabric.thickness, for cloth.start = pleats");
  if (flat_run_length(c) <= 0)
    throw Error::invalid_input(shown(scene, "cloth.length", c.length, "m") + " must be > " +
                               number_text((c.pleats - 1) * kPi * c.radius) + " m for " +
                               shown(scene, "cloth.pleats", std::to_string(c.pleats), "") +
                               " with turns of " + shown(scene, "cloth.radius", c.radius, "m"));
}

void check_start_name(const Scene& scene) {
  static const std::vector<std::string> kNames = {"rest", "knot", "pleats"};
  const std::string& start = scene.cloth.start;
  if (std::count(kNames.begin(), kNames.end(), start)) return;
  throw Error::invalid_input(shown(scene, "cloth.start", start, "") + " must be " + join(kNames, " | ") +
                             " | FILE.obj" + suggestion(start, kNames))
      .with_key("cloth.start", start);
}

}  // namespace

double knot_length(double width, double radius) { return Knot(width, radius).length() + 2 * radius; }

void check_start_shape(const Scene& scene) {
  const ClothShape& c = scene.cloth;
  if (c.copies > 1 && scene.triangles < 2 * c.copies)
    throw Error::invalid_input(shown(scene, "triangles", std::to_string(scene.triangles), "") +
                               " must be at least 2 for each of " +
                               shown(scene, "cloth.copies", std::to_string(c.copies), ""));
  if (c.copies > 1 && (names_an_obj(c.start) || c.shape == ClothOutline::pattern))
    throw Error::invalid_input(shown(scene, "cloth.copies", std::to_string(c.copies), "") +
                               " must be 1 where a file says where the cloth starts");
  if (c.start == "rest" || names_an_obj(c.start)) return;
  check_start_name(scene);
  const bool knot = c.start == "knot", of_file = names_an_obj(scene.mesh);
  if (of_file || !(c.shape == ClothOutline::strip || (!knot && c.shape == ClothOutline::square)))
    throw Error::invalid_input(shown(scene, "cloth.start", c.start, "") + " needs cloth.shape = strip" +
                               (knot ? "" : " or square") + ", not " +
                               (of_file ? "the mesh " + scene.mesh : enum_name(c.shape)));
  if (knot)
    check_knot(scene);
  else
    check_pleats(scene);
}

std::vector<Vector3d> start_shape(const Scene& scene, const ClothMesh& mesh) {
  const ClothShape& c = scene.cloth;
  if (names_an_obj(c.start)) return read_start(c.start, c.weld, mesh, c.unit);
  if (c.shape == ClothOutline::pattern) return read_start(c.file, c.weld, mesh, c.unit);
  std::vector<Vector3d> x = mesh.rest;
  const auto each_with = [&](const auto& place) {
    const std::size_t each = x.size() / c.copies;
    for (std::size_t i = 0; i < x.size(); ++i) {
      const Vector3d offset = static_cast<double>(i / each) * c.copy_offset, flat = x[i] - offset;
      x[i] = place(flat) + offset;
    }
  };
  if (c.start == "knot") {
    const Knot knot(c.width, c.radius);
    const double tail = (c.length - knot.length()) / 2;
    each_with([&](const Vector3d& p) { return knot.at(p.x() - tail, p.y() - c.width / 2); });
  } else if (c.start == "pleats") {
    each_with([&](const Vector3d& p) { return pleated(c, p.x(), p.y()); });
  }
  draw_copies(scene, x);
  return x;
}

}  // namespace hysteron
