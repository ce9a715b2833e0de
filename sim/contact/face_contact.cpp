#include "sim/contact/face_contact.h"

namespace hysteron {

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
      stops_(device, faces_, scene.integrator == Integrator::quasi_static ? 3 * faces_ : 0),
      inside_(device, 1),
      lagged_(device, faces_),
      stiffness_(device, faces_),
      force_(device, 3 * static_cast<std::size_t>(faces_)),
      fraction_(device),
      scratch_(device) {}

template <class Real, class Device>
void FaceContact<Real, Device>::add(const ObstacleSet<Real>& set, const Vec3<Real>* x,
                                    const Vec3<Real>* before, Real step, Vec3<Real>* rhs,
                                    const BlockRowsView<Real>* matrix) {
  lag(set, x);
  evaluate(set, x, before, step, rhs, nullptr);
  if (matrix) add_stiffness(set, x, before, step * step, *matrix, Real(0));
}

template <class Real, class Device>
void FaceContact<Real, Device>::lag(const ObstacleSet<Real>& set, const Vec3<Real>* x) {
  const FaceView<Real> faces = view(set);
  const StopView<Real> stops = stops_.view();
  FaceFriction<Real>* lagged = lagged_.data();
  for_each(
      device_, "face contact: lagged friction", faces_, HYST_KERNEL(int f) {
        Vec3<Real> at[3];
        faces.place(f, x, at);
        lagged[f] = faces.friction(f, at, stops);
      });
}

template <class Real, class Device>
void FaceContact<Real, Device>::evaluate(const ObstacleSet<Real>& set, const Vec3<Real>* x,
                                         const Vec3<Real>* before, Real factor, Vec3<Real>* target,
                                         double* energy) {
  const FaceView<Real> faces = view(set);
  const FaceFriction<Real>* lagged = lagged_.data();
  Vec3<Real>* force = force_.data();
  for_each(
      device_, "face contact", faces_, HYST_KERNEL(int f) {
        Vec3<Real> at[3];
        faces.place(f, x, at);
        double sum = faces.press(f, at, 0, force + 3 * f);
        const FaceFriction<Real> friction = lagged[f];
        if (friction.limit > 0) {
          Vec3<Real> back;
          sum += friction.energy_at(faces.slip(f, friction, x, before),
                                    faces.stop_stiffness(f, friction.limit), back);
          for (int k = 0; k < 3; ++k) force[3 * f + k] -= friction.weight[k] * back;
        }
        if (energy) energy[f] = sum;
      });
  const GatheredForces<Real> forces{vertex_start_.data(), vertex_item_.data(), force};
  for_each(
      device_, "face contact: forces", vertices_, HYST_KERNEL(int i) { target[i] += factor * forces.at(i); });
}

// As Contact::commit(), with the friction of the positions that are accepted.
template <class Real, class Device>
int FaceContact<Real, Device>::commit(const ObstacleSet<Real>& set, const Vec3<Real>* x,
                                      const Vec3<Real>* before, const char* held) {
  lag(set, x);
  const FaceView<Real> faces = view(set);
  const StopView<Real> stops = stops_.view();
  const FaceFriction<Real>* lagged = lagged_.data();
  double* inside = inside_.data();
  for_each_sum<1>(
      device_, "face contact: history", faces_,
      HYST_KERNEL(int f, Sums<1>& sums) {
        const FaceFriction<Real> friction = lagged[f];
        const Eigen::Vector3i face = faces.corner[f];
        Vec3<Real> at[3], pressed[3];
        faces.place(f, x, at);
        for (int k = 0; stops.force && k < 3; ++k)
          stops.work_before(f, 3 * f + k, surface_motion(faces.set, stops.touching[f] - 1, at[k]));
        stops.touch(f, friction.index);
        if (friction.index < 0) return;
        if (friction.inside && !held[face[0]] && !held[face[1]] && !held[face[2]]) sums.term[0] += 1;
        faces.press(f, at, 0, pressed);
        const Real k_t = faces.stop_stiffness(f, friction.limit);
        const Vec3<Real> stretched =
            stops.accept(f, slip_within<Real>(faces.slip(f, friction, x, before), friction.limit, k_t));
        for (int k = 0; k < 3; ++k)
          stops.work_after(f, 3 * f + k, pressed[k] - k_t * friction.weight[k] * stretched,
                           surface_motion(faces.set, friction.index, at[k]));
      },
      HYST_KERNEL(const Sums<1>& total) { *inside = total.term[0]; });
  return static_cast<int>(inside_.download()[0]);
}

template <class Real, class Device>
void FaceContact<Real, Device>::store_energies(const ObstacleSet<Real>& set, const Vec3<Real>* x,
                                               double* energy) {
  const FaceView<Real> faces = view(set);
  const double* stored = stops_.stored.data();
  for_each(
      device_, "face contact: energy", faces_, HYST_KERNEL(int f) {
        Vec3<Real> at[3], force[3];
        faces.place(f, x, at);
        energy[f] = faces.press(f, at, stored[f], force);
      });
}

template <class Real, class Device>
std::size_t FaceContact<Real, Device>::bytes() const {
  return total_bytes(corner_, vertex_start_, vertex_item_, area_, stops_, inside_, lagged_, stiffness_,
                     force_, fraction_, scratch_);
}

template class FaceContact<double, ThisDevice>;
template class FaceContact<float, ThisDevice>;

}  // namespace hysteron
