// The step of `implicit` and `bdf2`: one solve for the whole step, in halves where that fails.
#include <string>

#include "sim/error.h"
#include "sim/solve/stepper.h"

namespace hysteron {

// Statics let the weight grow over the scene's `ramp`; with it, nothing moves through states that the cloth
// would not pass.
template <class Real, class Device>
double Stepper<Real, Device>::load_share(double time) const {
  if (scene_.integrator != "quasi-static" || !(scene_.ramp > time)) return 1;
  return time / scene_.ramp;
}

template <class Real, class Device>
std::vector<Eigen::Vector3d> Stepper<Real, Device>::handle_forces() {
  std::vector<Eigen::Vector3d> result;
  if (!implicit_) return result;
  for (const auto& f : implicit_->handle_forces(held_.data())) result.push_back(f.template cast<double>());
  return result;
}

template <class Real, class Device>
void Stepper<Real, Device>::implicit_interval(double start, double h, int halvings) {
  constexpr int kMostHalvings = 10;
  hold(start, static_cast<Real>(h));
  if (contact_) {
    contact_->move(start, start + h);
    remember_positions();
  }
  const VertexState<Real> state{x_.data(), v_.data(), held_.data(), mass_.data()};
  clock_.begin(Stage::solve);
  const NewtonOutcome outcome = implicit_->solve(state, h, load_share(start + h));
  clock_.end(Stage::solve);
  newton_iterations_ += outcome.iterations;
  solver_iterations_ += outcome.linear_iterations;
  if (!outcome.converged) {
    if (halvings == kMostHalvings)
      throw Error::run("no equilibrium of the step at t = " + std::to_string(start) +
                       " s was found, even in " + std::to_string(1 << kMostHalvings) +
                       " parts: an unbalanced force of " + std::to_string(outcome.residual) +
                       " N remains (weight " + std::to_string(outcome.load) + " N)");
    ++retried_steps_;
    implicit_interval(start, h / 2, halvings + 1);
    implicit_interval(start + h / 2, h / 2, halvings + 1);
    return;
  }
  clock_.begin(Stage::history);
  implicit_->accept(state, ledger_.data());
  clock_.end(Stage::history);
  if (!contact_) return;
  clock_.begin(Stage::contact);
  contact_->commit(x_.data(), before_.data());
  clock_.end(Stage::contact);
}

template class Stepper<double, ThisDevice>;
template class Stepper<float, ThisDevice>;

}  // namespace hysteron
