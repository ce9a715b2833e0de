// Computes triangles of the cloth against obstacles that are sharper than the mesh: edges, corners, rods.
//
// Vertices alone do not feel an obstacle between them.  Each triangle therefore also has a contact at its
// point nearest to such an obstacle (face_touch.h), with the barrier and the friction of vertices
// (contact.h); the force is spread over its corners by barycentric coordinates and gathered in a fixed order.
//
// An obstacle is sharper than the mesh if a triangle that lies on its vertices could reach its surface: on a
// sphere of radius R the middle of an equilateral triangle with edges h lies h^2/(6 R) lower.
#pragma once

#include "sim/contact/point_contact.h"
#include "sim/linear/block_rows.h"
#include "sim/linear/gathered_forces.h"
#include "sim/mesh/cloth_mesh.h"

namespace hysteron {

template <class Real>
struct FaceStiffness {
  Mat3<Real> block;  // at the point [N/m]
  Vec3<Real> weight;
  bool acts;
};

template <class Real, class Device>
class FaceContact : public PointContact<Real, Device, FacePoints<Real>> {
 public:
  FaceContact(Device& device, const ClothMesh& mesh, const Scene& scene, const ContactModel<Real>& model);

  FacePoints<Real> points(const ObstacleSet<Real>& set) const {
    return {model_, set, area_.data(), sharp_, corner_.data()};
  }
  // These work as in Contact.  `factor` multiplies forces, or stiffness; energy has one number per face [J]
  // or is null.
  void add_forces(const FacePoints<Real>& faces, const Vec3<Real>* x, const Vec3<Real>* before, Real factor,
                  Vec3<Real>* target, double* energy);
  void add_stiffness(const FacePoints<Real>& faces, const Vec3<Real>* x, const Vec3<Real>* before,
                     Real factor, BlockRowsView<Real> matrix, Real sliding_fraction);
  void clip_to_obstacles(const FacePoints<Real>& faces, const Vec3<Real>* start, Vec3<Real>* end,
                         const char* held, Real rest_distance);

  std::size_t bytes() const;

  // These are parts of the above; public because nvcc allows no device lambda in a private member function.
  void gather_stiffness(Real factor, BlockRowsView<Real> matrix);
  Real end_before(const FacePoints<Real>& faces, int obstacle, const Vec3<Real>* start, Vec3<Real>* end,
                  const char* held, Real rest_distance, bool stay);

 private:
  Device& device_;
  ContactModel<Real> model_;
  int vertices_;
  Real sharp_;  // radius [m]
  Buffer<Eigen::Vector3i, Device> corner_;
  Buffer<int, Device> vertex_start_, vertex_item_;  // vertex_item_: 3*face + corner
  Buffer<Real, Device> area_;
  Buffer<FaceStiffness<Real>, Device> stiffness_;
  Buffer<Vec3<Real>, Device> force_;  // three per face
};

}  // namespace hysteron
