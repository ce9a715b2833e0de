// Lists the vertices that may come near triangles, and edges near edges, while a cloth moves.
#pragma once

#include "sim/contact/box_tree.h"
#include "sim/device/algorithms.h"
#include "sim/device/archive_buffer.h"
#include "sim/mesh/cloth_mesh.h"

namespace hysteron {

// A pair of vertex v[0] and triangle v[1..3], or of edges v[0]v[1] and v[2]v[3].
template <class Real>
struct SelfPair {
  int v[4];
  int other;                 // triangle, or rank of the second edge: with the row it identifies the pair
  Real activation_distance;  // distance from which they repel each other [m]
  Real area;                 // share of the cloth that the pair represents [m^2]
  Real parallel;             // for edges: where the fade of parallel ones ends [m^4]; otherwise 0

  HYST_HD bool is_edges() const { return parallel > 0; }
  HYST_HD void gather(const Vec3<Real>* values, Vec3<Real> (&out)[4]) const {
    for (int k = 0; k < 4; ++k) out[k] = values[v[k]];
  }
};

// Lists the pairs that can matter while vertices go from x by a step along `direction`, and anywhere within
// `reach` of a point of that path: all that come nearer to each other than their activation distances.  The
// rows are vertices, then edges by rank in their tree.  Pairs that share a vertex are excluded, as are those
// whose vertices are all held; PinSweep lists those whose vertices are held by different pins.
//
// A pair's activation distance is the cloth's thickness, or half its distance at rest if that is less:
// neighbours on the flat cloth are not in contact.  On flat layers one upon the other the areas of vertices
// right above triangles and of edges that cross add up to that of the contact, half by each (on average over
// directions). Pairs beside these are in reach as well; all areas are reduced for them, so that the pressure
// of flat layers is that of the barrier within 10 % where edges are 4 to 25 thicknesses long.
template <class Real, class Device>
class SelfPairs {
 public:
  // `mesh` may have bodies behind the cloth's `cloth` vertices, which are held; pairs of a body with the
  // cloth have the whole thickness for it.  Without `layers` these are the only pairs.
  SelfPairs(Device& device, const ClothMesh& mesh, double thickness, int cloth, bool layers);
  SelfPairs(Device& device, const ClothMesh& mesh, double thickness)
      : SelfPairs(device, mesh, thickness, mesh.vertices(), true) {}

  // Makes a new list from n vertices x [m], n directions [m] and n held flags; the caller carries over data
  // of pairs that stay: `old_start`, with as many rows, and old_pairs() are those of the list before.  With
  // `pin`, the number of the pin at each vertex, it lists the pairs whose vertices are all held, but not all
  // by one pin.
  void find(const Vec3<Real>* x, const Vec3<Real>* direction, Real step_length, const char* held, Real reach,
            const int* pin = nullptr);
  // Saves or loads the list; find() makes boxes and the list before anew.
  void serialise(Archive& archive);
  Vec3<Real> mean_direction(const Vec3<Real>* direction);
  int count() const { return count_; }
  int rows() const { return rows_; }
  const SelfPair<Real>* pairs() const { return pair_.data(); }
  const int* start() const { return start_.data(); }
  const SelfPair<Real>* old_pairs() const { return old_pair_.data(); }
  const int* old_start() const { return old_start_.data(); }
  Scratch<Device>& scratch() { return scratch_; }
  std::size_t bytes() const;

  // A part of find(); public because nvcc allows no device lambda in a private member function.
  template <bool kWrite>
  void search(const Sweep<Real>& sweep, const char* held, Real reach, const int* pin);

 private:
  Device& device_;
  int vertices_, cloth_, edges_, rows_, count_ = 0;
  bool layers_;
  Real thickness_;
  Buffer<Vec3<Real>, Device> rest_;
  Buffer<int, Device> face_, edge_;  // 3 vertices per triangle, 2 per edge by rank
  Buffer<Real, Device> vertex_area_, edge_area_;
  BoxTree<Real, Device> triangle_tree_, edge_tree_;
  static constexpr int kKept = 24;                        // partners of a row kept from counting to writing
  Buffer<int, Device> found_, kept_, start_, old_start_;  // by row
  GrowingBuffer<SelfPair<Real>, Device> pair_, old_pair_;
  Scratch<Device> scratch_;
  Buffer<Vec3<double>, Device> sum_;
};

// Checks whether pins lead their layers through each other: vertices that are all held are in no pair of
// self-contact.
template <class Real, class Device>
class PinSweep {
 public:
  PinSweep(Device& device, const ClothMesh& mesh, double thickness)
      : device_(device), pairs_(device, mesh, thickness), fraction_(device) {}

  // Do layers that different pins hold stay as far apart as pressure could compress them while held vertices
  // go from x along `displacement` (n vertices [m], 0 for free ones)? `pin` is the number of the pin at each
  // vertex.
  bool is_free(const Vec3<Real>* x, const Vec3<Real>* displacement, const char* held, const int* pin);
  std::size_t bytes() const { return pairs_.bytes() + fraction_.bytes(); }

 private:
  Device& device_;
  SelfPairs<Real, Device> pairs_;
  GrowingBuffer<Real, Device> fraction_;  // the fraction of its way that each pair may go
};

}  // namespace hysteron
