// Declares a running simulation: one interface over both devices and both precisions.
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

  // Takes steps.  Throws Error::simulation when the state is no longer finite, no equilibrium is found, or an
  // obstacle crushes the cloth.
  virtual void advance(int steps) = 0;
  // Takes one step of this length [s] instead of the scene's.  A longer step leads to the equilibrium after a
  // rest: it throws Error::invalid_input for integrators other than `quasi-static`, and Error::simulation as
  // advance() does.
  virtual void advance_by(double seconds) = 0;
  // Makes every step find an equilibrium from now on: inertia, drag and viscosity are left out, and pins and
  // obstacles stand still.  Where there is none, the step is accepted unbalanced and counted as such.  Throws
  // Error::invalid_input for integrators that are not implicit in all forces.
  virtual void become_static() = 0;
  // Returns the state that outlives a step, bit for bit, as bytes that only this program reads; a simulation
  // of the same scene and cloth, on a device of the same kind, in the same precision and not yet static, goes
  // on from them as this one does.
  virtual std::string save() = 0;
  virtual void load(std::string_view state) = 0;
  virtual void wait() = 0;          // until the device has done the work of advance()
  virtual double time() const = 0;  // [s]
  virtual Diagnostics counts() const = 0;
  long steps() const { return counts().steps; }

  // Makes the pin go on from where it is with this velocity [m/s] and spin about its axis [degree/s],
  // whatever its motion was, until it is driven again; pin_displacement() is how far it has come by now.
  // Throws Error::invalid_input for a pin that does not exist.
  virtual void drive(int pin, const Eigen::Vector3d& velocity, double spin) = 0;
  virtual Keyframe pin_displacement(int pin) const = 0;

  // Gives access to the state in the host's memory between steps without a copy: n x 3 numbers, row-major, of
  // one of the two types; both null on a GPU, and for positions of cloth that starts far from the origin,
  // which are kept relative to its start (cloth.h).  A step may move the state elsewhere, but frees nothing.
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
  // Returns the factors from geometric curvature to the law's, `dimension` components per element; the law's
  // moment is smaller than moment() by the same factors (CurvatureOperator::metric).  Empty: 1.
  virtual std::vector<double> metric() const = 0;
  // Opens an OpenGL buffer of n x 3 floats for positions that do not pass the host.  Its context is current
  // and draws on CUDA device `gl_device` (-1: none).  Returns null, and sets `reason`, where that is
  // impossible; the simulation must outlive the result.
  virtual std::unique_ptr<GlPositions> share_positions(unsigned gl_buffer, int gl_device,
                                                       std::string& reason) = 0;
  // Returns the forces of the pins on each vertex at the end of the last step [N], zero on free vertices;
  // empty for integrators that are not implicit in all forces.
  virtual std::vector<Eigen::Vector3d> pin_forces() = 0;
  virtual Ledger ledger() = 0;
  virtual double largest_stretch() = 0;    // largest principal stretch minus 1
  virtual std::uint64_t state_hash() = 0;  // hashes positions and velocities, bit for bit

  virtual std::vector<std::pair<std::string, double>> stage_seconds() = 0;
  virtual std::vector<ScenePart> parts() const = 0;
  virtual double copy_bandwidth() = 0;  // measured on this device, bytes read plus written [byte/s]
  // Times every loop by its name from now on; kernel_costs() returns the sums since then.  On a GPU each
  // includes the launch, which alone takes launch_seconds(), measured.
  virtual void profile() = 0;
  virtual KernelCosts kernel_costs() = 0;
  virtual double launch_seconds() = 0;

  const StepLimits& limits() const { return limits_; }
  int dimension() const { return dimension_; }           // 1: elements are hinges, 3: elements are faces
  const std::string& device() const { return device_; }  // "cpu: ..." or "cuda: ..."
  int cuda_device() const { return cuda_device_; }       // -1: the CPU

  MethodChoice method = {};  // the choice of make_simulation()

 protected:
  Simulation(const StepLimits& limits, int dimension, std::string device, int cuda_device)
      : limits_(limits), dimension_(dimension), device_(std::move(device)), cuda_device_(cuda_device) {}

 private:
  const StepLimits limits_;
  const int dimension_;
  const std::string device_;
  const int cuda_device_;
};

// Makes a simulation on the device and in the precision that the scene asks for.  Throws Error::invalid_input
// for scenes that cannot be simulated, including a start that contact cannot go on from
// (contact/start_checks.h), and Error::system for a missing GPU.
std::unique_ptr<Simulation> make_simulation(const Scene& scene, const Cloth& cloth);

// Returns the names of the usable devices: the CPU, then the GPUs or the reason why there are none.
std::vector<std::string> device_list();

}  // namespace hysteron
