// A running simulation: one interface over both devices and both precisions.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "sim/device/device_counts.h"
#include "sim/device/gl_positions.h"
#include "sim/device/kernel_profile.h"
#include "sim/scene/cloth.h"
#include "sim/scene/scene.h"
#include "sim/time/ledger.h"
#include "sim/time/method_choice.h"

namespace hysteron {

// A part of a scene and what it costs; parts that the scene does not need have no bytes and say why.
struct ScenePart {
  std::string name;
  bool included = false;
  std::size_t bytes = 0;
  std::string kernels;  // names of its loops
  std::string reason;
};

struct StepLimits {
  double bending_step =
      0;  // largest stable explicit bending step, safety margin included; 0 where no step is too long [s]
  double membrane_step = 0;  // the same for the membrane; 0 if the integrator treats it implicitly [s]
  int substeps = 1;          // alpha in use
  double substep = 0;        // he = hi/alpha [s]
};

// Of all implicit solves since the start.
struct SolverCounts {
  long newton = 0, linear = 0;  // iterations
  long unbalanced = 0, retried = 0;
  double time_steps = 0;     // sum over Newton's iterations, 1 for a full step
  double last_residual = 0;  // unbalanced force over load where Newton's method ended last
  // What Newton's method has left at the ends of stages: the largest unbalanced force over load, and the
  // velocity that it would give free masses within the stage, the largest and the mean, each a root mean
  // square over the cloth [m/s].
  double largest_residual = 0, largest_velocity = 0, mean_velocity = 0;
};

class Simulation {
 public:
  virtual ~Simulation() = default;

  // Error::simulation when the state is no longer finite, no equilibrium is found, or an obstacle crushes the
  // cloth.
  virtual void advance(int steps) = 0;
  // One step of this length instead of the scene's: to the equilibrium after a rest, however long [s].
  // Error::invalid_input for integrators but `quasi-static`, Error::simulation as advance().
  virtual void advance_by(double seconds) = 0;
  // From now on every step looks for equilibrium: inertia, drag and viscosity are left out, and what moves
  // stands still.  Where there is none, the step is taken as it is and counted in unbalanced_steps().
  // Error::invalid_input for integrators that are not implicit in all forces.
  virtual void become_static() = 0;
  // All that outlives a step, bit for bit, as bytes that only this program reads; a simulation of the same
  // scene and cloth, on a device of the same kind, in the same precision and not yet static, goes on from
  // them as this one does.
  virtual std::string save() = 0;
  virtual void load(std::string_view state) = 0;
  virtual void wait() = 0;          // until the device has done what advance() ordered
  virtual double time() const = 0;  // [s]
  virtual long steps() const = 0;

  // From now on the hand of that pin goes on from where it is with this velocity [m/s] and spin about its
  // axis [degree/s], whatever its motion was, until it is driven again; hand() is how far it has come by now.
  // Error::invalid_input for a pin that there is not.
  virtual void drive(int pin, const Eigen::Vector3d& velocity, double spin) = 0;
  virtual Keyframe hand(int pin) const = 0;

  // Where the state lies in the host's memory, for who looks at it between steps without a copy: three
  // numbers a vertex, of one of the two types; both null on a GPU, and for positions of cloth that starts far
  // from the origin, which are kept relative to its start (cloth.h).  A step may lay it elsewhere, but
  // frees nothing.
  struct InPlace {
    const double* fp64 = nullptr;
    const float* fp32 = nullptr;
  };
  virtual InPlace positions_in_place() const = 0;         // [m]
  virtual InPlace velocities_in_place() const = 0;        // [m/s]
  virtual std::vector<Eigen::Vector3d> positions() = 0;   // [m]
  virtual std::vector<Eigen::Vector3d> velocities() = 0;  // [m/s]
  virtual std::vector<double> curvature() = 0;            // `dimension` components per element [1/m]
  virtual std::vector<double> moment() = 0;               // likewise, with viscosity [N]
  virtual std::vector<double> residual_curvature() = 0;   // likewise, where the moment is zero [1/m]
  virtual std::vector<double> friction_share() = 0;       // per element: |friction moment|/M0
  virtual int dimension() const = 0;                      // 1: elements are hinges, 3: elements are faces
  // Opens an OpenGL buffer of three floats a vertex for positions that do not pass the host.  Its context is
  // current and draws on CUDA device `gl_device` (-1: none).  Null, and why, where that cannot be; the
  // simulation must outlive what is returned.
  virtual std::unique_ptr<GlPositions> share_positions(unsigned gl_buffer, int gl_device,
                                                       std::string& reason) = 0;
  // Forces of the handles on each vertex at the end of the last step [N], zero on free ones; empty for
  // integrators that are not implicit in all forces.
  virtual std::vector<Eigen::Vector3d> handle_forces() = 0;
  virtual Ledger ledger() = 0;
  virtual double largest_stretch() = 0;    // largest principal stretch minus 1
  virtual std::uint64_t state_hash() = 0;  // of positions and velocities, bit for bit

  virtual std::vector<std::pair<std::string, double>> stage_seconds() = 0;
  virtual double solver_iterations() const = 0;  // mean per step
  virtual double newton_iterations() const = 0;  // mean per step; 0 where there is no Newton solve
  virtual long parts_taken() const = 0;          // into which steps were divided, by retries or a tolerance
  virtual long retried_steps() const = 0;        // that were taken again in smaller parts
  virtual long unbalanced_steps() const = 0;     // parts taken before Newton's method had converged
  virtual SolverCounts solver_counts() const = 0;
  virtual StepLimits limits() const = 0;
  virtual std::vector<ScenePart> parts() const = 0;
  virtual std::size_t device_bytes() const = 0;
  virtual DeviceCounts device_work()
      const = 0;                        // launches, waits and allocations of all steps since the start
  virtual double copy_bandwidth() = 0;  // of this device, bytes read plus written [byte/s], measured
  // From now on every loop is timed by its name; kernel_costs() are those since then.  On a GPU each includes
  // the launch, which alone takes launch_seconds(), measured.
  virtual void profile() = 0;
  virtual KernelCosts kernel_costs() = 0;
  virtual double launch_seconds() = 0;
  virtual std::string device() const = 0;  // "cpu: ..." or "cuda: ..."
  virtual int cuda_device() const = 0;     // -1: the CPU
  // Parts taken with a vertex deeper than the cloth's thickness in an obstacle: after a hard blow, or with
  // steps that are taken unbalanced (newton-iterations), of cloth that is crushed.
  virtual long deep_steps() const = 0;
  // Of hands of limited strength, and of rigid ones that gave way to the cloth: parts of steps in which one
  // pulled with all that it may, in which rigid ones gave way, and how far vertices have lagged behind at
  // most [m].
  virtual long slack_hand_steps() const = 0;
  virtual long barred_hand_steps() const = 0;
  virtual double hand_lag() const = 0;

  MethodChoice method = {};  // as make_simulation() chose
};

// Chooses device and precision as the scene asks.  Error::invalid_input for what cannot be simulated, a start
// that contact cannot go on from included (contact/start_checks.h), Error::system for a missing GPU.
std::unique_ptr<Simulation> make_simulation(const Scene& scene, const Cloth& cloth);

// Names of the usable devices: the CPU, then the GPUs or the reason why there are none.
std::vector<std::string> device_list();

}  // namespace hysteron
