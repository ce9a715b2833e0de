// What friction between layers remembers: the stops' stretch from step to step and from list to list.
#include "sim/contact/self_contact.h"
#include "sim/contact/self_touch.h"

namespace hysteron {

// Of each vertex the entries whose pairs bear, in the order of all: few, and most pairs look through them.
template <class Real, class Device>
void SelfContact<Real, Device>::gather_bearing() {
  const int *start = rows_.start.data(), *item = rows_.item.data();
  const PairFriction<Real>* friction = friction_.data();
  int *end = bearing_end_.data(), *bearing = bearing_item_.data();
  for_each(
      device_, "self-contact: bearing", vertices_, HYST_KERNEL(int i) {
        int n = start[i];
        for (int j = start[i]; j < start[i + 1]; ++j)
          if (friction[item[j] / 4].limit > 0) bearing[n++] = item[j];
        end[i] = n;
      });
}

// Friction of the pairs that stay in the list, or follow on neighbours.
template <class Real, class Device>
void SelfContact<Real, Device>::carry_over() {
  if (ready_) gather_bearing();
  friction_.swap(old_friction_);
  PairFriction<Real>* friction = friction_.reserve(pairs_.count());
  const PairFriction<Real>* old = old_friction_.data();
  const SelfPair<Real>*pairs = pairs_.pairs(), *old_pairs = pairs_.old_pairs();
  const int *start = pairs_.start(), *old_start = pairs_.old_start();
  const BearingRows bearing = this->bearing();  // of the list before
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

// The stops stretch and slide; work done against them that they do not store is lost.
template <class Real, class Device>
void SelfContact<Real, Device>::commit(const Vec3<Real>* x, const Vec3<Real>* before) {
  if (!(model_.friction > 0)) return;
  clock_.begin(Stage::contact);
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
  hand_over();
  clock_.end(Stage::contact);
}

// To pairs that do not bear yet.
template <class Real, class Device>
void SelfContact<Real, Device>::hand_over() {
  gather_bearing();
  const SelfPair<Real>* pairs = pairs_.pairs();
  const BearingRows bearing = this->bearing();
  PairFriction<Real>* friction = friction_.data();
  for_each(
      device_, "self-contact: hand over", pairs_.count(), HYST_KERNEL(int p) {
        if (!(friction[p].limit > 0)) friction[p].slip = inherited_slip(pairs[p], pairs, friction, bearing);
      });
}

template class SelfContact<double, ThisDevice>;
template class SelfContact<float, ThisDevice>;

}  // namespace hysteron
