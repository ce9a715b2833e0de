#include "render/offscreen.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <string>

#include "tests/render/test_scene.h"

namespace hysteron::render {
namespace {

bool is_loaded(const std::string& library) {
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);)
    if (line.find(library) != std::string::npos) return true;
  return false;
}

TEST(Offscreen, AutomaticChoiceGivesAContextAndNamesIt) {
  const auto offscreen = Offscreen::create(Renderer::automatic);
  GLint major = 0;
  offscreen->gl().GetIntegerv(GL_MAJOR_VERSION, &major);
  EXPECT_GE(major, 3);
  EXPECT_NE(offscreen->description().find("GL "), std::string::npos) << offscreen->description();
  EXPECT_GE(offscreen->max_samples(), 4);
}

TEST(Offscreen, EveryEglCandidateIsUsableOrSaysWhyNot) {
  const auto list = Offscreen::candidates(Renderer::egl);
  if (list.empty()) GTEST_SKIP() << "no EGL on this machine";
  int usable = 0;
  for (const Candidate& candidate : list) {
    try {
      usable += Offscreen::create(candidate)->description().starts_with(candidate.name());
    } catch (const Error& error) {
      EXPECT_EQ(error.exit_code(), 1);
    }
  }
  EXPECT_GE(usable, 1);
}

TEST(Offscreen, OSMesaAloneOpensNoOtherGl) {
  std::unique_ptr<Offscreen> offscreen;
  try {
    offscreen = Offscreen::create(Renderer::osmesa);
  } catch (const Error&) {
    GTEST_SKIP() << "no OSMesa on this machine (Mesa 25.1 and later have none)";
  }
  EXPECT_TRUE(is_loaded("libOSMesa"));
  EXPECT_FALSE(is_loaded("libEGL"));
  EXPECT_FALSE(is_loaded("libGL.so"));
}

TEST(Offscreen, HardwareIsTriedFirstAndOSMesaLast) {
  const auto list = Offscreen::candidates(Renderer::automatic);
  ASSERT_FALSE(list.empty());
  EXPECT_EQ(list.back().kind, Candidate::Kind::osmesa);
  EXPECT_TRUE(std::is_sorted(list.begin(), list.end(),
                             [](const Candidate& a, const Candidate& b) { return a.hardware > b.hardware; }));
}

TEST(Offscreen, ADeviceThatIsNotThereIsTheMachinesFailure) {
  const Candidate missing{.kind = Candidate::Kind::egl_device, .device = 999};
  EXPECT_EQ(test::error_of([&] { Offscreen::create(missing); }).exit_code(), 1);
}

TEST(Offscreen, RendererNamesAreThoseOfTheInterface) {
  EXPECT_EQ(renderer_named("auto"), Renderer::automatic);
  EXPECT_EQ(renderer_named("egl"), Renderer::egl);
  EXPECT_EQ(renderer_named("osmesa"), Renderer::osmesa);
  const Error error = test::error_of([] { renderer_named("vulkan"); });
  EXPECT_EQ(error.exit_code(), 2);
  EXPECT_NE(std::string(error.what()).find("auto, egl, osmesa"), std::string::npos);
}

TEST(Offscreen, TwoContextsLiveSideBySide) {
  const auto first = Offscreen::create(Renderer::automatic);
  const auto second = Offscreen::create(Renderer::automatic);
  const PictureSize size{64, 36};
  auto view = test::draped_view(*first, size, Look{});
  const Image before = view->draw(test::draped_camera(16.0f / 9));
  second->make_current();
  EXPECT_EQ(view->draw(test::draped_camera(16.0f / 9)), before);
}

}  // namespace
}  // namespace hysteron::render
