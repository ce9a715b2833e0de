// Pins: the held vertices and their motion.
//
// A rigid pin brings its vertices exactly to their positions on it.  Where cloth bars its way, it gives way
// for the stage: its vertices are free, and it pulls as a pin of limited strength does (compliant_pins.h),
// with ten times the pressure of the compression test (compression.h) on the area of each.  Once all these
// vertices are within the give of that pull again, pins are rigid again.
#pragma once

#include <memory>
#include <vector>

#include "sim/contact/self_pairs.h"
#include "sim/device/algorithms.h"
#include "sim/device/archive_buffer.h"
#include "sim/scene/cloth.h"
#include "sim/time/back_end.h"
#include "sim/time/compliant_pins.h"

namespace hysteron {

template <class Real, class Device>
struct Body;

// The placements of moving pins travel with a kernel launch by value.
template <class Real>
struct PinPlacements {
  Mat3<Real> rotation[kMaxMovingPins];
  Vec3<Real> translation[kMaxMovingPins];
  // The share of the way home that is done at the end of the step, and in it.
  Real home[kMaxMovingPins], homewards[kMaxMovingPins];
  // The way of a step as one screw: the pin turns by `turn` [rad] about a pivot, at its end [m], that moves
  // by `shift` [m].
  Vec3<Real> turn[kMaxMovingPins], pivot[kMaxMovingPins], shift[kMaxMovingPins];
};

template <class Real, class Device>
class Pins {
 public:
  // with_arcs: the integrator asks for the way along the pins' arcs.
  Pins(Device& device, const Scene& scene, const Cloth& cloth, bool with_arcs);

  // Lets pins take hold and let go that are due at `start` [s], and returns whether any did; vertices that
  // gave way are held again.  Throws Error::simulation where cloth is let go in an obstacle.
  bool attach_and_release(Body<Real, Device>& body, double start);
  // Makes the pin go on from where it is with this velocity [m/s] and spin about its axis [degree/s],
  // whatever its motion was.
  void drive(Body<Real, Device>& body, int pin, double now, const Eigen::Vector3d& velocity, double spin);
  // Gives held vertices the constant velocity that brings them to their positions on the pins at the end of
  // the stage.
  void move(Body<Real, Device>& body, double start, Real h);

  bool any_moves() const { return kind_ != Kind::still; }
  // Returns the way of a stage along the arcs, as its end sees them: duration times velocity, n vertices [m];
  // null if no pin moves.
  const Vec3<Real>* arcs() const { return arc_.data(); }
  // Returns the pins of limited strength, and those that give way in this stage.
  CompliantPins<Real> compliant_pins() const { return {target_.data(), strength_.data(), yield_distance_}; }
  // Are rigid pins barred from the way of a stage that move() has begun? They are if they are behind already,
  // or would lead their vertices through each other.  Where free cloth bars the way, the step finds out.
  bool are_blocked(Body<Real, Device>& body, Real h);
  // Makes moving rigid pins give way for this stage; false where none moves.
  bool yield_to_cloth(Body<Real, Device>& body, Real h);
  // Accepts the stage: vertices that gave way are held again.  Notes how far vertices lag behind, and counts
  // stages in which a pin pulls with its whole strength.
  void end_stage(Body<Real, Device>& body);
  // Saves or loads the state that outlives a step; positions at t = 0 do not change.
  void serialise(Archive& archive, Body<Real, Device>& body);
  double work() const { return work_; }  // done on the cloth by taking hold and letting go [J]
  std::size_t bytes() const {
    return total_bytes(start_, home_, pin_, arc_, target_, strength_, lag_, displacement_) +
           (sweep_ ? sweep_->bytes() : 0) + (scratch_ ? scratch_->bytes() : 0);
  }

 private:
  // Allocates the arrays that moving pins need, where they are missing; vertices held at `time` [s] start
  // where they were at t = 0.
  void allocate(Device& device, const Scene& scene, const Cloth& cloth, double time);
  bool has_limited() const { return kind_ == Kind::limited; }
  // Returns whether `held` differs from the present flags.
  bool update_ledger(Body<Real, Device>& body, const std::vector<char>& held);
  void take(Body<Real, Device>& body, const std::vector<int>& pins, double time);
  void share_strength(const Scene& scene, const std::vector<int>& pins);
  void restore_rigid(Body<Real, Device>& body);
  void hold_again(Body<Real, Device>& body);
  Real farthest_behind(Body<Real, Device>& body);
  PinPlacements<Real> placements(const Scene& scene, double start, double h) const;

  // The most that any of the scene's pins does.
  enum class Kind : char {
    still,
    moving,
    limited,  // has limited strength, in motion or not
  };
  // The state of the rigid pins, from stage to stage.
  enum class Rigidity : char {
    rigid,
    compliant,  // they give way in this stage: their vertices are free
    restored,   // they gave way in the stage accepted last, whose pull is still known, and hold again
  };

  static Kind kind_of(const Pin& pin) {
    if (pin.strength > 0) return Kind::limited;
    return !pin.motion.keys.empty() || pin.from > 0 ? Kind::moving : Kind::still;
  }

  const bool with_arcs_;
  Kind kind_ = Kind::still;
  Rigidity rigidity_ = Rigidity::rigid;
  bool moving_now_ = false;  // a rigid pin moves in this stage
  double next_ = 0;          // when pins take hold or let go next [s]
  double work_ = 0;
  Real yield_distance_;
  Real behind_ = 0;                   // how far pins that gave way lagged in the stage accepted last [m]
  std::vector<char> rigid_;           // the flags of held vertices if no pin gave way
  std::vector<double> times_;         // times of all takes and releases [s]
  Buffer<Vec3<Real>, Device> start_;  // each pin's vertices before it moves [m]
  Buffer<Vec3<Real>, Device> home_;   // vertices at t = 0, if a pin brings them back there [m]
  Buffer<Vec3<Real>, Device> arc_;
  Buffer<int, Device> pin_;
  Buffer<Vec3<Real>, Device> target_;  // where compliant pins pull their vertices [m]
  Buffer<Real, Device> strength_, lag_;
  Buffer<Vec3<Real>, Device> displacement_;  // of held vertices in a stage [m], where pins might meet
  std::unique_ptr<PinSweep<Real, Device>> sweep_;
  std::unique_ptr<Scratch<Device>> scratch_;
};

}  // namespace hysteron
