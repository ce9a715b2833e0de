// Tests that run on a GPU: skipped where there is none.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "sim/time/back_end.h"
#include "tests/sim/base/case_name.h"

namespace hysteron::test {

class OnGpu : public testing::Test {
 protected:
  void SetUp() override {
    std::string reason;
    if (gpu_count(reason) == 0) GTEST_SKIP() << "no GPU: " << reason;
  }
};

template <class Case>
class OnGpuWith : public OnGpu, public testing::WithParamInterface<Case> {};

// Cases are names of devices: those of CPUs begin with "cpu".
class OnEachDevice : public OnGpuWith<const char*> {
 protected:
  void SetUp() override {
    if (on_gpu()) OnGpu::SetUp();
  }
  static bool on_gpu() { return !std::string(GetParam()).starts_with("cpu"); }
};

}  // namespace hysteron::test
