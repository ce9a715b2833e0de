// Bending in an implicit step: the incremental potential of the laws along the pipeline angles -> curvatures
// -> moments -> forces, and its Gauss-Newton stiffness as a product.
#include <cmath>
#include <utility>

#include "sim/bending/bending.h"
#include "sim/bending/stiffness_product.h"

namespace hysteron {

template <class Real, class Device>
void Bending<Real, Device>::make_trials() {
  const int packed = dimension_ * (dimension_ + 1) / 2;
  trial_angle_ = Buffer<Real, Device>(device_, hinges_);
  iterate_angle_ = Buffer<Real, Device>(device_, hinges_);
  hinge_stiffness_ = Buffer<Real, Device>(device_, hinges_);
  tangent_ = Buffer<Real, Device>(device_, static_cast<std::size_t>(elements_) * packed);
  if (rate_.size() == 0) rate_ = Buffer<Real, Device>(device_, hinges_);
  if (viscosity_ > 0) reference_ = Buffer<Real, Device>(device_, hinges_);
  if (viscosity_ > 0) angle_before_ = Buffer<Real, Device>(device_, hinges_);
}

// The moments are saved because measurements before the next step read them.
template <class Real, class Device>
void Bending<Real, Device>::serialise(Archive& archive) {
  bool tries = trial_angle_.size() > 0;
  archive(tries);
  if (tries && trial_angle_.size() == 0) make_trials();
  hysteron::serialise(archive, device_, angle_);
  hysteron::serialise(archive, device_, angle_before_);
  hysteron::serialise(archive, device_, viscous_);
  hysteron::serialise(archive, device_, taken_);
  hysteron::serialise(archive, device_, moment_area_);
  law_->serialise(archive, device_);
}

template <class Real, class Device>
void Bending<Real, Device>::begin_step(const StepFormula& formula) {
  formula_ = formula;
  iterates_ = false;
  if (trial_angle_.size() == 0) make_trials();
  if (viscosity_ <= 0) return;
  const Real now = static_cast<Real>(1 + formula.extrapolation),
             extrapolation = static_cast<Real>(formula.extrapolation);
  const Real *angle = angle_.data(), *before = angle_before_.data();
  Real* reference = reference_.data();
  for_each(
      device_, {"bending reference", total_bytes(angle_, angle_before_, reference_)}, hinges_,
      HYST_KERNEL(int h) { reference[h] = now * angle[h] - extrapolation * before[h]; });
}

template <class Real, class Device>
typename LawLoop<Real, Device>::Trial Bending<Real, Device>::trial_step() const {
  const bool viscous = viscosity_ > 0 && std::isfinite(formula_.beta_dt);
  return {static_cast<Real>(formula_.dt), static_cast<Real>(formula_.beta_dt), viscous ? viscosity_ : Real(0),
          rate_.data()};
}

template <class Real, class Device>
void Bending<Real, Device>::evaluate(const Vec3<Real>* x) {
  AngleRates rates;
  if (viscosity_ > 0) rates = {rate_.data(), reference_.data(), static_cast<Real>(1 / formula_.beta_dt)};
  compute_angles(x, iterates_ ? iterate_angle_.data() : angle_.data(), trial_angle_.data(), rates);
  tried_ = true;
  law_->trial(device_, view(), trial_angle_.data(), trial_step(), moment_area_.data(), energy_.data());
  compute_energy_forces();
}

template <class Real, class Device>
void Bending<Real, Device>::linearise() {
  if (std::exchange(tried_, false)) std::swap(iterate_angle_, trial_angle_);
  iterates_ = true;
  law_->tangents(device_, view(), iterate_angle_.data(), trial_step(), tangent_.data());
}

template <class Real, class Device>
void Bending<Real, Device>::apply_stiffness(const Vec3<Real>* p) {
  compute_rates(p);
  const OperatorView<Real> op = view();
  const Kernel stiffness = {"bending stiffness", op.bytes + total_bytes(tangent_, moment_area_)};
  if (dimension_ == 1)
    for_each(device_, stiffness, elements_,
             ElementMoments<Real, 1>{op, rate_.data(), tangent_.data(), moment_area_.data()});
  else
    for_each(device_, stiffness, elements_,
             ElementMoments<Real, 3>{op, rate_.data(), tangent_.data(), moment_area_.data()});
  compute_energy_forces();
}

// Keeps the forces of the trial: a step's moments do not depend on whether it is committed.
template <class Real, class Device>
void Bending<Real, Device>::accept() {
  if (viscosity_ > 0) std::swap(angle_before_, angle_);
  std::swap(angle_, trial_angle_);
  const auto trial = trial_step();
  law_->commit(device_, view(), angle_.data(), trial.dt, {trial.viscosity, rate_.data(), viscous_.data()},
               moment_area_.data());
}

// Computes for each hinge c^T (A dM/dK) c with its column c of C, summed over the elements.
template <class Real, class Device>
template <int D>
void Bending<Real, Device>::gather_stiffness() {
  const int *start = column_start_.data(), *element = column_element_.data();
  const Real *coefficient = transposed_.data(), *tangent = tangent_.data();
  Real* stiffness = hinge_stiffness_.data();
  for_each(
      device_, {"bending stiffness of hinges", column_bytes() + total_bytes(tangent_, hinge_stiffness_)},
      hinges_, HYST_KERNEL(int h) {
        Real sum = 0;
        for (int j = start[h]; j < start[h + 1]; ++j) {
          const Real* t = tangent + element[j] * (D * (D + 1) / 2);
          for (int a = 0; a < D; ++a)
            for (int b = 0; b <= a; ++b)
              sum += (a == b ? 1 : 2) * coefficient[j * D + a] * *t++ * coefficient[j * D + b];
        }
        stiffness[h] = sum;
      });
}

// Adds each hinge's stiffness times the squares of its gradients.
template <class Real, class Device>
void Bending<Real, Device>::add_stiffness_diagonal(Mat3<Real>* diagonal) {
  dimension_ == 1 ? gather_stiffness<1>() : gather_stiffness<3>();
  const Real* stiffness = hinge_stiffness_.data();
  const int *first = vertex_start_.data(), *item = vertex_item_.data();
  const Real* gradient = gradient_.data();
  const int vertices = static_cast<int>(vertex_start_.size()) - 1;
  const std::size_t blocks = 2 * vertices * sizeof(Mat3<Real>);  // read and written
  for_each(
      device_,
      {"bending diagonal", total_bytes(vertex_start_, vertex_item_, gradient_, hinge_stiffness_) + blocks},
      vertices, HYST_KERNEL(int v) {
        Mat3<Real> block = diagonal[v];
        for (int j = first[v]; j < first[v + 1]; ++j) {
          const Aligned<Real, 8> hinge = Aligned<Real, 8>::of(gradient, item[j] / 4);
          const Vec3<Real> g = angle_gradient(hinge.value, item[j] % 4);
          block += stiffness[item[j] / 4] * g * g.transpose();
        }
        diagonal[v] = block;
      });
}

template class Bending<double, ThisDevice>;
template class Bending<float, ThisDevice>;

}  // namespace hysteron
