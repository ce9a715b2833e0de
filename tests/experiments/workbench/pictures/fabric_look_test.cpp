#include "experiments/workbench/pictures/fabric_look.h"

#include <set>

#include "sim/scene/assets.h"
#include "sim/scene/fabric_reader.h"
#include "tests/experiments/folder.h"

namespace hysteron::experiments {
namespace {

TEST(FabricLook, EveryShippedFabricHasOneOfItsOwn) {
  std::set<render::Rgb8> colors;
  std::set<render::Weave> weaves;
  for (const std::string& name : list_assets("fabrics")) {
    const render::Look look = apply_fabric_look({}, name);
    colors.insert(look.front);
    weaves.insert(look.weave_kind);
    EXPECT_GT(look.thread_spacing, 0) << name;
  }
  EXPECT_GE(colors.size(), 15u) << "fabrics are told apart by colour";
  EXPECT_EQ(weaves.size(), 4u);
}

TEST(FabricLook, LeavesLooksThatShowSomethingElseAsTheyAre) {
  for (const char* name : {"curvature", "wireframe", "clay"}) {
    const render::Look look = render::look_named(name);
    EXPECT_EQ(apply_fabric_look(look, "denim-c-friction").front, look.front) << name;
  }
}

class FabricFileLook : public testing::Test {
 protected:
  // Returns the refusal of a fabric's table [look], which begins in line 3.
  std::string refusal(const std::string& lines) {
    folder_.write("look.toml", "name = \"x\"\n\n[look]\n" + lines);
    return test::refusal([&] { apply_fabric_look({}, file_); });
  }

  const Folder folder_;
  const std::string file_ = folder_.file("look.toml");
};

TEST_F(FabricFileLook, ABackThatIsNotNamedIsThePalerFront) {
  ASSERT_EQ(refusal("colour = [100, 0, 255]\nweave = \"twill\"\nthreads = [25, 20]\nsheen = 0\n"
                    "source = \"assumed\"\n"),
            "(accepted)");
  const render::Look look = apply_fabric_look({}, file_);
  EXPECT_EQ(look.weave_kind, render::Weave::twill);
  EXPECT_FLOAT_EQ(look.thread_spacing, 4e-4f);
  EXPECT_FLOAT_EQ(look.weft_spacing, 5e-4f);
  EXPECT_EQ(look.back, (render::Rgb8{147, 77, 255}));
}

TEST_F(FabricFileLook, WhatIsWrongIsNamedWithItsLine) {
  EXPECT_TRUE(says(refusal("color = [1, 2, 3]\n"), "unknown key look.color"));
  EXPECT_TRUE(says(refusal("colour = [1, 2, 300]\n"), ":4)"));
  EXPECT_TRUE(
      says(refusal("colour = [1, 2, 3]\nweave = \"felt\"\n"), "must be plain | twill | satin | knit"));
  EXPECT_TRUE(says(refusal("colour = [1, 2, 3]\nweave = \"knit\"\nthreads = [0, 1]\n"), "look.threads"));
  EXPECT_TRUE(says(refusal("colour = [1, 2, 3]\nweave = \"knit\"\nsheen = 0\nsource = \"x\"\n"),
                   "look needs threads"));
}

}  // namespace
}  // namespace hysteron::experiments
