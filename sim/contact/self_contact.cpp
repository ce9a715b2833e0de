#include "sim/contact/self_contact.h"

#include <algorithm>
#include <cmath>

#include "sim/contact/self_touch.h"
#include "sim/contact/sliding_stop.h"

namespace hysteron {

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
      model_{static_cast<Real>(barrier_stiffness(scene.fabric.thickness)),
             static_cast<Real>(scene.fabric.friction),
             static_cast<Real>(kElasticSlip) * static_cast<Real>(scene.fabric.thickness)},
      near_(device, mesh, all ? *all : mesh, scene),
      friction_(device),
      old_friction_(device),
      stiffness_(device),
      stiffness_rows_(device, vertices_),
      push_(device),
      body_force_(device, scene.integrator == Integrator::quasi_static ? bodies_.count() : 0),
      slot_(device),
      energy_(device),
      sum_(device, 2),
      clock_(device) {}

template <class Real, class Device>
double SelfContact<Real, Device>::prepare(const Vec3<Real>* cloth, const Vec3<Real>* along_cloth,
                                          const char* held, double max_step, double kept_share) {
  clock_.begin(Stage::contact);
  bodies_.try_step(0);
  const Vec3<Real>* x = bodies_.positions(cloth);
  if (bodies_.are_barred()) yield_bodies(x, bodies_.directions(along_cloth), held);
  const StepPath<Real> path = near_.bounded_path(x, bodies_.directions(along_cloth), max_step);
  if (!near_.covers(path)) renew_list(path, bodies_.held(held));
  const double feasible = near_.feasible_fraction(path, friction_.data(), static_cast<Real>(kept_share));
  clock_.end(Stage::contact);
  return static_cast<double>(path.step_length) * feasible;
}

template <class Real, class Device>
void SelfContact<Real, Device>::yield_bodies(const Vec3<Real>* x, const Vec3<Real>* direction,
                                             const char* held) {
  const PairRows<Device>& corners = near_.corners();
  bodies_.yield({near_.pairs(), near_.count(), corners.start.data(), corners.item.data(), slot_.data()}, x,
                direction, held);
}

template <class Real, class Device>
void SelfContact<Real, Device>::renew_list(const StepPath<Real>& path, const char* held) {
  const bool had_list = near_.has_list();
  near_.find(path, held);
  carry_friction_over(had_list);  // while corners are those of the list before
  near_.index_corners();
  reserve_results();
}

template <class Real, class Device>
void SelfContact<Real, Device>::reserve_results() {
  slot_.reserve(4 * static_cast<std::size_t>(near_.count()));
  energy_.reserve(near_.count());
}

template <class Real, class Device>
void SelfContact<Real, Device>::accept_iterate(const Vec3<Real>* cloth) {
  bodies_.accept();
  if (near_.lacks_center()) near_.set_center(bodies_.positions(cloth));
}

template <class Real, class Device>
void SelfContact<Real, Device>::serialise(Archive& archive) {
  near_.serialise(archive);
  hysteron::serialise(archive, device_, friction_.reserve(near_.count()), near_.count());
  archive(stored_, loss_, body_work_);
  bodies_.serialise(archive);
  hysteron::serialise(archive, device_, body_force_);
  hysteron::serialise(archive, clock_);
  if (archive.loads()) reserve_results();
}

template <class Real, class Device>
void SelfContact<Real, Device>::update_lagged_friction(const Vec3<Real>* cloth) {
  if (!rubs()) return;
  clock_.begin(Stage::contact);
  const Vec3<Real>* x = bodies_.positions(cloth);
  const Real* of_body = bodies_.friction();
  const int first_body = vertices_;
  const SelfContactModel<Real> model = model_;
  const SelfPair<Real>* pairs = near_.pairs();
  const char* near = near_.near();
  PairFriction<Real>* friction = friction_.data();
  for_each(
      device_, "self-contact: lagged friction", near_.count(), HYST_KERNEL(int p) {
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
  const SelfPair<Real>* pairs = near_.pairs();
  const PairFriction<Real>* friction = friction_.data();
  const char* near = near_.near();
  Vec3<Real>* slot = slot_.data();
  double* energy = energy_.data();
  for_each(
      device_, "self-contact: barrier", near_.count(), HYST_KERNEL(int p) {
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
  const GatheredForces<Real> forces = gradients();
  for_each(
      device_, "self-contact: forces", vertices_, HYST_KERNEL(int i) { gradient[i] += forces.at(i); });
  clock_.end(Stage::contact);
}

template <class Real, class Device>
void SelfContact<Real, Device>::linearise(const Vec3<Real>* cloth, const Vec3<Real>* cloth_before,
                                          Real sliding_fraction) {
  clock_.begin(Stage::contact);
  const Vec3<Real>*x = bodies_.positions(cloth), *before = bodies_.positions_before(cloth_before);
  stiffnesses_ = near_.number_active(x, friction_.data(), stiffens_parallel_);
  const std::size_t entries = 4 * static_cast<std::size_t>(stiffnesses_);
  const SelfContactModel<Real> model = model_;
  const SelfPair<Real>* pairs = near_.pairs();
  const PairFriction<Real>* friction = friction_.data();
  const int *stiffnesses_of = near_.stiffnesses_of(), *first_of = near_.first_stiffness_of();
  PairStiffness<Real>* stiffness = stiffness_.reserve(stiffnesses_);
  int* key = stiffness_rows_.key.reserve(entries);
  for_each(
      device_, "self-contact: stiffness", near_.count(), HYST_KERNEL(int p) {
        if (!stiffnesses_of[p]) return;
        const SelfTouch<Real> touch = self_touch(pairs[p], model, x);
        const PairFriction<Real> f = friction[p];
        PairStiffness<Real>& s = stiffness[first_of[p]];
        for (int k = 0; k < 4; ++k) s.v[k] = pairs[p].v[k];
        for (int k = 0; k < 4 * stiffnesses_of[p]; ++k) key[4 * first_of[p] + k] = s.v[k % 4];
        if (stiffnesses_of[p] == 2) stiffness[first_of[p] + 1] = turning_stiffness(pairs[p], touch);
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
  if (bodies_.any()) take_bodies_out();
  group(device_, near_.scratch(), key, 4 * stiffnesses_, vertices_, stiffness_rows_.start.data(),
        stiffness_rows_.item.reserve(entries));
  clock_.end(Stage::contact);
}

// Takes the bodies' vertices out of the stiffnesses: a vertex of the cloth replaces them with weight 0, and
// the push of the rest of their way is stored.
template <class Real, class Device>
void SelfContact<Real, Device>::take_bodies_out() {
  const int cloth = vertices_;
  const Real left = static_cast<Real>(bodies_.left());
  const Vec3<Real>* way = bodies_.way();
  PairStiffness<Real>* stiffness = stiffness_.data();
  int* key = stiffness_rows_.key.data();
  Vec3<Real>* push = push_.reserve(stiffnesses_);
  for_each(
      device_, "self-contact: push", stiffnesses_, HYST_KERNEL(int i) {
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
  const SelfPair<Real>* pairs = near_.pairs();
  double* sum = sum_.data();
  for_each_sum<1>(
      device_, "self-contact: energy", near_.count(),
      HYST_KERNEL(int p, Sums<1>& sums) {
        const SelfTouch<Real> touch = self_touch(pairs[p], model, x);
        if (touch.touches) sums.term[0] += touch.energy;
      },
      HYST_KERNEL(const Sums<1>& total) { sum[0] = total.term[0]; });
  return sum_.download()[0] + stored_;
}

template <class Real, class Device>
std::vector<Vec3<Real>> SelfContact<Real, Device>::forces() const {
  const std::vector<int> start = near_.corners().start.download();
  std::vector<int> item(4 * static_cast<std::size_t>(near_.count()));
  std::vector<Vec3<Real>> slot(item.size()), forces(vertices_, Vec3<Real>::Zero());
  if (item.empty()) return forces;
  device_download(device_, item.data(), near_.corners().item.data(), item.size() * sizeof(int));
  device_download(device_, slot.data(), slot_.data(), slot.size() * sizeof(Vec3<Real>));
  for (int i = 0; i < vertices_; ++i)
    for (int j = start[i]; j < start[i + 1]; ++j) forces[i] -= slot[item[j]];
  return forces;
}

template <class Real, class Device>
std::size_t SelfContact<Real, Device>::bytes() const {
  return total_bytes(bodies_, near_, friction_, old_friction_, stiffness_, stiffness_rows_, push_,
                     body_force_, slot_, energy_, sum_);
}

// The following keep the memory of friction between layers: the stops' stretch from step to step and from
// list to list.

// Carries over the friction of pairs that stay in the list, or follow their neighbours.
template <class Real, class Device>
void SelfContact<Real, Device>::carry_friction_over(bool had_list) {
  if (had_list) near_.gather_rubbing(friction_.data());
  friction_.swap(old_friction_);
  PairFriction<Real>* friction = friction_.reserve(near_.count());
  const PairFriction<Real>* old = old_friction_.data();
  const SelfPairs<Real, Device>& list = near_.list();
  const SelfPair<Real>*pairs = list.pairs(), *old_pairs = list.old_pairs();
  const int *start = list.start(), *old_start = list.old_start();
  const RubbingRows rubbing = near_.rubbing();  // of the list before
  for_each(
      device_, "self-contact: carry over", list.rows(), HYST_KERNEL(int row) {
        for (int p = start[row]; p < start[row + 1]; ++p) {
          int same = -1;
          for (int q = old_start[row]; q < old_start[row + 1]; ++q)
            if (old_pairs[q].other == pairs[p].other) same = q;
          if (same >= 0) {
            friction[p] = old[same];
          } else {
            const Vec3<Real> slip =
                had_list ? inherited_slip(pairs[p], old_pairs, old, rubbing) : Vec3<Real>(Vec3<Real>::Zero());
            friction[p] = {slip, Vec3<Real>::Zero(), Vec<Real, 4>::Zero(), 0};
          }
        }
      });
}

// Stretches and slides the stops; work done against them that they do not store is lost.
template <class Real, class Device>
void SelfContact<Real, Device>::commit(const Vec3<Real>* cloth, const Vec3<Real>* cloth_before) {
  if (bodies_.any()) {
    add_body_work();
    bodies_.keep_dents();
  }
  if (!rubs()) return;
  clock_.begin(Stage::contact);
  const Vec3<Real>*x = bodies_.positions(cloth), *before = bodies_.positions_before(cloth_before);
  const SelfContactModel<Real> model = model_;
  const SelfPair<Real>* pairs = near_.pairs();
  PairFriction<Real>* friction = friction_.data();
  double* sum = sum_.data();
  for_each_sum<2>(
      device_, "self-contact: history", near_.count(),
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
void SelfContact<Real, Device>::add_body_work() {
  const GatheredForces<Real> forces = gradients();
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

// Passes the stretch of rubbing pairs' stops on to pairs that do not rub yet.
template <class Real, class Device>
void SelfContact<Real, Device>::pass_friction_on() {
  near_.gather_rubbing(friction_.data());
  const SelfPair<Real>* pairs = near_.pairs();
  const RubbingRows rubbing = near_.rubbing();
  PairFriction<Real>* friction = friction_.data();
  for_each(
      device_, "self-contact: inherit", near_.count(), HYST_KERNEL(int p) {
        if (!(friction[p].limit > 0)) friction[p].slip = inherited_slip(pairs[p], pairs, friction, rubbing);
      });
}

template class SelfContact<double, ThisDevice>;
template class SelfContact<float, ThisDevice>;

}  // namespace hysteron
