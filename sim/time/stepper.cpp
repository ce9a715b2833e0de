#include "sim/time/stepper.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>

#include "sim/base/error.h"
#include "sim/device/share_positions.h"
#include "sim/time/make_linear_solver.h"

namespace hysteron {

namespace {

template <class Real>
std::vector<Vec3<Real>> cast(const std::vector<Eigen::Vector3d>& values) {
  std::vector<Vec3<Real>> result;
  for (const auto& v : values) result.push_back(v.cast<Real>());
  return result;
}

template <class Real>
std::vector<Real> masses(const Scene& scene, const ClothMesh& mesh) {
  std::vector<Real> mass;
  for (double area : mesh.vertex_area) mass.push_back(static_cast<Real>(scene.fabric.density * area));
  return mass;
}

std::uint64_t fnv1a(const void* memory, std::size_t bytes, std::uint64_t hash) {
  const unsigned char* p = static_cast<const unsigned char*>(memory);
  for (std::size_t i = 0; i < bytes; ++i) hash = (hash ^ p[i]) * 1099511628211ull;
  return hash;
}

}  // namespace

template <class Real, class Device>
Stepper<Real, Device>::Stepper(std::unique_ptr<Device> device, const Scene& scene, const Cloth& cloth,
                               const CurvatureOperator& op, const StepLimits& limits)
    : device_(std::move(device)),
      scene_(scene),
      explicit_(scene.integrator == "explicit"),
      all_implicit_(scene.is_implicit()),
      with_self_contact_(scene.integrator == "semi-implicit" && scene.self_contact),
      coupled_(!explicit_ && !all_implicit_ && scene.implicit_every == "substep"),
      vertices_(cloth.mesh.vertices()),
      limits_(limits),
      clock_(*device_),
      matrix_(*device_, cloth.mesh),
      membrane_(*device_, cloth.mesh, scene.fabric, matrix_),
      bending_(*device_, cloth.mesh, op,
               make_law_loop<Real>(*device_, choose_law(scene.law, scene.fabric.virgin_curve(), scene.param),
                                   op.dimension, op.elements()),
               scene.force == "chapter" ? ForceConvention::chapter : ForceConvention::energy,
               scene.fabric.damping * scene.fabric.b1),
      pcg_(*device_, explicit_ || all_implicit_ || with_self_contact_ ? 0 : vertices_),
      cloth_(cloth),
      x_(*device_, cast<Real>(cloth.start)),
      v_(*device_, vertices_),
      rhs_(*device_, vertices_),
      mass_(*device_, masses<Real>(scene, cloth.mesh)),
      held_(*device_, cloth.held(scene, 0)),
      ledger_(*device_, vertices_),
      size_(*device_, 1) {
  if (!explicit_ && !all_implicit_ && !with_self_contact_) {
    change_ = Buffer<Vec3<Real>, Device>(*device_, vertices_);
    correction_ = Buffer<Vec3<Real>, Device>(*device_, vertices_);
    if (coupled_) impulse_ = Buffer<Vec3<Real>, Device>(*device_, vertices_);
  }
  bool homing = false;
  for (const Pin& pin : scene.pin) {
    moving_pins_ |= !pin.motion.keys.empty() || pin.from > 0;
    homing |= pin.home > 0;
    for (double time : {pin.from, pin.until})
      if (time > 0 && time < scene.seconds) grip_times_.push_back(time);
  }
  std::sort(grip_times_.begin(), grip_times_.end());
  if (moving_pins_) {
    start_ = Buffer<Vec3<Real>, Device>(*device_, cast<Real>(cloth.start));
    if (homing) home_ = Buffer<Vec3<Real>, Device>(*device_, cast<Real>(cloth.start));
    pin_ = Buffer<int, Device>(*device_, cloth.pins(scene, 0));
    if (all_implicit_ || with_self_contact_) handle_way_ = Buffer<Vec3<Real>, Device>(*device_, vertices_);
  }
  if (!scene.command.empty()) command_center_ = cloth.element_centers(op.dimension);
  if (!scene.obstacle.empty()) {
    contact_.emplace(*device_, cloth.mesh, scene);
    before_ = Buffer<Vec3<Real>, Device>(*device_, vertices_);
    contact_->move(0, 0);
  }
  if (scene.self_contact) {
    self_contact_.emplace(*device_, cloth.mesh, scene);
    if (before_.size() == 0) before_ = Buffer<Vec3<Real>, Device>(*device_, vertices_);
  }
  if (all_implicit_ || with_self_contact_)
    implicit_ = std::make_unique<ImplicitStep<Real, Device>>(
        *device_, scene, mass_, matrix_, membrane_, bending_, contact_ ? &*contact_ : nullptr,
        self_contact_ ? &*self_contact_ : nullptr,
        make_linear_solver<Real>(*device_, scene, cloth,
                                 with_self_contact_ ? 0.0 : bending_.law().largest_stiffness()));
  bending_.commit(x_.data(), v_.data(), 0);
  if (self_contact_) {
    self_contact_->prepare(x_.data(), v_.data(), held_.data());  // at rest: v = 0
    self_contact_->moved(x_.data());
  }
  initial_ = measure();
  initial_.initial =
      initial_.kinetic + initial_.gravitational + initial_.membrane + initial_.bending + initial_.contact;
}

template <class Real, class Device>
std::vector<Eigen::Vector3d> Stepper<Real, Device>::positions() {
  std::vector<Eigen::Vector3d> result;
  for (const auto& x : x_.download()) result.push_back(x.template cast<double>());
  return result;
}

template <class Real, class Device>
std::vector<Eigen::Vector3d> Stepper<Real, Device>::velocities() {
  std::vector<Eigen::Vector3d> result;
  for (const auto& v : v_.download()) result.push_back(v.template cast<double>());
  return result;
}

template <class Real, class Device>
std::unique_ptr<GlPositions> Stepper<Real, Device>::share_positions(unsigned gl_buffer, int gl_device,
                                                                    std::string& reason) {
  return hysteron::share_positions(*device_, x_, gl_buffer, gl_device, reason);
}

template <class Real, class Device>
std::uint64_t Stepper<Real, Device>::state_hash() {
  const auto x = x_.download(), v = v_.download();
  std::uint64_t hash = 14695981039346656037ull;
  hash = fnv1a(x.data(), x.size() * sizeof(Vec3<Real>), hash);
  return fnv1a(v.data(), v.size() * sizeof(Vec3<Real>), hash);
}

// Energies at this moment.
template <class Real, class Device>
Ledger Stepper<Real, Device>::measure() {
  Ledger ledger;
  const auto x = x_.download(), v = v_.download();
  const auto mass = mass_.download();
  const auto held = held_.download();
  for (int i = 0; i < vertices_; ++i) {
    const double m = static_cast<double>(mass[i]);
    ledger.gravitational -= m * scene_.gravity.dot(x[i].template cast<double>());
    if (!held[i]) ledger.kinetic += m / 2 * v[i].template cast<double>().squaredNorm();
  }
  ledger.membrane = membrane_.stored_energy(x_.data());
  ledger.bending = bending_.stored_energy();
  if (contact_) ledger.contact = contact_->stored_energy(x_.data());
  if (self_contact_) ledger.contact += self_contact_->stored_energy(x_.data());
  return ledger;
}

template <class Real, class Device>
Ledger Stepper<Real, Device>::ledger() {
  Ledger ledger = measure();
  ledger.gravitational -= initial_.gravitational;
  ledger.initial = initial_.initial - initial_.gravitational;
  double bending_work = 0, gravity_work = 0, implicit_work = 0;
  for (const VertexLedger& sum : ledger_.download()) {
    bending_work += sum.bending_work;
    gravity_work += sum.gravity_work;
    implicit_work += sum.implicit_work;
    ledger.air += sum.air;
    ledger.inertia += sum.inertia;
    ledger.unbalanced += sum.unbalanced;
    ledger.handle_work += sum.handle_work;
  }
  ledger.handle_work += grip_work_;
  ledger.bending_friction = bending_.dissipated_energy();
  const double viscous_bending = bending_.viscous_loss(), viscous_membrane = membrane_.viscous_loss();
  ledger.viscous = viscous_bending + viscous_membrane;
  if (contact_) {
    const ContactLoss contact = contact_->losses();
    ledger.contact_friction = contact.friction;
    ledger.obstacle_work = contact.obstacle_work;
  }
  if (self_contact_) ledger.contact_friction += self_contact_->friction_loss();
  ledger.commands = bending_.taken_by_commands();
  ledger.bending_gap = initial_.bending - ledger.bending - ledger.bending_friction - ledger.commands -
                       viscous_bending - bending_work;
  ledger.gravity_gap = -ledger.gravitational - gravity_work;
  ledger.implicit_gap = initial_.membrane - ledger.membrane + initial_.contact - ledger.contact -
                        viscous_membrane - ledger.contact_friction + ledger.obstacle_work - implicit_work;
  ledger.close();
  return ledger;
}

template <class Real, class Device>
std::vector<std::pair<std::string, double>> Stepper<Real, Device>::stage_seconds() {
  StageSeconds seconds = clock_.seconds();
  if (self_contact_) {  // inside the solve
    const double contact = self_contact_->seconds();
    seconds[static_cast<int>(Stage::contact)] += contact;
    seconds[static_cast<int>(Stage::solve)] -= contact;
  }
  std::vector<std::pair<std::string, double>> result;
  for (int s = 0; s < kStages; ++s) result.emplace_back(kStageName[s], seconds[s]);
  return result;
}

template <class Real, class Device>
double Stepper<Real, Device>::copy_bandwidth() {
  constexpr int kDoubles = 1 << 24, kRounds = 5;  // 128 MiB each way: more than any cache
  Buffer<double, Device> from(*device_, kDoubles), to(*device_, kDoubles);
  const double* source = from.data();
  double* target = to.data();
  double best = 1e30;
  for (int round = 0; round < kRounds; ++round) {
    wait();
    const auto start = std::chrono::steady_clock::now();
    for_each(
        *device_, "copy", kDoubles, HYST_KERNEL(int i) { target[i] = source[i]; });
    wait();
    best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return 2.0 * kDoubles * sizeof(double) / best;
}

template <class Real, class Device>
double Stepper<Real, Device>::solver_iterations() const {
  return step_count_ ? static_cast<double>(solver_iterations_) / static_cast<double>(step_count_) : 0;
}

template <class Real, class Device>
double Stepper<Real, Device>::newton_iterations() const {
  return step_count_ ? static_cast<double>(newton_iterations_) / static_cast<double>(step_count_) : 0;
}

template <class Real, class Device>
std::string Stepper<Real, Device>::device() const {
  return (Device::kGpu ? "cuda: " : "cpu: ") + device_->description();
}

template <class Real, class Device>
std::vector<ScenePart> Stepper<Real, Device>::parts() const {
  const LawLoop<Real, Device>& law = bending_.law();
  std::vector<ScenePart> parts;
  const auto add = [&](const char* name, bool included, std::size_t bytes, const char* kernels,
                       const char* why) {
    parts.push_back({name, included, bytes, kernels, included ? "" : why});
  };
  add("state", true, x_.bytes() + v_.bytes() + mass_.bytes() + rhs_.bytes() + held_.bytes(), "substep", "");
  add("membrane", true, membrane_.bytes(), "membrane stress, membrane matrix", "");
  add("implicit solve", !explicit_,
      matrix_.bytes() + pcg_.bytes() + 2 * change_.bytes() + impulse_.bytes() +
          (implicit_ ? implicit_->bytes() : 0),
      "solve: start, product, advance, direction", "the integrator is explicit");
  add("bending", true, bending_.bytes(), "bending angles, bending law, bending forces", "");
  add("bending history", law.has_history(), law.history_bytes(), "bending law", "the law remembers nothing");
  add("commands", !scene_.command.empty(), 0, "bending command", "no command");
  add("viscous damping", scene_.fabric.damping > 0, 0, "bending rates, viscous loss", "fabric.damping = 0");
  add("air drag", scene_.air_drag > 0, 0, "substep", "air-drag = 0");
  add("moving handles", moving_pins_, start_.bytes() + home_.bytes() + pin_.bytes() + handle_way_.bytes(),
      "handles", "no pin moves");
  add("obstacles", contact_.has_value(), contact_ ? contact_->bytes() + before_.bytes() : 0,
      "contact, contact history", "no obstacles");
  add("self-contact", self_contact_.has_value(), self_contact_ ? self_contact_->bytes() : 0,
      "self-contact: pairs, collisions, barrier, product", "self-contact = false");
  add("energy ledger", true, ledger_.bytes(), "substep, implicit ledger", "");
  return parts;
}

template class Stepper<double, ThisDevice>;
template class Stepper<float, ThisDevice>;

}  // namespace hysteron
