#include "sim/time/incremental_potential.h"

#include <algorithm>
#include <cmath>

namespace hysteron {

template <class Real, class Device>
IncrementalPotential<Real, Device>::IncrementalPotential(
    Device& device, BlockRows<Real, Device>& matrix, Membrane<Real, Device>& membrane,
    Bending<Real, Device>& bending, Contact<Real, Device>* contact, SelfContact<Real, Device>* self_contact,
    const Buffer<Real, Device>& mass, bool bending_lags, const SolverTuning& tuning)
    : device_(device),
      matrix_(matrix),
      membrane_(membrane),
      bending_(bending),
      contact_(contact),
      self_contact_(self_contact),
      mass_(mass),
      bending_lags_(bending_lags),
      tuning_(tuning),
      vertices_(static_cast<int>(mass.size())),
      gradient_(device, vertices_),
      descent_(device, vertices_),
      rest_diagonal_(device, vertices_),
      softening_off_diagonal_(device, matrix.col().size()),
      softening_diagonal_(device, vertices_),
      vertex_totals_(device, 1),
      totals_(device) {}

template <class Real, class Device>
PotentialValue IncrementalPotential<Real, Device>::balance(const Vec3<Real>* x, const Vec3<Real>* direction) {
  compute_gradient(x);
  if (contact_) contact_->evaluate(x, start_.now, gradient_.data());
  if (self_contact_) self_contact_->evaluate(x, start_.now, gradient_.data());
  add_up(energies(), x, direction);
  device_.synchronize();
  const Totals& t = *totals_;
  return {t.energy,
          t.size,
          std::sqrt(t.residual2),
          std::sqrt(t.reaction2),
          std::sqrt(t.inertia2),
          std::sqrt(t.internal2),
          std::sqrt(t.weight2),
          t.slope};
}

template <class Real, class Device>
typename IncrementalPotential<Real, Device>::Energies IncrementalPotential<Real, Device>::energies() {
  return {{contact_ ? contact_->energies() : nullptr, self_contact_ ? self_contact_->energies() : nullptr,
           membrane_.energies(), bending_lags_ ? nullptr : bending_.energies()},
          {contact_ ? contact_->energies_count() : 0, self_contact_ ? self_contact_->pairs() : 0,
           membrane_.energies_count(), bending_lags_ ? 0 : bending_.elements()}};
}

template <class Real, class Device>
std::string IncrementalPotential<Real, Device>::not_finite(const Vec3<Real>* x) {
  constexpr const char* kPart[] = {"contact with obstacles", "contact between layers", "the membrane",
                                   "bending"};
  if (std::isfinite(evaluate(x, nullptr).energy)) return "";
  const Energies of = energies();
  for (int l = 0; l < 4; ++l) {
    const std::vector<double> energy = downloaded(device_, of.list[l], of.count[l]);
    const auto bad = std::find_if(energy.begin(), energy.end(), [](double e) { return !std::isfinite(e); });
    if (bad != energy.end())
      return std::string("the energy of ") + kPart[l] + " (element " + std::to_string(bad - energy.begin()) +
             " of " + std::to_string(of.count[l]) + ")";
  }
  return "inertia, weight or the pull of pins";
}

// Computes inertia, drag and weight with their energies, and gathers the gradients of membrane and bending.
template <class Real, class Device>
void IncrementalPotential<Real, Device>::compute_gradient(const Vec3<Real>* x) {
  const StepStart<Real> s = start_;
  const Real beta_dt = static_cast<Real>(s.formula.beta_dt);
  const Real inertia = 1 / (beta_dt * beta_dt), drag = s.drag / beta_dt;  // 0 in statics
  const Vec3<Real> g = s.fraction * s.gravity;
  const MembraneForceView<Real> membrane = membrane_.forces();
  const GatheredForces<Real> bending = bending_.forces();
  const Real* mass = mass_.data();
  const bool lags = bending_lags_;
  Vec3<Real>* gradient = gradient_.data();
  Totals* totals = vertex_totals_.data();
  for_each_sum<5>(
      device_, {"potential: vertices", membrane_.force_bytes() + bending_.force_bytes() + vertex_bytes(5)},
      vertices_,
      HYST_KERNEL(int i, Sums<5>& sums) {
        const Vec3<Real> moved = x[i] - s.predicted[i], drift = x[i] - s.reference[i];
        const Vec3<Real> stretch = membrane.at(i), bend = bending.at(i);
        gradient[i] = mass[i] * (inertia * moved + drag * drift - g) - stretch - bend;
        if (s.compliant_pins.any_at(i)) gradient[i] -= s.compliant_pins.force(i, x[i]);
        sums.term[2] += static_cast<double>(stretch.squaredNorm() + bend.squaredNorm());
        if (s.held[i]) return;
        sums.term[4] += static_cast<double>((mass[i] * s.gravity).squaredNorm());
        sums.term[3] += static_cast<double>((mass[i] * inertia * moved).squaredNorm());
        double kinetic =
            static_cast<double>(mass[i] / 2 * (inertia * moved.squaredNorm() + drag * drift.squaredNorm()));
        if (s.compliant_pins.any_at(i)) kinetic += static_cast<double>(s.compliant_pins.energy(i, x[i]));
        Vec3<Real> given = mass[i] * g;
        if (lags) given += bend;
        const double weight = static_cast<double>(given.dot(x[i] - s.now[i]));
        sums.term[0] += kinetic - weight;
        sums.term[1] += kinetic + (weight < 0 ? -weight : weight);
      },
      HYST_KERNEL(const Sums<5>& total) {
        *totals = {total.term[0], total.term[1], total.term[2], total.term[3], total.term[4], 0, 0, 0};
      });
}

// Adds up the energies, each list by itself, in the order of its elements.
template <class Real, class Device>
void IncrementalPotential<Real, Device>::add_up(const Energies& energies, const Vec3<Real>* x,
                                                const Vec3<Real>* direction) {
  const Energies of = energies;
  const int vertices = vertices_, longest = std::max(vertices, *std::max_element(of.count, of.count + 4));
  const Vec3<Real>* gradient = gradient_.data();
  const char* held = start_.held;
  const CompliantPins<Real> compliant_pins = start_.compliant_pins;
  const Totals* of_vertices = vertex_totals_.data();
  Totals* totals = totals_.data();
  std::size_t bytes = vertex_bytes(direction ? 2 : 1);
  for (const int count : of.count) bytes += count * sizeof(double);
  for_each_sum<11>(
      device_, {"potential: sums", bytes}, longest,
      HYST_KERNEL(int i, Sums<11>& sums) {
        for (int l = 0; l < 4; ++l) {
          if (i >= of.count[l]) continue;
          const double energy = of.list[l][i];
          sums.term[3 + 2 * l] += energy;
          sums.term[4 + 2 * l] += energy < 0 ? -energy : energy;
        }
        if (i >= vertices) return;
        const double force2 = static_cast<double>(gradient[i].squaredNorm());
        (held[i] ? sums.term[1] : sums.term[0]) += force2;
        if (compliant_pins.any_at(i))
          sums.term[1] += static_cast<double>(compliant_pins.force(i, x[i]).squaredNorm());
        if (direction && !held[i]) sums.term[2] += static_cast<double>(gradient[i].dot(direction[i]));
      },
      HYST_KERNEL(const Sums<11>& total) {
        Totals t = *of_vertices;
        for (int l = 0; l < 4; ++l) {
          t.energy += total.term[3 + 2 * l];
          t.size += total.term[4 + 2 * l];
        }
        t.residual2 = total.term[0];
        t.reaction2 = total.term[1];
        t.slope = total.term[2];
        *totals = t;
      });
}

template <class Real, class Device>
LinearSystem<Real, Device> IncrementalPotential<Real, Device>::linearise(const Vec3<Real>* x, Real shift,
                                                                         bool full) {
  const BlockRowsView<Real> matrix = matrix_.view();
  ScalarRowsView<Real> softening;
  if (full) softening = {softening_off_diagonal_.data(), softening_diagonal_.data()};
  membrane_.assemble(1 + membrane_.viscous_factor(), 1, matrix, softening);
  if (!bending_lags_) bending_.linearise();
  const Real beta_dt = static_cast<Real>(start_.formula.beta_dt);
  const Real inertia = 1 / (beta_dt * beta_dt) + start_.drag / beta_dt + shift;
  const Real* mass = mass_.data();
  const Real sliding_fraction = static_cast<Real>(full ? tuning_.sliding_near : tuning_.sliding_far);
  const CompliantPins<Real> compliant_pins = start_.compliant_pins;
  const Vec3<Real>* gradient = gradient_.data();
  Vec3<Real>* descent = descent_.data();
  Mat3<Real>* rest = rest_diagonal_.data();
  for_each(
      device_, {"potential: masses", vertex_bytes(2) + vertices_ * (3 * sizeof(Mat3<Real>) + sizeof(Real))},
      vertices_, HYST_KERNEL(int i) {
        for (int k = 0; k < 3; ++k) matrix.diagonal[i](k, k) += inertia * mass[i];
        if (compliant_pins.any_at(i))
          matrix.diagonal[i] += compliant_pins.stiffness(i, x[i], sliding_fraction);
        rest[i].setZero();
        descent[i] = -gradient[i];
      });
  if (contact_) contact_->add_stiffness(x, start_.now, matrix, sliding_fraction);
  if (!bending_lags_) bending_.add_stiffness_diagonal(rest);
  if (self_contact_) {
    self_contact_->linearise(x, start_.now, sliding_fraction);
    self_contact_->add_stiffness_diagonal(rest);
    self_contact_->add_push(descent);
  }
  LinearSystem<Real, Device> system{matrix, {}, rest, nullptr, softening, {}, matrix_.bytes()};
  if (full) system.bytes += total_bytes(softening_off_diagonal_, softening_diagonal_);
  if (!bending_lags_) {
    system.bending = [this](const Vec3<Real>* p) {
      bending_.apply_stiffness(p);
      return bending_.forces();
    };
    system.bytes += bending_.force_bytes();
  }
  if (self_contact_) system.pairs = self_contact_->product();
  if (whole_) {
    system.whole = whole_->assemble(matrix, softening);
    system.whole_blocks = whole_->blocks();
    system.bytes = whole_->matrix_bytes();
  }
  return system;
}

template class IncrementalPotential<double, ThisDevice>;
template class IncrementalPotential<float, ThisDevice>;

}  // namespace hysteron
