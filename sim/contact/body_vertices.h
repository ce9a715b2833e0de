// Bodies of triangles in contact: their vertices stand behind the cloth's in arrays of all vertices, and go a
// prescribed way over each stage of a step.
//
// Newton's method takes them along: it begins a stage where the guess has brought them, and each of its steps
// takes them the same fraction of what is left of their way, so that one bound on its length (additive_ccd.h)
// holds for cloth and bodies alike.  Bodies are no unknowns: the stiffness of a pair has the vertices of the
// cloth alone, and what the rest of a body's way pushes stands on the right-hand side.
//
// Bodies yield where they press cloth harder than kYieldPressure (compression.h) and cannot arrive, as where
// two of them, or two parts of one, close on it: their vertices stay back along the pair's normal, cloth
// takes its place between, and what they stayed back by goes back over kRecovery as it finds room.
#pragma once

#include "sim/base/archive.h"
#include "sim/contact/self_pairs.h"
#include "sim/device/buffer.h"
#include "sim/device/device.h"
#include "sim/mesh/cloth_mesh.h"
#include "sim/scene/scene.h"

namespace hysteron {

inline constexpr double kRecovery = 0.05;  // in which a dent falls to 1/e, an assumed softness [s]

bool has_mesh_bodies(const Scene& scene);

// The cloth and the bodies of the scene as they are at the start, as one mesh: vertices, triangles and areas
// of the cloth, then those of each body.
ClothMesh mesh_with_bodies(const ClothMesh& cloth, const Scene& scene);

// Pairs, their corners by vertex (PairRows), and the gradient at each corner where they are [N].
template <class Real>
struct PressedPairs {
  const SelfPair<Real>* pair;
  int count;
  const int *start, *item;
  const Vec3<Real>* gradient;

  // Whether what presses this vertex from different sides holds itself in balance, or nearly.
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
  // `cloth`: its number of vertices.
  BodyVertices(Device& device, const Scene& scene, int cloth);

  bool any() const { return count_ > 0; }
  int count() const { return count_; }
  int all() const { return cloth_ + count_; }  // vertices, of the cloth and of bodies

  // A stage from `start` to `end` [s] begins.
  void move(double start, double end);
  // The stage's guess begins at the start of their way, and goes `fraction` of it with all that is free.
  void begin_guess();
  void aim(double fraction) { aim_ = fraction; }
  // A trial that takes this fraction of the step from where they are towards their aim; accept() stays there.
  void try_step(double step_length) { at_ = step_length == 1 ? aim_ : gone_ + step_length * (aim_ - gone_); }
  void accept() {
    gone_ = at_;
    aim_ = 1;
    ++steps_;
  }
  double left() const { return aim_ - gone_; }  // of the way, for the next step
  bool have_arrived() const { return count_ == 0 || gone_ == 1; }

  // Arrays of all vertices, of those of the cloth and: bodies where they are now, where they were at the
  // start of the stage, and how far a whole step takes them.  Without bodies the cloth's own.
  const Vec3<Real>* positions(const Vec3<Real>* cloth) {
    return joined(cloth, position_, start_.data(), at_);
  }
  const Vec3<Real>* positions_before(const Vec3<Real>* cloth) {
    return joined(cloth, before_, from_.data(), 0);
  }
  const Vec3<Real>* directions(const Vec3<Real>* cloth) {
    return joined(cloth, direction_, nullptr, aim_ - gone_);
  }
  const char* held(const char* cloth);                       // bodies are
  const Vec3<Real>* way() const { return way_.data(); }      // of bodies alone, for a step of length 1 [m]
  const Vec3<Real>* from() const { return from_.data(); }    // where the stage began, of bodies alone [m]
  const Vec3<Real>* start() const { return start_.data(); }  // from() if none has yielded
  // Coulomb coefficients, of bodies alone.
  const Real* friction() const { return friction_.data(); }
  bool rubs() const { return rubs_; }

  // Whether bodies that have not arrived are barred their way: their first steps find out, unless they were
  // pressed in before.
  bool are_barred() const { return !have_arrived() && steps_ >= (deepest_ > 0 ? 1 : kPatience); }
  // Takes out of their way what would press cloth beyond the yield, of all vertices at x that go along
  // `direction`: cloth that is held, or pressed from its other side, too; any other gets out of their way.
  void yield(const PressedPairs<Real>& pairs, const Vec3<Real>* x, const Vec3<Real>* direction,
             const char* held);
  // The stage has ended: what bodies stayed back by are dents.
  void keep_dents();
  double deepest_dent() const { return deepest_; }  // of the last stage; 0: none [m]

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
  static constexpr int kPatience = 3;  // steps, the guess among them

  Device& device_;
  std::vector<Obstacle> body_;
  int cloth_, count_;
  double gone_ = 1, at_ = 1, aim_ = 1;       // fractions of the way: accepted, of the last trial, of a step
  bool rubs_ = false, has_yielded_ = false;  // the latter in this stage
  int steps_ = 0;                            // of the stage so far
  Real yield_share_;                         // of a shell, at which it bears kYieldPressure
  double thickness_, deepest_ = 0;           // [m]
  std::vector<Vec3<Real>> end_;              // where the scene has them at end_time_ [m]
  double end_time_ = 0;                      // of the last stage [s]
  // Of bodies alone [m].  They go start + fraction way, and began the stage at `from`; `dent` is how far they
  // are from where the scene has them, `behind` how far they will be at the end of the stage.
  Buffer<Vec3<Real>, Device> from_, start_, way_, dent_, behind_;
  GrowingBuffer<Vec3<Real>, Device> recede_;  // four for each pair
  GrowingBuffer<Real, Device> length_;
  Scratch<Device> scratch_;
  Buffer<Real, Device> friction_;
  Buffer<Vec3<Real>, Device> position_, before_, direction_;  // of all; empty without bodies
  Buffer<char, Device> held_;
};

}  // namespace hysteron
