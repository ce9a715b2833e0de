// Triangles of the cloth against obstacles that are sharper than the mesh: edges, corners, rods.
//
// Vertices alone do not feel what stands between them.  Each triangle therefore also bears at its point
// nearest to such an obstacle (face_touch.h), with the shell and the friction of vertices (contact.h); the
// force is spread over its corners by barycentric coordinates and gathered in a fixed order.
//
// An obstacle is sharper than the mesh if a triangle that lies on its vertices could reach its surface: on a
// sphere of radius R the middle of an equilateral triangle with edges h lies h^2/(6 R) lower.
#pragma once

#include "sim/contact/face_touch.h"
#include "sim/contact/touch.h"
#include "sim/device/algorithms.h"
#include "sim/linear/block_rows.h"
#include "sim/linear/gathered_forces.h"
#include "sim/mesh/cloth_mesh.h"

namespace hysteron {

// Friction at a triangle's nearest point.
template <class Real>
struct FaceFriction : LaggedFriction<Real> {
  Vec3<Real> weight;
  int index;    // of the obstacle in the scene; -1: none
  bool inside;  // the point is in a solid
};

template <class Real>
struct FaceStiffness {
  Mat3<Real> block;  // at the point [N/m]
  Vec3<Real> weight;
  bool acts;
};

// Triangles against all obstacles that are sharper than the mesh; travels with a kernel launch by value.
template <class Real>
struct FaceView {
  ContactModel<Real> model;
  ObstacleSet<Real> set;
  Real sharp;  // below this radius of curvature an obstacle is [m]
  const Eigen::Vector3i* corner;
  const Real* area;

  HYST_HD bool feels(int obstacle) const { return set.item[obstacle].sharpest < sharp; }
  HYST_HD void place(int f, const Vec3<Real>* x, Vec3<Real> (&at)[3]) const {
    for (int k = 0; k < 3; ++k) at[k] = x[corner[f][k]];
  }
  HYST_HD Real stop_stiffness(int f, Real limit) const { return model.stop_stiffness(limit, area[f]); }

  // Forces of the shells on the corners [N]; returns their energy, added to `energy` [J].
  HYST_HD double press(int f, const Vec3<Real> (&at)[3], double energy, Vec3<Real>* force) const {
    for (int k = 0; k < 3; ++k) force[k].setZero();
    for (int o = 0; o < set.count; ++o) {
      if (!feels(o)) continue;
      const FaceTouch<Real> t = face_touch(set.item[o], model, at, area[f]);
      if (!t.bears()) continue;
      energy += t.energy;
      for (int k = 0; k < 3; ++k) force[k] += t.on_corner(k);
    }
    return energy;
  }
  // Against the obstacle that presses most.
  HYST_HD FaceFriction<Real> friction(int f, const Vec3<Real> (&at)[3], const StopView<Real>& stops) const {
    FaceFriction<Real> friction{{Vec3<Real>::Zero(), Vec3<Real>::Zero(), 0}, Vec3<Real>::Zero(), -1, false};
    Real strongest = 0;
    for (int o = 0; o < set.count; ++o) {
      if (!feels(o)) continue;
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
    if (friction.index >= 0 && stops.touching[f] == friction.index + 1) friction.start += stops.slip[f];
    return friction;
  }
  // Stretch of a triangle's stop.
  HYST_HD Vec3<Real> slip(int f, const FaceFriction<Real>& friction, const Vec3<Real>* x,
                          const Vec3<Real>* before) const {
    Vec3<Real> e = friction.start;
    for (int k = 0; k < 3; ++k) e += friction.weight[k] * (x[corner[f][k]] - before[corner[f][k]]);
    return e - friction.normal * friction.normal.dot(e);
  }
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
                     BlockRowsView<Real> matrix, Real sliding_fraction);
  int commit(const ObstacleSet<Real>& set, const Vec3<Real>* x, const Vec3<Real>* before, const char* held);
  void store_energies(const ObstacleSet<Real>& set, const Vec3<Real>* x, double* energy);

  // Paths of triangles (face_sweep.cpp); those with a held corner go where that leads them.
  void clip_to_obstacles(const ObstacleSet<Real>& set, const Vec3<Real>* start, Vec3<Real>* end,
                         const char* held, Real rest_distance);
  bool path_is_clear(const ObstacleSet<Real>& set, const Vec3<Real>* start, const Vec3<Real>* end,
                     const char* held);
  double feasible_step(const ObstacleSet<Real>& set, const Vec3<Real>* x, const Vec3<Real>* direction,
                       const char* held, double max_step);

  void serialise(Archive& archive) { stops_.serialise(archive, device_); }
  ContactLoss losses() const { return stops_.losses(); }
  int faces() const { return faces_; }
  std::size_t bytes() const;

  // Parts; public because nvcc allows no device lambda in a private member function.
  void gather_stiffness(Real factor, BlockRowsView<Real> matrix);
  Real end_before(const Obstacle3<Real>& obstacle, const Vec3<Real>* start, Vec3<Real>* end, const char* held,
                  Real rest_distance, bool stay);

 private:
  bool is_sharp(const Obstacle3<Real>& obstacle) const { return obstacle.sharpest < sharp_; }
  FaceView<Real> view(const ObstacleSet<Real>& set) const {
    return {model_, set, sharp_, corner_.data(), area_.data()};
  }

  Device& device_;
  ContactModel<Real> model_;
  int vertices_, faces_;
  Real sharp_;  // radius [m]
  Buffer<Eigen::Vector3i, Device> corner_;
  Buffer<int, Device> vertex_start_, vertex_item_;  // 3*face + corner
  Buffer<Real, Device> area_;
  FrictionStops<Real, Device> stops_;  // a force for each corner
  Buffer<double, Device> inside_;
  Buffer<FaceFriction<Real>, Device> lagged_;
  Buffer<FaceStiffness<Real>, Device> stiffness_;
  Buffer<Vec3<Real>, Device> force_;  // three for each face
  GrowingBuffer<Real, Device> fraction_;
  Scratch<Device> scratch_;
};

}  // namespace hysteron
