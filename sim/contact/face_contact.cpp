#include "sim/contact/face_contact.h"

#include <algorithm>
#include <numeric>

#include "sim/contact/face_touch.h"
#include "sim/contact/obstacle_set.h"
#include "sim/contact/sliding_stop.h"
#include "sim/contact/touch.h"

namespace hysteron {

namespace {

template <class Real>
HYST_HD void corners_of(const Eigen::Vector3i& face, const Vec3<Real>* x, Vec3<Real> (&corner)[3]) {
  for (int k = 0; k < 3; ++k) corner[k] = x[face[k]];
}

// Stretch of a triangle's stop.
template <class Real>
HYST_HD Vec3<Real> face_slip(const FaceFriction<Real>& friction, const Eigen::Vector3i& face,
                             const Vec3<Real>* x, const Vec3<Real>* before) {
  Vec3<Real> e = friction.start;
  for (int k = 0; k < 3; ++k) e += friction.weight[k] * (x[face[k]] - before[face[k]]);
  return e - friction.normal * friction.normal.dot(e);
}

}  // namespace

template <class Real, class Device>
FaceContact<Real, Device>::FaceContact(Device& device, const ClothMesh& mesh, const Scene& scene,
                                       const ContactModel<Real>& model)
    : device_(device),
      model_(model),
      vertices_(mesh.vertices()),
      faces_(mesh.faces()),
      sharp_(static_cast<Real>(sharp_radius(scene, mesh))),
      corner_(device, mesh.face),
      vertex_start_(device, mesh.vertex_faces.start),
      vertex_item_(device, mesh.vertex_faces.item),
      area_(device, std::vector<Real>(mesh.face_area.begin(), mesh.face_area.end())),
      slip_(device, faces_),
      touching_(device, faces_),
      stored_(device, faces_),
      loss_(device, faces_),
      work_(device, faces_),
      inside_(device, 1),
      pressed_(device, scene.integrator == Integrator::quasi_static ? 3 * faces_ : 0),
      lagged_(device, faces_),
      stiffness_(device, faces_),
      force_(device, 3 * static_cast<std::size_t>(faces_)),
      share_(device),
      scratch_(device) {}

template <class Real, class Device>
void FaceContact<Real, Device>::visit(Archive& archive) {
  hysteron::visit(archive, device_, slip_);
  hysteron::visit(archive, device_, touching_);
  hysteron::visit(archive, device_, stored_);
  hysteron::visit(archive, device_, loss_);
  hysteron::visit(archive, device_, work_);
  hysteron::visit(archive, device_, pressed_);
}

template <class Real, class Device>
void FaceContact<Real, Device>::add(const ObstacleSet<Real>& set, const Vec3<Real>* x,
                                    const Vec3<Real>* before, Real step, Vec3<Real>* rhs,
                                    const BlockRowsView<Real>* matrix) {
  lag(set, x);
  evaluate(set, x, before, step, rhs, nullptr);
  if (matrix) add_stiffness(set, x, before, step * step, *matrix, Real(0));
}

// Normals and limits of friction, against the obstacle that presses most.
template <class Real, class Device>
void FaceContact<Real, Device>::lag(const ObstacleSet<Real>& in, const Vec3<Real>* x) {
  const ContactModel<Real> model = model_;
  const ObstacleSet<Real> set = in;
  const Real sharp = sharp_;
  const Eigen::Vector3i* corner = corner_.data();
  const Real* area = area_.data();
  const Vec3<Real>* slipped = slip_.data();
  const int* touching = touching_.data();
  FaceFriction<Real>* lagged = lagged_.data();
  for_each(
      device_, "face contact: lagged friction", faces_, HYST_KERNEL(int f) {
        Vec3<Real> at[3];
        corners_of(corner[f], x, at);
        FaceFriction<Real> friction{Vec3<Real>::Zero(), Vec3<Real>::Zero(), Vec3<Real>::Zero(), 0, -1, false};
        Real strongest = 0;
        for (int o = 0; o < set.count; ++o) {
          if (!(set.item[o].sharpest < sharp)) continue;
          const FaceTouch<Real> t = face_touch(set.item[o], model, at, area[f]);
          friction.inside |= t.inside;
          if (!(t.force > strongest)) continue;
          strongest = t.force;
          friction.normal = t.direction.normalized();
          friction.weight = t.weight;
          friction.limit = t.limit;
          friction.index = set.item[o].index;
          const Vec3<Real> point = t.weight[0] * at[0] + t.weight[1] * at[1] + t.weight[2] * at[2];
          friction.start = -motion_over_step(set.item[o], point);
        }
        if (friction.index >= 0 && touching[f] == friction.index + 1) friction.start += slipped[f];
        lagged[f] = friction;
      });
}

template <class Real, class Device>
void FaceContact<Real, Device>::evaluate(const ObstacleSet<Real>& in, const Vec3<Real>* x,
                                         const Vec3<Real>* before, Real factor, Vec3<Real>* target,
                                         double* energy) {
  const ContactModel<Real> model = model_;
  const ObstacleSet<Real> set = in;
  const Real sharp = sharp_;
  const Eigen::Vector3i* corner = corner_.data();
  const Real* area = area_.data();
  const FaceFriction<Real>* lagged = lagged_.data();
  Vec3<Real>* force = force_.data();
  for_each(
      device_, "face contact", faces_, HYST_KERNEL(int f) {
        Vec3<Real> at[3];
        corners_of(corner[f], x, at);
        double sum = 0;
        for (int k = 0; k < 3; ++k) force[3 * f + k].setZero();
        for (int o = 0; o < set.count; ++o) {
          if (!(set.item[o].sharpest < sharp)) continue;
          const FaceTouch<Real> t = face_touch(set.item[o], model, at, area[f]);
          if (!t.bears()) continue;
          sum += t.energy;
          for (int k = 0; k < 3; ++k) force[3 * f + k] += t.on_corner(k);
        }
        const FaceFriction<Real> friction = lagged[f];
        if (friction.limit > 0) {
          const Vec3<Real> e = face_slip(friction, corner[f], x, before);
          const Real k_t = model.stop_stiffness(friction.limit, area[f]), length = e.norm(),
                     most = friction.limit / k_t;
          const bool slides = length > most;
          sum += static_cast<double>(k_t * (slides ? most * (length - most / 2) : length * length / 2));
          const Vec3<Real> back = (slides ? k_t * most / length : k_t) * e;
          for (int k = 0; k < 3; ++k) force[3 * f + k] -= friction.weight[k] * back;
        }
        if (energy) energy[f] = sum;
      });
  const GatheredForces<Real> forces{vertex_start_.data(), vertex_item_.data(), force};
  for_each(
      device_, "face contact: forces", vertices_, HYST_KERNEL(int i) { target[i] += factor * forces.at(i); });
}

// One obstacle after the other, so that a face has one point at a time.
template <class Real, class Device>
void FaceContact<Real, Device>::add_stiffness(const ObstacleSet<Real>& set, const Vec3<Real>* x,
                                              const Vec3<Real>* before, Real factor,
                                              BlockRowsView<Real> matrix, Real sliding_share) {
  const ContactModel<Real> model = model_;
  const Eigen::Vector3i* corner = corner_.data();
  const Real* area = area_.data();
  const FaceFriction<Real>* lagged = lagged_.data();
  FaceStiffness<Real>* stiffness = stiffness_.data();
  for (int o = 0; o < set.count; ++o) {
    if (!is_sharp(set.item[o])) continue;
    const Obstacle3<Real> obstacle = set.item[o];
    for_each(
        device_, "face contact: stiffness", faces_, HYST_KERNEL(int f) {
          Vec3<Real> at[3];
          corners_of(corner[f], x, at);
          const FaceTouch<Real> t = face_touch(obstacle, model, at, area[f]);
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
          if (!rubs) return;
          const Vec3<Real> e = face_slip(friction, corner[f], x, before);
          const Real k_t = model.stop_stiffness(friction.limit, area[f]);
          s.block += sliding_stiffness<Real>(e, friction.normal, k_t, friction.limit / k_t, sliding_share);
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

// As Contact::commit(), with the friction of the positions that are accepted.
template <class Real, class Device>
int FaceContact<Real, Device>::commit(const ObstacleSet<Real>& in, const Vec3<Real>* x,
                                      const Vec3<Real>* before, const char* held) {
  lag(in, x);
  const ContactModel<Real> model = model_;
  const ObstacleSet<Real> set = in;
  const Real sharp = sharp_;
  const Eigen::Vector3i* corner = corner_.data();
  const Real* area = area_.data();
  const FaceFriction<Real>* lagged = lagged_.data();
  Vec3<Real>* slipped = slip_.data();
  int* touching = touching_.data();
  double *stored = stored_.data(), *loss = loss_.data(), *work = work_.data(), *inside = inside_.data();
  Vec3<Real>* kept_force = pressed_.size() > 0 ? pressed_.data() : nullptr;
  for_each_sum<1>(
      device_, "face contact: history", faces_,
      HYST_KERNEL(int f, Sums<1>& sums) {
        const FaceFriction<Real> friction = lagged[f];
        const Eigen::Vector3i face = corner[f];
        Vec3<Real> at[3];
        corners_of(face, x, at);
        if (kept_force)
          for (int k = 0; k < 3; ++k) {
            Vec3<Real>& force = kept_force[3 * f + k];
            work[f] += static_cast<double>(force.dot(motion_of(set, touching[f] - 1, at[k])) / 2);
            force.setZero();
          }
        if (touching[f] != 0 && touching[f] != friction.index + 1) {  // let go
          loss[f] += stored[f];
          stored[f] = 0;
          slipped[f].setZero();
        }
        touching[f] = friction.index + 1;
        if (friction.index < 0) return;
        if (friction.inside && !held[face[0]] && !held[face[1]] && !held[face[2]]) sums.term[0] += 1;
        Vec3<Real> pressed[3] = {Vec3<Real>::Zero(), Vec3<Real>::Zero(), Vec3<Real>::Zero()};
        for (int o = 0; o < set.count; ++o) {
          if (!(set.item[o].sharpest < sharp)) continue;
          const FaceTouch<Real> t = face_touch(set.item[o], model, at, area[f]);
          if (!t.bears()) continue;
          for (int k = 0; k < 3; ++k) pressed[k] += t.on_corner(k);
        }
        const Vec3<Real> trial = face_slip(friction, face, x, before);
        const Real k_t = model.stop_stiffness(friction.limit, area[f]), length = trial.norm();
        const Real share = k_t * length > friction.limit ? friction.limit / (k_t * length) : Real(1);
        const Vec3<Real> stretched = share * trial;
        const double kept = static_cast<double>(k_t * stretched.squaredNorm() / 2);
        loss[f] += stored[f] - kept + static_cast<double>(k_t * stretched.dot(trial - slipped[f]));
        for (int k = 0; k < 3; ++k) {
          pressed[k] -= k_t * friction.weight[k] * stretched;
          work[f] += (kept_force ? 0.5 : 1.0) *
                     static_cast<double>(pressed[k].dot(motion_of(set, friction.index, at[k])));
          if (kept_force) kept_force[3 * f + k] = pressed[k];
        }
        stored[f] = kept;
        slipped[f] = stretched;
      },
      HYST_KERNEL(const Sums<1>& total) { *inside = total.term[0]; });
  return static_cast<int>(inside_.download()[0]);
}

template <class Real, class Device>
void FaceContact<Real, Device>::store_energies(const ObstacleSet<Real>& in, const Vec3<Real>* x,
                                               double* energy) {
  const ContactModel<Real> model = model_;
  const ObstacleSet<Real> set = in;
  const Real sharp = sharp_;
  const Eigen::Vector3i* corner = corner_.data();
  const Real* area = area_.data();
  const double* stored = stored_.data();
  for_each(
      device_, "face contact: energy", faces_, HYST_KERNEL(int f) {
        Vec3<Real> at[3];
        corners_of(corner[f], x, at);
        double sum = stored[f];
        for (int o = 0; o < set.count; ++o)
          if (set.item[o].sharpest < sharp) sum += face_touch(set.item[o], model, at, area[f]).energy;
        energy[f] = sum;
      });
}

template <class Real, class Device>
ContactLoss FaceContact<Real, Device>::losses() const {
  const std::vector<double> loss = loss_.download(), work = work_.download();
  return {std::accumulate(loss.begin(), loss.end(), 0.0), std::accumulate(work.begin(), work.end(), 0.0)};
}

template <class Real, class Device>
std::size_t FaceContact<Real, Device>::bytes() const {
  return corner_.bytes() + vertex_start_.bytes() + vertex_item_.bytes() + area_.bytes() + slip_.bytes() +
         touching_.bytes() + stored_.bytes() + loss_.bytes() + work_.bytes() + inside_.bytes() +
         pressed_.bytes() + lagged_.bytes() + stiffness_.bytes() + force_.bytes() + share_.bytes() +
         scratch_.bytes();
}

template class FaceContact<double, ThisDevice>;
template class FaceContact<float, ThisDevice>;

}  // namespace hysteron
