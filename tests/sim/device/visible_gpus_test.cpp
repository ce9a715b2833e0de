// These tests check the messages about GPUs that a run cannot have.
#include "sim/device/visible_gpus.h"

#include <gtest/gtest.h>

#include "tests/sim/base/folder.h"

namespace hysteron {
namespace {

TEST(VisibleGpus, AreCountedByTheirDeviceFiles) {
  const test::Folder folder;
  EXPECT_EQ(gpus_of_machine(folder.path()), 0);
  for (const char* file : {"nvidia0", "nvidia11", "nvidiactl", "nvidia-uvm", "nvidia", "nvidia0x"})
    folder.write(file, "");
  EXPECT_EQ(gpus_of_machine(folder.path()), 2);
  EXPECT_EQ(gpus_of_machine(folder.file("none")), 0);
}

TEST(VisibleGpus, ThatAreNotThereAreSaidWithTheirNumberAndTheVariable) {
  const std::string reason = "no CUDA-capable device is detected";
  EXPECT_EQ(no_gpu_message(reason, 1, "3"),
            reason + ": CUDA_VISIBLE_DEVICES = 3, and this machine has 1 GPU, cuda:0");
  EXPECT_EQ(no_gpu_message(reason, 4, nullptr), reason + ": this machine has 4 GPUs, cuda:0 to cuda:3");
  EXPECT_EQ(no_gpu_message(reason, 0, "3"), reason + ": CUDA_VISIBLE_DEVICES = 3");
  EXPECT_EQ(no_gpu_message(reason, 0, nullptr), reason);
}

// A variable that the program does not read is no reason of it.
TEST(VisibleGpus, AreNotSpokenOfByAProgramWithoutCuda) {
  if (is_built_with_cuda()) GTEST_SKIP() << "built with CUDA";
  setenv(kVisibleGpus, "3", 1);
  EXPECT_EQ(no_gpu_message("this program was built without CUDA"), "this program was built without CUDA");
  unsetenv(kVisibleGpus);
}

}  // namespace
}  // namespace hysteron
