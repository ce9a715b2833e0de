// Cloth against obstacles: a penalty shell with Coulomb friction, inside the implicit solve.
//
// Normal: energy k A (d - t)^2/2 per vertex where the distance d is less than the shell t (the cloth's
// thickness); its Gauss-Newton Hessian k A n n^T is positive semidefinite.  Friction is a Prandtl stop in the
// tangent plane: an elastic slip E with stiffness k_t, limited to mu f_n/k_t by radial return.  It holds a
// resting cloth for good, where a velocity-smoothed friction would let it creep.
#pragma once

#include "sim/contact/obstacle_set.h"
#include "sim/linear/block_rows.h"
#include "sim/mesh/cloth_mesh.h"

namespace hysteron {

// Friction of one vertex as an implicit step sees it: what depends on the normal force, held fixed.
template <class Real>
struct LaggedFriction {
  Vec3<Real> normal;
  Vec3<Real> start;  // slip from before, less the obstacle's motion over the step [m]
  Real limit;        // mu f_n [N]; 0: no contact
};

struct ContactLoss {
  double friction = 0;       // dissipated [J]
  double obstacle_work = 0;  // done on the cloth by moving obstacles [J]
};

template <class Real, class Device>
class Contact {
 public:
  Contact(Device& device, const ClothMesh& mesh, const Scene& scene);

  // Places the obstacles for the step from `start` to `end` [s].
  void move(double start, double end);
  // Adds step * force to rhs and step^2 * stiffness to the diagonal blocks, unless these are null.
  void add(const Vec3<Real>* position, const Vec3<Real>* before, Real step, Vec3<Real>* rhs,
           Mat3<Real>* diagonal);
  // Implicit steps (contact_implicit.cpp).  lag() fixes normals and limits of friction at `position`; with
  // them friction has a potential, to which evaluate() adds the normal penalty's: its gradient to `gradient`,
  // its energies() per vertex.  add_stiffness() is its positive semidefinite part.
  void lag(const Vec3<Real>* position);
  void evaluate(const Vec3<Real>* position, const Vec3<Real>* before, Vec3<Real>* gradient);
  const double* energies() const { return energy_.data(); }  // [J]
  void add_stiffness(const Vec3<Real>* position, const Vec3<Real>* before, Mat3<Real>* diagonal);

  // Accepts the positions: slips and losses.  Returns how many vertices are deeper below a surface than the
  // shell is thick.
  int commit(const Vec3<Real>* position, const Vec3<Real>* before, const char* held);
  // Vertices that may be that deep while they are held: they were when they or the obstacle came.
  void spare(const std::vector<char>& vertices) { spared_.upload(vertices); }
  std::vector<char> spared() const { return spared_.download(); }

  double stored_energy(const Vec3<Real>* position);  // [J]
  ContactLoss losses() const;                        // since the start
  double stiffness() const { return stiffness_; }    // per area [N/m^3]
  std::size_t bytes() const;

 private:
  Device& device_;
  std::vector<Obstacle> obstacle_;
  double fabric_friction_;
  Real shell_, stiffness_, tangential_;  // t [m], k [N/m^3], k_t [N/m^3]
  int vertices_;
  ObstacleSet<Real> set_;
  Buffer<Real, Device> area_;
  Buffer<Vec3<Real>, Device> slip_;  // E [m]
  Buffer<int, Device> touching_;     // obstacle index + 1, 0 = free
  Buffer<char, Device> spared_;
  Buffer<double, Device> loss_, work_, energy_, deep_;
  Buffer<LaggedFriction<Real>, Device> lagged_;  // of implicit steps; empty before the first
};

}  // namespace hysteron
