// The step of `implicit` and `bdf2`: one solve for the whole step, in halves where that fails.
#include <string>

#include "sim/error.h"
#include "sim/solve/stepper.h"

namespace hysteron {

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
  const NewtonOutcome outcome = implicit_->solve(state, h);
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
