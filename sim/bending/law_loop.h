// Applies one law to all bending elements of a cloth and commits its history.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sim/bending/choices.h"
#include "sim/bending/curvature_operator.h"
#include "sim/bending/laws/law.h"
#include "sim/bending/laws/law_parameters.h"
#include "sim/device/archive_buffer.h"

namespace hysteron {

// The curvature operator on a device, as loops read it.
template <class Real>
struct OperatorView {
  int elements;
  const Real* area;                 // one per element [m^2]
  const int* start;                 // elements + 1 row starts
  const int* hinge;                 // one per item
  const Real* coefficient;          // D per item [1/m]
  const Real* direction = nullptr;  // 2 per element (CurvatureOperator); null: elements have none
  const Real* elastic = nullptr;    // D per element (CurvatureOperator) [N m]; null: none beside the law
  std::size_t bytes = 0;            // bytes of these arrays and a number per hinge; 0: not counted

  template <int D>
  HYST_HD Vec<Real, D> curvature(int i, const Real* angle_change) const {
    Vec<Real, D> k = Vec<Real, D>::Zero();
    for (int j = start[i]; j < start[i + 1]; ++j) {
      const Real a = angle_change[hinge[j]];
      for (int d = 0; d < D; ++d) k[d] += coefficient[j * D + d] * a;
    }
    return k;
  }
  template <int D>
  HYST_HD Vec<Real, D> elastic_beside(int i) const {
    Vec<Real, D> e;
    for (int d = 0; d < D; ++d) e[d] = elastic[i * D + d];
    return e;
  }
};

// Measures of a law.  One loop serves all of them: each loop would take nvcc as long as a step of the law.
enum class LawMeasure {
  stored_energy,       // recoverable [J]
  residual_curvature,  // curvature of zero moment on the recovery branch [1/m]
  // This says how far friction or plasticity is used, from 0 (not) to 1 (slides, yields); 0 for laws without
  // history.
  slip
};

// A law's loop over a cloth's elements.  Pointers are to arrays on the device; angle_change has one number
// per hinge [rad].
template <class Real, class Device>
class LawLoop {
 public:
  virtual ~LawLoop() = default;
  // Viscosity [N m s] > 0 adds a moment viscosity * C angle_rate, and its work over a step to lost [J].
  struct Viscous {
    Real viscosity;
    const Real* angle_rate;  // per hinge [rad/s]
    double* lost;            // per element [J]
  };
  // Accepts the angles after a step of dt [s]: sets moment_area = A M (D per element [N m^2]), updates
  // history and adds dissipation [J].
  virtual void commit(Device& device, const OperatorView<Real>& op, const Real* angle_change, Real dt,
                      const Viscous& viscous, Real* moment_area) = 0;
  // Parameters of a trial step from the accepted history, which is not changed. angle_rate was formed with
  // `beta_dt`, the inverse of its derivative by the angle.
  struct Trial {
    Real dt, beta_dt;        // [s]
    Real viscosity;          // [N m s]
    const Real* angle_rate;  // per hinge [rad/s]; null without viscosity
  };
  // Sets moment_area = A M (D per element [N m^2]) and energy = A times the incremental potential, viscosity
  // included (one per element [J]).
  virtual void trial(Device& device, const OperatorView<Real>& op, const Real* angle_change,
                     const Trial& trial, Real* moment_area, double* energy) = 0;
  // Sets tangent_area = A dM/dK, positive semidefinite: the lower triangle row by row, D (D + 1)/2 numbers
  // per element [N m^3].
  virtual void tangents(Device& device, const OperatorView<Real>& op, const Real* angle_change,
                        const Trial& trial, Real* tangent_area) = 0;
  // Carries out a command on the elements with chosen[i] != 0 and adds the recoverable energy that it takes
  // away (or gives, if negative) to taken[i] [J].  Laws without history ignore it.
  virtual void command(Device& device, const OperatorView<Real>& op, const Real* angle_change,
                       CommandKind kind, const char* chosen, double* taken) = 0;
  // Evaluates a measure of each element at the accepted state, which it does not change, and writes D
  // numbers per element for a curvature, else one.
  virtual void measure(Device& device, const OperatorView<Real>& op, const Real* angle_change,
                       LawMeasure what, double* result) = 0;
  virtual double largest_stiffness() const = 0;  // bound on dM/dK [N m]
  virtual bool has_history() const = 0;
  virtual std::size_t history_bytes() const = 0;
  virtual void serialise(Archive& archive, Device& device) = 0;  // saves or loads history and losses
  virtual const double* dissipated() const = 0;  // per element [J]; null where the law loses nothing
  virtual const double* relaxed() const = 0;     // the part that branches have lost; null without branches
};

// Makes the law for D = 1 (hinge) or D = 3 (shape; laws of scalar form run along four material directions).
template <class Real, class Device>
std::unique_ptr<LawLoop<Real, Device>> make_law_loop(Device& device, const LawParams& choice, int dimension,
                                                     int elements);

// Makes a law of one group (every_law.h), which is compiled apart; null for a law of another group.
template <class Group, class Real, class Device, int D>
std::unique_ptr<LawLoop<Real, Device>> make_group_loop(Device&, const LawParams&, int elements);

}  // namespace hysteron
