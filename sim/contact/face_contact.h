// Triangles of the cloth against obstacles that are sharper than the mesh: edges, corners, rods.
//
// Vertices alone do not feel what stands between them.  Each triangle therefore also bears at its point
// nearest to such an obstacle (face_touch.h), with the shell and the friction of vertices (contact.h); the
// force is spread over its corners by barycentric coordinates and gathered in a fixed order.
//
// An obstacle is sharper than the mesh if a triangle that lies on its vertices could reach its surface: on a
// sphere of radius R the middle of an equilateral triangle with edges h lies h^2/(6 R) lower.
#pragma once

#include "sim/contact/compression.h"
#include "sim/contact/obstacle_set.h"
#include "sim/device/algorithms.h"
#include "sim/device/archive_buffer.h"
#include "sim/linear/block_rows.h"
#include "sim/linear/gathered_forces.h"
#include "sim/mesh/cloth_mesh.h"

namespace hysteron {

// Friction at a triangle's nearest point: what depends on the normal force, held fixed.
template <class Real>
struct FaceFriction {
  Vec3<Real> normal, weight;
  Vec3<Real> start;  // slip from before, less the obstacle's motion over the step [m]
  Real limit;        // mu f_n [N]
  int index;         // of the obstacle in the scene; -1: none
  bool inside;       // the point is in a solid
};

template <class Real>
struct FaceStiffness {
  Mat3<Real> block;  // at the point [N/m]
  Vec3<Real> weight;
  bool acts;
};

template <class Real, class Device>
class FaceContact {
 public:
  FaceContact(Device& device, const ClothMesh& mesh, const Scene& scene, const ContactModel<Real>& model);

  // As in Contact, of the obstacles in `set`.  `factor` multiplies forces, or stiffness; energy is per face.
  void add(const ObstacleSet<Real>& set, const Vec3<Real>* x, const Vec3<Real>* before, Real step,
           Vec3<Real>* rhs, const BlockRowsView<Real>* matrix);
  void lag(const ObstacleSet<Real>& set, const Vec3<Real>* x);
  void evaluate(const ObstacleSet<Real>& set, const Vec3<Real>* x, const Vec3<Real>* before, Real factor,
                Vec3<Real>* target, double* energy);
  void add_stiffness(const ObstacleSet<Real>& set, const Vec3<Real>* x, const Vec3<Real>* before, Real factor,
                     BlockRowsView<Real> matrix, Real sliding_share);
  int commit(const ObstacleSet<Real>& set, const Vec3<Real>* x, const Vec3<Real>* before, const char* held);
  void store_energies(const ObstacleSet<Real>& set, const Vec3<Real>* x, double* energy);

  // Paths of triangles (face_sweep.cpp); those with a held corner go where that leads them.
  void keep_out(const ObstacleSet<Real>& set, const Vec3<Real>* start, Vec3<Real>* end, const char* held,
                Real rest);
  bool reaches(const ObstacleSet<Real>& set, const Vec3<Real>* start, const Vec3<Real>* end,
               const char* held);
  double feasible_step(const ObstacleSet<Real>& set, const Vec3<Real>* x, const Vec3<Real>* direction,
                       const char* held, double max_step);

  void visit(Archive& archive);
  ContactLoss losses() const;
  int faces() const { return faces_; }
  std::size_t bytes() const;

  // Parts; public because nvcc allows no device lambda in a private member function.
  void gather_stiffness(Real factor, BlockRowsView<Real> matrix);
  Real end_before(const Obstacle3<Real>& obstacle, const Vec3<Real>* start, Vec3<Real>* end, const char* held,
                  Real rest, bool stay);

 private:
  bool is_sharp(const Obstacle3<Real>& obstacle) const { return obstacle.sharpest < sharp_; }

  Device& device_;
  ContactModel<Real> model_;
  int vertices_, faces_;
  Real sharp_;  // radius [m]
  Buffer<Eigen::Vector3i, Device> corner_;
  Buffer<int, Device> vertex_start_, vertex_item_;  // 3*face + corner
  Buffer<Real, Device> area_;
  Buffer<Vec3<Real>, Device> slip_;  // E [m]
  Buffer<int, Device> touching_;     // obstacle index + 1, 0 = free
  Buffer<double, Device> stored_, loss_, work_, inside_;
  Buffer<Vec3<Real>, Device> pressed_;  // on corners at the positions accepted last; of quasi-static scenes
  Buffer<FaceFriction<Real>, Device> lagged_;
  Buffer<FaceStiffness<Real>, Device> stiffness_;
  Buffer<Vec3<Real>, Device> force_;  // three for each face
  GrowingBuffer<Real, Device> share_;
  Scratch<Device> scratch_;
};

}  // namespace hysteron
