#include "sim/contact/self_contact.h"

#include <algorithm>
#include <cmath>

#include "sim/contact/self_touch.h"
#include "sim/contact/sliding_stop.h"

namespace hysteron {

namespace {

constexpr double kDisplacementOfEdge = 5;  // largest displacement of a step, over the mean edge length
constexpr double kReachOfEdge = 0.2;       // largest reach of lists beyond a path, over the mean edge length
constexpr double kPressedNearer = 0.9;  // share of their distance that a guess leaves pressed layers at least
constexpr double kSafely = 1.01;        // exceeds the rounding of distances beside the thickness

double mean_edge(const ClothMesh& mesh) {
  double sum = 0;
  for (const Edge& e : mesh.edge) sum += (mesh.rest[e.p3] - mesh.rest[e.p2]).norm();
  return sum / static_cast<double>(mesh.edge.size());
}

}  // namespace

template <class Real, class Device>
SelfContact<Real, Device>::SelfContact(Device& device, const ClothMesh& mesh, const Scene& scene)
    : SelfContact(device, mesh,
                  has_mesh_bodies(scene) ? std::optional(mesh_with_bodies(mesh, scene)) : std::nullopt,
                  scene) {}

template <class Real, class Device>
SelfContact<Real, Device>::SelfContact(Device& device, const ClothMesh& mesh,
                                       const std::optional<ClothMesh>& all, const Scene& scene)
    : device_(device),
      vertices_(mesh.vertices()),
      bodies_(device, scene, vertices_),
      thickness_(static_cast<Real>(scene.fabric.thickness)),
      least_reach_(thickness_ / 4),
      most_reach_(std::max(thickness_, static_cast<Real>(kReachOfEdge * mean_edge(mesh)))),
      max_displacement_(std::max(4 * thickness_, static_cast<Real>(kDisplacementOfEdge * mean_edge(mesh)))),
      model_{static_cast<Real>(barrier_stiffness(scene.fabric.thickness)),
             static_cast<Real>(scene.fabric.friction), static_cast<Real>(kElasticSlip) * thickness_},
      pairs_(device, all ? *all : mesh, scene.fabric.thickness, vertices_, scene.self_contact),
      center_(device, bodies_.all()),
      step_length_(device),
      near_(device),
      friction_(device),
      old_friction_(device),
      presses_(device),
      active_(device),
      stiffness_(device),
      push_(device),
      body_force_(device, scene.integrator == Integrator::quasi_static ? bodies_.count() : 0),
      rows_(device, bodies_.all()),
      stiffness_rows_(device, vertices_),
      active_end_(device, bodies_.all()),
      active_item_(device),
      slot_(device),
      energy_(device),
      sum_(device, 2),
      clock_(device) {}

// Returns the longest displacement of any vertex of the cloth at the full step, less the mean of all [m].
template <class Real, class Device>
Real SelfContact<Real, Device>::longest_displacement(const Vec3<Real>* direction) {
  const Vec3<Real> mean = pairs_.mean_direction(direction);
  Real* lengths = step_length_.reserve(vertices_);
  for_each(
      device_, "self-contact: displacements", vertices_,
      HYST_KERNEL(int i) { lengths[i] = -(direction[i] - mean).norm(); });
  return -smallest(device_, pairs_.scratch(), lengths, vertices_, Real(0));
}

// Returns the largest distance of the step's end from the positions for which the list of pairs was made [m].
template <class Real, class Device>
Real SelfContact<Real, Device>::farthest(const Vec3<Real>* x, const Vec3<Real>* direction, Real step_length) {
  const Vec3<Real>* center = center_.data();
  Real* lengths = step_length_.reserve(bodies_.all());
  for_each(
      device_, "self-contact: lengths", bodies_.all(),
      HYST_KERNEL(int i) { lengths[i] = -(x[i] + step_length * direction[i] - center[i]).norm(); });
  return -smallest(device_, pairs_.scratch(), lengths, bodies_.all(), Real(0));
}

template <class Real, class Device>
double SelfContact<Real, Device>::prepare(const Vec3<Real>* cloth, const Vec3<Real>* along_cloth,
                                          const char* held, double max_step,
                                          double archived_activation_distance) {
  clock_.begin(Stage::contact);
  bodies_.try_step(0);
  const Vec3<Real>*x = bodies_.positions(cloth), *direction = bodies_.directions(along_cloth);
  if (bodies_.are_barred()) {
    bodies_.yield({pairs_.pairs(), pairs_.count(), rows_.start.data(), rows_.item.data(), slot_.data()}, x,
                  direction, held);
    direction = bodies_.directions(along_cloth);
  }
  const Real longest = longest_displacement(direction), requested = static_cast<Real>(max_step),
             step_length = requested * longest > max_displacement_ ? max_displacement_ / longest : requested;
  if (!ready_ || pending_ || !(farthest(x, direction, step_length) <= reach_))
    rebuild(x, direction, step_length, bodies_.held(held),
            std::clamp(step_length * longest / 2, least_reach_, most_reach_));
  const SelfPair<Real>* pairs = pairs_.pairs();
  const PairFriction<Real>* friction = friction_.data();
  Real* feasible = step_length_.reserve(pairs_.count());
  char* near = near_.reserve(pairs_.count());
  const Real kept = static_cast<Real>(archived_activation_distance);
  for_each(
      device_, "self-contact: collisions", pairs_.count(), HYST_KERNEL(int p) {
        const SelfPair<Real> pair = pairs[p];
        Vec3<Real> from[4], along[4];
        pair.gather(x, from);
        pair.gather(direction, along);
        for (Vec3<Real>& d : along) d *= step_length;
        const Approach<Real> start = approach(from, along, pair.is_edges());
        near[p] =
            start.distance - start.speed < Real(kSafely) * pair.activation_distance || friction[p].limit > 0;
        const Real least = least_distance(pair), nearer = Real(kPressedNearer) * start.distance;
        const Real wanted =
            kept * pair.activation_distance < nearer ? kept * pair.activation_distance : nearer;
        feasible[p] = feasible_step(start, from, along, pair.is_edges(), wanted > least ? wanted : least);
      });
  const double least = smallest(device_, pairs_.scratch(), feasible, pairs_.count(), Real(1));
  clock_.end(Stage::contact);
  return static_cast<double>(step_length) * least;
}

template <class Real, class Device>
void SelfContact<Real, Device>::accept_iterate(const Vec3<Real>* cloth) {
  bodies_.accept();
  if (!pending_) return;
  pending_ = false;
  const Vec3<Real>* x = bodies_.positions(cloth);
  Vec3<Real>* center = center_.data();
  for_each(
      device_, "self-contact: moved", bodies_.all(), HYST_KERNEL(int i) { center[i] = x[i]; });
}

template <class Real, class Device>
void SelfContact<Real, Device>::rebuild(const Vec3<Real>* x, const Vec3<Real>* direction, Real step_length,
                                        const char* held, Real reach) {
  reach_ = reach;
  pairs_.find(x, direction, step_length, held, reach);
  carry_over();
  index_corners();
  ready_ = pending_ = true;
}

// Finds the pairs of each vertex, and makes room for their results.
template <class Real, class Device>
void SelfContact<Real, Device>::index_corners() {
  const int count = pairs_.count();
  slot_.reserve(4 * static_cast<std::size_t>(count));
  energy_.reserve(count);
  active_item_.reserve(4 * static_cast<std::size_t>(count));
  int* key = rows_.key.reserve(4 * static_cast<std::size_t>(count));
  const SelfPair<Real>* pairs = pairs_.pairs();
  for_each(
      device_, "self-contact: corners", count, HYST_KERNEL(int p) {
        for (int k = 0; k < 4; ++k) key[4 * p + k] = pairs[p].v[k];
      });
  group(device_, pairs_.scratch(), key, 4 * count, bodies_.all(), rows_.start.data(),
        rows_.item.reserve(4 * static_cast<std::size_t>(count)));
}

template <class Real, class Device>
void SelfContact<Real, Device>::serialise(Archive& archive) {
  pairs_.serialise(archive);
  hysteron::serialise(archive, device_, friction_.reserve(pairs_.count()), pairs_.count());
  archive(ready_);
  archive(pending_);
  archive(reach_);
  archive(stored_);
  archive(loss_);
  archive(body_work_);
  bodies_.serialise(archive);
  hysteron::serialise(archive, device_, body_force_);
  hysteron::serialise(archive, device_, center_);
  hysteron::serialise(archive, clock_);
  if (archive.loads()) index_corners();
}

template <class Real, class Device>
void SelfContact<Real, Device>::update_lagged_friction(const Vec3<Real>* cloth) {
  if (!rubs()) return;
  clock_.begin(Stage::contact);
  const Vec3<Real>* x = bodies_.positions(cloth);
  const Real* of_body = bodies_.friction();
  const int first_body = vertices_;
  const SelfContactModel<Real> model = model_;
  const SelfPair<Real>* pairs = pairs_.pairs();
  const char* near = near_.data();
  PairFriction<Real>* friction = friction_.data();
  for_each(
      device_, "self-contact: lagged friction", pairs_.count(), HYST_KERNEL(int p) {
        if (!near[p]) return;  // its limit is 0
        const SelfTouch<Real> touch = self_touch(pairs[p], model, x);
        const int last = pairs[p].v[0] < pairs[p].v[3] ? pairs[p].v[3] : pairs[p].v[0];
        const Real coefficient = last < first_body ? model.friction : of_body[last - first_body];
        friction[p].limit = touch.touches ? coefficient * touch.force : Real(0);
        if (!touch.touches) return;
        friction[p].normal = touch.normal;
        friction[p].weight = touch.weight;
      });
  clock_.end(Stage::contact);
}

template <class Real, class Device>
void SelfContact<Real, Device>::evaluate(const Vec3<Real>* cloth, const Vec3<Real>* cloth_before,
                                         Vec3<Real>* gradient) {
  clock_.begin(Stage::contact);
  const Vec3<Real>*x = bodies_.positions(cloth), *before = bodies_.positions_before(cloth_before);
  const SelfContactModel<Real> model = model_;
  const SelfPair<Real>* pairs = pairs_.pairs();
  const PairFriction<Real>* friction = friction_.data();
  const char* near = near_.data();
  Vec3<Real>* slot = slot_.data();
  double* energy = energy_.data();
  for_each(
      device_, "self-contact: barrier", pairs_.count(), HYST_KERNEL(int p) {
        if (!near[p]) {
          for (int k = 0; k < 4; ++k) slot[4 * p + k].setZero();
          energy[p] = 0;
          return;
        }
        const SelfTouch<Real> touch = self_touch(pairs[p], model, x);
        for (int k = 0; k < 4; ++k)
          slot[4 * p + k] = touch.touches ? barrier_gradient(touch, k) : Vec3<Real>(Vec3<Real>::Zero());
        energy[p] = touch.touches ? touch.energy : 0;
        const PairFriction<Real> f = friction[p];
        if (!(f.limit > 0)) return;
        const Vec3<Real> e = pair_slip(pairs[p], f, x, before);
        const Real length = e.norm(), k_t = f.limit / model.slip;
        const bool slides = length > model.slip;
        energy[p] +=
            static_cast<double>(slides ? f.limit * (length - model.slip / 2) : k_t * length * length / 2);
        const Vec3<Real> force = (slides ? f.limit / length : k_t) * e;
        for (int k = 0; k < 4; ++k) slot[4 * p + k] += f.weight[k] * force;
      });
  const GatheredForces<Real> forces{rows_.start.data(), rows_.item.data(), slot};
  for_each(
      device_, "self-contact: forces", vertices_, HYST_KERNEL(int i) { gradient[i] += forces.at(i); });
  clock_.end(Stage::contact);
}

// Numbers the stiffnesses of the pairs that touch or have friction; returns how many there are.
template <class Real, class Device>
int SelfContact<Real, Device>::find_active(const Vec3<Real>* x) {
  const int count = pairs_.count();
  const SelfPair<Real>* pairs = pairs_.pairs();
  const PairFriction<Real>* friction = friction_.data();
  const char* near = near_.data();
  const bool stiffens_parallel = stiffens_parallel_;
  int* presses = presses_.reserve(count);
  for_each(
      device_, "self-contact: pressing", count, HYST_KERNEL(int p) {
        presses[p] = 0;
        if (!near[p]) return;
        Vec3<Real> at[4];
        pairs[p].gather(x, at);
        const bool touches = pair_distance(at, pairs[p].is_edges()) < pairs[p].activation_distance;
        presses[p] = touches && stiffens_parallel && are_fading(pairs[p], at) ? 2
                     : touches || friction[p].limit > 0                       ? 1
                                                                              : 0;
      });
  return exclusive_scan(device_, pairs_.scratch(), presses, count, active_.reserve(count + 1));
}

template <class Real, class Device>
void SelfContact<Real, Device>::linearise(const Vec3<Real>* cloth, const Vec3<Real>* cloth_before,
                                          Real sliding_fraction) {
  clock_.begin(Stage::contact);
  const Vec3<Real>*x = bodies_.positions(cloth), *before = bodies_.positions_before(cloth_before);
  active_count_ = find_active(x);
  const std::size_t entries = 4 * static_cast<std::size_t>(active_count_);
  const SelfContactModel<Real> model = model_;
  const SelfPair<Real>* pairs = pairs_.pairs();
  const PairFriction<Real>* friction = friction_.data();
  const int *presses = presses_.data(), *number = active_.data();
  PairStiffness<Real>* stiffness = stiffness_.reserve(active_count_);
  int* key = stiffness_rows_.key.reserve(entries);
  for_each(
      device_, "self-contact: stiffness", pairs_.count(), HYST_KERNEL(int p) {
        if (!presses[p]) return;
        const SelfTouch<Real> touch = self_touch(pairs[p], model, x);
        const PairFriction<Real> f = friction[p];
        PairStiffness<Real>& s = stiffness[number[p]];
        for (int k = 0; k < 4; ++k) s.v[k] = pairs[p].v[k];
        for (int k = 0; k < 4 * presses[p]; ++k) key[4 * number[p] + k] = s.v[k % 4];
        if (presses[p] == 2) stiffness[number[p] + 1] = turning_stiffness(pairs[p], touch);
        s.block.setZero();
        s.weight = f.weight;
        if (touch.touches) {
          s.block = touch.stiffness * touch.normal * touch.normal.transpose();
          s.weight = touch.weight;
        }
        if (!(f.limit > 0)) return;
        const Vec3<Real> e = pair_slip(pairs[p], f, x, before);
        s.block += sliding_stiffness<Real>(e, f.normal, f.limit / model.slip, model.slip, sliding_fraction);
      });
  if (bodies_.any()) leave_cloth_alone();
  group(device_, pairs_.scratch(), key, 4 * active_count_, vertices_, stiffness_rows_.start.data(),
        stiffness_rows_.item.reserve(entries));
  clock_.end(Stage::contact);
}

// Takes the bodies' vertices out of the stiffnesses: a vertex of the cloth replaces them with weight 0, and
// the push of the rest of their way is stored.
template <class Real, class Device>
void SelfContact<Real, Device>::leave_cloth_alone() {
  const int cloth = vertices_;
  const Real left = static_cast<Real>(bodies_.left());
  const Vec3<Real>* way = bodies_.way();
  PairStiffness<Real>* stiffness = stiffness_.data();
  int* key = stiffness_rows_.key.data();
  Vec3<Real>* push = push_.reserve(active_count_);
  for_each(
      device_, "self-contact: push", active_count_, HYST_KERNEL(int i) {
        PairStiffness<Real>& s = stiffness[i];
        Vec3<Real> apart = Vec3<Real>::Zero();
        int own = 0;
        for (int k = 0; k < 4; ++k)
          if (s.v[k] < cloth) own = s.v[k];
        for (int k = 0; k < 4; ++k) {
          if (s.v[k] < cloth) continue;
          apart += s.weight[k] * left * way[s.v[k] - cloth];
          s.v[k] = key[4 * i + k] = own;
          s.weight[k] = 0;
        }
        push[i] = s.block * apart;
      });
}

template <class Real, class Device>
void SelfContact<Real, Device>::add_push(Vec3<Real>* force) {
  if (bodies_.have_arrived()) return;
  const PairProduct<Real> rows = product();
  const Vec3<Real>* push = push_.data();
  for_each(
      device_, "self-contact: pushed", vertices_, HYST_KERNEL(int i) {
        for (int j = rows.start[i]; j < rows.start[i + 1]; ++j)
          force[i] -= rows.pair[rows.item[j] / 4].weight[rows.item[j] % 4] * push[rows.item[j] / 4];
      });
}

template <class Real, class Device>
void SelfContact<Real, Device>::add_stiffness_diagonal(Mat3<Real>* diagonal) {
  const PairProduct<Real> rows = product();
  for_each(
      device_, "self-contact: diagonal", vertices_, HYST_KERNEL(int i) {
        for (int j = rows.start[i]; j < rows.start[i + 1]; ++j) {
          const PairStiffness<Real>& s = rows.pair[rows.item[j] / 4];
          const Real w = s.weight[rows.item[j] % 4];
          diagonal[i] += w * w * s.block;
        }
      });
}

template <class Real, class Device>
double SelfContact<Real, Device>::stored_energy(const Vec3<Real>* cloth) {
  const Vec3<Real>* x = bodies_.positions(cloth);
  const SelfContactModel<Real> model = model_;
  const SelfPair<Real>* pairs = pairs_.pairs();
  double* sum = sum_.data();
  for_each_sum<1>(
      device_, "self-contact: energy", pairs_.count(),
      HYST_KERNEL(int p, Sums<1>& sums) {
        const SelfTouch<Real> touch = self_touch(pairs[p], model, x);
        if (touch.touches) sums.term[0] += touch.energy;
      },
      HYST_KERNEL(const Sums<1>& total) { sum[0] = total.term[0]; });
  return sum_.download()[0] + stored_;
}

template <class Real, class Device>
std::vector<Vec3<Real>> SelfContact<Real, Device>::forces() const {
  const std::vector<int> start = rows_.start.download();
  std::vector<int> item(4 * static_cast<std::size_t>(pairs_.count()));
  std::vector<Vec3<Real>> slot(item.size()), forces(vertices_, Vec3<Real>::Zero());
  if (item.empty()) return forces;
  device_download(device_, item.data(), rows_.item.data(), item.size() * sizeof(int));
  device_download(device_, slot.data(), slot_.data(), slot.size() * sizeof(Vec3<Real>));
  for (int i = 0; i < vertices_; ++i)
    for (int j = start[i]; j < start[i + 1]; ++j) forces[i] -= slot[item[j]];
  return forces;
}

template <class Real, class Device>
SelfPair<Real> SelfContact<Real, Device>::blocking_pair() const {
  std::vector<Real> feasible(pairs_.count());
  device_download(device_, feasible.data(), step_length_.data(), feasible.size() * sizeof(Real));
  const auto least = std::min_element(feasible.begin(), feasible.end()) - feasible.begin();
  SelfPair<Real> pair;
  device_download(device_, &pair, pairs_.pairs() + least, sizeof pair);
  return pair;
}

template <class Real, class Device>
std::size_t SelfContact<Real, Device>::bytes() const {
  return pairs_.bytes() + center_.bytes() + step_length_.bytes() + friction_.bytes() + old_friction_.bytes() +
         near_.bytes() + active_end_.bytes() + active_item_.bytes() + presses_.bytes() + active_.bytes() +
         stiffness_.bytes() + push_.bytes() + body_force_.bytes() + bodies_.bytes() + rows_.bytes() +
         stiffness_rows_.bytes() + slot_.bytes() + energy_.bytes() + sum_.bytes();
}

// The following keep the memory of friction between layers: the stops' stretch from step to step and from
// list to list.

// Gathers for each vertex the entries of active pairs, in the order of all: they are few, and most pairs
// search them.
template <class Real, class Device>
void SelfContact<Real, Device>::gather_active() {
  const int *start = rows_.start.data(), *item = rows_.item.data();
  const PairFriction<Real>* friction = friction_.data();
  int *end = active_end_.data(), *bearing = active_item_.data();
  for_each(
      device_, "self-contact: bearing", bodies_.all(), HYST_KERNEL(int i) {
        int n = start[i];
        for (int j = start[i]; j < start[i + 1]; ++j)
          if (friction[item[j] / 4].limit > 0) bearing[n++] = item[j];
        end[i] = n;
      });
}

// Carries over the friction of pairs that stay in the list, or follow their neighbours.
template <class Real, class Device>
void SelfContact<Real, Device>::carry_over() {
  if (ready_) gather_active();
  friction_.swap(old_friction_);
  PairFriction<Real>* friction = friction_.reserve(pairs_.count());
  const PairFriction<Real>* old = old_friction_.data();
  const SelfPair<Real>*pairs = pairs_.pairs(), *old_pairs = pairs_.old_pairs();
  const int *start = pairs_.start(), *old_start = pairs_.old_start();
  const ActiveRows bearing = this->bearing();  // of the list before
  const bool has_old = ready_;
  for_each(
      device_, "self-contact: carry over", pairs_.rows(), HYST_KERNEL(int row) {
        for (int p = start[row]; p < start[row + 1]; ++p) {
          int same = -1;
          for (int q = old_start[row]; q < old_start[row + 1]; ++q)
            if (old_pairs[q].other == pairs[p].other) same = q;
          if (same >= 0) {
            friction[p] = old[same];
          } else {
            const Vec3<Real> slip =
                has_old ? inherited_slip(pairs[p], old_pairs, old, bearing) : Vec3<Real>(Vec3<Real>::Zero());
            friction[p] = {slip, Vec3<Real>::Zero(), Vec<Real, 4>::Zero(), 0};
          }
        }
      });
}

// Stretches and slides the stops; work done against them that they do not store is lost.
template <class Real, class Device>
void SelfContact<Real, Device>::commit(const Vec3<Real>* cloth, const Vec3<Real>* cloth_before) {
  if (bodies_.any()) {
    book_body_work();
    bodies_.keep_dents();
  }
  if (!rubs()) return;
  clock_.begin(Stage::contact);
  const Vec3<Real>*x = bodies_.positions(cloth), *before = bodies_.positions_before(cloth_before);
  const SelfContactModel<Real> model = model_;
  const SelfPair<Real>* pairs = pairs_.pairs();
  PairFriction<Real>* friction = friction_.data();
  double* sum = sum_.data();
  for_each_sum<2>(
      device_, "self-contact: history", pairs_.count(),
      HYST_KERNEL(int p, Sums<2>& sums) {
        PairFriction<Real>& f = friction[p];
        if (!(f.limit > 0)) {
          f.slip.setZero();
          return;
        }
        const Vec3<Real> e = pair_slip(pairs[p], f, x, before);
        const Real length = e.norm(), k_t = f.limit / model.slip;
        const Vec3<Real> held = length > model.slip ? Vec3<Real>(model.slip / length * e) : e;
        sums.term[0] += static_cast<double>(k_t * held.dot(e - f.slip));
        sums.term[1] += static_cast<double>(k_t * held.squaredNorm() / 2);
        f.slip = held;
      },
      HYST_KERNEL(const Sums<2>& total) {
        sum[0] = total.term[0];
        sum[1] = total.term[1];
      });
  const std::vector<double> total = sum_.download();
  loss_ += stored_ + total[0] - total[1];
  stored_ = total[1];
  pass_friction_on();
  clock_.end(Stage::contact);
}

// Adds the work of moving bodies on the cloth: that of the forces on their vertices over their way; in
// statics of the mean of the forces before and after it.
template <class Real, class Device>
void SelfContact<Real, Device>::book_body_work() {
  const GatheredForces<Real> forces{rows_.start.data(), rows_.item.data(), slot_.data()};
  const int first = vertices_;
  const Vec3<Real>*from = bodies_.from(), *start = bodies_.start(), *way = bodies_.way();
  Vec3<Real>* kept = body_force_.size() > 0 ? body_force_.data() : nullptr;
  double* sum = sum_.data();
  for_each_sum<1>(
      device_, "self-contact: work of bodies", bodies_.count(),
      HYST_KERNEL(int i, Sums<1>& sums) {
        const Vec3<Real> now = forces.at(first + i);
        const Vec3<Real> mean = kept ? Vec3<Real>(Real(0.5) * (now + kept[i])) : now;
        if (kept) kept[i] = now;
        sums.term[0] += static_cast<double>(mean.dot(start[i] - from[i] + way[i]));
      },
      HYST_KERNEL(const Sums<1>& total) { sum[0] = total.term[0]; });
  body_work_ += sum_.download()[0];
}

// Passes the stretch of active pairs' stops on to pairs that are not active yet.
template <class Real, class Device>
void SelfContact<Real, Device>::pass_friction_on() {
  gather_active();
  const SelfPair<Real>* pairs = pairs_.pairs();
  const ActiveRows bearing = this->bearing();
  PairFriction<Real>* friction = friction_.data();
  for_each(
      device_, "self-contact: hand over", pairs_.count(), HYST_KERNEL(int p) {
        if (!(friction[p].limit > 0)) friction[p].slip = inherited_slip(pairs[p], pairs, friction, bearing);
      });
}

template class SelfContact<double, ThisDevice>;
template class SelfContact<float, ThisDevice>;

}  // namespace hysteron
