#include "sim/contact/contact.h"

#include <numeric>

#include "sim/contact/obstacle_set.h"
#include "sim/contact/touch.h"

namespace hysteron {

namespace {

// Most of the stiffness of friction's stop, over that of the shell at its stiffest.
constexpr double kTangential = 0.5;

template <class Real>
ContactModel<Real> contact_model(const Scene& scene) {
  const ObstacleShell<double> shell = obstacle_shell(scene);
  return {{static_cast<Real>(shell.thickness), static_cast<Real>(shell.k), static_cast<Real>(shell.last)},
          static_cast<Real>(kElasticSlip * shell.thickness),
          static_cast<Real>(kTangential * shell.stiffest())};
}

}  // namespace

template <class Real, class Device>
Contact<Real, Device>::Contact(Device& device, const ClothMesh& mesh, const Scene& scene)
    : device_(device),
      obstacle_(scene.obstacle),
      fabric_friction_(scene.fabric.friction),
      model_(contact_model<Real>(scene)),
      vertices_(mesh.vertices()),
      area_(device, std::vector<Real>(mesh.vertex_area.begin(), mesh.vertex_area.end())),
      slip_(device, vertices_),
      touching_(device, vertices_),
      spared_(device, vertices_),
      stored_(device, vertices_),
      loss_(device, vertices_),
      work_(device, vertices_),
      energy_(device, 0),
      inside_(device, 1),
      force_(device, scene.integrator == Integrator::quasi_static ? vertices_ : 0),
      share_(device),
      scratch_(device) {
  if (is_sharper_than_mesh(scene, mesh)) faces_.emplace(device, mesh, scene, model_);
  energy_ = Buffer<double, Device>(device, vertices_ + (faces_ ? faces_->faces() : 0));
}

template <class Real, class Device>
void Contact<Real, Device>::move(double start, double end) {
  set_ = obstacles_during<Real>(obstacle_, fabric_friction_, start, end);
  moved_from_ = start;
  moved_to_ = end;
}

template <class Real, class Device>
void Contact<Real, Device>::visit(Archive& archive) {
  archive(moved_from_);
  archive(moved_to_);
  if (archive.loads()) move(moved_from_, moved_to_);
  hysteron::visit(archive, device_, slip_);
  hysteron::visit(archive, device_, touching_);
  hysteron::visit(archive, device_, spared_);
  hysteron::visit(archive, device_, stored_);
  hysteron::visit(archive, device_, loss_);
  hysteron::visit(archive, device_, work_);
  hysteron::visit(archive, device_, force_);
  if (faces_) faces_->visit(archive);
}

template <class Real, class Device>
void Contact<Real, Device>::add(const Vec3<Real>* x, const Vec3<Real>* before, Real step, Vec3<Real>* rhs,
                                const BlockRowsView<Real>* matrix) {
  Mat3<Real>* diagonal = matrix ? matrix->diagonal : nullptr;
  const ContactModel<Real> model = model_;
  const ObstacleSet<Real> set = set_;
  const Real* area = area_.data();
  const Vec3<Real>* slipped = slip_.data();
  const int* touching = touching_.data();
  for_each(
      device_, "contact", vertices_, HYST_KERNEL(int i) {
        const Touch<Real> t = touch(set, model, x[i], area[i]);
        if (t.index < 0) return;
        const Slip<Real> s = slip<Real>(t, model, area[i], x[i] - before[i], slipped[i], touching[i]);
        const Real kt = s.stiffness * s.share;
        rhs[i] += step * (t.normal_force - kt * s.trial);
        if (!diagonal) return;
        diagonal[i] += step * step *
                       (t.normal_stiffness + kt * (Mat3<Real>::Identity() - t.normal * t.normal.transpose()));
      });
  if (faces_) faces_->add(set, x, before, step, rhs, matrix);
}

template <class Real, class Device>
int Contact<Real, Device>::commit(const Vec3<Real>* x, const Vec3<Real>* before, const char* held) {
  const ContactModel<Real> model = model_;
  const ObstacleSet<Real> set = set_;
  const Real* area = area_.data();
  Vec3<Real>* slipped = slip_.data();
  int* touching = touching_.data();
  double *stored = stored_.data(), *loss = loss_.data(), *work = work_.data(), *inside = inside_.data();
  const char* spared = spared_.data();
  Vec3<Real>* force = force_.size() > 0 ? force_.data() : nullptr;
  for_each_sum<1>(
      device_, "contact history", vertices_,
      HYST_KERNEL(int i, Sums<1>& sums) {
        const Touch<Real> t = touch(set, model, x[i], area[i]);
        if (force) {
          const Vec3<Real> moved = motion_of(set, touching[i] - 1, x[i]), half = Real(0.5) * force[i];
          work[i] += static_cast<double>(half.dot(moved));
          force[i].setZero();
        }
        if (touching[i] != 0 && touching[i] != t.index + 1) {  // let go: what the stop had stored is lost
          loss[i] += stored[i];
          stored[i] = 0;
          slipped[i].setZero();
        }
        touching[i] = t.index + 1;
        if (t.index < 0) return;
        if (t.inside && !(held[i] && spared[i])) sums.term[0] += 1;
        const Slip<Real> s = slip<Real>(t, model, area[i], x[i] - before[i], slipped[i], touching[i]);
        // The stop's stiffness follows the pressure: what the work done on it does not leave stored is lost.
        const Vec3<Real> stretched = s.share * s.trial;
        const double kept = static_cast<double>(s.stiffness * stretched.squaredNorm() / 2);
        loss[i] += stored[i] - kept + static_cast<double>(s.stiffness * stretched.dot(s.trial - slipped[i]));
        const Vec3<Real> pressed = t.normal_force - s.stiffness * stretched;
        work[i] += (force ? 0.5 : 1.0) * static_cast<double>(pressed.dot(t.obstacle_motion));
        if (force) force[i] = pressed;
        stored[i] = kept;
        slipped[i] = stretched;
      },
      HYST_KERNEL(const Sums<1>& total) { *inside = total.term[0]; });
  return static_cast<int>(inside_.download()[0]) + (faces_ ? faces_->commit(set, x, before, held) : 0);
}

template <class Real, class Device>
double Contact<Real, Device>::stored_energy(const Vec3<Real>* x) {
  const ContactModel<Real> model = model_;
  const ObstacleSet<Real> set = set_;
  const Real* area = area_.data();
  const double* stored = stored_.data();
  double* energy = energy_.data();
  for_each(
      device_, "contact energy", vertices_,
      HYST_KERNEL(int i) { energy[i] = touch(set, model, x[i], area[i]).energy + stored[i]; });
  if (faces_) faces_->store_energies(set, x, energy + vertices_);
  const std::vector<double> values = energy_.download();
  return std::accumulate(values.begin(), values.end(), 0.0);
}

template <class Real, class Device>
ContactLoss Contact<Real, Device>::losses() const {
  const std::vector<double> loss = loss_.download(), work = work_.download();
  ContactLoss lost{std::accumulate(loss.begin(), loss.end(), 0.0),
                   std::accumulate(work.begin(), work.end(), 0.0)};
  if (faces_) {
    const ContactLoss between = faces_->losses();
    lost.friction += between.friction;
    lost.obstacle_work += between.obstacle_work;
  }
  return lost;
}

template <class Real, class Device>
std::size_t Contact<Real, Device>::bytes() const {
  return area_.bytes() + slip_.bytes() + touching_.bytes() + spared_.bytes() + stored_.bytes() +
         loss_.bytes() + work_.bytes() + energy_.bytes() + lagged_.bytes() + inside_.bytes() +
         force_.bytes() + share_.bytes() + scratch_.bytes() + (faces_ ? faces_->bytes() : 0);
}

template class Contact<double, ThisDevice>;
template class Contact<float, ThisDevice>;

}  // namespace hysteron
