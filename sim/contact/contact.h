// Cloth against obstacles: a shell that gives in to pressure as layers do, with Coulomb friction, inside the
// implicit solve.
//
// Normal: the barrier of compression.h per vertex where its distance is less than the cloth's thickness; the
// Gauss-Newton Hessian is positive semidefinite.  Iterates may be in a solid, where the shell is stiff and
// pushes them out; a state of equilibrium is not, unless it is crushed.  Friction is a Prandtl stop in the
// tangent plane: an elastic slip of up to 1 % of the thickness, limited to mu f_n by radial return.  It holds
// a resting cloth for good, where a velocity-smoothed friction would let it creep.
//
// Obstacles that are sharper than the mesh are felt by the triangles between the vertices, too
// (face_contact.h).
#pragma once

#include <optional>

#include "sim/contact/face_contact.h"

namespace hysteron {

template <class Real, class Device>
class Contact {
 public:
  Contact(Device& device, const ClothMesh& mesh, const Scene& scene);

  // Places the obstacles for the step from `start` to `end` [s].
  void move(double start, double end);
  // Adds step * force to rhs and step^2 * stiffness to the matrix, unless that is null.
  void add(const Vec3<Real>* position, const Vec3<Real>* before, Real step, Vec3<Real>* rhs,
           const BlockRowsView<Real>* matrix);
  // Implicit steps.  lag() fixes normals and limits of friction at `position`; with
  // them friction has a potential, to which evaluate() adds the shells': its gradient to `gradient`,
  // its energies() per vertex and triangle.  add_stiffness() is its positive semidefinite part
  // (sliding_fraction: sliding_stop.h).
  void lag(const Vec3<Real>* position);
  void evaluate(const Vec3<Real>* position, const Vec3<Real>* before, Vec3<Real>* gradient);
  const double* energies() const { return energy_.data(); }  // [J]
  int energies_count() const { return static_cast<int>(energy_.size()); }
  void add_stiffness(const Vec3<Real>* position, const Vec3<Real>* before, BlockRowsView<Real> matrix,
                     Real sliding_fraction);

  // Free vertices, and triangles of free vertices beside sharp obstacles, do not pass through a solid that
  // has another side, nor it through them (sweep.h).  clip_to_obstacles() ends each path of a step from
  // `start` to `end` where it meets an obstacle that blocks it, path_is_clear() says whether none is blocked,
  // and feasible_step() how long a step along `direction` from x may be, up to `max_step`.
  void clip_to_obstacles(const Vec3<Real>* start, Vec3<Real>* end, const char* held);
  bool path_is_clear(const Vec3<Real>* start, const Vec3<Real>* end, const char* held);
  double feasible_step(const Vec3<Real>* x, const Vec3<Real>* direction, const char* held, double max_step);

  // Accepts the positions: slips, losses and the obstacles' work, which in quasi-static scenes is that of the
  // mean of the forces before and after.  Returns how many vertices and triangles are in a solid.
  int commit(const Vec3<Real>* position, const Vec3<Real>* before, const char* held);
  // Vertices that may be there while they are held: they were when they or the obstacle came.
  void exempt(const std::vector<char>& vertices) { exempt_.upload(vertices); }
  std::vector<char> exempted() const { return exempt_.download(); }

  // What outlives a step: the stops, what they touch, losses, and where the obstacles were placed.
  void serialise(Archive& archive);

  double stored_energy(const Vec3<Real>* position);  // [J]
  ContactLoss losses() const;                        // since the start
  std::size_t bytes() const;

 private:
  VertexPoints<Real> points() const { return {model_, set_, area_.data(), exempt_.data()}; }

  Device& device_;
  std::vector<Obstacle> obstacle_;
  double fabric_friction_;
  ContactModel<Real> model_;
  ObstacleSet<Real> set_;
  double moved_from_ = 0, moved_to_ = 0;  // for which it is [s]
  Buffer<Real, Device> area_;
  Buffer<char, Device> exempt_;
  Buffer<double, Device> energy_;
  PointContact<Real, Device, VertexPoints<Real>> vertices_;
  std::optional<FaceContact<Real, Device>> faces_;  // where an obstacle is sharper than the mesh
};

}  // namespace hysteron
