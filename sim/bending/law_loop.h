// One law applied to all bending elements of a cloth: the loop that commits history.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sim/bending/curvature_operator.h"
#include "sim/bending/law.h"
#include "sim/bending/law_parameters.h"
#include "sim/device/device.h"

namespace hysteron {

// The curvature operator on a device, as loops see it.
template <class Real>
struct OperatorView {
  int elements;
  const Real* area;         // [m^2]
  const int* start;         // rows: elements
  const int* hinge;         // items
  const Real* coefficient;  // D per item [1/m]

  template <int D>
  HYST_HD Vec<Real, D> curvature(int i, const Real* angle_change) const {
    Vec<Real, D> k = Vec<Real, D>::Zero();
    for (int j = start[i]; j < start[i + 1]; ++j) {
      const Real a = angle_change[hinge[j]];
      for (int d = 0; d < D; ++d) k[d] += coefficient[j * D + d] * a;
    }
    return k;
  }
};

template <class Real, class Device>
class LawLoop {
 public:
  virtual ~LawLoop() = default;
  // Accepts the angles: moment_area = A M (D per element), history updated, dissipation added [J].
  // viscosity [N m s] > 0 adds a moment viscosity * C angle_rate and adds its work over dt [s] to viscous
  // [J].
  struct Viscous {
    Real viscosity, dt;
    const Real* angle_rate;  // per hinge [rad/s]
    double* lost;            // per element [J]
  };
  virtual void commit(Device& device, const OperatorView<Real>& op, const Real* angle_change,
                      const Viscous& viscous, Real* moment_area) = 0;
  // Recoverable energy of each element at the accepted state [J] (a measurement; changes nothing).
  virtual void stored(Device& device, const OperatorView<Real>& op, const Real* angle_change,
                      double* energy) = 0;
  // D curvature components of each element: with zero moment on the recovery branch [1/m].
  virtual void residual(Device& device, int elements, Real* curvature) = 0;
  // How far the friction is used, 0 (none) to 1 (sliding), for each element; 0 for laws without history.
  virtual void slip(Device& device, const OperatorView<Real>& op, const Real* angle_change, Real* share) = 0;
  virtual double largest_stiffness() const = 0;  // bound on dM/dK [N m]
  virtual bool has_history() const = 0;
  virtual std::size_t history_bytes() const = 0;
  virtual const double* dissipated() const = 0;  // per element [J]; null where the law loses nothing
};

// Law `name` for D = 1 (hinge) or D = 3 (shape; laws of scalar form run along four material directions).
// Error::request for unknown names and parameters that the law does not have.
template <class Real, class Device>
std::unique_ptr<LawLoop<Real, Device>> make_law_loop(Device& device, const std::string& name,
                                                     const LawParameters& parameters,
                                                     const VirginCurve& curve, int dimension, int elements);

// Its two halves, compiled apart.
template <class Real, class Device>
std::unique_ptr<LawLoop<Real, Device>> make_hinge_law(Device& device, const std::string& name,
                                                      const HysteresisChoice& choice,
                                                      const VirginCurve& curve, int elements);
template <class Real, class Device>
std::unique_ptr<LawLoop<Real, Device>> make_shape_law(Device& device, const std::string& name,
                                                      const HysteresisChoice& choice,
                                                      const VirginCurve& curve, int elements);

}  // namespace hysteron
