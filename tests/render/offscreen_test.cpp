#include "render/offscreen.h"

#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <string>

#include "sim/base/enum_names.h"
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
  EXPECT_TRUE(says(offscreen->description(), "GL "));
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

// In a process of its own, because other tests of this one open EGL.
TEST(OffscreenDeathTest, OSMesaAloneOpensNoOtherGl) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  enum { kClean = 10, kOthersOpen = 11, kNoOSMesa = 12 };
  const auto open_osmesa = [] {
    try {
      const auto offscreen = Offscreen::create(Renderer::osmesa);
      std::_Exit(is_loaded("libEGL") || is_loaded("libGL.so") || !is_loaded("libOSMesa") ? kOthersOpen
                                                                                         : kClean);
    } catch (const Error&) {
      std::_Exit(kNoOSMesa);  // Mesa 25.1 and later have none
    }
  };
  const auto clean_or_missing = [](int status) {
    return WIFEXITED(status) && (WEXITSTATUS(status) == kClean || WEXITSTATUS(status) == kNoOSMesa);
  };
  EXPECT_EXIT(open_osmesa(), clean_or_missing, "");
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
  EXPECT_EQ(thrown_error([&] { Offscreen::create(missing); }).exit_code(), 1);
}

TEST(Offscreen, RendererNamesAreThoseOfTheInterface) {
  EXPECT_EQ(value_named<Renderer>("auto"), Renderer::automatic);
  EXPECT_EQ(value_named<Renderer>("egl"), Renderer::egl);
  EXPECT_EQ(value_named<Renderer>("osmesa"), Renderer::osmesa);
  const Error error = thrown_error([] { value_named<Renderer>("vulkan"); });
  EXPECT_EQ(error.exit_code(), 2);
  EXPECT_TRUE(says(error.what(), "auto, egl, osmesa"));
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
