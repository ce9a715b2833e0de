#include "sim/contact/near_pairs.h"

#include <algorithm>

namespace hysteron {

namespace {

constexpr double kDisplacementOfEdge = 5;  // largest displacement of a step, over the mean edge length
constexpr double kReachOfEdge = 0.2;       // largest reach of lists beyond a path, over the mean edge length
constexpr double kPressedNearer = 0.9;  // share of their distance that a guess leaves pressed layers at least
constexpr double kSafely = 1.01;        // exceeds the rounding of distances beside the thickness

}  // namespace

template <class Real, class Device>
NearPairs<Real, Device>::NearPairs(Device& device, const ClothMesh& cloth, const ClothMesh& all,
                                   const Scene& scene)
    : device_(device),
      cloth_(cloth.vertices()),
      all_(all.vertices()),
      least_reach_(static_cast<Real>(scene.fabric.thickness) / 4),
      most_reach_(std::max(static_cast<Real>(scene.fabric.thickness),
                           static_cast<Real>(kReachOfEdge * cloth.mean_edge_in_space()))),
      max_displacement_(std::max(4 * static_cast<Real>(scene.fabric.thickness),
                                 static_cast<Real>(kDisplacementOfEdge * cloth.mean_edge_in_space()))),
      pairs_(device, all, scene.fabric.thickness, cloth_, scene.self_contact),
      center_(device, all_),
      length_(device),
      near_(device),
      stiffnesses_of_(device),
      first_stiffness_of_(device),
      rows_(device, all_),
      rubbing_end_(device, all_),
      rubbing_item_(device) {}

template <class Real, class Device>
StepPath<Real> NearPairs<Real, Device>::bounded_path(const Vec3<Real>* x, const Vec3<Real>* direction,
                                                     double max_step) {
  const Real longest = longest_displacement(direction), requested = static_cast<Real>(max_step);
  return {x, direction, requested * longest > max_displacement_ ? max_displacement_ / longest : requested,
          longest};
}

template <class Real, class Device>
bool NearPairs<Real, Device>::covers(const StepPath<Real>& path) {
  return has_list_ && !lacks_center_ && farthest(path) <= reach_;
}

template <class Real, class Device>
void NearPairs<Real, Device>::find(const StepPath<Real>& path, const char* held) {
  reach_ = std::clamp(path.step_length * path.longest / 2, least_reach_, most_reach_);
  pairs_.find(path.x, path.direction, path.step_length, held, reach_);
  has_list_ = lacks_center_ = true;
}

template <class Real, class Device>
void NearPairs<Real, Device>::index_corners() {
  const int count = pairs_.count();
  const std::size_t entries = 4 * static_cast<std::size_t>(count);
  rubbing_item_.reserve(entries);
  int* key = rows_.key.reserve(entries);
  const SelfPair<Real>* pairs = pairs_.pairs();
  for_each(
      device_, "self-contact: corners", count, HYST_KERNEL(int p) {
        for (int k = 0; k < 4; ++k) key[4 * p + k] = pairs[p].v[k];
      });
  group(device_, pairs_.scratch(), key, 4 * count, all_, rows_.start.data(), rows_.item.reserve(entries));
}

template <class Real, class Device>
Real NearPairs<Real, Device>::longest_displacement(const Vec3<Real>* direction) {
  const Vec3<Real> mean = pairs_.mean_direction(direction);
  Real* lengths = length_.reserve(cloth_);
  for_each(
      device_, "self-contact: displacements", cloth_,
      HYST_KERNEL(int i) { lengths[i] = -(direction[i] - mean).norm(); });
  return -smallest(device_, pairs_.scratch(), lengths, cloth_, Real(0));
}

// Returns the largest distance of the path's end from the positions from which the list's reach counts [m].
template <class Real, class Device>
Real NearPairs<Real, Device>::farthest(const StepPath<Real>& path) {
  const Vec3<Real>*x = path.x, *direction = path.direction, *center = center_.data();
  const Real step_length = path.step_length;
  Real* lengths = length_.reserve(all_);
  for_each(
      device_, "self-contact: lengths", all_,
      HYST_KERNEL(int i) { lengths[i] = -(x[i] + step_length * direction[i] - center[i]).norm(); });
  return -smallest(device_, pairs_.scratch(), lengths, all_, Real(0));
}

template <class Real, class Device>
double NearPairs<Real, Device>::feasible_fraction(const StepPath<Real>& path,
                                                  const PairFriction<Real>* friction, Real kept_share) {
  const Vec3<Real>*x = path.x, *direction = path.direction;
  const Real step_length = path.step_length, kept = kept_share;
  const SelfPair<Real>* pairs = pairs_.pairs();
  Real* feasible = length_.reserve(pairs_.count());
  char* near = near_.reserve(pairs_.count());
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
  return smallest(device_, pairs_.scratch(), feasible, pairs_.count(), Real(1));
}

template <class Real, class Device>
void NearPairs<Real, Device>::set_center(const Vec3<Real>* x) {
  lacks_center_ = false;
  Vec3<Real>* center = center_.data();
  for_each(
      device_, "self-contact: moved", all_, HYST_KERNEL(int i) { center[i] = x[i]; });
}

template <class Real, class Device>
int NearPairs<Real, Device>::number_active(const Vec3<Real>* x, const PairFriction<Real>* friction,
                                           bool with_turning) {
  const int count = pairs_.count();
  const SelfPair<Real>* pairs = pairs_.pairs();
  const char* near = near_.data();
  int* stiffnesses_of = stiffnesses_of_.reserve(count);
  for_each(
      device_, "self-contact: active", count, HYST_KERNEL(int p) {
        stiffnesses_of[p] = 0;
        if (!near[p]) return;
        Vec3<Real> at[4];
        pairs[p].gather(x, at);
        const bool touches = pair_distance(at, pairs[p].is_edges()) < pairs[p].activation_distance;
        stiffnesses_of[p] = touches && with_turning && are_fading(pairs[p], at) ? 2
                            : touches || friction[p].limit > 0                  ? 1
                                                                                : 0;
      });
  return exclusive_scan(device_, pairs_.scratch(), stiffnesses_of, count,
                        first_stiffness_of_.reserve(count + 1));
}

template <class Real, class Device>
void NearPairs<Real, Device>::gather_rubbing(const PairFriction<Real>* friction) {
  const int *start = rows_.start.data(), *item = rows_.item.data();
  int *end = rubbing_end_.data(), *rubbing = rubbing_item_.data();
  for_each(
      device_, "self-contact: rubbing", all_, HYST_KERNEL(int i) {
        int n = start[i];
        for (int j = start[i]; j < start[i + 1]; ++j)
          if (friction[item[j] / 4].limit > 0) rubbing[n++] = item[j];
        end[i] = n;
      });
}

template <class Real, class Device>
void NearPairs<Real, Device>::serialise(Archive& archive) {
  pairs_.serialise(archive);
  archive(has_list_, lacks_center_, reach_);
  hysteron::serialise(archive, device_, center_);
  if (archive.loads()) index_corners();
}

template <class Real, class Device>
SelfPair<Real> NearPairs<Real, Device>::blocking_pair() const {
  std::vector<Real> feasible(pairs_.count());
  device_download(device_, feasible.data(), length_.data(), feasible.size() * sizeof(Real));
  const auto least = std::min_element(feasible.begin(), feasible.end()) - feasible.begin();
  SelfPair<Real> pair;
  device_download(device_, &pair, pairs_.pairs() + least, sizeof pair);
  return pair;
}

template <class Real, class Device>
std::size_t NearPairs<Real, Device>::bytes() const {
  return total_bytes(center_, length_, near_, stiffnesses_of_, first_stiffness_of_, rubbing_end_,
                     rubbing_item_) +
         pairs_.bytes() + rows_.bytes();
}

template class NearPairs<double, ThisDevice>;
template class NearPairs<float, ThisDevice>;

}  // namespace hysteron
