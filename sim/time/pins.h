// Pins: which vertices are held, and how those move.
//
// A rigid hand brings its vertices exactly to their place.  Where cloth bars its way, it gives way for the
// stage: its vertices are free, and it pulls as a hand of limited strength does (compliant_pins.h), with ten
// times the pressure of the compression test (compression.h) on the area of each.  Once all that gave way are
// within the give of that pull again, hands are rigid again.
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

// Travels with a kernel launch by value.
template <class Real>
struct PinPlacements {
  Mat3<Real> rotation[kMaxMovingPins];
  Vec3<Real> translation[kMaxMovingPins];
  // Share of the way home that is done at the end of the step, and in it.
  Real home[kMaxMovingPins], homewards[kMaxMovingPins];
  // The way of a step as one screw: the hand turns by `turn` about a pivot that moves by `shift`.
  Vec3<Real> turn[kMaxMovingPins], pivot[kMaxMovingPins], shift[kMaxMovingPins];  // [rad], at the end [m]
};

template <class Real, class Device>
class Pins {
 public:
  // with_arcs: for integrators that ask for the way along the hands' arcs.
  Pins(Device& device, const Scene& scene, const Cloth& cloth, bool with_arcs);

  // Pins take hold and let go where that is due at `start`; Error::simulation where cloth is let go in an
  // obstacle. Says whether any did.  What gave way is held again.
  bool attach_and_release(Body<Real, Device>& body, double start);
  // From now on the hand of that pin goes on from where it is with this velocity [m/s] and spin about its
  // axis [degree/s], whatever its motion was.
  void drive(Body<Real, Device>& body, int pin, double now, const Eigen::Vector3d& velocity, double spin);
  // Gives held vertices the constant velocity that brings them to their place at the end of the stage.
  void move(Body<Real, Device>& body, double start, Real h);

  bool any_moves() const { return moving_; }
  // Of a stage: along the arcs as its end sees them, duration times velocity [m]; null if no hand moves.
  const Vec3<Real>* arcs() const { return arc_.data(); }
  // Those of limited strength, and those that give way in this stage.
  CompliantPins<Real> compliant_pins() const { return {place_.data(), strength_.data(), yield_distance_}; }
  // Whether rigid hands cannot go the way of a stage that move() has begun: they are behind already, or would
  // lead what they hold through each other.  Where the cloth itself bars it, the step finds out.
  bool are_blocked(Body<Real, Device>& body, Real h);
  // Rigid hands that move give way for this stage; false where none moves.
  bool yield_to_cloth(Body<Real, Device>& body, Real h);
  // Accepts the stage: what gave way is held again.  Notes how far vertices lag behind, and counts stages in
  // which a hand pulls with all its strength.
  void end_stage(Body<Real, Device>& body);
  // What outlives a step; where things were at t = 0 does not change.
  void serialise(Archive& archive, Body<Real, Device>& body);
  double work() const { return work_; }  // done on the cloth by taking hold and letting go [J]
  std::size_t bytes() const {
    return total_bytes(start_, home_, pin_, arc_, place_, strength_, lag_, displacement_) +
           (sweep_ ? sweep_->bytes() : 0) + (scratch_ ? scratch_->bytes() : 0);
  }

  // Parts; public because nvcc allows no device lambda in a private member function.
  Real farthest_behind(Body<Real, Device>& body);

 private:
  // What hands that move take, where it is not there yet; what is held at `time` starts where it was at t =
  // 0.
  void set_out(Device& device, const Scene& scene, const Cloth& cloth, double time);
  // Says whether `held` differs from what was.
  bool book(Body<Real, Device>& body, const std::vector<char>& held);
  void take(Body<Real, Device>& body, const std::vector<int>& pins, double time);
  void share_strength(const Scene& scene, const std::vector<int>& pins);
  void regain(Body<Real, Device>& body);
  void hold_again(Body<Real, Device>& body);
  PinPlacements<Real> placements(const Scene& scene, double start, double h) const;

  const bool with_arcs_;
  bool moving_ = false;                  // or of limited strength
  bool limited_ = false;                 // any is of limited strength
  bool goes_ = false;                    // a rigid one in the stage
  bool yields_ = false, pulls_ = false;  // rigid ones in this stage; in it or in the one accepted last
  double next_ = 0;                      // when hands take hold or let go next [s]
  double work_ = 0;
  Real yield_distance_;
  Real behind_ = 0;                   // how far what gave way lagged in the stage accepted last [m]
  std::vector<char> rigid_;           // what would be held if none gave way
  std::vector<double> times_;         // of all that
  Buffer<Vec3<Real>, Device> start_;  // where each hand has its vertices before it moves [m]
  Buffer<Vec3<Real>, Device> home_;   // where vertices were at t = 0, if a hand brings them back there
  Buffer<Vec3<Real>, Device> arc_;
  Buffer<int, Device> pin_;
  Buffer<Vec3<Real>, Device> place_;  // of Grips
  Buffer<Real, Device> strength_, lag_;
  Buffer<Vec3<Real>, Device> displacement_;  // of held vertices in a stage [m]; where hands might meet
  std::unique_ptr<PinSweep<Real, Device>> sweep_;
  std::unique_ptr<Scratch<Device>> scratch_;
};

}  // namespace hysteron
