// Linear systems on a mesh, solved on one device with values of the host.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "sim/mesh/cloth_mesh.h"

namespace hysteron::test {

struct LinearSolve {
  std::vector<Eigen::Vector3d> x;
  double residual;  // norm of rhs - A x over that of rhs, of the rows that are not held
  int iterations;
  bool converged;
  long loops;  // ordered while it was solved
};

enum class LinearMethod { block_jacobi, multigrid, dissection };

class LinearSolves {
 public:
  virtual ~LinearSolves() = default;

  // Springs along the edges of the mesh, in steps of a mass for each vertex; the first vertex is held. Solved
  // `times` times over from zero; the last one counts.  by_batches: a GPU asks the host how to go on.
  virtual LinearSolve solve(const ClothMesh& mesh, LinearMethod method, double tolerance,
                            bool by_batches = false, int times = 1) = 0;
  // The whole matrix inverted densely and applied to the load; without_first: nothing moves the first vertex.
  virtual LinearSolve invert(const ClothMesh& mesh, bool without_first) = 0;
};

std::unique_ptr<LinearSolves> cpu_linear_solves();
std::unique_ptr<LinearSolves> gpu_linear_solves();  // nullptr in a build without CUDA

}  // namespace hysteron::test
