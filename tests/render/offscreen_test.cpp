#include "render/offscreen.h"

#include <sys/wait.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <string>

#include "render/context_probe.h"
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

// The test runs in a process of its own, because other tests of this one open EGL.
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

TEST(ContextProbe, TellsACrashFromAnErrorAndFromNone) {
  EXPECT_NO_THROW(try_in_child([] {}));
  EXPECT_NO_THROW(try_in_child([] { throw Error::system("no context"); }));
  const Error error = thrown_error([] { try_in_child([] { std::raise(SIGSEGV); }); });
  EXPECT_EQ(error.exit_code(), 1);
  EXPECT_EQ(error.what(), std::string("it ends by a signal (Segmentation fault)"));
}

// zink needs a window system, and OSMesa has none.
TEST(ContextProbe, ADriverThatCrashesIsAnErrorThatNamesIt) {
  const char* before = std::getenv("GALLIUM_DRIVER");
  const std::string kept = before ? before : "";
  setenv("GALLIUM_DRIVER", "softpipe", 1);
  EXPECT_EQ(named_driver(), "");
  setenv("GALLIUM_DRIVER", "zink", 1);
  EXPECT_EQ(named_driver(), "GALLIUM_DRIVER = zink");
  try {
    Offscreen::create(Candidate{.kind = Candidate::Kind::osmesa});  // a Mesa that can is no fault
  } catch (const Error& error) {
    EXPECT_EQ(error.exit_code(), 1);
  }
  if (before)
    setenv("GALLIUM_DRIVER", kept.c_str(), 1);
  else
    unsetenv("GALLIUM_DRIVER");
}

}  // namespace
}  // namespace hysteron::render
