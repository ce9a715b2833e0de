// Drape coefficient, outline and folds of shapes whose area and extrema are known in closed form.
#include "experiments/drape/outline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "render/cloth_view.h"
#include "tests/render/formula_pictures.h"

namespace hysteron::experiments {
namespace {

using std::numbers::pi;
using Radius = std::function<double(double angle)>;  // of an outline [m]

constexpr double kDisc = 0.09, kSpecimen = 0.15;  // [m], as the experiment's pedestal and cloth
constexpr double kProminence = 2e-3;              // [m], as the experiment's
constexpr int kDirections = 3600;                 // as the experiment's
constexpr double kRounding = 1e-12;               // of a sum over all directions, relative

Radius circle(double radius) {
  return [=](double) { return radius; };
}
Radius ellipse(double a, double b) {
  return [=](double t) { return a * b / std::hypot(b * std::cos(t), a * std::sin(t)); };
}
// `folds` lobes that stand out by 2 `amplitude` from the valleys between them.
Radius star(double middle, double amplitude, int folds) {
  return [=](double t) { return middle + amplitude * std::cos(folds * t + 0.3); };
}
double star_area(double middle, double amplitude) {
  return pi * (middle * middle + amplitude * amplitude / 2);
}

Outline sampled(const Radius& radius) {
  Outline outline;
  for (int k = 0; k < kDirections; ++k) outline.radius.push_back(radius(2 * pi * k / kDirections));
  return outline;
}

TEST(Outlines, OverlapByTheAreaOfBothOverThatOfEither) {
  const Outline small = sampled(circle(0.1)), large = sampled(circle(0.12));
  EXPECT_NEAR(overlap(small, large), std::pow(0.1 / 0.12, 2), kRounding);
  EXPECT_EQ(overlap(large, small), overlap(small, large));
  EXPECT_EQ(overlap(small, small), 1);
  // Two lobes beside each other share what lies within both.
  const Outline along = sampled(ellipse(0.14, 0.1)), across = sampled(ellipse(0.1, 0.14));
  EXPECT_LT(overlap(along, across), 0.8);
}

// The rim of a draped cloth through `corners` points of the shape, at heights that must not matter, and
// spokes from its middle to them.
struct RoundSpecimen {
  ClothMesh mesh;
  std::vector<Eigen::Vector3d> x = {{0.01, -0.02, 0}};

  RoundSpecimen(const Radius& radius, int corners) {
    for (int k = 0; k < corners; ++k) {
      const double angle = 2 * pi * (k + 0.37) / corners, r = radius(angle);
      x.push_back({r * std::cos(angle), r * std::sin(angle), 0.05 * std::sin(7 * k)});
      const int here = k + 1, next = (k + 1) % corners + 1;
      mesh.edge.push_back({-1, -1, here, next, 0, -1});
      mesh.edge.push_back({-1, -1, 0, here, 0, 1});
    }
  }
  Outline outline() const { return outline_from_above(mesh, x, kDirections); }
};

TEST(DrapeCoefficient, IsZeroOnThePedestalAndAHundredFlat) {
  EXPECT_DOUBLE_EQ(drape_coefficient(pi * kDisc * kDisc, kDisc, kSpecimen), 0);
  EXPECT_DOUBLE_EQ(drape_coefficient(pi * kSpecimen * kSpecimen, kDisc, kSpecimen), 100);
  EXPECT_NEAR(drape_coefficient(sampled(circle(kSpecimen)).area(), kDisc, kSpecimen), 100, 100 * kRounding);
}

TEST(DrapeCoefficient, OfAnEllipseAndAStarIsTheirAreasClosedForm) {
  const double ring = kSpecimen * kSpecimen - kDisc * kDisc;
  EXPECT_NEAR(drape_coefficient(sampled(ellipse(0.14, 0.1)).area(), kDisc, kSpecimen),
              100 * (0.14 * 0.1 - kDisc * kDisc) / ring, 100 * kRounding);
  EXPECT_NEAR(drape_coefficient(sampled(star(0.12, 0.02, 6)).area(), kDisc, kSpecimen),
              100 * (star_area(0.12, 0.02) / pi - kDisc * kDisc) / ring, 100 * kRounding);
}

// Chords of a curve of n points lie within them by some (pi/n)^2; of a star with m lobes, by some m^2 times
// that.
TEST(DrapeOutline, OfACornerToCornerRimHasTheShapesAreaToSecondOrder) {
  struct {
    const char* name;
    Radius radius;
    double area;
  } const shapes[] = {{"disc", circle(0.12), pi * 0.12 * 0.12},
                      {"ellipse", ellipse(0.14, 0.1), pi * 0.14 * 0.1},
                      {"star", star(0.12, 0.015, 5), star_area(0.12, 0.015)}};
  for (const auto& shape : shapes) {
    const double coarse = RoundSpecimen(shape.radius, 100).outline().area() / shape.area - 1,
                 fine = RoundSpecimen(shape.radius, 400).outline().area() / shape.area - 1;
    EXPECT_GT(std::abs(coarse), 1e-5) << shape.name;
    EXPECT_LT(std::abs(coarse), 1e-2) << shape.name;
    EXPECT_GT(std::log(std::abs(coarse / fine)) / std::log(4), 1.9) << shape.name;
  }
}

TEST(DrapeOutline, IsTheOutermostCrossingWhateverLiesWithin) {
  RoundSpecimen folded(circle(0.12), 400);
  const double alone = folded.outline().area();
  const int first = static_cast<int>(folded.x.size());  // a second rim below the first
  for (int k = 0; k < 400; ++k) folded.x.push_back(0.8 * folded.x[k + 1]);
  for (int k = 0; k < 400; ++k) folded.mesh.edge.push_back({-1, -1, first + k, first + (k + 1) % 400, 0, -1});
  EXPECT_EQ(folded.outline().area(), alone);
}

TEST(DrapeNodes, AreTheLobesOfAStarAndTheLongEndsOfAnEllipse) {
  EXPECT_EQ(sampled(circle(0.12)).nodes(kProminence), 0);
  EXPECT_EQ(sampled(ellipse(0.14, 0.1)).nodes(kProminence), 2);
  for (int folds = 2; folds <= 12; ++folds) {
    EXPECT_EQ(sampled(star(0.12, 0.015, folds)).nodes(kProminence), folds);
    EXPECT_EQ(RoundSpecimen(star(0.12, 0.015, folds), 720).outline().nodes(kProminence), folds);
  }
}

TEST(DrapeNodes, StandOutByMoreThanTheProminence) {
  EXPECT_EQ(sampled(star(0.12, 0.49 * kProminence, 7)).nodes(kProminence), 0);
  EXPECT_EQ(sampled(star(0.12, 0.51 * kProminence, 7)).nodes(kProminence), 7);
  // Ripples on lobes count only where they stand out themselves.
  const auto rippled = [](double ripple) {
    return [=](double t) { return 0.12 + 0.015 * std::cos(4 * t) + ripple * std::cos(60 * t); };
  };
  EXPECT_EQ(sampled(rippled(0.2 * kProminence)).nodes(kProminence), 4);
  EXPECT_GT(sampled(rippled(2 * kProminence)).nodes(kProminence), 20);
}

// The shadow's area is what the picture shows: pixels whose middle is inside, as good as a lattice counts a
// curve.
TEST(DrapeShadow, CoversTheAreaOfTheShape) {
  constexpr int kPixels = 500;
  constexpr double kMetres = 0.32 / kPixels;
  struct {
    Radius radius;
    double area;
  } const shapes[] = {{circle(0.12), pi * 0.12 * 0.12},
                      {ellipse(0.14, 0.1), pi * 0.14 * 0.1},
                      {star(0.12, 0.02, 6), star_area(0.12, 0.02)}};
  for (const auto& shape : shapes) {
    const auto shadow = render::test::drawn(kPixels, kPixels, [&](int i, int j) -> std::array<int, 3> {
      const double x = (i + 0.5 - kPixels / 2) * kMetres, y = (j + 0.5 - kPixels / 2) * kMetres;
      const int light = std::hypot(x, y) < shape.radius(std::atan2(y, x)) ? 0 : 255;
      return {light, light, light};
    });
    const double kLattice = 2 * pi * 0.12 * kMetres / 10;  // a tenth of a pixel along the outline
    EXPECT_NEAR(render::covered_area(shadow, kMetres), shape.area, kLattice);
  }
  // A pixel that is half covered reflects half of the light: 188 of 255 in sRGB.
  EXPECT_NEAR(render::covered_area(render::Image(10, 10, render::Rgb8{188, 188, 188}), 0.1), 0.5, 5e-3);
}

}  // namespace
}  // namespace hysteron::experiments
