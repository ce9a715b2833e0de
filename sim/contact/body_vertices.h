// Bodies of triangles in contact: their vertices stand behind the cloth's in arrays of all vertices, and go a
// prescribed way over each stage of a step.
//
// Newton's method takes them along: it begins a stage where the guess has brought them, and each of its steps
// takes them the same fraction of what is left of their way, so that one bound on its length (additive_ccd.h)
// holds for cloth and bodies alike.  Bodies are no unknowns: the stiffness of a pair has the vertices of the
// cloth alone, and what the rest of a body's way pushes stands on the right-hand side.
#pragma once

#include "sim/base/archive.h"
#include "sim/device/buffer.h"
#include "sim/device/device.h"
#include "sim/mesh/cloth_mesh.h"
#include "sim/scene/scene.h"

namespace hysteron {

bool has_mesh_bodies(const Scene& scene);

// The cloth and the bodies of the scene as they are at the start, as one mesh: vertices, triangles and areas
// of the cloth, then those of each body.
ClothMesh mesh_with_bodies(const ClothMesh& cloth, const Scene& scene);

template <class Real, class Device>
class BodyVertices {
 public:
  // `cloth`: its number of vertices.
  BodyVertices(Device& device, const Scene& scene, int cloth);

  bool any() const { return count_ > 0; }
  int count() const { return count_; }
  int all() const { return cloth_ + count_; }  // vertices, of the cloth and of bodies

  // A stage from `start` to `end` [s] begins.
  void move(double start, double end);
  // The stage's guess begins at the start of their way, and goes `fraction` of it with all that is free.
  void begin_guess() { gone_ = at_ = 0; }
  void aim(double fraction) { aim_ = fraction; }
  // A trial that takes this fraction of the step from where they are towards their aim; accept() stays there.
  void try_step(double step_length) { at_ = step_length == 1 ? aim_ : gone_ + step_length * (aim_ - gone_); }
  void accept() {
    gone_ = at_;
    aim_ = 1;
  }
  double left() const { return aim_ - gone_; }  // of the way, for the next step
  bool have_arrived() const { return count_ == 0 || gone_ == 1; }

  // Arrays of all vertices, of those of the cloth and: bodies where they are now, where they were at the
  // start of the stage, and how far a whole step takes them.  Without bodies the cloth's own.
  const Vec3<Real>* positions(const Vec3<Real>* cloth) { return joined(cloth, position_, 1, at_); }
  const Vec3<Real>* positions_before(const Vec3<Real>* cloth) { return joined(cloth, before_, 1, 0); }
  const Vec3<Real>* directions(const Vec3<Real>* cloth) { return joined(cloth, direction_, 0, aim_ - gone_); }
  const char* held(const char* cloth);                   // bodies are
  const Vec3<Real>* way() const { return way_.data(); }  // of the stage, of bodies alone [m]
  // Coulomb coefficients, of bodies alone.
  const Real* friction() const { return friction_.data(); }
  bool rubs() const { return rubs_; }

  void serialise(Archive& archive);
  std::size_t bytes() const {
    return total_bytes(start_, way_, friction_, position_, before_, direction_, held_);
  }

  // Public because nvcc allows no device lambda in a private member function.
  const Vec3<Real>* joined(const Vec3<Real>* cloth, Buffer<Vec3<Real>, Device>& into, double of_start,
                           double of_way);

 private:
  Device& device_;
  std::vector<Obstacle> body_;
  int cloth_, count_;
  double moved_from_ = 0, moved_to_ = 0;  // [s]
  double gone_ = 1, at_ = 1, aim_ = 1;    // fractions of the way: accepted, of the last trial, of a step
  bool rubs_ = false;
  Buffer<Vec3<Real>, Device> start_, way_;  // of bodies alone [m]
  Buffer<Real, Device> friction_;
  Buffer<Vec3<Real>, Device> position_, before_, direction_;  // of all; empty without bodies
  Buffer<char, Device> held_;
};

}  // namespace hysteron
