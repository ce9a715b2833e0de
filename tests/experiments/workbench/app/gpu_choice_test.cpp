#include "experiments/workbench/app/gpu_choice.h"

#include <cstdlib>
#include <optional>

#include "tests/experiments/program.h"

namespace hysteron::experiments {
namespace {

constexpr char kAllowed[] = "CUDA_VISIBLE_DEVICES";

class GpuChoice : public testing::Test {
 protected:
  void TearDown() override { allow(before_); }

  static void allow(const std::optional<std::string>& gpus) {
    if (gpus)
      setenv(kAllowed, gpus->c_str(), 1);
    else
      unsetenv(kAllowed);
  }
  static std::optional<std::string> allowed() {
    const char* text = std::getenv(kAllowed);
    return text ? std::optional<std::string>(text) : std::nullopt;
  }
  static CommandLine on(const std::string& device) {
    return {"swing", "hysteron swing", {{"seconds", 1}, {"device", device}}, {}};
  }

 private:
  std::optional<std::string> before_ = allowed();
};

TEST_F(GpuChoice, LeavesTheChosenOneOfThoseThatAreAllowed) {
  const std::pair<std::optional<std::string>, const char*> cases[] = {{std::nullopt, "1"}, {"3,5", "5"}};
  for (const auto& [gpus, seen] : cases) {
    allow(gpus);
    CommandLine line = on("cuda:1");
    choose_gpu(line, 2, true);
    EXPECT_EQ(line.flags[1].text(), "cuda");
    EXPECT_EQ(line.command, "hysteron swing");
    EXPECT_EQ(allowed(), seen);
  }
}

TEST_F(GpuChoice, ChangesNothingWhereNoneIsNamed) {
  for (const char* device : {"auto", "cpu", "cuda", "cudax"}) {
    allow("2");
    CommandLine line = on(device);
    choose_gpu(line);
    EXPECT_EQ(line.flags[1].text(), device);
    EXPECT_EQ(allowed(), "2");
  }
}

TEST_F(GpuChoice, IsRefusedInOneLineWhereThereIsNoSuchGpu) {
  allow("4,7");
  const auto refused = [](const char* device) {
    return test::refusal([&] {
      CommandLine line = on(device);
      choose_gpu(line, 2, true);
    });
  };
  EXPECT_TRUE(says(refused("cuda:2"), "CUDA_VISIBLE_DEVICES = 4,7 leaves 2 GPUs, cuda:0 to cuda:1"));
  for (const char* device : {"cuda:", "cuda:x", "cuda:-1", "cuda:1.5", "cuda:99999"})
    EXPECT_TRUE(says(refused(device), "the number of a GPU")) << device;
  EXPECT_EQ(allowed(), "4,7");
}

TEST_F(GpuChoice, IsRefusedWhereTheMachineHasFewer) {
  allow(std::nullopt);
  CommandLine line = on("cuda:3");
  EXPECT_EQ(test::refusal([&] { choose_gpu(line, 1, true); }),
            "swing: --device cuda:3: this machine has 1 GPU, cuda:0");
  EXPECT_EQ(allowed(), std::nullopt);
  choose_gpu(line, 0, true);  // where it is not known how many there are, CUDA says it
  EXPECT_EQ(allowed(), "3");
}

TEST_F(GpuChoice, IsLeftToWhoSimulatesInAProgramWithoutCuda) {
  allow("4");
  CommandLine line = on("cuda:3");
  choose_gpu(line, 0, false);
  EXPECT_EQ(line.flags[1].text(), "cuda");
  EXPECT_EQ(allowed(), "4");
}

// Such a program does not read the variable, which is no reason.
TEST_F(GpuChoice, IsRefusedByAProgramWithoutCudaWithThatReason) {
  if (is_built_with_cuda()) GTEST_SKIP() << "built with CUDA";
  allow("4");
  for (const char* device : {"cuda", "cuda:7"})
    EXPECT_EQ(ended(1, std::string("swing --triangles 40 --explain --device ") + device).err,
              "hysteron swing: device = cuda: this program was built without CUDA; use --device cpu\n");
}

}  // namespace
}  // namespace hysteron::experiments
