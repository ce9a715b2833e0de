#include "sim/bending/bending_elements.h"

#include "sim/bending/stiffness_product.h"

namespace hysteron {

template <class Device>
FloatBending<Device>::FloatBending(Device& device, const Bending<double, Device>& bending)
    : device_(device), bending_(bending) {
  const BendingFactors<double> factors = bending.factors();
  const std::size_t d = factors.dimension, elements = factors.elements, hinges = factors.hinges;
  const auto reals = [&](std::size_t count) { return Buffer<float, Device>(device, count); };
  coefficient_ = reals(d * factors.items);
  transposed_ = reals(d * factors.items);
  gradient_ = reals(8 * hinges);
  tangent_ = reals(d * (d + 1) / 2 * elements);
  rate_ = reals(hinges);
  moment_area_ = reals(d * elements);
  force_ = Buffer<Vec3<float>, Device>(device, 4 * hinges);
  round_all(device, "in float: bending operator", coefficient_.size(), factors.coefficient,
            coefficient_.data());
  round_all(device, "in float: bending operator", transposed_.size(), factors.transposed, transposed_.data());
}

template <class Device>
void FloatBending<Device>::round() {
  const BendingFactors<double> factors = bending_.factors();
  round_all(device_, "in float: bending gradients", gradient_.size(), factors.gradient, gradient_.data());
  round_all(device_, "in float: bending tangents", tangent_.size(), factors.tangent, tangent_.data());
}

template <class Device>
GatheredForces<float> FloatBending<Device>::apply(const Vec3<float>* p) {
  const BendingFactors<double> factors = bending_.factors();
  const std::size_t read = factors.hinges * sizeof(Eigen::Vector4i) + bending_.vertices() * sizeof(*p);
  for_each(device_, {"in float: bending rates", read + total_bytes(gradient_, rate_)}, factors.hinges,
           HingeRates<float>{factors.corner, gradient_.data(), p, rate_.data()});
  factors.dimension == 1 ? apply_moments<1>(factors) : apply_moments<3>(factors);
  const GatheredForces<double> rows = bending_.forces();
  return {rows.start, rows.item, force_.data()};
}

template <class Device>
template <int D>
void FloatBending<Device>::apply_moments(const BendingFactors<double>& factors) {
  const std::size_t items = factors.items * sizeof(int), rows = (factors.elements + 1) * sizeof(int),
                    columns = (factors.hinges + 1) * sizeof(int);
  const OperatorView<float> op{factors.elements, nullptr, factors.start, factors.hinge, coefficient_.data()};
  for_each(device_,
           {"in float: bending stiffness",
            rows + items + total_bytes(coefficient_, rate_, tangent_, moment_area_)},
           factors.elements,
           ElementMoments<float, D>{op, rate_.data(), tangent_.data(), moment_area_.data()});
  for_each(device_,
           {"in float: bending forces",
            columns + items + total_bytes(transposed_, moment_area_, gradient_, force_)},
           factors.hinges,
           HingeForces<float, D>{factors.column_start, factors.column_element, transposed_.data(),
                                 moment_area_.data(), gradient_.data(), force_.data()});
}

// Counts the bytes of forces() that float saves over double.
template <class Device>
std::size_t FloatBending<Device>::force_bytes() const {
  return bending_.force_bytes() - force_.bytes();
}

template class FloatBending<ThisDevice>;

}  // namespace hysteron
