#include "sim/contact/contact.h"

#include <numeric>

#include "sim/contact/penalty.h"
#include "sim/contact/touch.h"

namespace hysteron {

namespace {

// Tangential over normal penalty stiffness.
constexpr double kTangential = 0.5;

}  // namespace

template <class Real, class Device>
Contact<Real, Device>::Contact(Device& device, const ClothMesh& mesh, const Scene& scene)
    : device_(device),
      obstacle_(scene.obstacle),
      fabric_friction_(scene.fabric.friction),
      shell_(static_cast<Real>(scene.fabric.thickness)),
      vertices_(mesh.vertices()),
      area_(device, std::vector<Real>(mesh.vertex_area.begin(), mesh.vertex_area.end())),
      slip_(device, vertices_),
      touching_(device, vertices_),
      spared_(device, vertices_),
      loss_(device, vertices_),
      work_(device, vertices_),
      energy_(device, vertices_),
      deep_(device, 1) {
  stiffness_ = static_cast<Real>(contact_stiffness_per_area(scene));
  tangential_ = static_cast<Real>(kTangential) * stiffness_;
}

template <class Real, class Device>
void Contact<Real, Device>::move(double start, double end) {
  set_ = obstacles_during<Real>(obstacle_, fabric_friction_, start, end);
}

template <class Real, class Device>
void Contact<Real, Device>::add(const Vec3<Real>* x, const Vec3<Real>* before, Real step, Vec3<Real>* rhs,
                                Mat3<Real>* diagonal) {
  const ContactModel<Real> model{shell_, stiffness_, tangential_};
  const ObstacleSet<Real> set = set_;
  const Real* area = area_.data();
  const Vec3<Real>* slipped = slip_.data();
  const int* touching = touching_.data();
  for_each(
      device_, "contact", vertices_, HYST_KERNEL(int i) {
        const Touch<Real> t = touch(set, model, x[i], area[i]);
        if (t.index < 0) return;
        const Slip<Real> s = slip<Real>(t, model, area[i], x[i] - before[i], slipped[i], touching[i]);
        const Real kt = model.tangential * area[i] * s.share;
        rhs[i] += step * (t.normal_force - kt * s.trial);
        if (!diagonal) return;
        diagonal[i] += step * step *
                       (t.normal_stiffness + kt * (Mat3<Real>::Identity() - t.normal * t.normal.transpose()));
      });
}

template <class Real, class Device>
int Contact<Real, Device>::commit(const Vec3<Real>* x, const Vec3<Real>* before, const char* held) {
  const ContactModel<Real> model{shell_, stiffness_, tangential_};
  const ObstacleSet<Real> set = set_;
  const Real* area = area_.data();
  Vec3<Real>* slipped = slip_.data();
  int* touching = touching_.data();
  double *loss = loss_.data(), *work = work_.data(), *deep = deep_.data();
  const char* spared = spared_.data();
  for_each_sum<1>(
      device_, "contact history", vertices_,
      HYST_KERNEL(int i, Sums<1>& sums) {
        const Touch<Real> t = touch(set, model, x[i], area[i]);
        const Real k = model.tangential * area[i];
        if (touching[i] != 0 && touching[i] != t.index + 1) {  // let go: what the stop had stored is lost
          loss[i] += static_cast<double>(k * slipped[i].squaredNorm() / 2);
          slipped[i].setZero();
        }
        touching[i] = t.index + 1;
        if (t.index < 0) return;
        const bool too_deep = t.strongest > 2 * model.shell * model.stiffness * area[i];
        if (too_deep && !(held[i] && spared[i])) sums.term[0] += 1;
        const Slip<Real> s = slip<Real>(t, model, area[i], x[i] - before[i], slipped[i], touching[i]);
        const Vec3<Real> stretched = s.share * s.trial;
        loss[i] += static_cast<double>(k * stretched.dot(s.trial - stretched));
        work[i] += static_cast<double>((t.normal_force - k * stretched).dot(t.obstacle_motion));
        slipped[i] = stretched;
      },
      HYST_KERNEL(const Sums<1>& total) { *deep = total.term[0]; });
  return static_cast<int>(deep_.download()[0]);
}

template <class Real, class Device>
double Contact<Real, Device>::stored_energy(const Vec3<Real>* x) {
  const ContactModel<Real> model{shell_, stiffness_, tangential_};
  const ObstacleSet<Real> set = set_;
  const Real* area = area_.data();
  const Vec3<Real>* slipped = slip_.data();
  double* energy = energy_.data();
  for_each(
      device_, "contact energy", vertices_, HYST_KERNEL(int i) {
        energy[i] = touch(set, model, x[i], area[i]).energy +
                    static_cast<double>(model.tangential * area[i] * slipped[i].squaredNorm() / 2);
      });
  const std::vector<double> values = energy_.download();
  return std::accumulate(values.begin(), values.end(), 0.0);
}

template <class Real, class Device>
ContactLoss Contact<Real, Device>::losses() const {
  const std::vector<double> loss = loss_.download(), work = work_.download();
  return {std::accumulate(loss.begin(), loss.end(), 0.0), std::accumulate(work.begin(), work.end(), 0.0)};
}

template <class Real, class Device>
std::size_t Contact<Real, Device>::bytes() const {
  return area_.bytes() + slip_.bytes() + touching_.bytes() + spared_.bytes() + loss_.bytes() + work_.bytes() +
         energy_.bytes() + lagged_.bytes() + deep_.bytes();
}

template class Contact<double, ThisDevice>;
template class Contact<float, ThisDevice>;

}  // namespace hysteron
