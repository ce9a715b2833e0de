// Steps of `implicit`, `bdf2` and `quasi-static`: one solve for the whole step, in halves where that fails,
// or in as many parts as an error tolerance asks for.
#include <algorithm>
#include <cmath>
#include <string>

#include "sim/base/error.h"
#include "sim/time/stepper.h"

namespace hysteron {

namespace {
constexpr int kMostHalvings = 12;
// Of adaptive steps: aim below the tolerance, and change slowly (Hairer, Norsett & Wanner 1993, II.4).
constexpr double kAim = 0.9, kFastestGrowth = 2, kFastestFall = 0.3;
}  // namespace

template <class Real, class Device>
void Stepper<Real, Device>::become_static() {
  if (!all_implicit_)
    throw Error::request("integrator = " + scene_.integrator +
                         " has no equilibrium solve: use implicit | bdf2 | quasi-static");
  implicit_->become_static(scene_);
  scene_.tolerance = 0;  // of steps in time
}

template <class Real, class Device>
std::vector<Eigen::Vector3d> Stepper<Real, Device>::handle_forces() {
  std::vector<Eigen::Vector3d> result;
  if (!implicit_) return result;
  for (const auto& f : implicit_->handle_forces(held_.data())) result.push_back(f.template cast<double>());
  return result;
}

// Statics let the weight grow over the scene's `ramp` and fall over its `unload`: the cloth passes through
// states of equilibrium.
template <class Real, class Device>
double Stepper<Real, Device>::load_share(double time) const {
  if (scene_.integrator != "quasi-static") return 1;
  if (scene_.ramp > time) return time / scene_.ramp;
  return scene_.unload > 0 ? std::max(0.0, 1 - (time - scene_.ramp) / scene_.unload) : 1;
}

template <class Real, class Device>
NewtonOutcome Stepper<Real, Device>::try_step(double start, double h) {
  hold(start, static_cast<Real>(h));
  if (contact_) contact_->move(start, start + h);
  if (contact_ || self_contact_) remember_positions();
  clock_.begin(Stage::solve);
  const NewtonOutcome outcome = implicit_->solve(vertex_state(), h, load_share(start + h));
  clock_.end(Stage::solve);
  newton_iterations_ += outcome.iterations;
  solver_iterations_ += outcome.linear_iterations;
  unbalanced_steps_ += outcome.unbalanced;
  return outcome;
}

template <class Real, class Device>
void Stepper<Real, Device>::take_step(double end) {
  clock_.begin(Stage::history);
  implicit_->accept(vertex_state(), ledger_.data());
  clock_.end(Stage::history);
  ++substeps_taken_;
  if (self_contact_) self_contact_->commit(x_.data(), before_.data());
  if (contact_) commit_contact(end);
}

template <class Real, class Device>
void Stepper<Real, Device>::implicit_interval(double start, double h, int halvings) {
  const NewtonOutcome outcome = try_step(start, h);
  if (outcome.converged) return take_step(start + h);
  if (halvings == kMostHalvings) refuse_unbalanced(start, h, outcome);
  ++retried_steps_;
  implicit_interval(start, h / 2, halvings + 1);
  implicit_interval(start + h / 2, h / 2, halvings + 1);
}

// Parts whose estimated error stays below the tolerance; one that does not is taken again, shorter.
template <class Real, class Device>
void Stepper<Real, Device>::adaptive_interval(double start) {
  const double end = start + scene_.step, least = scene_.step / (1 << kMostHalvings);
  if (part_ <= 0) part_ = scene_.step / 16;
  for (double now = start; end - now > least / 2;) {
    const double h = (end - now) / std::ceil((end - now) / part_ * (1 - 1e-9));
    const NewtonOutcome outcome = try_step(now, h);
    const double error = outcome.converged ? implicit_->local_error(vertex_state()) : 1e30;
    const double wanted =
        h * std::clamp(kAim * std::pow(scene_.tolerance / error, 1 / implicit_->error_order()), kFastestFall,
                       kFastestGrowth);
    if (outcome.converged && error <= scene_.tolerance) {
      take_step(now + h);
      now += h;
    } else if (wanted < least) {
      throw Error::run("tolerance = " + std::to_string(scene_.tolerance) + " m cannot be met at t = " +
                       std::to_string(now) + " s with steps of " + std::to_string(least) + " s or more");
    } else {
      ++retried_steps_;
    }
    part_ = wanted;
  }
}

// The same for semi-implicit steps, which cannot be taken back: the error of one sets the length of the next.
template <class Real, class Device>
void Stepper<Real, Device>::adaptive_stages(double start) {
  const double end = start + scene_.step, largest = limits_.substep,
               least = scene_.step / (1 << kMostHalvings);
  if (part_ <= 0) part_ = std::min(largest, scene_.step / 16);
  for (double now = start; end - now > least / 2;) {
    const double h = (end - now) / std::ceil((end - now) / std::min(part_, largest) * (1 - 1e-9));
    stage(now, static_cast<Real>(h));
    ++substeps_taken_;
    now += h;
    // x_n + h v_n misses by h dv, of which half is the error of a first-order step.
    const double error = h * change_size() / 2;
    part_ = std::max(
        least, h * std::clamp(kAim * std::sqrt(scene_.tolerance / error), kFastestFall, kFastestGrowth));
  }
}

// Root mean square of the last stage's velocity change, by mass [m/s].
template <class Real, class Device>
double Stepper<Real, Device>::change_size() {
  const Real* mass = mass_.data();
  const char* held = held_.data();
  const Vec3<Real>* dv = change_.data();
  double* size = size_.data();
  for_each_sum<2>(
      *device_, "velocity change", vertices_,
      HYST_KERNEL(int i, Sums<2>& sums) {
        sums.term[1] += static_cast<double>(mass[i]);
        if (!held[i]) sums.term[0] += static_cast<double>(mass[i] * dv[i].squaredNorm());
      },
      HYST_KERNEL(const Sums<2>& total) { *size = total.term[0] / total.term[1]; });
  return std::sqrt(size_.download()[0]);
}

template class Stepper<double, ThisDevice>;
template class Stepper<float, ThisDevice>;

}  // namespace hysteron
