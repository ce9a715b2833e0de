// A running simulation: one interface over both devices and both precisions.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/device/gl_positions.h"
#include "sim/device/kernel_profile.h"
#include "sim/scene/cloth.h"
#include "sim/scene/scene.h"
#include "sim/time/diagnostics.h"
#include "sim/time/ledger.h"
#include "sim/time/method_choice.h"

namespace hysteron {

class Simulation {
 public:
  virtual ~Simulation() = default;

  // Error::simulation when the state is no longer finite, no equilibrium is found, or an obstacle crushes the
  // cloth.
  virtual void advance(int steps) = 0;
  // One step of this length instead of the scene's [s].  One that is longer leads to the equilibrium after a
  // rest: Error::invalid_input for integrators but `quasi-static`.  Error::simulation as advance().
  virtual void advance_by(double seconds) = 0;
  // From now on every step looks for equilibrium: inertia, drag and viscosity are left out, and what moves
  // stands still.  Where there is none, the step is taken as it is and counted as unbalanced.
  // Error::invalid_input for integrators that are not implicit in all forces.
  virtual void become_static() = 0;
  // All that outlives a step, bit for bit, as bytes that only this program reads; a simulation of the same
  // scene and cloth, on a device of the same kind, in the same precision and not yet static, goes on from
  // them as this one does.
  virtual std::string save() = 0;
  virtual void load(std::string_view state) = 0;
  virtual void wait() = 0;          // until the device has done what advance() ordered
  virtual double time() const = 0;  // [s]
  virtual Diagnostics counts() const = 0;
  long steps() const { return counts().steps; }

  // From now on the hand of that pin goes on from where it is with this velocity [m/s] and spin about its
  // axis [degree/s], whatever its motion was, until it is driven again; pin_displacement() is how far it has
  // come by now. Error::invalid_input for a pin that there is not.
  virtual void drive(int pin, const Eigen::Vector3d& velocity, double spin) = 0;
  virtual Keyframe pin_displacement(int pin) const = 0;

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
  // Curvature as the law sees it over the geometric one, `dimension` components per element; the moment that
  // the law gives is as much smaller than moment() (CurvatureOperator::metric). Empty: 1.
  virtual std::vector<double> metric() const = 0;
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
  virtual std::vector<ScenePart> parts() const = 0;
  virtual double copy_bandwidth() = 0;  // of this device, bytes read plus written [byte/s], measured
  // From now on every loop is timed by its name; kernel_costs() are those since then.  On a GPU each includes
  // the launch, which alone takes launch_seconds(), measured.
  virtual void profile() = 0;
  virtual KernelCosts kernel_costs() = 0;
  virtual double launch_seconds() = 0;

  const StepLimits& limits() const { return limits_; }
  int dimension() const { return dimension_; }           // 1: elements are hinges, 3: elements are faces
  const std::string& device() const { return device_; }  // "cpu: ..." or "cuda: ..."
  int cuda_device() const { return cuda_device_; }       // -1: the CPU

  MethodChoice method = {};  // as make_simulation() chose

 protected:
  Simulation(const StepLimits& limits, int dimension, std::string device, int cuda_device)
      : limits_(limits), dimension_(dimension), device_(std::move(device)), cuda_device_(cuda_device) {}

 private:
  const StepLimits limits_;
  const int dimension_;
  const std::string device_;
  const int cuda_device_;
};

// Chooses device and precision as the scene asks.  Error::invalid_input for what cannot be simulated, a start
// that contact cannot go on from included (contact/start_checks.h), Error::system for a missing GPU.
std::unique_ptr<Simulation> make_simulation(const Scene& scene, const Cloth& cloth);

// Names of the usable devices: the CPU, then the GPUs or the reason why there are none.
std::vector<std::string> device_list();

}  // namespace hysteron
