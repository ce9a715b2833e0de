// Moves bodies of triangles in contact: their vertices follow the cloth's in arrays of all vertices, and go a
// prescribed way over each stage of a step.
//
// Newton's method takes them along: it begins a stage where the guess has brought them, and each of its steps
// takes them the same fraction of what is left of their way, so that one bound on its length (additive_ccd.h)
// holds for cloth and bodies alike.  Bodies are no unknowns: the stiffness of a pair has the vertices of the
// cloth alone, and the push of the rest of a body's way is on the right-hand side.
//
// Bodies yield where they press cloth harder than kYieldPressure (compression.h) and cannot arrive, as where
// two of them, or two parts of one, close on it: their vertices stay back along the pair's normal, cloth
// takes its place between, and this dent recovers over kRecovery as it finds room.
#pragma once

#include "sim/base/archive.h"
#include "sim/contact/self_pairs.h"
#include "sim/device/buffer.h"
#include "sim/device/device.h"
#include "sim/mesh/cloth_mesh.h"
#include "sim/scene/scene.h"

namespace hysteron {

inline constexpr double kRecovery = 0.05;  // time in which a dent falls to 1/e, an assumed softness [s]

bool has_mesh_bodies(const Scene& scene);

// Joins the cloth and the scene's bodies, as they are at the start, into one mesh: vertices, triangles and
// areas of the cloth, then those of each body.
ClothMesh mesh_with_bodies(const ClothMesh& cloth, const Scene& scene);

// The pairs, their corners by vertex (PairRows), and the gradient at each corner [N].
template <class Real>
struct PressedPairs {
  const SelfPair<Real>* pair;
  int count;
  const int *start, *item;
  const Vec3<Real>* gradient;

  // Are the forces that press this vertex from different sides in balance, or nearly?
  HYST_HD bool squeeze(int vertex) const {
    constexpr Real kBalanced = Real(0.5);  // share of the forces' sizes that is left of their sum
    Vec3<Real> sum = Vec3<Real>::Zero();
    Real sizes = 0;
    for (int j = start[vertex]; j < start[vertex + 1]; ++j) {
      sum += gradient[item[j]];
      sizes += gradient[item[j]].norm();
    }
    return sum.norm() < kBalanced * sizes;
  }
};

template <class Real, class Device>
class BodyVertices {
 public:
  // `cloth` is its number of vertices.
  BodyVertices(Device& device, const Scene& scene, int cloth);

  bool any() const { return count_ > 0; }
  int count() const { return count_; }
  int all() const { return cloth_ + count_; }  // number of vertices of cloth and bodies

  // Begins a stage from `start` to `end` [s].
  void move(double start, double end);
  // begin_guess() begins the stage's guess at the start of the bodies' way; aim() lets it go `fraction` of
  // it.
  void begin_guess();
  void aim(double fraction) { aim_ = fraction; }
  // Tries to move this fraction of the step from the present positions towards the aim; accept() stays there.
  void try_step(double step_length) { at_ = step_length == 1 ? aim_ : gone_ + step_length * (aim_ - gone_); }
  void accept() {
    gone_ = at_;
    aim_ = 1;
    ++steps_;
  }
  double left() const { return aim_ - gone_; }  // of the way, for the next step
  bool have_arrived() const { return count_ == 0 || gone_ == 1; }

  // Return arrays of all vertices, the cloth's and the bodies': the bodies' present positions, those at the
  // start of the stage [m], and the displacement of a whole step [m].  Without bodies these are the cloth's
  // own arrays.
  const Vec3<Real>* positions(const Vec3<Real>* cloth) {
    return joined(cloth, position_, start_.data(), at_);
  }
  const Vec3<Real>* positions_before(const Vec3<Real>* cloth) {
    return joined(cloth, before_, from_.data(), 0);
  }
  const Vec3<Real>* directions(const Vec3<Real>* cloth) {
    return joined(cloth, direction_, nullptr, aim_ - gone_);
  }
  const char* held(const char* cloth);                       // n flags; bodies are held
  const Vec3<Real>* way() const { return way_.data(); }      // of bodies alone, for a step of length 1 [m]
  const Vec3<Real>* from() const { return from_.data(); }    // bodies where the stage began [m]
  const Vec3<Real>* start() const { return start_.data(); }  // equals from() if none has yielded
  // The Coulomb coefficients of the bodies' vertices.
  const Real* friction() const { return friction_.data(); }
  bool rubs() const { return rubs_; }

  // Is the way of bodies that have not arrived barred? Their first steps find out, unless they were pressed
  // in before.
  bool are_barred() const { return !have_arrived() && steps_ >= (deepest_ > 0 ? 1 : kPatience); }
  // Shortens the bodies' way where it would press cloth beyond the yield, for all() vertices at x [m] that go
  // along `direction` [m], if the cloth is held or pressed from its other side; other cloth gets out of their
  // way.
  void yield(const PressedPairs<Real>& pairs, const Vec3<Real>* x, const Vec3<Real>* direction,
             const char* held);
  // Ends the stage: what bodies stayed back by becomes their dents.
  void keep_dents();
  double deepest_dent() const { return deepest_; }  // in the last stage; 0: none [m]

  void serialise(Archive& archive);
  std::size_t bytes() const {
    return total_bytes(from_, start_, way_, dent_, behind_, friction_, position_, before_, direction_,
                       held_) +
           recede_.bytes();
  }

  // Public because nvcc allows no device lambda in a private member function.
  const Vec3<Real>* joined(const Vec3<Real>* cloth, Buffer<Vec3<Real>, Device>& into, const Vec3<Real>* start,
                           double of_way);
  void find_recession(const PressedPairs<Real>& pairs, const Vec3<Real>* x, const Vec3<Real>* direction,
                      const char* held);
  void begin_way(double kept_dent);
  void restart_way();
  double measure_dents();

 private:
  static constexpr int kPatience = 3;  // in steps, the guess included

  Device& device_;
  std::vector<Obstacle> body_;
  int cloth_, count_;
  double gone_ = 1, at_ = 1, aim_ = 1;       // fractions of the way: accepted, of the last trial, aimed at
  bool rubs_ = false, has_yielded_ = false;  // has_yielded_: in this stage
  int steps_ = 0;                            // in the stage so far
  Real yield_share_;                // share of the activation distance with the pressure kYieldPressure
  double thickness_, deepest_ = 0;  // [m]
  std::vector<Vec3<Real>> end_;     // the scene's positions at end_time_ [m]
  double end_time_ = 0;             // of the last stage [s]
  // These are of bodies alone [m]: they go start + fraction way, and began the stage at `from`; `dent` is how
  // far they are from the scene's positions, `behind` how far they will be at the end of the stage.
  Buffer<Vec3<Real>, Device> from_, start_, way_, dent_, behind_;
  GrowingBuffer<Vec3<Real>, Device> recede_;  // four per pair
  GrowingBuffer<Real, Device> length_;
  Scratch<Device> scratch_;
  Buffer<Real, Device> friction_;
  Buffer<Vec3<Real>, Device> position_, before_, direction_;  // of all vertices; empty without bodies
  Buffer<char, Device> held_;
};

}  // namespace hysteron
