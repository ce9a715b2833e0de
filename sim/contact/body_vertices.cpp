#include "sim/contact/body_vertices.h"

#include <cmath>

#include "sim/contact/self_touch.h"
#include "sim/device/archive_buffer.h"
#include "sim/scene/body.h"

namespace hysteron {

namespace {

std::vector<Obstacle> mesh_bodies(const Scene& scene) {
  std::vector<Obstacle> bodies;
  for (const Obstacle& o : scene.obstacle)
    if (is_body(o)) bodies.push_back(o);
  return bodies;
}

int vertices_of(const std::vector<Obstacle>& bodies) {
  int count = 0;
  for (const Obstacle& o : bodies) count += o.mesh->vertices();
  return count;
}

template <class Real>
std::vector<Vec3<Real>> positions_at(const std::vector<Obstacle>& bodies, double time) {
  std::vector<Vec3<Real>> all;
  all.reserve(vertices_of(bodies));
  for (const Obstacle& o : bodies)
    for (const Eigen::Vector3d& x : body_positions(o, time)) all.push_back(x.cast<Real>());
  return all;
}

// Returns the share of the activation distance of a body and cloth at which the pressure is kYieldPressure.
double yield_share(double thickness) {
  SelfPair<double> pair{};
  pair.activation_distance = thickness;
  const double k = barrier_stiffness(thickness);
  double low = kClosest, high = 1;
  constexpr double kWithin = 1e-12;
  while (high - low > kWithin) {
    const double middle = (low + high) / 2;
    (-pair_barrier(pair, k, middle * thickness).slope > kYieldPressure ? low : high) = middle;
  }
  return high;
}

}  // namespace

template <class Real, class Device>
BodyVertices<Real, Device>::BodyVertices(Device& device, const Scene& scene, int cloth)
    : device_(device),
      body_(mesh_bodies(scene)),
      cloth_(cloth),
      count_(vertices_of(body_)),
      yield_share_(static_cast<Real>(yield_share(scene.fabric.thickness))),
      thickness_(scene.fabric.thickness),
      from_(device, count_),
      start_(device, count_),
      way_(device, count_),
      dent_(device, count_),
      behind_(device, count_),
      recede_(device),
      length_(device),
      scratch_(device),
      friction_(device, count_),
      position_(device, any() ? all() : 0),
      before_(device, any() ? all() : 0),
      direction_(device, any() ? all() : 0),
      held_(device, any() ? all() : 0) {
  if (!any()) return;
  std::vector<Real> friction;
  for (const Obstacle& o : body_) {
    const double mu = o.friction < 0 ? scene.fabric.friction : o.friction;
    friction.insert(friction.end(), o.mesh->vertices(), static_cast<Real>(mu));
    rubs_ |= mu > 0;
  }
  friction_.upload(friction);
  move(0, 0);
  try_step(1);
  accept();
}

template <class Real, class Device>
void BodyVertices<Real, Device>::move(double start, double end) {
  if (!any()) return;
  if (start != end_time_ || end_.empty()) end_ = positions_at<Real>(body_, start);
  start_.upload(end_);
  end_ = positions_at<Real>(body_, end);
  end_time_ = end;
  way_.upload(end_);
  begin_way(std::exp(-(end - start) / kRecovery));
  begin_guess();
  aim(1);
}

// Begins the way between the scene's positions at the stage's start and end, which are in start_ and way_;
// kept_dent is the share of their dents that is left at its end.
template <class Real, class Device>
void BodyVertices<Real, Device>::begin_way(double kept_dent) {
  const Real kept = static_cast<Real>(kept_dent);
  const Vec3<Real>* dent = dent_.data();
  Vec3<Real>*from = from_.data(), *start = start_.data(), *way = way_.data(), *behind = behind_.data();
  for_each(
      device_, "self-contact: bodies' way", count_, HYST_KERNEL(int i) {
        from[i] = start[i] += dent[i];
        behind[i] = kept * dent[i];
        way[i] += behind[i] - start[i];
      });
  has_yielded_ = false;
}

template <class Real, class Device>
void BodyVertices<Real, Device>::begin_guess() {
  gone_ = at_ = 0;
  steps_ = 0;
  if (has_yielded_) restart_way();
}

// Makes bodies that have yielded go from where the stage began to the same end.
template <class Real, class Device>
void BodyVertices<Real, Device>::restart_way() {
  const Vec3<Real>* from = from_.data();
  Vec3<Real>*start = start_.data(), *way = way_.data();
  for_each(
      device_, "self-contact: bodies' way", count_, HYST_KERNEL(int i) {
        way[i] += start[i] - from[i];
        start[i] = from[i];
      });
}

template <class Real, class Device>
const Vec3<Real>* BodyVertices<Real, Device>::joined(const Vec3<Real>* cloth,
                                                     Buffer<Vec3<Real>, Device>& into,
                                                     const Vec3<Real>* start, double of_way) {
  if (!any()) return cloth;
  const Real share = static_cast<Real>(of_way);
  const int first = cloth_;
  const Vec3<Real>* way = way_.data();
  Vec3<Real>* to = into.data();
  for_each(
      device_, "self-contact: bodies", all(), HYST_KERNEL(int i) {
        if (i < first) {
          to[i] = cloth[i];
          return;
        }
        to[i] = share * way[i - first];
        if (start) to[i] += start[i - first];
      });
  return to;
}

// Finds how far each pair asks the vertices of its body to stay back: all vertices that carry it, equally
// far.
template <class Real, class Device>
void BodyVertices<Real, Device>::find_recession(const PressedPairs<Real>& pressed, const Vec3<Real>* x,
                                                const Vec3<Real>* direction, const char* held) {
  const int first = cloth_;
  const Real share = yield_share_;
  const PressedPairs<Real> pairs = pressed;
  Vec3<Real>* recede = recede_.reserve(4 * static_cast<std::size_t>(pairs.count));
  for_each(
      device_, "self-contact: yield", pairs.count, HYST_KERNEL(int p) {
        const SelfPair<Real> pair = pairs.pair[p];
        for (int k = 0; k < 4; ++k) recede[4 * p + k].setZero();
        if (pair.v[0] < first && pair.v[3] < first) return;
        Vec3<Real> at[4];
        pair.gather(x, at);
        const ClosestPoints<Real> closest = pair.is_edges() ? edge_edge(at) : point_triangle(at);
        const Real distance = closest.offset.norm(), yield = share * pair.activation_distance;
        if (!(distance < yield)) return;
        const Vec3<Real> normal = closest.offset / distance;
        Real after = distance;
        for (int k = 0; k < 4; ++k) after += closest.weight[k] * normal.dot(direction[pair.v[k]]);
        if (!(after < yield)) return;
        bool stays = false;
        for (int k = 0; k < 4; ++k)
          if (pair.v[k] < first && closest.weight[k] != 0)
            stays |= held[pair.v[k]] || pairs.squeeze(pair.v[k]);
        if (!stays) return;
        const Real back = pair.v[0] < first ? after - yield : yield - after;
        for (int k = 0; k < 4; ++k)
          if (pair.v[k] >= first && closest.weight[k] != 0) recede[4 * p + k] = back * normal;
      });
}

// Makes each vertex stay back as its pairs ask, one after the other: each asks only for what the ones before
// have left missing.
template <class Real, class Device>
void BodyVertices<Real, Device>::yield(const PressedPairs<Real>& pairs, const Vec3<Real>* x,
                                       const Vec3<Real>* direction, const char* held) {
  find_recession(pairs, x, direction, held);
  has_yielded_ = true;
  const int first = cloth_;
  const Real gone = static_cast<Real>(gone_), left = static_cast<Real>(aim_ - gone_);
  const int *start_of = pairs.start, *item = pairs.item;
  const Vec3<Real>* recede = recede_.data();
  Vec3<Real>*start = start_.data(), *way = way_.data(), *behind = behind_.data();
  for_each(
      device_, "self-contact: stay back", count_, HYST_KERNEL(int i) {
        Vec3<Real> back = Vec3<Real>::Zero();
        for (int j = start_of[first + i]; j < start_of[first + i + 1]; ++j) {
          const Vec3<Real> asked = recede[item[j]];
          const Real size2 = asked.squaredNorm();
          if (!(size2 > 0)) continue;
          const Real missing = 1 - back.dot(asked) / size2;
          if (missing > 0) back += missing * asked;
        }
        behind[i] += back;
        way[i] += back / left;
        start[i] -= gone * (back / left);
      });
}

template <class Real, class Device>
void BodyVertices<Real, Device>::keep_dents() {
  if (!has_yielded_ && deepest_ == 0) return;
  deepest_ = measure_dents();
  constexpr double kSeen = 0.01;  // over the thickness
  if (deepest_ >= kSeen * thickness_) {
    std::swap(dent_, behind_);
    return;
  }
  deepest_ = 0;
  dent_.upload(std::vector<Vec3<Real>>(count_, Vec3<Real>::Zero()));
}

template <class Real, class Device>
double BodyVertices<Real, Device>::measure_dents() {
  Real* size = length_.reserve(count_);
  const Vec3<Real>* behind = behind_.data();
  for_each(
      device_, "self-contact: dents", count_, HYST_KERNEL(int i) { size[i] = -behind[i].norm(); });
  return static_cast<double>(-smallest(device_, scratch_, size, count_, Real(0)));
}

template <class Real, class Device>
const char* BodyVertices<Real, Device>::held(const char* cloth) {
  if (!any()) return cloth;
  const int first = cloth_;
  char* to = held_.data();
  for_each(
      device_, "self-contact: held", all(), HYST_KERNEL(int i) { to[i] = i < first ? cloth[i] : char(1); });
  return to;
}

// Between steps the bodies have arrived.
template <class Real, class Device>
void BodyVertices<Real, Device>::serialise(Archive& archive) {
  hysteron::serialise(archive, device_, start_, way_, dent_);
  archive(deepest_);
  if (!archive.loads()) return;
  try_step(1);
  accept();
}

template class BodyVertices<double, ThisDevice>;
template class BodyVertices<float, ThisDevice>;

}  // namespace hysteron
