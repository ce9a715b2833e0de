#include "sim/contact/contact.h"

#include <numeric>

#include "sim/contact/sweep.h"

namespace hysteron {

namespace {

// The largest stiffness of friction's stop, over that of the barrier at its stiffest.
constexpr double kTangential = 0.5;

template <class Real>
ContactModel<Real> contact_model(const Scene& scene) {
  const ObstacleResponse<double> response = obstacle_response(scene);
  return {{static_cast<Real>(response.thickness), static_cast<Real>(response.k),
           static_cast<Real>(response.last), static_cast<Real>(response.yield)},
          static_cast<Real>(kElasticSlip * response.thickness),
          static_cast<Real>(kTangential * response.stiffest())};
}

}  // namespace

template <class Real, class Device>
Contact<Real, Device>::Contact(Device& device, const ClothMesh& mesh, const Scene& scene)
    : device_(device),
      obstacle_(scene.obstacle),
      fabric_friction_(scene.fabric.friction),
      model_(contact_model<Real>(scene)),
      area_(device, std::vector<Real>(mesh.vertex_area.begin(), mesh.vertex_area.end())),
      exempt_(device, mesh.vertices()),
      energy_(device, 0),
      vertices_(device, mesh.vertices(), scene.integrator == Integrator::quasi_static) {
  if (is_sharper_than_mesh(scene, mesh)) faces_.emplace(device, mesh, scene, model_);
  energy_ = Buffer<double, Device>(device, vertices_.count() + (faces_ ? faces_->count() : 0));
}

template <class Real, class Device>
void Contact<Real, Device>::move(double start, double end) {
  set_ = obstacles_during<Real>(obstacle_, fabric_friction_, start, end);
  moved_from_ = start;
  moved_to_ = end;
}

template <class Real, class Device>
void Contact<Real, Device>::serialise(Archive& archive) {
  archive(moved_from_);
  archive(moved_to_);
  if (archive.loads()) move(moved_from_, moved_to_);
  vertices_.stops().serialise(archive, device_, exempt_);
  if (faces_) faces_->stops().serialise(archive, device_);
}

// For triangles this takes the parts of an implicit step one after the other.
template <class Real, class Device>
void Contact<Real, Device>::add(const Vec3<Real>* x, const Vec3<Real>* before, Real step, Vec3<Real>* rhs,
                                const BlockRowsView<Real>* matrix) {
  Mat3<Real>* diagonal = matrix ? matrix->diagonal : nullptr;
  const VertexPoints<Real> vertices = points();
  const StopView<Real> stops = vertices_.stops().view();
  for_each(
      device_, "contact", vertices_.count(), HYST_KERNEL(int i) {
        const auto b = active_contacts<Real>(vertices, i, x);
        if (b.index < 0) return;
        const Slip<Real> s = vertices.slip(i, b, x, before, stops);
        const Real kt = s.stiffness * s.fraction;
        rhs[i] += step * (b.force[0] - kt * s.trial);
        if (!diagonal) return;
        diagonal[i] +=
            step * step * (b.stiffness + kt * (Mat3<Real>::Identity() - b.normal * b.normal.transpose()));
      });
  if (!faces_) return;
  const FacePoints<Real> faces = faces_->points(set_);
  faces_->update_lagged_friction(faces, x);
  faces_->add_forces(faces, x, before, step, rhs, nullptr);
  if (matrix) faces_->add_stiffness(faces, x, before, step * step, *matrix, Real(0));
}

template <class Real, class Device>
int Contact<Real, Device>::commit(const Vec3<Real>* x, const Vec3<Real>* before, const char* held) {
  const int inside = vertices_.commit(points(), x, before, held);
  return inside + (faces_ ? faces_->commit(faces_->points(set_), x, before, held) : 0);
}

template <class Real, class Device>
double Contact<Real, Device>::stored_energy(const Vec3<Real>* x) {
  vertices_.store_energies(points(), x, energy_.data());
  if (faces_) faces_->store_energies(faces_->points(set_), x, energy_.data() + vertices_.count());
  const std::vector<double> values = energy_.download();
  return std::accumulate(values.begin(), values.end(), 0.0);
}

template <class Real, class Device>
ContactLoss Contact<Real, Device>::losses() const {
  ContactLoss lost = vertices_.stops().losses();
  if (faces_) {
    const ContactLoss between = faces_->stops().losses();
    lost.friction += between.friction;
    lost.obstacle_work += between.obstacle_work;
  }
  return lost;
}

template <class Real, class Device>
std::size_t Contact<Real, Device>::bytes() const {
  return total_bytes(area_, exempt_, energy_, vertices_) + (faces_ ? faces_->bytes() : 0);
}

template <class Real, class Device>
void Contact<Real, Device>::update_lagged_friction(const Vec3<Real>* x) {
  vertices_.update_lagged_friction(points(), x);
  if (faces_) faces_->update_lagged_friction(faces_->points(set_), x);
}

template <class Real, class Device>
void Contact<Real, Device>::evaluate(const Vec3<Real>* x, const Vec3<Real>* before, Vec3<Real>* gradient) {
  vertices_.evaluate(points(), x, before, gradient, energy_.data());
  if (faces_)
    faces_->add_forces(faces_->points(set_), x, before, Real(-1), gradient,
                       energy_.data() + vertices_.count());
}

template <class Real, class Device>
void Contact<Real, Device>::add_stiffness(const Vec3<Real>* x, const Vec3<Real>* before,
                                          BlockRowsView<Real> matrix, Real sliding_fraction) {
  const VertexPoints<Real> vertices = points();
  const LaggedFriction<Real>* lagged = vertices_.lagged();
  Mat3<Real>* diagonal = matrix.diagonal;
  for_each(
      device_, "contact: stiffness", vertices_.count(), HYST_KERNEL(int i) {
        diagonal[i] += active_contacts<Real>(vertices, i, x).stiffness;
        if (!(lagged[i].limit > 0)) return;
        const Real k = vertices.model.stop_stiffness(lagged[i].limit, vertices.area[i]);
        diagonal[i] +=
            lagged[i].stiffness_at(lagged_slip<Real>(vertices, i, lagged[i], x, before), k, sliding_fraction);
      });
  if (faces_) faces_->add_stiffness(faces_->points(set_), x, before, Real(1), matrix, sliding_fraction);
}

// Clips the guess of a step, each vertex by itself, so that one does not hold up the others.
template <class Real, class Device>
void Contact<Real, Device>::clip_to_obstacles(const Vec3<Real>* start, Vec3<Real>* end, const char* held) {
  if (!set_.has_thin()) return;
  const VertexPoints<Real> vertices = points();
  const Real rest_distance =
      static_cast<Real>(1 - kCompressed) * model_.response.thickness;  // cloth is pressed back to here
  for_each(
      device_, "contact: guess", vertices_.count(), HYST_KERNEL(int i) {
        if (!held[i]) clip_path(vertices, i, start, end, rest_distance);
      });
  if (faces_) faces_->clip_to_obstacles(faces_->points(set_), start, end, held, rest_distance);
}

template <class Real, class Device>
bool Contact<Real, Device>::path_is_clear(const Vec3<Real>* start, const Vec3<Real>* end, const char* held) {
  if (!set_.has_thin()) return true;
  return vertices_.path_is_clear(points(), start, end, held) &&
         (!faces_ || faces_->path_is_clear(faces_->points(set_), start, end, held));
}

template <class Real, class Device>
double Contact<Real, Device>::feasible_step(const Vec3<Real>* x, const Vec3<Real>* direction,
                                            const char* held, double max_step) {
  if (!set_.has_thin()) return max_step;
  const double free = vertices_.feasible_step(points(), x, direction, held, max_step);
  return faces_ ? faces_->feasible_step(faces_->points(set_), x, direction, held, free) : free;
}

template class Contact<double, ThisDevice>;
template class Contact<float, ThisDevice>;

}  // namespace hysteron
