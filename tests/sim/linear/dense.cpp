#include "tests/sim/linear/dense.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

namespace hysteron::test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd eigenvalues(const MatrixXd& symmetric) {
  return Eigen::SelfAdjointEigenSolver<MatrixXd>(symmetric).eigenvalues();
}

MatrixXd positive_part(const MatrixXd& symmetric) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> principal(symmetric);
  return principal.eigenvectors() * principal.eigenvalues().cwiseMax(0).asDiagonal() *
         principal.eigenvectors().transpose();
}

VectorXd solution(const MatrixXd& a, const VectorXd& b) { return a.partialPivLu().solve(b); }

}  // namespace hysteron::test
