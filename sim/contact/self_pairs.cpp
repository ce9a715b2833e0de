#include "sim/contact/self_pairs.h"

#include "sim/contact/additive_ccd.h"
#include "sim/contact/self_touch.h"
#include "sim/scene/cloth.h"

namespace hysteron {

namespace {

constexpr double kRestDistanceFraction =
    0.5;  // largest share of the distance at rest that an activation distance may have
constexpr double kParallel = 1e-3;  // sine squared at rest below which edges fade (Li et al. 2020)

std::vector<std::array<int, 3>> triangle_corners(const ClothMesh& mesh) {
  std::vector<std::array<int, 3>> corners;
  for (const auto& f : mesh.face) corners.push_back({f[0], f[1], f[2]});
  return corners;
}

std::vector<std::array<int, 3>> edge_corners(const ClothMesh& mesh) {
  std::vector<std::array<int, 3>> corners;
  for (const Edge& e : mesh.edge) corners.push_back({e.p2, e.p3, e.p3});
  return corners;
}

template <class Real>
struct Candidates {  // the data of the loops, passed by value
  const Vec3<Real>* rest;
  const int *face, *edge;
  const Real *vertex_area, *edge_area;
  int cloth;    // vertices from here on are bodies'
  bool layers;  // pairs of the cloth with itself count, too
  Real thickness, reach;
  Sweep<Real> sweep;
  const char* held;
  const int* pin;  // null: only pairs that are not all held

  HYST_HD bool is_out(const int (&v)[4], bool edges) const {
    for (int i = 0; i < (edges ? 2 : 1); ++i)
      for (int j = edges ? 2 : 1; j < 4; ++j)
        if (v[i] == v[j]) return true;
    const bool all_held = held[v[0]] && held[v[1]] && held[v[2]] && held[v[3]];
    if (!pin) return all_held;
    return !all_held || (pin[v[0]] == pin[v[1]] && pin[v[0]] == pin[v[2]] && pin[v[0]] == pin[v[3]]);
  }

  // Can the pair matter? If so, completes it.
  HYST_HD bool complete(SelfPair<Real>& pair, bool edges) const {
    const bool with_body = (pair.v[0] < cloth) != (pair.v[3] < cloth);
    if ((!layers && !with_body) || is_out(pair.v, edges)) return false;
    Vec3<Real> x[4], direction[4];
    pair.gather(sweep.from, x);
    pair.gather(sweep.direction, direction);
    remove_mean(direction);
    const Real near =
        pair_distance(x, edges) - sweep.step_length * fastest_approach(direction, edges) - 2 * reach;
    if (near > thickness) return false;
    pair.gather(rest, x);
    const Real apart = Real(kRestDistanceFraction) * pair_distance(x, edges);
    pair.activation_distance = apart < thickness && !with_body ? apart : thickness;
    pair.parallel = edges ? Real(kParallel) * (x[1] - x[0]).squaredNorm() * (x[3] - x[2]).squaredNorm() : 0;
    return near <= pair.activation_distance;
  }

  HYST_HD bool vertex_on_triangle(int vertex, int triangle, SelfPair<Real>& pair) const {
    pair.v[0] = vertex;
    for (int k = 0; k < 3; ++k) pair.v[1 + k] = face[3 * triangle + k];
    pair.other = triangle;
    pair.area = vertex_area[vertex] / 4;
    return complete(pair, false);
  }

  HYST_HD bool edge_on_edge(int first, int second, SelfPair<Real>& pair) const {
    for (int k = 0; k < 2; ++k) {
      pair.v[k] = edge[2 * first + k];
      pair.v[2 + k] = edge[2 * second + k];
    }
    pair.other = second;
    pair.area = (edge_area[first] + edge_area[second]) / 8;
    return complete(pair, true);
  }

  // Makes the pair of a row with the item of a rank in its tree.
  HYST_HD bool pair_at_rank(int row, int vertices, int rank, const BoxTreeView<Real>& triangles,
                            SelfPair<Real>& pair) const {
    return row < vertices ? vertex_on_triangle(row, triangles.item[rank], pair)
                          : edge_on_edge(row - vertices, rank, pair);
  }
};

// Returns the factor by which pairs within reach exceed those right above each other, which grows as
// triangles become small beside the thickness.  `triangle` is their mean area [m^2].
double overcount(double triangle, double thickness) {
  // Measured on flat layers of random meshes: SelfContact.OfFlatLayersHasTheBarriersPressureOnAnyMesh.
  constexpr double kBeside = 2.5;
  return 1 + kBeside * thickness / std::sqrt(4 / std::sqrt(3.0) * triangle);
}

}  // namespace

template <class Real, class Device>
SelfPairs<Real, Device>::SelfPairs(Device& device, const ClothMesh& mesh, double thickness, int cloth,
                                   bool layers)
    : device_(device),
      vertices_(mesh.vertices()),
      cloth_(cloth),
      edges_(static_cast<int>(mesh.edge.size())),
      rows_(vertices_ + edges_),
      layers_(layers),
      thickness_(static_cast<Real>(thickness)),
      triangle_tree_(device, triangle_corners(mesh), mesh.rest, cloth),
      edge_tree_(device, edge_corners(mesh), mesh.rest, cloth),
      found_(device, rows_),
      kept_(device, static_cast<std::size_t>(kKept) * rows_),
      start_(device, rows_ + 1),
      old_start_(device, rows_ + 1),
      pair_(device),
      old_pair_(device),
      scratch_(device),
      sum_(device, 1) {
  std::vector<Vec3<Real>> rest;
  const Eigen::Vector3d origin = local_origin(mesh.rest);
  for (const auto& x : mesh.rest) rest.push_back((x - origin).cast<Real>());
  rest_ = Buffer<Vec3<Real>, Device>(device, rest);
  std::vector<int> face, edge;
  for (const auto& f : mesh.face) face.insert(face.end(), {f[0], f[1], f[2]});
  face_ = Buffer<int, Device>(device, face);
  std::vector<int> order(edges_);
  device_download(device, order.data(), edge_tree_.view().item, order.size() * sizeof(int));
  std::vector<Real> area;
  for (int e : order) {
    const Edge& it = mesh.edge[e];
    edge.insert(edge.end(), {it.p2, it.p3});
    const double both = mesh.face_area[it.face0] + (it.interior() ? mesh.face_area[it.face1] : 0.0);
    area.push_back(static_cast<Real>(both / 3 / overcount(it.interior() ? both / 2 : both, thickness)));
  }
  edge_ = Buffer<int, Device>(device, edge);
  edge_area_ = Buffer<Real, Device>(device, area);
  area.clear();
  for (double a : mesh.vertex_area) area.push_back(static_cast<Real>(a / overcount(a / 2, thickness)));
  vertex_area_ = Buffer<Real, Device>(device, area);
}

template <class Real, class Device>
Vec3<Real> SelfPairs<Real, Device>::mean_direction(const Vec3<Real>* direction) {
  Vec3<double>* sum = sum_.data();
  for_each_sum<3>(
      device_, "self-contact: mean direction", vertices_,
      HYST_KERNEL(int i, Sums<3>& sums) {
        for (int k = 0; k < 3; ++k) sums.term[k] += static_cast<double>(direction[i][k]);
      },
      HYST_KERNEL(const Sums<3>& total) {
        for (int k = 0; k < 3; ++k) (*sum)[k] = total.term[k];
      });
  return (sum_.download()[0] / vertices_).template cast<Real>();
}

// Counts the pairs of each row and keeps the first partners, or writes the pairs: from the kept partners if
// these are all, else by a second walk.
template <class Real, class Device>
template <bool kWrite>
void SelfPairs<Real, Device>::search(const Sweep<Real>& sweep, const char* held, Real reach, const int* pin) {
  const Candidates<Real> candidates{rest_.data(),
                                    face_.data(),
                                    edge_.data(),
                                    vertex_area_.data(),
                                    edge_area_.data(),
                                    cloth_,
                                    layers_,
                                    thickness_,
                                    reach,
                                    sweep,
                                    held,
                                    pin};
  const BoxTreeView<Real> triangles = triangle_tree_.view(), edges = edge_tree_.view();
  int *found = found_.data(), *kept = kept_.data();
  const int* start = start_.data();
  SelfPair<Real>* pairs = pair_.data();
  const int vertices = vertices_, rows = rows_;
  for_each(
      device_, "self-contact: pairs", rows, HYST_KERNEL(int row) {
        int n = 0;
        const int first = kWrite ? start[row] : 0;
        const auto visit = [&](int rank) {
          SelfPair<Real> pair;
          if (!candidates.pair_at_rank(row, vertices, rank, triangles, pair)) return;
          if (kWrite) {
            pairs[first + n] = pair;
          } else if (n < kKept) {
            kept[n * rows + row] = rank;
          }
          ++n;
        };
        if (kWrite && start[row + 1] - first <= kKept) {
          const int count = start[row + 1] - first;
          for (int k = 0; k < count; ++k) visit(kept[k * rows + row]);
        } else if (row < vertices) {
          Box<Real> box = Box<Real>::nothing();
          sweep.include(box, row);
          triangles.find(box, 0, row >= candidates.cloth, visit);
        } else {
          const int edge = row - vertices;
          const bool of_body = candidates.edge[2 * edge] >= candidates.cloth;
          edges.find(edges.box[edges.leaves + edge], edge + 1, of_body, visit);
        }
        if (!kWrite) found[row] = n;
      });
}

template <class Real, class Device>
void SelfPairs<Real, Device>::find(const Vec3<Real>* x, const Vec3<Real>* direction, Real step_length,
                                   const char* held, Real reach, const int* pin) {
  std::swap(start_, old_start_);
  pair_.swap(old_pair_);
  const Sweep<Real> sweep{x, direction, mean_direction(direction), step_length, thickness_ + 2 * reach};
  triangle_tree_.fit(sweep);
  Sweep<Real> half = sweep;  // both edges' boxes are widened
  half.margin = sweep.margin / 2;
  edge_tree_.fit(half);
  search<false>(sweep, held, reach, pin);
  count_ = exclusive_scan(device_, scratch_, found_.data(), rows_, start_.data());
  pair_.reserve(count_);
  search<true>(sweep, held, reach, pin);
}

template <class Real, class Device>
void SelfPairs<Real, Device>::serialise(Archive& archive) {
  count_ = static_cast<int>(archive.size(count_));
  hysteron::serialise(archive, device_, start_);
  hysteron::serialise(archive, device_, pair_.reserve(count_), count_);
}

template <class Real, class Device>
std::size_t SelfPairs<Real, Device>::bytes() const {
  return rest_.bytes() + face_.bytes() + edge_.bytes() + vertex_area_.bytes() + edge_area_.bytes() +
         triangle_tree_.bytes() + edge_tree_.bytes() + kept_.bytes() + 3 * start_.bytes() + pair_.bytes() +
         old_pair_.bytes() + scratch_.bytes();
}

template class SelfPairs<double, ThisDevice>;
template class SelfPairs<float, ThisDevice>;

namespace {
constexpr double kNearer = 0.9;  // share of the initial distance, for layers that begin fully compressed
}  // namespace

template <class Real, class Device>
bool PinSweep<Real, Device>::is_free(const Vec3<Real>* x, const Vec3<Real>* displacement, const char* held,
                                     const int* pin) {
  pairs_.find(x, displacement, 1, held, 0, pin);
  const SelfPair<Real>* pairs = pairs_.pairs();
  Real* fraction = fraction_.reserve(pairs_.count());
  for_each(
      device_, "pins: collisions", pairs_.count(), HYST_KERNEL(int p) {
        const SelfPair<Real> pair = pairs[p];
        Vec3<Real> from[4], along[4];
        pair.gather(x, from);
        pair.gather(displacement, along);
        const Approach<Real> start = approach(from, along, pair.is_edges());
        const Real hardest = static_cast<Real>(kHardest) * pair.activation_distance,
                   nearer = static_cast<Real>(kNearer) * start.distance;
        fraction[p] = feasible_step(start, from, along, pair.is_edges(), nearer < hardest ? nearer : hardest);
      });
  return !(smallest(device_, pairs_.scratch(), fraction, pairs_.count(), Real(1)) < 1);
}

template class PinSweep<double, ThisDevice>;
template class PinSweep<float, ThisDevice>;

}  // namespace hysteron
