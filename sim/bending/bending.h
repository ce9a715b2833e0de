// Computes the bending of a whole cloth on one device: angles -> curvatures -> law -> torques -> forces.
#pragma once

#include <memory>

#include "sim/base/step_formula.h"
#include "sim/bending/angle.h"
#include "sim/bending/choices.h"
#include "sim/bending/law_loop.h"
#include "sim/linear/gathered_forces.h"
#include "sim/mesh/cloth_mesh.h"

namespace hysteron {

// The factors of the stiffness J^T C^T T C J [N/m], in arrays on the device.
template <class Real>
struct BendingFactors {
  int elements, hinges, items, dimension;    // `items` counts the entries of C; dimension: D
  const int *start, *hinge;                  // C by rows: elements + 1 starts, `items` hinges
  const Real* coefficient;                   // items x D [1/m]
  const int *column_start, *column_element;  // C by columns: hinges + 1 starts, `items` elements
  const Real* transposed;                    // items x D, column by column [1/m]
  const Eigen::Vector4i* corner;             // hinges x (p0, p1, p2, p3)
  // J: hinges x 8 (angle.h); T = A dM/dK: elements x D (D + 1)/2 [N m^3].
  const Real *gradient, *tangent;
};

template <class Real, class Device>
class Bending {
 public:
  Bending(Device& device, const ClothMesh& mesh, const CurvatureOperator& op,
          std::unique_ptr<LawLoop<Real, Device>> law, ForceConvention convention, double viscosity);

  // Accepts the positions (n vertices [m]): continues angles, commits history, and leaves hinge forces ready
  // in forces().  `velocity` (n vertices [m/s]) acts through the viscosity alone, whose loss is that over the
  // coming dt [s].
  void commit(const Vec3<Real>* position, const Vec3<Real>* velocity, Real dt);
  GatheredForces<Real> forces() const { return {vertex_start_.data(), vertex_item_.data(), force_.data()}; }

  // Implicit steps (bending_implicit.cpp). begin_step() sets the formula of rates, (angle -
  // reference)/beta_dt with the reference (1 + e) times the accepted angle minus e times the one accepted
  // before it, e the extrapolation. evaluate() tries a step to `position`; accept() commits the one that was
  // tried last.  Angles are continued from where linearise() was called last, so that they follow Newton's
  // iterates: within a step a hinge may turn by more than half a turn, and its energy has no jump there.
  void begin_step(const StepFormula& formula);
  void evaluate(const Vec3<Real>* position);  // fills forces() and energies(); position: n vertices [m]
  const double* energies() const { return energy_.data(); }  // incremental potential per element [J]
  void linearise();  // forms the tangents where evaluate() was called last
  // Sets forces() = -K p [N], p n vertices [m], with K the Gauss-Newton stiffness J^T C^T (A dM/dK) C J of
  // the last linearise().
  void apply_stiffness(const Vec3<Real>* p);
  // Adds the diagonal blocks of K (n blocks [N/m]), without the terms that couple several hinges of one
  // element.
  void add_stiffness_diagonal(Mat3<Real>* diagonal);
  void accept();
  BendingFactors<Real> factors() const {  // K's, where linearise() was called last
    return {elements_,
            hinges_,
            static_cast<int>(row_hinge_.size()),
            dimension_,
            row_start_.data(),
            row_hinge_.data(),
            coefficient_.data(),
            column_start_.data(),
            column_element_.data(),
            transposed_.data(),
            corner_.data(),
            gradient_.data(),
            tangent_.data()};
  }

  // Saves or loads the state that outlives a step.  Forces and trials do not: every step begins with
  // evaluate() or commit().
  void serialise(Archive& archive);

  // Irons or edits the elements i with chosen[i] != 0 at the last accepted state.
  void command(CommandKind kind, const std::vector<char>& chosen);

  // Measurements of the last accepted state; they change nothing.
  double stored_energy();  // [J]
  // Energies since the start [J]: lost by the law, the part of it that relaxing branches have lost, lost by
  // viscosity, and recoverable energy that commands have taken.
  double dissipated_energy() { return sum_over_elements(law_->dissipated()); }
  double relaxed_energy() { return sum_over_elements(law_->relaxed()); }
  double viscous_loss() { return sum_over_elements(viscous_.data()); }
  double taken_by_commands() { return sum_over_elements(taken_.data()); }
  // Per element: D curvatures [1/m], D moments [N] with viscosity, D residual curvatures [1/m], and a slip
  // from 0 to 1.
  std::vector<double> curvature();
  std::vector<double> moment();
  std::vector<double> residual_curvature() {
    return geometric(measured(LawMeasure::residual_curvature, dimension_));
  }
  std::vector<double> slip() { return measured(LawMeasure::slip, 1); }
  const std::vector<double>& metric() const { return metric_; }
  int dimension() const { return dimension_; }
  int elements() const { return elements_; }
  const LawLoop<Real, Device>& law() const { return *law_; }
  int vertices() const { return static_cast<int>(vertex_start_.size()) - 1; }
  std::size_t bytes() const;  // does not count the law's history
  std::size_t force_bytes() const { return total_bytes(vertex_start_, vertex_item_, force_); }  // in forces()

  // Asks for the hinges' rates (angle - reference) * inverse_time.
  struct AngleRates {
    Real* rate = nullptr;             // one per hinge [rad/s]; null: not asked for
    const Real* reference = nullptr;  // one per hinge [rad]
    Real inverse_time = 0;            // [1/s]
  };
  // The parts of commit(), with one angle per hinge [rad]; public because nvcc allows no device lambda in a
  // private member function.
  void compute_angles(const Vec3<Real>* position, const Real* previous, Real* change, AngleRates rates = {});
  void compute_rates(const Vec3<Real>* velocity);
  void compute_forces(const Vec3<Real>* position);
  void compute_energy_forces();  // uses the present gradients and moments
  template <int D>
  void gather_torques();
  template <int D>
  void gather_stiffness();
  typename LawLoop<Real, Device>::Trial trial_step() const;

 private:
  void make_trials();
  OperatorView<Real> view() const;
  std::size_t vertex_bytes() const { return vertices() * sizeof(Vec3<Real>); }
  std::size_t element_bytes() const {
    return total_bytes(area_, row_start_, row_hinge_, coefficient_, direction_, elastic_);
  }
  std::size_t column_bytes() const { return total_bytes(column_start_, column_element_, transposed_); }
  std::vector<double> measured(LawMeasure what, int numbers);          // `numbers` of them per element
  std::vector<double> geometric(std::vector<double> curvature) const;  // divides by the metric
  double sum_over_elements(const double* on_device);                   // one number per element; 0 for null

  Device& device_;
  int dimension_, elements_, hinges_;
  ForceConvention convention_;
  Real viscosity_;  // moment over curvature rate [N m s]
  std::unique_ptr<LawLoop<Real, Device>> law_;
  std::vector<double> metric_;  // D per element; empty: 1 (CurvatureOperator::metric)
  Buffer<Real, Device> area_, coefficient_, direction_, elastic_, transposed_, rest_angle_;
  Buffer<int, Device> row_start_, row_hinge_, column_start_, column_element_;
  Buffer<Eigen::Vector4i, Device> corner_;  // p0, p1, p2, p3 of each hinge
  Buffer<int, Device> vertex_start_, vertex_item_;
  Buffer<Real, Device> angle_;        // continued angle minus rest angle [rad]
  Buffer<Real, Device> rate_;         // rates of the angles [rad/s]; empty without viscosity
  Buffer<double, Device> viscous_;    // lost per element [J]; empty without viscosity
  Buffer<Real, Device> gradient_;     // 8 Reals per hinge: g0, g1, t0, t1
  Buffer<Real, Device> moment_area_;  // A M, D per element [N m^2]
  Buffer<Vec3<Real>, Device> force_;  // 4 per hinge [N]
  Buffer<double, Device> energy_;     // per element, scratch of measurements
  Buffer<double, Device> taken_;      // energy taken by commands, per element [J]; empty until the first
  // State of implicit steps, empty before the first one.
  StepFormula formula_;
  Buffer<Real, Device> trial_angle_, tangent_, hinge_stiffness_;
  Buffer<Real, Device> iterate_angle_;             // angles where linearise() was called last [rad]
  bool iterates_ = false;                          // linearise() was called in this step
  bool tried_ = false;                             // evaluate() was called after it
  Buffer<Real, Device> reference_, angle_before_;  // [rad]; empty without viscosity
};

// Returns the largest eigenvalue of M^-1 J^T C^T A b C J at rest: the square of the highest bending frequency
// [1/s^2], where b is `stiffness` [N m] and `mass` is per vertex [kg].  `held` vertices do not move.
double bending_spectral_radius(const ClothMesh& mesh, const CurvatureOperator& op, double stiffness,
                               const std::vector<double>& mass, const std::vector<char>& held);

}  // namespace hysteron
