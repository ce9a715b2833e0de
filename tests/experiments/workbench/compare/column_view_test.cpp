#include "experiments/workbench/compare/column_view.h"

#include <gtest/gtest.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "experiments/workbench/app/law_family.h"
#include "render/color_map.h"
#include "render/color_vision.h"
#include "sim/bending/laws/law_parameters.h"
#include "tests/experiments/folder.h"

namespace hysteron::experiments {
namespace {

TEST(ShortNumber, HasThreeDigitsAndAPrefix) {
  EXPECT_EQ(short_number("recovery_angle_deg", 116.2), "116°");
  EXPECT_EQ(short_number("residual_curvature_rms_per_m", 30.98), "κ 31 /m");
  EXPECT_EQ(short_number("residual_curvature_rms_per_m", 2173.0), "κ 2173 /m");
  EXPECT_EQ(short_number("bending_friction_J", 0.0009377), "0.94 mJ");
  EXPECT_EQ(short_number("2HB_N", 8.4e-5), "2HB 84.0 µN");
  EXPECT_EQ(short_number("residual_curvature_rms_per_m", 1e-12), "κ 0 /m");
  EXPECT_EQ(short_number("bending_friction_J", 0.0), "0 J");
  EXPECT_EQ(short_number("node_count", 6), "6 folds");
  EXPECT_EQ(short_number("decay_shape", "two-step"), "decays at two rates");
  EXPECT_EQ(short_number("max_stretch_percent", 8.216e-13), "stretch 0 %") << "what sums of doubles leave";
}

TEST(LawFamily, EveryLawHasAFamilyAndAColorOfItsOwn) {
  std::set<render::Rgb8> colors;
  for (const LawEntry& law : law_catalogue()) {
    EXPECT_NE(family_of_law(law.name), "") << law.name;
    EXPECT_TRUE(colors.insert(color_of_law(law.name)).second) << law.name;
  }
  EXPECT_EQ(family_of_law("prandle"), "");
}

ChildRun of_law(const std::string& law) {
  ChildRun run;
  run.manifest.emplace().keys = std::make_shared<const Json>(Json{{"law", law}});
  return run;
}

// All fabrics have one law then, whose name would say nothing.
TEST(ProbedLoops, NameTheColumnThatIsGrey) {
  const Folder folder;
  folder.write("probe1.csv", "time,curvature,moment\n0,0,0\n1,100,1e-3\n");
  std::vector<ChildRun> fabrics;
  for (const char* name : {"cotton-broad", "wool-tropical"}) {
    ChildRun run = of_law("prandtl");
    run.name = name;
    run.folder = folder.path();
    run.manifest->curves = {{"plot_probe1_moment_warp", "probe1.csv", "curvature", "moment", false, ""}};
    fabrics.push_back(run);
  }
  EXPECT_EQ(ProbedLoops(fabrics).note(column_names(fabrics)), "grey: cotton-broad");
  fabrics.pop_back();
  EXPECT_EQ(ProbedLoops(fabrics).note(column_names(fabrics)), "") << "it is in its own colour";
}

// A law keeps its colour whatever columns stand beside it.
TEST(ColumnColors, AreTheLawsOwn) {
  const std::vector<ChildRun> once = {of_law("linear"), of_law("prandtl")},
                              twice = {of_law("linear"), of_law("prandtl"), of_law("prandtl")},
                              alone = {of_law("prandtl"), of_law("prandtl")};
  EXPECT_EQ(column_colors(once), (std::vector{color_of_law("linear"), color_of_law("prandtl")}));
  EXPECT_EQ(column_families(twice), (std::vector<std::string>{"elastic", "hysteretic", "hysteretic"}));
  EXPECT_EQ(column_colors(twice),
            (std::vector{color_of_law("linear"), color_of_law("prandtl"), color_of_law("prandtl")}));
  EXPECT_EQ(column_families(alone), std::vector<std::string>(2)) << "of one law";
}

TEST(ColumnColors, AreTheLawsOwnBesideAColumnThatWasRefused) {
  ChildRun refused;
  refused.line.flags = {{"law", "spring"}};
  EXPECT_EQ(column_colors({of_law("linear"), refused}),
            (std::vector{color_of_law("linear"), color_of_law("spring")}));
}

// Lines of any two laws differ in colour for everyone, or in their dashes.
TEST(ColumnColors, OrDashesTellAllLawsApart) {
  std::vector<std::string> colors;
  std::vector<render::Rgb8> drawn;
  for (const LawEntry& law : law_catalogue()) {
    drawn.push_back(color_of_law(law.name));
    colors.push_back(render::hex(drawn.back()));
  }
  const std::vector<int> patterns = render::patterns_beside(colors);
  for (std::size_t a = 0; a < drawn.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      EXPECT_TRUE(patterns[a] != patterns[b] || render::least_color_difference(drawn[a], drawn[b]) >= 12)
          << law_catalogue()[a].name << ", " << law_catalogue()[b].name;
  EXPECT_LT(*std::ranges::max_element(patterns), 6) << "as many as there are dashes";
}

TEST(ColumnLabels, AreWhatOneWouldWriteAndSayWhatTheIntegratorTook) {
  EXPECT_EQ(column_text("linear+fabric.damping=0.006378"), "linear, damping 0.00638");
  EXPECT_EQ(column_text("prandtl+fabric=cotton-broad-creasing"), "prandtl, cotton-broad-creasing");
  EXPECT_EQ(column_text("prandtl"), "prandtl");
  std::vector<ChildRun> columns = {of_law("linear"), of_law("prandtl")};
  columns[0].name = "linear", columns[1].name = "prandtl";
  columns[0].manifest->metrics = {{"integrator_share_percent", 71.2}};
  columns[1].manifest->metrics = {{"integrator_share_percent", 4.9}};
  EXPECT_EQ(column_labels(columns), (std::vector<std::string>{"linear (integrator 71 %)", "prandtl"}));
  EXPECT_EQ(column_labels(columns, {"elastic", "hysteretic"})[0], "elastic (integrator 71 %)");
  EXPECT_EQ(integrators_note(columns),
            "Of the energy lost the integrator took 71 % (linear): that share is no law's.");
  EXPECT_EQ(integrators_note({columns[1]}), "");
  columns[0].manifest->keys =
      std::make_shared<const Json>(Json{{"law", "linear"}, {"integrator", "quasi-static"}});
  EXPECT_EQ(integrators_note(columns), "") << "statics lose nothing in time";
}

// A body that no instant notes, on paper that is not quite white.
TEST(Crop, IsAllThatAPictureShowsWhereItIncludesOne) {
  render::Image picture(200, 100, render::Rgb8{254, 254, 255});
  for (int y = 20; y < 60; ++y)
    for (int x = 50; x < 150; ++x) picture.at(x, y)[1] = 200;
  Crop crop;
  crop.include_shown(picture);
  EXPECT_DOUBLE_EQ(crop.width(), 0.5);
  const render::Image part = crop.of(picture);
  EXPECT_NEAR(part.width(), 116, 2) << "8 % of room on either side";
  EXPECT_NEAR(part.height(), 46, 2);
  Crop nothing;
  nothing.include_shown(render::Image(20, 10, render::Rgb8{255, 255, 255}));
  EXPECT_EQ(nothing.width(), 0);
}

// White of 200 x 100 with cloth in a quarter of its width: what is left has it in the middle, and some room.
TEST(Crop, IsWhatTheInstantsReachAndSomeRoom) {
  render::Image picture(200, 100, render::Rgb8{255, 255, 255});
  Crop crop;
  crop.include({.time = 0, .phase = "", .cloth = {0.25, 0.3, 0.4, 0.6}});
  crop.include({.time = 0, .phase = "", .cloth = {0.35, 0.4, 0.5, 0.7}});
  const render::Image part = crop.of(picture);
  EXPECT_NEAR(part.width(), 50 * 1.16, 2);
  EXPECT_NEAR(part.height(), 40 * 1.16, 2);
  EXPECT_EQ(Crop().of(picture), picture) << "nothing is known";
  Crop whole;
  whole.include({});
  EXPECT_EQ(whole.of(picture), picture);
}

}  // namespace
}  // namespace hysteron::experiments
