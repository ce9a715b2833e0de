// Implements LawLoop for one law type.  Only files that instantiate it include it.
#pragma once

#include <cmath>

#include "sim/bending/law_loop.h"
#include "sim/bending/laws/beside_elasticity.h"
#include "sim/bending/laws/directed.h"
#include "sim/bending/laws/law_commands.h"
#include "sim/bending/laws/law_potential.h"
#include "sim/bending/laws/law_visit.h"

namespace hysteron {

// Load and store a law's history, one set per element, in the device's preferred order.
template <class Law, class Real>
HYST_HD inline History<Real, Law::kHistory> load_history(const Real* memory, int i, int n) {
  History<Real, Law::kHistory> h;
  if constexpr (Law::kHistory > 0)
    for (int k = 0; k < Law::kHistory; ++k) h[k] = memory[slot_index(i, k, Law::kHistory, n)];
  return h;
}

template <class Law, class Real>
HYST_HD inline void store_history(Real* memory, int i, int n, const History<Real, Law::kHistory>& h) {
  if constexpr (Law::kHistory > 0)
    for (int k = 0; k < Law::kHistory; ++k) memory[slot_index(i, k, Law::kHistory, n)] = h[k];
}

// Laws around other laws are long.
template <class Law>
constexpr bool is_long_law() {
  if constexpr (SettingLaw<Law> || RelaxingLaw<Law>)
    return true;
  else if constexpr (requires(Law & law) { law.law; })
    return is_long_law<decltype(Law::law)>();
  else
    return false;
}

// These are the laws that sweeps over fabrics use: a batch of cloths launches their loops once for all
// cloths. nvcc would have to compile other laws a second time for that: there each cloth launches them by
// itself.
template <class Law>
constexpr bool runs_in_batches() {
  return Law::kHistory == 0 || (!is_long_law<Law>() && requires(Law & law) { innermost(law).limit; });
}

template <class Law, class Device, class Body>
void for_each_element(Device& device, const Kernel& kernel, int elements, const Body& body) {
  if constexpr (runs_in_batches<Law>())
    for_each(device, kernel, elements, body);
  else
    for_each_alone(device, kernel, elements, body);
}

template <class Real, class Device, class Law>
class LawLoopOf : public LawLoop<Real, Device> {
 public:
  static constexpr int D = Law::kDimension;

  LawLoopOf(Device& device, const Law& law, const VirginCurve& curve, int elements)
      : law_(law),
        curve_(curve),
        history_(device, static_cast<std::size_t>(elements) * Law::kHistory),
        dissipated_(device, Law::kHistory > 0 ? elements : 0),
        relaxed_(device, RelaxingLaw<Law> ? elements : 0) {}

  using typename LawLoop<Real, Device>::Viscous;

  void commit(Device& device, const OperatorView<Real>& op, const Real* angle_change, Real dt,
              const Viscous& viscous, Real* moment_area) override {
    Law law = law_;
    set_step_time(law, dt);
    Real* history = history_.data();
    double *lost = dissipated_.data(), *relaxed = relaxed_.data();
    for_each_element<Law>(
        device,
        {"bending law", op.bytes + step_bytes(op.elements) + total_bytes(history_, dissipated_, dissipated_)},
        op.elements, HYST_KERNEL(int i) {
          const Vec<Real, D> k = op.template curvature<D>(i, angle_change);
          const auto step =
              law_in_direction(law, op.direction, i).step(k, load_history<Law>(history, i, op.elements));
          Vec<Real, D> moment = step.moment;
          if (op.elastic) moment += op.template elastic_beside<D>(i).cwiseProduct(k);
          if (viscous.viscosity > 0) {
            const Vec<Real, D> rate = op.template curvature<D>(i, viscous.angle_rate);
            moment += viscous.viscosity * rate;
            viscous.lost[i] += static_cast<double>(dt * viscous.viscosity * op.area[i] * rate.squaredNorm());
          }
          for (int d = 0; d < D; ++d) moment_area[i * D + d] = op.area[i] * moment[d];
          store_history<Law>(history, i, op.elements, step.history);
          if (Law::kHistory > 0) lost[i] += static_cast<double>(op.area[i] * step.dissipated);
          if (RelaxingLaw<Law>) relaxed[i] += static_cast<double>(op.area[i] * step.relaxed);
        });
  }

  using typename LawLoop<Real, Device>::Trial;

  void trial(Device& device, const OperatorView<Real>& op, const Real* angle_change, const Trial& trial,
             Real* moment_area, double* energy) override {
    Law law = law_;
    set_step_time(law, trial.dt);
    const Real* history = history_.data();
    for_each_element<Law>(
        device, {"bending law, tried", op.bytes + step_bytes(op.elements) + op.elements * sizeof(double)},
        op.elements, HYST_KERNEL(int i) {
          const Vec<Real, D> k = op.template curvature<D>(i, angle_change);
          const auto before = load_history<Law>(history, i, op.elements);
          const auto& own = law_in_direction(law, op.direction, i);
          const auto tried = step_and_potential(own, k, before);
          Vec<Real, D> moment = tried.step.moment;
          Real potential = tried.potential;
          if (op.elastic) {
            const Vec<Real, D> beside = op.template elastic_beside<D>(i).cwiseProduct(k);
            moment += beside;
            potential += beside.dot(k) / 2;
          }
          if (trial.viscosity > 0) {
            const Vec<Real, D> rate = op.template curvature<D>(i, trial.angle_rate);
            moment += trial.viscosity * rate;
            potential += trial.viscosity * trial.beta_dt / 2 * rate.squaredNorm();
          }
          for (int d = 0; d < D; ++d) moment_area[i * D + d] = op.area[i] * moment[d];
          energy[i] = static_cast<double>(op.area[i] * potential);
        });
  }

  void tangents(Device& device, const OperatorView<Real>& op, const Real* angle_change, const Trial& trial,
                Real* tangent_area) override {
    Law law = law_;
    set_step_time(law, trial.dt);
    const Real viscous = trial.viscosity > 0 ? trial.viscosity / trial.beta_dt : Real(0);
    const Real* history = history_.data();
    const std::size_t tangents = op.elements * (D * (D + 1) / 2) * sizeof(Real);
    for_each_element<Law>(
        device, {"bending tangent", op.bytes + history_.bytes() + tangents}, op.elements, HYST_KERNEL(int i) {
          const Vec<Real, D> k = op.template curvature<D>(i, angle_change);
          const auto& own = law_in_direction(law, op.direction, i);
          Tangent<Real, D> t = convex_tangent(own, k, load_history<Law>(history, i, op.elements));
          if (op.elastic) t.diagonal() += op.template elastic_beside<D>(i);
          Real* row = tangent_area + i * (D * (D + 1) / 2);
          for (int a = 0; a < D; ++a)
            for (int b = 0; b <= a; ++b) *row++ = op.area[i] * (t(a, b) + (a == b ? viscous : Real(0)));
        });
  }

  void command(Device& device, const OperatorView<Real>& op, const Real* angle_change, CommandKind kind,
               const char* chosen, double* taken) override {
    if (Law::kHistory == 0 || (kind == CommandKind::edit && !EditableLaw<Law>)) return;
    const Law law = law_;
    Real* history = history_.data();
    for_each_alone(
        device, "bending command", op.elements, HYST_KERNEL(int i) {
          if (!chosen[i]) return;
          const Vec<Real, D> k = op.template curvature<D>(i, angle_change);
          const auto before = load_history<Law>(history, i, op.elements);
          const auto& own = law_in_direction(law, op.direction, i);
          const auto after = kind == CommandKind::edit ? edited(own, k, before) : ironed(own, k, before);
          Real stored[2];
          for (int end = 0; end < 2; ++end)
            stored[end] = called_step(own, k, end == 0 ? before : after).stored;
          taken[i] += static_cast<double>(op.area[i] * (stored[0] - stored[1]));
          store_history<Law>(history, i, op.elements, after);
        });
  }

  void measure(Device& device, const OperatorView<Real>& op, const Real* angle_change, LawMeasure what,
               double* result) override {
    const Law law = law_;
    const Real* history = history_.data();
    const Real b2 = static_cast<Real>(curve_.b2), m0 = static_cast<Real>(curve_.friction_moment());
    for_each_alone(
        device, "bending measured", op.elements, HYST_KERNEL(int i) {
          const auto memory = load_history<Law>(history, i, op.elements);
          const auto& own = law_in_direction(law, op.direction, i);
          if (what == LawMeasure::residual_curvature) {
            const Vec<Real, D> k = op.elastic
                                       ? beside_elasticity(own, op.template elastic_beside<D>(i), memory)
                                       : Vec<Real, D>(own.residual(memory));
            for (int d = 0; d < D; ++d) result[i * D + d] = static_cast<double>(k[d]);
            return;
          }
          const Vec<Real, D> k = op.template curvature<D>(i, angle_change);
          Real value = what == LawMeasure::stored_energy ? op.area[i] * called_step(own, k, memory).stored
                                                         : friction_utilisation(own, k, memory, b2, m0);
          if (op.elastic && what == LawMeasure::stored_energy)
            value += op.area[i] * op.template elastic_beside<D>(i).cwiseProduct(k).dot(k) / 2;
          result[i] = static_cast<double>(value);
        });
  }

  double largest_stiffness() const override { return static_cast<double>(law_.largest_stiffness()); }
  bool has_history() const override { return Law::kHistory > 0; }
  std::size_t history_bytes() const override { return history_.bytes(); }
  void serialise(Archive& archive, Device& device) override {
    hysteron::serialise(archive, device, history_);
    hysteron::serialise(archive, device, dissipated_);
    if (RelaxingLaw<Law>) hysteron::serialise(archive, device, relaxed_);
  }
  const double* dissipated() const override { return dissipated_.data(); }
  const double* relaxed() const override { return relaxed_.data(); }

 private:
  // Counts the history read and the moments written, without viscosity's own arrays.
  std::size_t step_bytes(int elements) const { return history_.bytes() + elements * D * sizeof(Real); }

  Law law_;
  VirginCurve curve_;
  Buffer<Real, Device> history_;
  Buffer<double, Device> dissipated_, relaxed_;
};

// Makes the loops of a group of laws. law_loops.cpp.in instantiates them, a file for each group, dimension
// and precision: they are the slowest to compile.
template <class Group, class Real, class Device, int D>
std::unique_ptr<LawLoop<Real, Device>> make_group_loop(Device& device, const LawParams& choice,
                                                       int elements) {
  std::unique_ptr<LawLoop<Real, Device>> loop;
  const auto make = [&]<class Law>(const Law& law) {
    loop = std::make_unique<LawLoopOf<Real, Device, Law>>(device, law, choice.curve, elements);
  };
  visit_group<Group, Real, D, ClothMemory>(choice, [&]<class Law>(const Law& law) {
    if constexpr (LawOfOneDirection<Law>)
      if (Device::kGpu || innermost(law).two_spectra) return make(Directed<Law>{law});
    if constexpr (!(LawOfOneDirection<Law> && Device::kGpu)) make(law);  // one to compile: nvcc takes long
  });
  return loop;
}

}  // namespace hysteron
