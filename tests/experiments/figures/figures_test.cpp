#include "experiments/figures/figures.h"

#include <cmath>
#include <fstream>
#include <set>

#include "sim/base/error.h"
#include "sim/scene/assets.h"
#include "sim/scene/fabric_reader.h"
#include "tests/experiments/folder.h"

namespace hysteron::experiments {
namespace {

// Points of curves are 1/200 of a leg apart and joined by straight lines: h^2 |M''|/8 of the moment there.
constexpr double kSampling = 1e-4;  // relative to the largest moment drawn

const std::vector<Figure>& cotton_figures() {
  static const std::vector<Figure> all = chapter_figures(read_fabric("cotton-broad-k50", "test").fabric);
  return all;
}

const render::Mark& mark(const Figure& figure, const std::string& text) {
  for (const render::Mark& mark : figure.plot.marks)
    if (mark.text == text) return mark;
  throw Error::invalid_input(figure.name + " has no mark " + text);
}

// The smallest distance in moment from a point to a labelled curve over the same curvature.
double distance_to_curves(const Figure& figure, double curvature, double moment) {
  double nearest = INFINITY;
  for (const render::Series& series : figure.plot.series) {
    if (series.label.empty()) continue;
    for (std::size_t i = 1; i < series.x.size(); ++i) {
      const double a = series.x[i - 1], b = series.x[i];
      if (a == b || (curvature - a) * (curvature - b) > 1e-12 * a * a) continue;
      const double there = series.y[i - 1] + (series.y[i] - series.y[i - 1]) * (curvature - a) / (b - a);
      nearest = std::min(nearest, std::abs(there - moment));
    }
  }
  return nearest;
}

TEST(ChapterFigures, AreAllOfTheChapterWithItsLetters) {
  std::vector<std::string> names;
  std::set<std::string> letters;
  for (const Figure& figure : cotton_figures()) {
    names.push_back(figure.name);
    for (const render::Mark& mark : figure.plot.marks) letters.insert(mark.text);
  }
  EXPECT_EQ(names, (std::vector<std::string>{"figure-4-2a", "figure-4-2b", "equation-4-3", "figure-4-3",
                                             "figure-4-4a", "figure-4-4b", "figure-4-4c", "figure-4-4d"}));
  for (const char* letter : {"p₀", "p₁", "p₂", "p₃", "θ", "b₁", "b₂", "a",  "a′", "b", "b′",
                             "c",  "d",  "f",  "g",  "h", "o",  "K₀", "M₀", "Mₐ", "Kₘ"})
    EXPECT_TRUE(letters.count(letter)) << letter;
}

TEST(ChapterFigures, HaveTheirPointsOnTheirCurves) {
  int points = 0;
  for (const Figure& figure : cotton_figures()) {
    if (figure.name == "equation-4-3") continue;  // its marks name stiffnesses
    for (const render::Mark& mark : figure.plot.marks) {
      const bool letter = std::string("abcdfgh").find(mark.text[0]) != std::string::npos;
      if (!mark.dot || !letter || (figure.name == "figure-4-4b" && mark.text == "a")) continue;
      EXPECT_LT(distance_to_curves(figure, mark.x, mark.y), kSampling * figure.plot.y.high)
          << figure.name << " " << mark.text;
      ++points;
    }
  }
  EXPECT_GE(points, 22);
}

// Wong 4.3.2: from c to a' and from d to b' twice K0, and in moment twice Ma; a and b are the elastic limits.
TEST(ChapterFigures, HaveTheChaptersDistancesBetweenPoints) {
  const VirginCurve curve = read_fabric("cotton-broad-k50", "test").fabric.virgin_curve();
  const double k0 = curve.k0, ma = 1e3 * curve.elastic_limit_moment();
  for (const Figure& figure : cotton_figures()) {
    if (figure.name != "figure-4-3" && figure.name != "figure-4-4a") continue;
    EXPECT_DOUBLE_EQ(mark(figure, "a").x, k0);
    EXPECT_DOUBLE_EQ(mark(figure, "a").y, ma);
    EXPECT_DOUBLE_EQ(mark(figure, "b").x, -k0);
    EXPECT_NEAR(mark(figure, "c").x - mark(figure, "a′").x, 2 * k0, 1e-12 * k0);
    EXPECT_NEAR(mark(figure, "c").y - mark(figure, "a′").y, 2 * ma, 1e-12 * ma);
    EXPECT_NEAR(mark(figure, "b′").x - mark(figure, "d").x, 2 * k0, 1e-12 * k0);
    EXPECT_GT(mark(figure, "c").y, 2 * ma) << "the third case";
  }
}

const Figure& figure_named(const std::string& name) {
  for (const Figure& figure : cotton_figures())
    if (figure.name == name) return figure;
  throw Error::invalid_input("no figure " + name);
}

TEST(ChapterFigures, SayWhereTheChapterCannotHoldAsPrinted) {
  EXPECT_TRUE(says(figure_named("figure-4-2b").caption, "b1 ≥ b2"));
  EXPECT_TRUE(says(figure_named("figure-4-4b").caption, "disagree"));
}

// Eq. 4.3 of Eq. 4.2: b1 + 2 c1 |K| up to K0, then b2.  Its points are middles of the law's sampled legs,
// where the difference quotient of a parabola is exact; the one leg that K0 lies in is left out.
TEST(ChapterFigures, HaveTheStiffnessThatIsTheSlopeOfTheVirginCurve) {
  const VirginCurve curve = read_fabric("cotton-broad-k50", "test").fabric.virgin_curve();
  const render::Series& b = figure_named("equation-4-3").plot.series[0];
  const double leg = b.x[b.x.size() - 1] - b.x[b.x.size() - 2];
  constexpr double kRounding =
      1e-9;  // of the largest stiffness: differences of moments over a 200th of the leg
  for (std::size_t i = 0; i < b.x.size(); ++i) {
    const double k = std::abs(b.x[i]);
    if (std::abs(k - curve.k0) < leg) continue;
    const double expected = k < curve.k0 ? curve.b1 + 2 * curve.c1() * k : curve.b2;
    EXPECT_NEAR(b.y[i], 1e6 * expected, kRounding * 1e6 * curve.b1) << b.x[i];
  }
}

TEST(ChapterFigures, OfAFabricWithoutFrictionAreRefused) {
  Fabric fabric = read_fabric("cotton-broad-k50", "test").fabric;
  fabric.b1 = fabric.b2;
  EXPECT_NE(test::refusal([&] { chapter_figures(fabric); }), "(accepted)");
}

TEST(FiguresCommand, WritesCurvesAndCaptionsWithoutPicturesToo) {
  const Folder folder;
  testing::internal::CaptureStdout();
  EXPECT_EQ(experiment_named("figures").run(
                {"figures",
                 "hysteron figures",
                 {{"out", folder.path().string()}, {"no-images", true}, {"fabric", "wool-tropical-k50"}},
                 {}}),
            0);
  testing::internal::GetCapturedStdout();
  const std::string captions = file_content(folder.path() / "README.md");
  for (const Figure& figure : cotton_figures()) {
    EXPECT_TRUE(fs::exists(folder.path() / (figure.name + ".csv"))) << figure.name;
    EXPECT_TRUE(says(captions, figure.name + ".png")) << figure.name;
  }
  EXPECT_TRUE(says(captions, "wool-tropical"));
}

// Their sentences and closed forms are of the chapter's three numbers.
TEST(FiguresCommand, RefusesAFabricWithStopsByItsFile) {
  const Folder folder;
  const std::string file = folder.file("stops.toml");
  std::ifstream shipped(find_asset("fabrics", "cotton-broad-k50", "test"));
  std::ofstream text(file);
  for (std::string line; std::getline(shipped, line);)  // b1 and k0 follow from the stops
    if (!line.starts_with("b1 = {") && !line.starts_with("k0 = {")) text << line << "\n";
  text << "\n[bending.stops]\nthresholds = [10, 50]\nstiffnesses = [8e-6, 1e-6]\n";
  text.close();
  const std::string out = folder.file("out");
  EXPECT_TRUE(says(test::refusal([&] {
                     run_into(out, "figures", {{"fabric", file}});
                   }),
                   "--fabric " + file + " has friction by stops", "of b1, b2 and k0 alone"));
  EXPECT_TRUE(says(test::refusal([&] {
                     run_into(out, "figures", {{"fabric", "cotton-broad-creasing"}});
                   }),
                   "cotton-broad-creasing has a permanent set"));
  EXPECT_TRUE(says(test::refusal([&] {
                     run_into(out, "figures", {{"fabric", "cotton-broad-relaxing"}});
                   }),
                   "cotton-broad-relaxing has"));
  EXPECT_FALSE(fs::exists(out));
}

TEST(FiguresCommand, StatesTheFabricThatItUsesAsItsDefault) {
  for (const KeyDescription& key : experiment_named("figures").own_keys())
    if (key.path == "fabric.name") {
      EXPECT_EQ(key.default_text, "cotton-broad-k50");
    }
  const Folder folder;
  testing::internal::CaptureStdout();
  EXPECT_EQ(run_into(folder.path(), "figures", {}), 0);
  testing::internal::GetCapturedStdout();
  EXPECT_EQ(manifest_in(folder.path())["scene"]["fabric"]["name"], "cotton-broad-k50");
}

}  // namespace
}  // namespace hysteron::experiments
