// Finds the pairs of layers that may touch on the path of a step, how far it may go before they do, and which
// of them are active.
//
// A list of pairs (self_pairs.h) serves several steps: it also has those that come near anywhere within its
// reach of the path for which it was made.
#pragma once

#include "sim/contact/self_touch.h"

namespace hysteron {

// The entries of pairs' vertices, sorted by vertex.
template <class Device>
struct PairRows {
  PairRows(Device& device, int vertices) : start(device, vertices + 1), item(device), key(device) {}
  Buffer<int, Device> start;        // n + 1 row starts, one row per vertex
  GrowingBuffer<int, Device> item;  // 4 * pair + corner
  GrowingBuffer<int, Device> key;   // the vertex of each entry
  std::size_t bytes() const { return total_bytes(start) + item.bytes() + key.bytes(); }
};

// A step of all vertices, the cloth's and the bodies', from x along `direction` (arrays of theirs [m]).
template <class Real>
struct StepPath {
  const Vec3<Real>*x, *direction;
  Real step_length;
  Real longest;  // the longest displacement of any vertex of the cloth at length 1, less the mean of all [m]
};

template <class Real, class Device>
class NearPairs {
 public:
  // `all` is the mesh with the scene's bodies behind the `cloth`; without bodies it is the same.
  NearPairs(Device& device, const ClothMesh& cloth, const ClothMesh& all, const Scene& scene);

  // Returns the path along `direction` from x whose length is at most `max_step`, and no vertex moves farther
  // on it than some edges from the mean displacement.
  StepPath<Real> bounded_path(const Vec3<Real>* x, const Vec3<Real>* direction, double max_step);
  // Has the list all pairs that matter on the path?
  bool covers(const StepPath<Real>& path);
  // Makes a new list for the path; `held`: flags of all vertices.  The caller carries over its data of pairs
  // that stay (SelfPairs::find), then calls index_corners().
  void find(const StepPath<Real>& path, const char* held);
  // Finds the pairs of each vertex.
  void index_corners();
  // Returns the fraction of the path that keeps layers apart by more than `kept_share` of their activation
  // distances or most of their distance, and marks the pairs that may touch on it, or have friction (count()
  // stops).
  double feasible_fraction(const StepPath<Real>& path, const PairFriction<Real>* friction, Real kept_share);
  // The reach of a new list counts from the positions x to which the first step leads.
  bool lacks_center() const { return lacks_center_; }
  void set_center(const Vec3<Real>* x);
  // Tells that held vertices have become free: the next path needs a new list.
  void invalidate() { lacks_center_ = has_list_; }

  bool has_list() const { return has_list_; }
  const SelfPairs<Real, Device>& list() const { return pairs_; }  // with the one before it
  int count() const { return pairs_.count(); }
  const SelfPair<Real>* pairs() const { return pairs_.pairs(); }
  // For each pair: may it touch on the path of the last feasible_fraction(), or had it friction?
  const char* near() const { return near_.data(); }
  const PairRows<Device>& corners() const { return rows_; }
  Scratch<Device>& scratch() { return pairs_.scratch(); }

  // Numbers the stiffnesses of active pairs, which touch at x or have friction, and returns how many there
  // are. A pair has one, or two `with_turning` where its edges are nearly parallel.
  int number_active(const Vec3<Real>* x, const PairFriction<Real>* friction, bool with_turning);
  const int* stiffnesses_of() const { return stiffnesses_of_.data(); }          // for each pair, 0 to 2
  const int* first_stiffness_of() const { return first_stiffness_of_.data(); }  // for each pair, its index

  // Gathers for each vertex the entries of pairs with friction, in the order of all: they are few, and most
  // pairs search them.
  void gather_rubbing(const PairFriction<Real>* friction);
  RubbingRows rubbing() const { return {rows_.start.data(), rubbing_end_.data(), rubbing_item_.data()}; }

  // Saves or loads the list, which decides the order of sums, and when the next one is made.
  void serialise(Archive& archive);
  // Returns the pair that limited the last path.
  SelfPair<Real> blocking_pair() const;
  std::size_t bytes() const;

  // These are parts of the above; public because nvcc allows no device lambda in a private member function.
  Real longest_displacement(const Vec3<Real>* direction);
  Real farthest(const StepPath<Real>& path);

 private:
  Device& device_;
  int cloth_, all_;                                   // numbers of vertices
  Real least_reach_, most_reach_, max_displacement_;  // [m]
  SelfPairs<Real, Device> pairs_;
  bool has_list_ = false, lacks_center_ = false;
  Real reach_ = 0;                      // of the list [m]
  Buffer<Vec3<Real>, Device> center_;   // the positions from which the reach counts [m]
  GrowingBuffer<Real, Device> length_;  // of displacements [m]; the feasible fraction of each pair
  GrowingBuffer<char, Device> near_;
  GrowingBuffer<int, Device> stiffnesses_of_, first_stiffness_of_;
  PairRows<Device> rows_;
  Buffer<int, Device> rubbing_end_;  // the ends of RubbingRows in rows_
  GrowingBuffer<int, Device> rubbing_item_;
};

}  // namespace hysteron
