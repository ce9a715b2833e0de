#include "sim/time/pins.h"

#include <algorithm>

#include "sim/contact/compression.h"
#include "sim/scene/motion.h"
#include "sim/time/body.h"
#include "sim/time/step_errors.h"

namespace hysteron {

namespace {
constexpr double kYieldFraction = 0.5;  // over the fabric's thickness: how far a pin gives under its strength
constexpr double kStrongest = 10 * kTestPressure;  // the strongest pull of rigid pins that give way [Pa]

// Can pinned layers meet? They can where two pins are rigid and one of them moves.
bool may_meet(const Scene& scene) {
  int rigid = 0;
  bool moves = false;
  for (const Pin& pin : scene.pin) {
    if (pin.strength > 0) continue;
    ++rigid;
    moves |= !pin.motion.keys.empty() || pin.home > 0;
  }
  return scene.self_contact && rigid > 1 && moves;
}

// Sets how far vertices at x [m] lag behind compliant pins, with a minus sign: smallest() finds the farthest.
template <class Real, class Device>
void find_lags(Device& device, int vertices, const CompliantPins<Real>& compliant_pins, const Vec3<Real>* x,
               Real* lag) {
  const CompliantPins<Real> pins = compliant_pins;
  for_each(
      device, "pins: lag", vertices, HYST_KERNEL(int i) { lag[i] = -pins.lag(i, x[i]); });
}

void visit_keyframes(Archive& archive, std::vector<Keyframe>& keys) {
  keys.resize(archive.size(keys.size()));
  for (Keyframe& key : keys) {
    archive(key.time, key.angle, key.scale);
    archive.bytes(key.position.data(), sizeof key.position);
  }
}
}  // namespace

template <class Real, class Device>
Pins<Real, Device>::Pins(Device& device, const Scene& scene, const Cloth& cloth, bool with_arcs)
    : with_arcs_(with_arcs), yield_distance_(static_cast<Real>(kYieldFraction * scene.fabric.thickness)) {
  for (const Pin& pin : scene.pin) {
    kind_ = std::max(kind_, kind_of(pin));
    for (double time : {pin.from, pin.until})
      if (time > 0 && time < scene.seconds) times_.push_back(time);
  }
  std::sort(times_.begin(), times_.end());
  if (any_moves()) allocate(device, scene, cloth, 0);
}

template <class Real, class Device>
void Pins<Real, Device>::allocate(Device& device, const Scene& scene, const Cloth& cloth, double time) {
  const std::vector<Vec3<Real>> start = cast_to<Real>(cloth.start);
  const int vertices = cloth.mesh.vertices();
  if (start_.size() == 0) {
    const bool homing =
        std::any_of(scene.pin.begin(), scene.pin.end(), [](const Pin& pin) { return pin.home > 0; });
    start_ = Buffer<Vec3<Real>, Device>(device, start);
    if (homing) home_ = Buffer<Vec3<Real>, Device>(device, start);
    pin_ = Buffer<int, Device>(device, cloth.pins(scene, time));
    if (with_arcs_) arc_ = Buffer<Vec3<Real>, Device>(device, vertices);
  }
  if (!sweep_ && may_meet(scene)) {
    displacement_ = Buffer<Vec3<Real>, Device>(device, vertices);
    sweep_ = std::make_unique<PinSweep<Real, Device>>(device, cloth.mesh, scene.fabric.thickness);
  }
  if (!has_limited() || target_.size() > 0) return;
  target_ = Buffer<Vec3<Real>, Device>(device, start);
  strength_ = Buffer<Real, Device>(device, vertices);
}

template <class Real, class Device>
void Pins<Real, Device>::drive(Body<Real, Device>& body, int pin, double now, const Eigen::Vector3d& velocity,
                               double spin) {
  Motion& motion = body.scene.pin[pin].motion;
  motion = steady_from(motion, now, velocity, spin);
  kind_ = std::max(kind_, Kind::moving);
  allocate(*body.device, body.scene, body.cloth, now);
}

template <class Real, class Device>
bool Pins<Real, Device>::attach_and_release(Body<Real, Device>& body, double start) {
  restore_rigid(body);
  if (start < next_) return false;
  const auto next = std::upper_bound(times_.begin(), times_.end(), start);
  next_ = next == times_.end() ? 1e30 : *next;
  const std::vector<int> pins = body.cloth.pins(body.scene, start);
  const std::vector<char> held = body.cloth.held(body.scene, start);
  bool changed = update_ledger(body, held);
  if (body.contact) throw_if_release(body, held, start);
  body.held.upload(held);
  if (has_limited()) changed |= pins != pin_.download();
  if (any_moves()) take(body, pins, start);
  if (has_limited()) share_strength(body.scene, pins);
  return changed;
}

// Divides a pin's strength among its vertices in equal shares.
template <class Real, class Device>
void Pins<Real, Device>::share_strength(const Scene& scene, const std::vector<int>& pins) {
  std::vector<int> count(scene.pin.size());
  for (int p : pins)
    if (p >= 0) ++count[p];
  std::vector<Real> strength(pins.size());
  for (std::size_t i = 0; i < pins.size(); ++i)
    if (pins[i] >= 0) strength[i] = static_cast<Real>(scene.pin[pins[i]].strength / count[pins[i]]);
  strength_.upload(strength);
}

// Books the energy of taking hold and letting go: a pin stops the vertices it takes, and leaves those it lets
// go in motion, since the balance counts no kinetic energy of held vertices.
template <class Real, class Device>
bool Pins<Real, Device>::update_ledger(Body<Real, Device>& body, const std::vector<char>& held) {
  const std::vector<char> before = body.held.download();
  if (held == before) return false;
  const std::vector<Vec3<Real>> v = body.v.download();
  const std::vector<Real> mass = body.mass.download();
  for (int i = 0; i < body.vertices; ++i) {
    const double kinetic = static_cast<double>(mass[i]) / 2 * v[i].template cast<double>().squaredNorm();
    if (held[i] != before[i]) work_ += held[i] ? -kinetic : kinetic;
  }
  return true;
}

// Makes vertices that a pin takes start where they are.
template <class Real, class Device>
void Pins<Real, Device>::take(Body<Real, Device>& body, const std::vector<int>& pins, double time) {
  const std::vector<int> before = pin_.download();
  std::vector<Vec3<Real>> start = start_.download();
  const std::vector<Vec3<Real>> x = body.x.download();
  for (int i = 0; i < body.vertices; ++i) {
    if (pins[i] < 0 || pins[i] == before[i]) continue;
    const Placement at = placement(body.scene.pin[pins[i]].motion, time);
    const Eigen::Vector3d now = x[i].template cast<double>() - at.translation;
    start[i] = (at.rotation.transpose() * now / at.scale).template cast<Real>();
  }
  start_.upload(start);
  pin_.upload(pins);
}

template <class Real, class Device>
PinPlacements<Real> Pins<Real, Device>::placements(const Scene& scene, double start, double h) const {
  PinPlacements<Real> result;
  for (std::size_t p = 0; p < scene.pin.size(); ++p) {
    const Motion& motion = scene.pin[p].motion;
    const Placement from = placement(motion, start), at = placement(motion, start + h);
    const Eigen::AngleAxisd turn(at.rotation * from.rotation.transpose());
    const double home = home_fraction(scene.pin[p], start + h);
    result.home[p] = static_cast<Real>(home);
    result.homewards[p] = static_cast<Real>(home - home_fraction(scene.pin[p], start));
    result.rotation[p] = (at.scale * at.rotation).template cast<Real>();
    result.translation[p] = at.translation.template cast<Real>();
    result.turn[p] = (turn.angle() * turn.axis()).template cast<Real>();
    result.pivot[p] = at(motion.center).template cast<Real>();
    result.shift[p] = (at(motion.center) - from(motion.center)).template cast<Real>();
  }
  return result;
}

template <class Real, class Device>
void Pins<Real, Device>::serialise(Archive& archive, Body<Real, Device>& body) {
  Device& device = *body.device;
  archive(kind_);
  for (Pin& pin : body.scene.pin) {  // drive() may have changed them
    visit_keyframes(archive, pin.motion.keys);
    archive(pin.motion.cycles);
  }
  if (archive.loads() && any_moves()) allocate(device, body.scene, body.cloth, 0);
  archive(next_);
  hysteron::serialise(archive, device, start_, pin_);
  archive(work_, behind_, rigidity_);
  hysteron::serialise(archive, device, target_, strength_);
}

template <class Real, class Device>
void Pins<Real, Device>::move(Body<Real, Device>& body, double start, Real h) {
  if (!any_moves()) return;
  const PinPlacements<Real> placed = placements(body.scene, start, static_cast<double>(h));
  moving_now_ = false;
  for (std::size_t p = 0; p < body.scene.pin.size(); ++p)
    moving_now_ |= !(body.scene.pin[p].strength > 0) &&
                   (placed.homewards[p] != 0 || !placed.turn[p].isZero(0) || !placed.shift[p].isZero(0));
  const int* pin = pin_.data();
  const char* held = body.held.data();
  const Real* strength = strength_.data();
  Vec3<Real>* target = target_.data();
  const Vec3<Real>*origin = start_.data(), *home = home_.data(), *x = body.x.data();
  Vec3<Real>*v = body.v.data(), *arc = arc_.data();
  for_each(
      *body.device, "pins: positions", body.vertices, HYST_KERNEL(int i) {
        const bool compliant = strength && strength[i] > 0;
        if (!held[i] && !compliant) return;
        const int p = pin[i];
        Vec3<Real> from = origin[i], more = Vec3<Real>::Zero();
        if (home) {
          from += placed.home[p] * (home[i] - origin[i]);
          more = placed.homewards[p] * (placed.rotation[p] * (home[i] - origin[i]));
        }
        const Vec3<Real> end = placed.rotation[p] * from + placed.translation[p];
        if (compliant) {
          target[i] = end;
          return;
        }
        v[i] = (end - x[i]) / h;
        if (arc) arc[i] = placed.turn[p].cross(end - placed.pivot[p]) + placed.shift[p] + more;
      });
}

template <class Real, class Device>
bool Pins<Real, Device>::are_blocked(Body<Real, Device>& body, Real h) {
  if (behind_ > yield_distance_) return true;
  if (!sweep_ || !(moving_now_ || behind_ > 0)) return false;
  const char* held = body.held.data();
  const Vec3<Real>* v = body.v.data();
  Vec3<Real>* displacement = displacement_.data();
  for_each(
      *body.device, "pins: motion over the step", body.vertices, HYST_KERNEL(int i) {
        displacement[i] = held[i] ? Vec3<Real>(h * v[i]) : Vec3<Real>(Vec3<Real>::Zero());
      });
  return !sweep_->is_free(body.x.data(), displacement, held, pin_.data());
}

// Vertices of rigid pins that give way start at rest: the balance counts no kinetic energy of held vertices.
template <class Real, class Device>
bool Pins<Real, Device>::yield_to_cloth(Body<Real, Device>& body, Real h) {
  rigid_ = body.held.download();
  const std::vector<Vec3<Real>> x = body.x.download();
  std::vector<Vec3<Real>> v = body.v.download(), target = target_.download();
  std::vector<Real> strength = strength_.download();
  std::vector<char> held = rigid_;
  target.resize(body.vertices);
  strength.resize(body.vertices);
  for (int i = 0; i < body.vertices; ++i) {
    if (!held[i] || v[i].isZero(0)) continue;
    target[i] = x[i] + h * v[i];
    strength[i] = static_cast<Real>(kStrongest * body.cloth.mesh.vertex_area[i]);
    v[i].setZero();
    held[i] = 0;
  }
  if (held == rigid_) return false;
  if (target_.size() == 0) {
    target_ = Buffer<Vec3<Real>, Device>(*body.device, target);
    strength_ = Buffer<Real, Device>(*body.device, strength);
  }
  target_.upload(target);
  strength_.upload(strength);
  body.v.upload(v);
  body.held.upload(held);
  body.self_contact->invalidate_pairs();
  rigidity_ = Rigidity::compliant;
  return true;
}

// Makes pins rigid again before another stage, whether the last one was accepted or not.
template <class Real, class Device>
void Pins<Real, Device>::restore_rigid(Body<Real, Device>& body) {
  if (rigidity_ == Rigidity::rigid) return;
  if (rigidity_ == Rigidity::compliant) body.held.upload(rigid_);
  const std::vector<char> held = body.held.download();
  std::vector<Real> strength = strength_.download();
  for (int i = 0; i < body.vertices; ++i)
    if (held[i]) strength[i] = 0;
  strength_.upload(strength);
  rigidity_ = Rigidity::rigid;
}

// Stops the vertices that are held again.  Until the next stage the pull on them is known, as the force on
// the cloth.
template <class Real, class Device>
void Pins<Real, Device>::hold_again(Body<Real, Device>& body) {
  const std::vector<char> held = body.held.download();
  const std::vector<Vec3<Real>> x = body.x.download(), v = body.v.download(), target = target_.download();
  const std::vector<Real> mass = body.mass.download();
  for (int i = 0; i < body.vertices; ++i) {
    if (!rigid_[i] || held[i]) continue;
    work_ -= static_cast<double>(mass[i]) / 2 * v[i].template cast<double>().squaredNorm();
    behind_ = std::max(behind_, (x[i] - target[i]).norm());
  }
  body.held.upload(rigid_);
  rigidity_ = Rigidity::restored;
}

template <class Real, class Device>
Real Pins<Real, Device>::farthest_behind(Body<Real, Device>& body) {
  if (!scratch_) {
    scratch_ = std::make_unique<Scratch<Device>>(*body.device);
    lag_ = Buffer<Real, Device>(*body.device, body.vertices);
  }
  find_lags(*body.device, body.vertices, compliant_pins(), body.x.data(), lag_.data());
  return -smallest(*body.device, *scratch_, lag_.data(), body.vertices, Real(0));
}

template <class Real, class Device>
void Pins<Real, Device>::end_stage(Body<Real, Device>& body) {
  behind_ = 0;
  if (!has_limited() && rigidity_ != Rigidity::compliant) return;
  const Real largest = farthest_behind(body);
  body.counts.pin_lag = std::max(body.counts.pin_lag, static_cast<double>(largest));
  if (largest > yield_distance_) ++body.counts.saturated_pins;
  if (rigidity_ != Rigidity::compliant) return;
  ++body.counts.blocked_pins;
  hold_again(body);
}

template class Pins<double, ThisDevice>;
template class Pins<float, ThisDevice>;

}  // namespace hysteron
