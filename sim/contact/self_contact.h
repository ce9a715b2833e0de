// Handles cloth against itself and against bodies of triangles, in implicit steps: a barrier keeps layers
// apart, collision detection bounds each correction so that none passes the barrier, and there is Coulomb
// friction.
//
// A start without intersections stays so: every path that Newton's method takes is checked (additive_ccd.h)
// against all pairs that it could bring together (near_pairs.h).  This file is the response of these pairs.
//
// The barrier acts between layers from a distance of the thickness on and keeps them from coming nearer than
// half of it; its stiffness is that of compression.h.  Friction is a Prandtl stop per pair as against
// obstacles (contact.h), which slides after an elastic slip of 1 % of the thickness; its force limit is fixed
// at the iterate of the last update_lagged_friction().  A pair that becomes active takes the stretch of its
// neighbours' stops. The stiffness is Gauss-Newton's: positive semidefinite, without the second derivatives
// of distances.  It also leaves out the resistance of the fade of parallel edges (barrier.h) to their
// turning, unless stiffen_parallel_edges() asks for it: where pressure holds such edges, full steps then turn
// them several times too far.
#pragma once

#include <optional>

#include "sim/contact/body_vertices.h"
#include "sim/contact/near_pairs.h"
#include "sim/device/stage_clock.h"
#include "sim/linear/gathered_forces.h"
#include "sim/linear/pair_product.h"
#include "sim/scene/scene.h"

namespace hysteron {

template <class Real, class Device>
class SelfContact {
 public:
  SelfContact(Device& device, const ClothMesh& mesh, const Scene& scene);

  // Returns the largest step length along `direction` from x, up to `max_step`, that keeps layers apart by
  // more than `kept_share` of their activation distances or most of their distance, and no vertex farther
  // than some edges from the mean displacement (arrays of n vertices [m], n flags).  Then evaluate() and the
  // like may be called on the path up to there; accept_iterate() tells which of its points was taken.
  double prepare(const Vec3<Real>* x, const Vec3<Real>* direction, const char* held, double max_step = 1,
                 double kept_share = 0);
  // Moves bodies of triangles along with the step: try_step() precedes evaluate(), accept_iterate() follows
  // it.
  void try_step(double step_length) { bodies_.try_step(step_length); }
  void accept_iterate(const Vec3<Real>* x);
  void move_bodies(double start, double end) { bodies_.move(start, end); }  // the stage begins and ends [s]
  void begin_guess() { bodies_.begin_guess(); }
  void aim_bodies(double fraction) { bodies_.aim(fraction); }
  bool bodies_have_arrived() const { return bodies_.have_arrived(); }
  // Tells that held vertices have become free: the next prepare() finds their pairs, too.
  void invalidate_pairs() { near_.invalidate(); }

  // These work as in Contact: x, before and gradient have n vertices, those of the cloth.
  void update_lagged_friction(const Vec3<Real>* x);
  void evaluate(const Vec3<Real>* x, const Vec3<Real>* before, Vec3<Real>* gradient);
  const double* energies() const { return energy_.data(); }  // one per pair [J]
  int pairs() const { return near_.count(); }
  // Makes the next linearise() include the stiffness against the turning of nearly parallel edges.
  void stiffen_parallel_edges(bool on) { stiffens_parallel_ = on; }
  bool stiffens_parallel_edges() const { return stiffens_parallel_; }
  // Finds the stiffnesses (sliding_fraction: sliding_stop.h); add_stiffness_diagonal() adds their n diagonal
  // blocks [N/m].
  void linearise(const Vec3<Real>* x, const Vec3<Real>* before, Real sliding_fraction);
  void add_stiffness_diagonal(Mat3<Real>* diagonal);
  // Adds the push of the rest of the bodies' way on the cloth, n vertices [N].
  void add_push(Vec3<Real>* force);
  // Returns the stiffnesses of linearise(), on the device.
  PairProduct<Real> product() const {
    return {stiffness_rows_.start.data(), stiffness_rows_.item.data(), stiffness_.data(), stiffnesses_};
  }
  // Accepts x, where evaluate() was called last.
  void commit(const Vec3<Real>* x, const Vec3<Real>* before);

  // Saves or loads the state that outlives a step: the list of pairs, which decides the order of sums and
  // when the next one is made, and their stops.
  void serialise(Archive& archive);

  // These serve messages: the forces on vertices where evaluate() was called last [N], and the pair that
  // limited the step of the last prepare().
  std::vector<Vec3<Real>> forces() const;
  SelfPair<Real> blocking_pair() const { return near_.blocking_pair(); }

  double stored_energy(const Vec3<Real>* x);                      // [J]
  double friction_loss() const { return loss_; }                  // since the start [J]
  double deepest_dent() const { return bodies_.deepest_dent(); }  // of the bodies, in the last stage [m]
  double body_work() const { return body_work_; }  // done by moving bodies on the cloth, since the start [J]
  double seconds() { return clock_.seconds()[static_cast<int>(Stage::contact)]; }
  std::size_t bytes() const;

  // These are parts of the above; public because nvcc allows no device lambda in a private member function.
  void carry_friction_over(bool had_list);
  void pass_friction_on();
  void take_bodies_out();
  void add_body_work();

 private:
  // `all` is the mesh with the bodies; empty without bodies.
  SelfContact(Device& device, const ClothMesh& mesh, const std::optional<ClothMesh>& all, const Scene& scene);
  bool rubs() const { return model_.friction > 0 || bodies_.rubs(); }
  void yield_bodies(const Vec3<Real>* x, const Vec3<Real>* direction, const char* held);
  void renew_list(const StepPath<Real>& path, const char* held);
  void reserve_results();
  // Returns the gradient of each vertex, the cloth's and the bodies', where evaluate() was called last.
  GatheredForces<Real> gradients() const {
    return {near_.corners().start.data(), near_.corners().item.data(), slot_.data()};
  }

  Device& device_;
  int vertices_;  // of the cloth
  BodyVertices<Real, Device> bodies_;
  SelfContactModel<Real> model_;
  NearPairs<Real, Device> near_;
  bool stiffens_parallel_ = false;
  double stored_ = 0, loss_ = 0;  // energies of friction [J]
  double body_work_ = 0;          // [J]
  GrowingBuffer<PairFriction<Real>, Device> friction_, old_friction_;
  // The stiffnesses of the pairs that were active at the last linearise(), one or two for each
  // (NearPairs::number_active).
  int stiffnesses_ = 0;
  GrowingBuffer<PairStiffness<Real>, Device> stiffness_;
  PairRows<Device> stiffness_rows_;
  GrowingBuffer<Vec3<Real>, Device> push_;  // add_push() of each of them; with bodies alone
  Buffer<Vec3<Real>, Device> body_force_;   // at the last commit() of quasi-static scenes with bodies [N]
  GrowingBuffer<Vec3<Real>, Device> slot_;  // the gradient at each corner of a pair, four per pair [N]
  GrowingBuffer<double, Device> energy_;    // of each pair [J]
  Buffer<double, Device> sum_;              // two numbers
  StageClock<Device> clock_;
};

}  // namespace hysteron
