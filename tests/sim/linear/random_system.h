// Matrices of tests, and what a dense solve makes of them.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <random>
#include <vector>

#include "sim/linear/pcg.h"
#include "sim/mesh/builders.h"
#include "tests/sim/linear/dense.h"

namespace hysteron::test {

using Field = std::vector<Vec3<double>>;

inline double norm(const Field& v) {
  double sum = 0;
  for (const Eigen::Vector3d& x : v) sum += x.squaredNorm();
  return std::sqrt(sum);
}

inline double difference(Field a, const Field& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] -= b[i];
  return norm(a);
}

// The system is a symmetric matrix on a mesh's edges with random blocks off its diagonal, `diagonal` times
// the identity on it, and a random right-hand side, the same each time; without softening, and with nothing
// held at first.
struct RandomSystem {
  Cpu cpu{1};
  ClothMesh mesh = make_rectangle(0.3, 0.1, 120, MeshFamily::random, 1);
  BlockRows<double, Cpu> rows{cpu, mesh};
  std::vector<double> softening, softening_diagonal;
  std::vector<char> held;
  Field rhs;

  explicit RandomSystem(double diagonal) : softening_diagonal(n(), 0), held(n(), 0), rhs(n()) {
    const BlockRowsView<double> view = rows.view();
    softening.assign(view.row_ptr[view.rows], 0);
    std::mt19937 generator(3);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (int i = 0; i < n(); ++i) {
      view.diagonal[i] = diagonal * Mat3<double>::Identity();
      rhs[i] = {uniform(generator), uniform(generator), uniform(generator)};
      for (int j = view.row_ptr[i]; j < view.row_ptr[i + 1]; ++j) {
        if (view.col[j] > i) continue;
        Mat3<double> block;
        for (double& b : block.reshaped()) b = uniform(generator);
        view.off_diagonal[j] = block;
        view.off_diagonal[rows.slot(view.col[j], i)] = block.transpose();
      }
    }
  }

  int n() const { return mesh.vertices(); }

  LinearSystem<double, Cpu> linear() {
    LinearSystem<double, Cpu> system{rows.view()};
    system.softening = {softening.data(), softening_diagonal.data()};
    return system;
  }

  Eigen::MatrixXd dense() {
    using Eigen::Matrix3d;
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(3 * n(), 3 * n());
    const BlockRowsView<double> view = rows.view();
    for (int i = 0; i < n(); ++i) {
      a.block<3, 3>(3 * i, 3 * i) = view.diagonal[i] + softening_diagonal[i] * Matrix3d::Identity();
      for (int j = view.row_ptr[i]; j < view.row_ptr[i + 1]; ++j)
        a.block<3, 3>(3 * i, 3 * view.col[j]) = view.off_diagonal[j] + softening[j] * Matrix3d::Identity();
    }
    return a;
  }
  // Returns the solution of this matrix, with held rows at zero.
  Field solution_of(Eigen::MatrixXd a) const {
    Eigen::VectorXd b(3 * n());
    for (int i = 0; i < n(); ++i) {
      b.segment<3>(3 * i) = held[i] ? Eigen::Vector3d(0, 0, 0) : rhs[i];
      if (!held[i]) continue;
      a.middleRows<3>(3 * i).setZero();
      a.block<3, 3>(3 * i, 3 * i).setIdentity();
    }
    const Eigen::VectorXd x = test::solution(a, b);
    Field result;
    for (int i = 0; i < n(); ++i) result.emplace_back(x.segment<3>(3 * i));
    return result;
  }
};

}  // namespace hysteron::test
