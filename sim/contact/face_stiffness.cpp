// The matrix of triangles against obstacles that are sharper than the mesh.
#include "sim/contact/face_contact.h"

namespace hysteron {

// One obstacle after the other, so that a face has one point at a time.
template <class Real, class Device>
void FaceContact<Real, Device>::add_stiffness(const ObstacleSet<Real>& set, const Vec3<Real>* x,
                                              const Vec3<Real>* before, Real factor,
                                              BlockRowsView<Real> matrix, Real sliding_fraction) {
  const FaceView<Real> faces = view(set);
  const FaceFriction<Real>* lagged = lagged_.data();
  FaceStiffness<Real>* stiffness = stiffness_.data();
  for (int o = 0; o < set.count; ++o) {
    if (!is_sharp(set.item[o])) continue;
    for_each(
        device_, "face contact: stiffness", faces_, HYST_KERNEL(int f) {
          const Obstacle3<Real>& obstacle = faces.set.item[o];
          Vec3<Real> at[3];
          faces.place(f, x, at);
          const FaceTouch<Real> t = face_touch(obstacle, faces.model, at, faces.area[f]);
          const FaceFriction<Real> friction = lagged[f];
          const bool rubs = friction.limit > 0 && friction.index == obstacle.index;
          FaceStiffness<Real>& s = stiffness[f];
          s.acts = t.bears() || rubs;
          if (!s.acts) return;
          s.block.setZero();
          s.weight = friction.weight;
          if (t.bears()) {
            s.weight = t.weight;
            s.block = t.stiffness * t.direction * t.direction.transpose();
          }
          if (rubs)
            s.block += friction.stiffness_at(faces.slip(f, friction, x, before),
                                             faces.stop_stiffness(f, friction.limit), sliding_fraction);
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
      device_, "face contact: matrix", vertices_, HYST_KERNEL(int v) {
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

template class FaceContact<double, ThisDevice>;
template class FaceContact<float, ThisDevice>;

}  // namespace hysteron
