#include "experiments/workbench/pictures/fabric_look.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <string>

#include "sim/base/error.h"
#include "sim/scene/assets.h"
#include "sim/scene/fabric_reader.h"

namespace hysteron::experiments {
namespace {

TEST(FabricLook, EveryShippedFabricHasOneOfItsOwn) {
  std::set<render::Rgb8> colors;
  std::set<render::Weave> weaves;
  for (const std::string& name : list_assets("fabrics")) {
    const render::Look look = dressed({}, name);
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
    EXPECT_EQ(dressed(look, "denim-c-friction").front, look.front) << name;
  }
}

class FabricFileLook : public testing::Test {
 protected:
  // What is wrong with a fabric's table [look], which begins in line 3.
  std::string refusal(const std::string& lines) {
    std::ofstream(file_) << "name = \"x\"\n\n[look]\n" << lines;
    try {
      dressed({}, file_.string());
    } catch (const Error& error) {
      EXPECT_EQ(error.exit_code(), 2);
      return error.what();
    }
    return "";
  }
  void TearDown() override { std::filesystem::remove(file_); }

  const std::filesystem::path file_ =
      std::filesystem::temp_directory_path() / ("hysteron-look-" + std::to_string(::getpid()) + ".toml");
};

TEST_F(FabricFileLook, ABackThatIsNotNamedIsThePalerFront) {
  ASSERT_EQ(refusal("colour = [100, 0, 255]\nweave = \"twill\"\nthreads = [25, 20]\nsheen = 0\n"
                    "source = \"assumed\"\n"),
            "");
  const render::Look look = dressed({}, file_.string());
  EXPECT_EQ(look.weave_kind, render::Weave::twill);
  EXPECT_FLOAT_EQ(look.thread_spacing, 4e-4f);
  EXPECT_FLOAT_EQ(look.weft_spacing, 5e-4f);
  EXPECT_EQ(look.back, (render::Rgb8{147, 77, 255}));
}

TEST_F(FabricFileLook, WhatIsWrongIsNamedWithItsLine) {
  EXPECT_NE(refusal("color = [1, 2, 3]\n").find("unknown key look.color"), std::string::npos);
  EXPECT_NE(refusal("colour = [1, 2, 300]\n").find(":4)"), std::string::npos);
  EXPECT_NE(refusal("colour = [1, 2, 3]\nweave = \"felt\"\n").find("must be plain | twill | satin | knit"),
            std::string::npos);
  EXPECT_NE(refusal("colour = [1, 2, 3]\nweave = \"knit\"\nthreads = [0, 1]\n").find("look.threads"),
            std::string::npos);
  EXPECT_NE(
      refusal("colour = [1, 2, 3]\nweave = \"knit\"\nsheen = 0\nsource = \"x\"\n").find("look needs threads"),
      std::string::npos);
}

}  // namespace
}  // namespace hysteron::experiments
