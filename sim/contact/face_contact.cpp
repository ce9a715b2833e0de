#include "sim/contact/face_contact.h"

#include "sim/contact/sweep.h"

namespace hysteron {

template <class Real, class Device>
FaceContact<Real, Device>::FaceContact(Device& device, const ClothMesh& mesh, const Scene& scene,
                                       const ContactModel<Real>& model)
    : PointContact<Real, Device, FacePoints<Real>>(device, mesh.faces(),
                                                   scene.integrator == Integrator::quasi_static),
      device_(device),
      model_(model),
      vertices_(mesh.vertices()),
      sharp_(static_cast<Real>(sharp_radius(scene, mesh))),
      corner_(device, mesh.face),
      vertex_start_(device, mesh.vertex_faces.start),
      vertex_item_(device, mesh.vertex_faces.item),
      area_(device, std::vector<Real>(mesh.face_area.begin(), mesh.face_area.end())),
      stiffness_(device, mesh.faces()),
      force_(device, 3 * static_cast<std::size_t>(mesh.faces())) {}

template <class Real, class Device>
void FaceContact<Real, Device>::add_forces(const FacePoints<Real>& faces, const Vec3<Real>* x,
                                           const Vec3<Real>* before, Real factor, Vec3<Real>* target,
                                           double* energy) {
  this->evaluate(faces, x, before, force_.data(), energy);
  const GatheredForces<Real> forces{vertex_start_.data(), vertex_item_.data(), force_.data()};
  for_each(
      device_, "contact: gathered forces", vertices_,
      HYST_KERNEL(int i) { target[i] += factor * forces.at(i); });
}

// Handles one obstacle after the other, so that a face has one point at a time.
template <class Real, class Device>
void FaceContact<Real, Device>::add_stiffness(const FacePoints<Real>& faces, const Vec3<Real>* x,
                                              const Vec3<Real>* before, Real factor,
                                              BlockRowsView<Real> matrix, Real sliding_fraction) {
  const FaceFriction<Real>* lagged = this->lagged();
  FaceStiffness<Real>* stiffness = stiffness_.data();
  for (int o = 0; o < faces.set.count; ++o) {
    if (!faces.feels(o)) continue;
    for_each(
        device_, "contact: stiffness of triangles", this->count(), HYST_KERNEL(int f) {
          const FaceTouch<Real> t = faces.touch(f, o, x);
          const FaceFriction<Real> friction = lagged[f];
          const bool rubs = friction.limit > 0 && friction.index == faces.set.item[o].index;
          FaceStiffness<Real>& s = stiffness[f];
          s.acts = t.is_active() || rubs;
          if (!s.acts) return;
          s.block.setZero();
          s.weight = friction.weight;
          if (t.is_active()) {
            s.weight = t.weight;
            s.block = t.stiffness * t.direction * t.direction.transpose();
          }
          if (rubs)
            s.block += friction.stiffness_at(lagged_slip<Real>(faces, f, friction, x, before),
                                             faces.model.stop_stiffness(friction.limit, faces.area[f]),
                                             sliding_fraction);
        });
    gather_stiffness(factor, matrix);
  }
}

template <class Real, class Device>
void FaceContact<Real, Device>::gather_stiffness(Real factor, BlockRowsView<Real> matrix) {
  const int *start = vertex_start_.data(), *item = vertex_item_.data();
  const Eigen::Vector3i* corner = corner_.data();
  const FaceStiffness<Real>* stiffness = stiffness_.data();
  for_each(
      device_, "contact: matrix of triangles", vertices_, HYST_KERNEL(int v) {
        for (int j = start[v]; j < start[v + 1]; ++j) {
          const int f = item[j] / 3, c = item[j] % 3;
          const FaceStiffness<Real>& s = stiffness[f];
          if (!s.acts) continue;
          const Real own = factor * s.weight[c];
          matrix.diagonal[v] += own * s.weight[c] * s.block;
          for (int k = 1; k < 3; ++k) {
            const int other = (c + k) % 3;
            int at = matrix.row_ptr[v];
            while (matrix.col[at] != corner[f][other]) ++at;
            matrix.off_diagonal[at] += own * s.weight[other] * s.block;
          }
        }
      });
}

// Each corner goes the least fraction that its triangles allow.  If some corners then go farther than others
// and a triangle is blocked again, this is repeated; in the last rounds the corners stay beside the obstacle.
template <class Real, class Device>
void FaceContact<Real, Device>::clip_to_obstacles(const FacePoints<Real>& faces, const Vec3<Real>* start,
                                                  Vec3<Real>* end, const char* held, Real rest_distance) {
  constexpr int kRounds = 8, kShortened = 4;
  for (int o = 0; o < faces.set.count; ++o) {
    if (!faces.feels(o)) continue;
    for (int round = 0; round < kRounds; ++round)
      if (end_before(faces, o, start, end, held, rest_distance, round >= kShortened) == 1) break;
  }
}

// Returns the least fraction of its displacement that a corner has kept.
template <class Real, class Device>
Real FaceContact<Real, Device>::end_before(const FacePoints<Real>& faces, int o, const Vec3<Real>* start,
                                           Vec3<Real>* end, const char* held, Real rest_distance, bool stay) {
  Real* fraction = this->fractions();
  for_each(
      device_, "contact: guess of triangles", this->count(), HYST_KERNEL(int f) {
        fraction[f] = 1;
        if (is_held(faces, f, held)) return;
        const Obstacle3<Real>& obstacle = faces.set.item[o];
        const Real own =
            clipped_fraction(path_beside(obstacle, faces, f, start, end), obstacle, rest_distance);
        fraction[f] = stay && own < 1 ? Real(0) : own;
      });
  const Real least = this->least_fraction();
  if (!(least < 1)) return 1;
  const Obstacle3<Real> obstacle = faces.set.item[o];
  const int *first = vertex_start_.data(), *item = vertex_item_.data();
  for_each(
      device_, "contact: guess of corners", vertices_, HYST_KERNEL(int i) {
        Real own = 1;
        for (int j = first[i]; j < first[i + 1]; ++j)
          own = fraction[item[j] / 3] < own ? fraction[item[j] / 3] : own;
        if (!(own < 1)) return;
        const Vec3<Real> from = carried(obstacle, start[i]);
        end[i] = from + own * (end[i] - from);
      });
  return least;
}

template <class Real, class Device>
std::size_t FaceContact<Real, Device>::bytes() const {
  return PointContact<Real, Device, FacePoints<Real>>::bytes() +
         total_bytes(corner_, vertex_start_, vertex_item_, area_, stiffness_, force_);
}

template class FaceContact<double, ThisDevice>;
template class FaceContact<float, ThisDevice>;

}  // namespace hysteron
