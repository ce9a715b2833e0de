// A garment whose numbers are known: two rectangles sewn along two seams.
#pragma once

#include <functional>
#include <sstream>
#include <string>

#include "sim/mesh/garment.h"
#include "tests/sim/scene/scene_file.h"

namespace hysteron::test {

//   z
//   |
//   +--------S    Cross section of a tube along x.  The first panel covers the sides y = 0 ... S at z = 0 and
//   |        |    z = 0 ... S at y = S, the second the others; the seams run through 0 and through S.
//   |        |    All coordinates are binary fractions, so that cloth at rest has no strain, not even from
//   0--------+-y  rounding.
struct PanelTube {
  static constexpr double kSide = 0.125, kLength = 0.5;  // [m]
  static constexpr int kAlong = 4, kCells = 2;           // cells along, and on each of the four sides

  using Texture = std::function<Eigen::Vector2d(const Eigen::Vector2d&)>;
  using Place = std::function<Eigen::Vector3d(const Eigen::Vector3d&)>;
  Texture second = [](const Eigen::Vector2d& at) {
    return at;
  };                                                          // where the second panel lies in the texture
  Place worn = [](const Eigen::Vector3d& at) { return at; };  // where vertices are

  static double area() { return 4 * kSide * kLength; }
  static Eigen::Vector2d moved(const Eigen::Vector2d& at) { return at + Eigen::Vector2d(2, -1); }
  static Eigen::Vector2d turned(const Eigen::Vector2d& at) { return {-at.y(), at.x()}; }
  static Eigen::Vector2d mirrored(const Eigen::Vector2d& at) { return {at.x(), -at.y()}; }

  ClothMesh mesh(double texture_scale = 1) const {
    const TextFile file(obj(), ".obj");
    return read_pattern(file.path(), 0, texture_scale);
  }

  std::string obj() const {
    std::ostringstream text;
    text.precision(17);
    const double cell = kSide / kCells;
    for (int i = 0; i <= kAlong; ++i)
      for (int j = 0; j < 4 * kCells; ++j) {
        const Eigen::Vector3d x = worn(around(i * kLength / kAlong, j * cell));
        text << "v " << x.x() << ' ' << x.y() << ' ' << x.z() << '\n';
      }
    for (int panel = 0; panel < 2; ++panel)
      for (int i = 0; i <= kAlong; ++i)
        for (int j = 0; j <= 2 * kCells; ++j) {
          const Eigen::Vector2d flat(i * kLength / kAlong, j * cell), at = panel ? second(flat) : flat;
          text << "vt " << at.x() << ' ' << at.y() << '\n';
        }
    for (int panel = 0; panel < 2; ++panel)
      for (int i = 0; i < kAlong; ++i)
        for (int j = 0; j < 2 * kCells; ++j) {
          const auto corner = [&](int di, int dj) {
            const int vertex = (i + di) * 4 * kCells + (2 * kCells * panel + j + dj) % (4 * kCells);
            const int texture = (panel * (kAlong + 1) + i + di) * (2 * kCells + 1) + j + dj;
            return ' ' + std::to_string(vertex + 1) + '/' + std::to_string(texture + 1);
          };
          text << "f" << corner(0, 0) << corner(1, 0) << corner(1, 1) << "\nf" << corner(0, 0) << corner(1, 1)
               << corner(0, 1) << '\n';
        }
    return text.str();
  }

 private:
  // Returns the point at `s` around the cross section.
  static Eigen::Vector3d around(double x, double s) {
    const double a = kSide;
    if (s <= a) return {x, s, 0};
    if (s <= 2 * a) return {x, a, s - a};
    return s <= 3 * a ? Eigen::Vector3d(x, 3 * a - s, a) : Eigen::Vector3d(x, 0, 4 * a - s);
  }
};

}  // namespace hysteron::test
