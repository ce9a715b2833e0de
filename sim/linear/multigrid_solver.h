// Conjugate gradients preconditioned by multigrid, for Newton's method.
#pragma once

#include "sim/linear/linear_solver.h"
#include "sim/linear/multigrid.h"

namespace hysteron {

template <class Real, class Device>
class MultigridSolver : public LinearSolver<Real, Device> {
 public:
  // Takes the rigidity, the largest slope of the bending law [N m]; the systems are mass/step^2 + stiffness
  // [N/m].
  MultigridSolver(Device& device, const ClothMesh& mesh, const RestHierarchy& hierarchy, double rigidity)
      : multigrid_(device, mesh, hierarchy),
        pcg_(device, mesh.vertices(), true),
        rigidity_(static_cast<Real>(rigidity)) {}

  PcgOutcome solve(const LinearSystem<Real, Device>& system, const char* held, const Vec3<Real>* rhs,
                   Vec3<Real>* x, double tolerance) override {
    constexpr int kMaxIterations = 20000;
    const bool renews = is_stale_;
    if (renews)
      multigrid_.rebuild(system.matrix, system.rest_diagonal, rigidity_, held);
    else
      multigrid_.renew_finest(system.matrix, system.rest_diagonal);
    LinearSystem<Real, Device> preconditioned = system;
    preconditioned.preconditioner = &multigrid_;
    const PcgOutcome outcome =
        pcg_.solve(preconditioned, held, rhs, nullptr, nullptr, x, {tolerance, kMaxIterations});
    if (renews) iterations_when_new_ = outcome.iterations / decades(tolerance);
    is_stale_ =
        outcome.iterations > iterations_when_new_ * decades(tolerance) + multigrid_.refactor_threshold();
    return outcome;
  }
  void begin() override { is_stale_ = true; }
  // The levels need no saving: they are made anew after begin().
  void serialise(Archive& archive) override { pcg_.serialise(archive); }
  std::size_t bytes() const override { return multigrid_.bytes() + pcg_.bytes(); }

 private:
  Multigrid<Real, Device> multigrid_;
  Pcg<Real, Device> pcg_;
  Real rigidity_;
  bool is_stale_ = true;            // the coarse levels have to be made anew
  double iterations_when_new_ = 0;  // of the solve after that, for each decade of its tolerance
};

}  // namespace hysteron
