#include "sim/time/body.h"

#include <algorithm>
#include <cmath>

#include "sim/scene/cloth.h"
#include "sim/time/pinch.h"
#include "sim/time/step_errors.h"

namespace hysteron {

namespace {

template <class Real>
std::vector<Real> masses(const Scene& scene, const ClothMesh& mesh) {
  std::vector<Real> mass;
  for (double area : mesh.vertex_area) mass.push_back(static_cast<Real>(scene.fabric.density * area));
  return mass;
}

}  // namespace

template <class Real, class Device>
Body<Real, Device>::Body(std::unique_ptr<Device> on, const Scene& s, const Cloth& c,
                         const CurvatureOperator& op)
    : device(std::move(on)),
      origin(local_origin(c.start)),
      scene(relative_to(origin, s)),
      cloth(relative_to(origin, c)),
      vertices(c.mesh.vertices()),
      clock(*device),
      matrix(*device, membrane_couplings(c.mesh, s.fabric, s.membrane_element)),
      membrane(*device, c.mesh, s.fabric, s.membrane_element, matrix),
      bending(*device, c.mesh, op,
              make_law_loop<Real>(*device, choose_law(s.law, s.fabric.virgin_curve(), s.param), op.dimension,
                                  op.elements()),
              s.force, s.fabric.damping * s.fabric.b1),
      x(*device, cast_to<Real>(cloth.start)),
      v(*device, vertices),
      mass(*device, masses<Real>(s, c.mesh)),
      held(*device, c.held(s, 0)),
      ledger(*device, vertices),
      pins(*device, scene, cloth, s.finds_equilibrium()),
      size_(*device, 1) {
  if (!scene.command.empty()) command_center_ = cloth.element_centers(op.dimension);
  if (!scene.obstacle.empty()) {
    contact.emplace(*device, cloth.mesh, scene);
    contact->move(0, 0);
  }
  if (scene.self_contact || has_mesh_bodies(scene)) self_contact.emplace(*device, cloth.mesh, scene);
  if (contact || self_contact) before = Buffer<Vec3<Real>, Device>(*device, vertices);
  bending.commit(x.data(), v.data(), 0);
  membrane.start_friction(x.data());
  if (self_contact) {
    self_contact->prepare(x.data(), v.data(), held.data());  // at rest: v = 0
    self_contact->accept_iterate(x.data());
  }
  initial_ = energies();
  // A bent start gives cloth its history; the loss of that bend, which never happened, is subtracted from the
  // ledger.
  initial_.bending_relaxation = bending.relaxed_energy();
  initial_.bending_friction = bending.dissipated_energy() - initial_.bending_relaxation;
  initial_.initial =
      initial_.kinetic + initial_.gravitational + initial_.membrane + initial_.bending + initial_.contact;
}

template <class Real, class Device>
void Body<Real, Device>::apply_due_events(double start, Real h) {
  forces_discontinuous |= pins.attach_and_release(*this, start);
  if (contact && start >= next_obstacle_) {
    throw_if_arrival(*this, met_, start);
    met_ = start;
    forces_discontinuous = true;
    next_obstacle_ = 1e30;
    for (const Obstacle& o : scene.obstacle)
      if (o.from > start) next_obstacle_ = std::min(next_obstacle_, o.from);
  }
  pins.move(*this, start, h);
}

template <class Real, class Device>
void Body<Real, Device>::begin_stage(double start, Real h) {
  apply_due_events(start, h);
  if (contact) contact->move(start, start + static_cast<double>(h));
  if (self_contact) self_contact->move_bodies(start, start + static_cast<double>(h));
  if (before.size() == 0) return;
  const Vec3<Real>* from = x.data();
  Vec3<Real>* to = before.data();
  for_each(
      *device, {"remember positions", total_bytes(x, before)}, vertices,
      HYST_KERNEL(int i) { to[i] = from[i]; });
}

template <class Real, class Device>
void Body<Real, Device>::end_stage(double time) {
  pins.end_stage(*this);
  if (self_contact) {
    self_contact->commit(x.data(), before.data());
    count_dents(*this);
  }
  if (!contact) return;
  clock.begin(Stage::contact);
  const int inside = contact->commit(x.data(), before.data(), held.data());
  clock.end(Stage::contact);
  if (inside > 0) count_overlap(*this, time);
}

template <class Real, class Device>
void Body<Real, Device>::carry_out_commands(double start, double end) {
  for (const SceneEvent& command : scene.command) {
    if (command.time < start || command.time >= end) continue;
    std::vector<char> chosen;
    for (const Eigen::Vector3d& center : command_center_)
      chosen.push_back(is_in_box(center, command.low, command.high));
    bending.command(command.kind, chosen);
    forces_discontinuous = true;
  }
}

template <class Real, class Device>
void Body<Real, Device>::serialise(Archive& archive) {
  hysteron::serialise(archive, *device, x, v, held, ledger);
  hysteron::serialise(archive, clock);
  archive(counts, forces_discontinuous, initial_, next_obstacle_, met_);
  pins.serialise(archive, *this);
  membrane.serialise(archive);
  bending.serialise(archive);
  if (contact) contact->serialise(archive);
  if (self_contact) self_contact->serialise(archive);
}

template <class Real, class Device>
bool Body<Real, Device>::is_finite() {
  const Vec3<Real>*at = x.data(), *moving = v.data();
  double* size = size_.data();
  for_each_sum<1>(
      *device, {"finite", total_bytes(x, v)}, vertices,
      HYST_KERNEL(int i, Sums<1>& sums) {
        sums.term[0] += static_cast<double>(at[i].squaredNorm() + moving[i].squaredNorm());
      },
      HYST_KERNEL(const Sums<1>& total) { *size = total.term[0]; });
  return std::isfinite(size_.download()[0]);
}

template <class Real, class Device>
Ledger Body<Real, Device>::energies() {
  Ledger sum;
  const auto at = x.download(), moving = v.download();
  const auto host_mass = mass.download();
  const auto fixed = held.download();
  for (int i = 0; i < vertices; ++i) {
    const double m = static_cast<double>(host_mass[i]);
    sum.gravitational -= m * scene.gravity.dot(at[i].template cast<double>());
    if (!fixed[i]) sum.kinetic += m / 2 * moving[i].template cast<double>().squaredNorm();
  }
  sum.membrane = membrane.stored_energy(x.data());
  sum.bending = bending.stored_energy();
  if (contact) sum.contact = contact->stored_energy(x.data());
  if (self_contact) sum.contact += self_contact->stored_energy(x.data());
  return sum;
}

template <class Real, class Device>
Ledger Body<Real, Device>::balance() {
  Ledger sum = energies();
  sum.gravitational -= initial_.gravitational;
  sum.initial = initial_.initial - initial_.gravitational;
  double bending_work = 0, gravity_work = 0, implicit_work = 0;
  for (const VertexLedger& of : ledger.download()) {
    bending_work += of.bending_work;
    gravity_work += of.gravity_work;
    implicit_work += of.implicit_work;
    sum.air += of.air;
    sum.inertia += of.inertia;
    sum.unbalanced += of.unbalanced;
    sum.pin_work += of.pin_work;
  }
  sum.pin_work += pins.work();
  const double relaxed = bending.relaxed_energy();
  sum.bending_relaxation = relaxed - initial_.bending_relaxation;
  sum.bending_friction = bending.dissipated_energy() - relaxed - initial_.bending_friction;
  const double viscous_bending = bending.viscous_loss(), viscous_membrane = membrane.viscous_loss();
  sum.viscous = viscous_bending + viscous_membrane;
  sum.membrane_friction = membrane.friction_loss();
  if (contact) {
    const ContactLoss lost = contact->losses();
    sum.contact_friction = lost.friction;
    sum.obstacle_work = lost.obstacle_work;
  }
  if (self_contact) {
    sum.contact_friction += self_contact->friction_loss();
    sum.obstacle_work += self_contact->body_work();
  }
  sum.commands = bending.taken_by_commands();
  sum.bending_gap = initial_.bending - sum.bending - sum.bending_friction - sum.bending_relaxation -
                    sum.commands - viscous_bending - bending_work;
  sum.gravity_gap = -sum.gravitational - gravity_work;
  sum.implicit_gap = initial_.membrane - sum.membrane + initial_.contact - sum.contact - viscous_membrane -
                     sum.membrane_friction - sum.contact_friction + sum.obstacle_work - implicit_work;
  sum.close();
  return sum;
}

template struct Body<double, ThisDevice>;
template struct Body<float, ThisDevice>;

}  // namespace hysteron
