// Tests use these functions of dense matrices.  Eigen's solvers take g++ ten seconds, so that they are
// compiled once for all tests.
#pragma once

#include <Eigen/Core>

namespace hysteron::test {

// Returns the eigenvalues of a symmetric matrix, in increasing order.
Eigen::VectorXd eigenvalues(const Eigen::MatrixXd& symmetric);

// Returns the nearest positive semidefinite matrix to a symmetric one (Higham 1988): without its negative
// eigenvalues.
Eigen::MatrixXd positive_part(const Eigen::MatrixXd& symmetric);

// Returns x of a x = b.
Eigen::VectorXd solution(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

}  // namespace hysteron::test
