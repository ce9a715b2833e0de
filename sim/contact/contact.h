// Computes cloth against obstacles, whose response yields to pressure as that of layers does, with Coulomb
// friction, inside the implicit solve.
//
// The normal force is the barrier of compression.h at each vertex whose distance is less than the cloth's
// thickness; its Gauss-Newton Hessian is positive semidefinite.  Iterates may be in a solid, where the
// barrier is stiff and pushes them out; a state of equilibrium is not, unless it is crushed.  Friction is a
// Prandtl stop in the tangent plane: an elastic slip of up to 1 % of the thickness, limited to mu f_n by
// radial return.  It holds a resting cloth for good, where a velocity-smoothed friction would let it creep.
//
// Obstacles that are sharper than the mesh act on the triangles between the vertices, too (face_contact.h).
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
  // Adds step * force to rhs (n vertices) and step^2 * stiffness to the matrix, unless that is null.
  void add(const Vec3<Real>* position, const Vec3<Real>* before, Real step, Vec3<Real>* rhs,
           const BlockRowsView<Real>* matrix);
  // These serve implicit steps. update_lagged_friction() fixes normals and limits of friction at `position`;
  // friction then has a potential, to which evaluate() adds the barriers': it adds the gradient (n vertices
  // [N]) to `gradient`, and sets energies() per vertex and triangle. add_stiffness() adds the positive
  // semidefinite part of the Hessian (sliding_fraction: sliding_stop.h).
  void update_lagged_friction(const Vec3<Real>* position);
  void evaluate(const Vec3<Real>* position, const Vec3<Real>* before, Vec3<Real>* gradient);
  const double* energies() const { return energy_.data(); }  // energies_count() of them [J]
  int energies_count() const { return static_cast<int>(energy_.size()); }
  void add_stiffness(const Vec3<Real>* position, const Vec3<Real>* before, BlockRowsView<Real> matrix,
                     Real sliding_fraction);

  // Free vertices, and triangles of free vertices beside sharp obstacles, do not pass through a solid that
  // has another side, nor it through them (sweep.h). clip_to_obstacles() ends each path of a step from
  // `start` to `end` where it meets an obstacle that blocks it, path_is_clear() returns whether none is
  // blocked, and feasible_step() how long a step along `direction` from x may be, up to `max_step`.  All
  // arrays have n vertices [m]; held has n flags.
  void clip_to_obstacles(const Vec3<Real>* start, Vec3<Real>* end, const char* held);
  bool path_is_clear(const Vec3<Real>* start, const Vec3<Real>* end, const char* held);
  double feasible_step(const Vec3<Real>* x, const Vec3<Real>* direction, const char* held, double max_step);

  // Accepts the positions (n vertices [m]; held: n flags): slips, losses and the obstacles' work, for
  // quasi-static scenes that of the mean of the forces before and after.  Returns how many vertices and
  // triangles are in a solid.
  int commit(const Vec3<Real>* position, const Vec3<Real>* before, const char* held);
  // Sets the vertices that may be in obstacles while they are held, since they were when they or the obstacle
  // came.
  void exempt(const std::vector<char>& vertices) { exempt_.upload(vertices); }
  std::vector<char> exempted() const { return exempt_.download(); }

  // Saves or loads the state that outlives a step: the stops, the obstacles they touch, losses, and where the
  // obstacles were placed.
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
  double moved_from_ = 0, moved_to_ = 0;  // the step for which set_ is placed [s]
  Buffer<Real, Device> area_;
  Buffer<char, Device> exempt_;
  Buffer<double, Device> energy_;
  PointContact<Real, Device, VertexPoints<Real>> vertices_;
  std::optional<FaceContact<Real, Device>> faces_;  // present if an obstacle is sharper than the mesh
};

}  // namespace hysteron
