// Linear systems on the CPU: conjugate gradients preconditioned by a Cholesky factor of an earlier matrix,
// which is factorised again when that takes too many iterations.
#pragma once

#include <memory>

#include "sim/scene/scene.h"
#include "sim/solve/linear_solver.h"

namespace hysteron {

class AssembledStiffness;

// Factor of the assembled matrix (CHOLMOD, supernodal; Chen, Davis, Hager & Rajamanickam 2008), in double
// whatever Real is.
template <class Real>
class CholeskySolver : public LinearSolver<Real, Cpu> {
 public:
  CholeskySolver(Cpu& cpu, const ClothMesh& mesh, const CurvatureOperator& op);
  ~CholeskySolver() override;
  PcgOutcome solve(const LinearSystem<Real, Cpu>& system, const char* held, const Vec3<Real>* rhs,
                   Vec3<Real>* x, double tolerance) override;
  std::size_t bytes() const override;
  int factorisations() const { return factorisations_; }

 private:
  class Factor;
  void factorise(const LinearSystem<Real, Cpu>& system, const char* held);

  Cpu& cpu_;
  Pcg<Real, Cpu> pcg_;
  std::unique_ptr<AssembledStiffness> assembled_;
  std::unique_ptr<Factor> factor_;
  std::vector<char> factor_held_;
  int factorisations_ = 0;
};

}  // namespace hysteron
