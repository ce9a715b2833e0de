// Least squares where they cannot begin.
#include "sim/identification/least_squares.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hysteron {
namespace {

using Eigen::VectorXd;

// Users are told by whoever asked, not by a library's log.
TEST(LeastSquares, ThatCannotBeginSayNothingAndDoNotConverge) {
  const VectorXd wide = VectorXd::Constant(2, 10);
  const Residuals none = [](const VectorXd& p) {
    return VectorXd(VectorXd::Constant(4, std::nan("")) + 0 * p[0] * VectorXd::Ones(4));
  };
  const Residuals line = [](const VectorXd& p) {
    return VectorXd(VectorXd::LinSpaced(4, 0, 3) * p[0] + VectorXd::Ones(4) * p[1]);
  };
  testing::internal::CaptureStderr();
  EXPECT_FALSE(minimize(none, VectorXd::Zero(2), -wide, wide).converged);
  EXPECT_FALSE(minimize(line, VectorXd::Zero(2), wide, -wide).converged);
  EXPECT_FALSE(minimize(line, VectorXd::Constant(2, std::nan("")), -wide, wide).converged);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace hysteron
