#include "sim/solve/cholesky_solver.h"

#include <Eigen/CholmodSupport>

#include "sim/error.h"
#include "sim/solve/assembled_stiffness.h"

namespace hysteron {

namespace {
// Iterations that an old factor may take before a new one is cheaper: a factorisation costs as much as about
// this many products and solves at 18,000 triangles.
constexpr int kOldFactor = 12;
constexpr int kNewFactor = 200;
}  // namespace

template <class Real>
class CholeskySolver<Real>::Factor : public Preconditioner<Real, Cpu> {
 public:
  bool compute(const Eigen::SparseMatrix<double>& lower) {
    if (rows_ != lower.rows()) {
      cholesky_.analyzePattern(lower);
      rows_ = lower.rows();
      right_.resize(rows_);
      bytes_ = static_cast<std::size_t>(cholesky_.cholmod().lnz) * sizeof(double);
    }
    cholesky_.factorize(lower);
    return cholesky_.info() == Eigen::Success;
  }
  void apply(const Vec3<Real>* r, Vec3<Real>* z) override {
    for (Eigen::Index i = 0; i < rows_ / 3; ++i) right_.segment<3>(3 * i) = r[i].template cast<double>();
    const Eigen::VectorXd solution = cholesky_.solve(right_);
    for (Eigen::Index i = 0; i < rows_ / 3; ++i) z[i] = solution.segment<3>(3 * i).template cast<Real>();
  }
  std::size_t bytes() const override { return bytes_; }

 private:
  Eigen::CholmodSupernodalLLT<Eigen::SparseMatrix<double>, Eigen::Lower> cholesky_;
  Eigen::Index rows_ = 0;
  std::size_t bytes_ = 0;
  Eigen::VectorXd right_;
};

template <class Real>
CholeskySolver<Real>::CholeskySolver(Cpu& cpu, const ClothMesh& mesh, const CurvatureOperator& op)
    : cpu_(cpu),
      pcg_(cpu, mesh.vertices()),
      assembled_(std::make_unique<AssembledStiffness>(mesh, op)),
      factor_(std::make_unique<Factor>()) {}

template <class Real>
CholeskySolver<Real>::~CholeskySolver() = default;

template <class Real>
std::size_t CholeskySolver<Real>::bytes() const {
  return pcg_.bytes() + assembled_->bytes() + factor_->bytes();
}

template <class Real>
void CholeskySolver<Real>::factorise(const LinearSystem<Real, Cpu>& system, const char* held) {
  factor_held_.assign(held, held + system.matrix.rows);
  ++factorisations_;
  if (!factor_->compute(assembled_->assemble(cpu_, system.matrix, system.bending->stiffness(), held)))
    throw Error::run("the step's matrix could not be factorised: it holds numbers that are not finite");
}

template <class Real>
PcgOutcome CholeskySolver<Real>::solve(const LinearSystem<Real, Cpu>& system, const char* held,
                                       const Vec3<Real>* rhs, Vec3<Real>* x, double tolerance) {
  LinearSystem<Real, Cpu> with_factor = system;
  with_factor.preconditioner = factor_.get();
  PcgOutcome outcome;
  if (std::equal(factor_held_.begin(), factor_held_.end(), held, held + system.matrix.rows))
    outcome = pcg_.solve(with_factor, held, rhs, nullptr, nullptr, x, tolerance, kOldFactor);
  if (outcome.converged) return outcome;
  factorise(system, held);
  const PcgOutcome again = pcg_.solve(with_factor, held, rhs, nullptr, nullptr, x, tolerance, kNewFactor);
  return {outcome.iterations + again.iterations, again.converged};
}

template class CholeskySolver<double>;
template class CholeskySolver<float>;

}  // namespace hysteron
