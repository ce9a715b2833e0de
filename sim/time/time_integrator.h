// Declares an integrator, which moves a body from one state to the next.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "sim/base/error.h"
#include "sim/time/body.h"
#include "sim/time/simulation.h"

namespace hysteron {

template <class Real, class Device>
class TimeIntegrator {
 public:
  explicit TimeIntegrator(Body<Real, Device>& body) : body_(body) {}
  virtual ~TimeIntegrator() = default;
  // Goes from `start` to `start` + `h` [s].  Throws Error::invalid_input for a step longer than the scene's
  // where steps do not lead from equilibrium to equilibrium (refuse_longer()).
  virtual void step(double start, double h) = 0;
  // Makes steps equilibria from now on; throws Error::invalid_input where there is no equilibrium solve.
  virtual void become_static() {
    refuse("has no equilibrium solve: use implicit | bdf2 | tr-bdf2 | quasi-static");
  }
  // Returns the pins' forces on each vertex in the step accepted last [N]; empty where they are not known.
  virtual std::vector<Vec3<Real>> pin_forces() { return {}; }
  virtual void serialise(Archive& archive) = 0;  // state that outlives a step, without the body's
  virtual std::size_t bytes() const = 0;

 protected:
  Body<Real, Device>& body_;

  void refuse_longer(double h) const {
    if (h > body_.scene.step) refuse("has no steps that are longer than the scene's: use quasi-static");
  }

 private:
  [[noreturn]] void refuse(const std::string& why) const {
    throw Error::invalid_input("integrator = " + enum_name(body_.scene.integrator) + " " + why);
  }
};

// The lengths of the parts of adaptive steps.

inline constexpr int kMaxHalvings = 12;  // a step is halved at most so often

// Returns the next part after one of h [s], if h grown by `growth` would have met the tolerance: it aims
// below it, and changes slowly (Hairer, Norsett & Wanner 1993, II.4).
inline double next_part(double h, double growth) {
  constexpr double kAim = 0.9, kFastestGrowth = 2, kFastestFall = 0.3;
  return h * std::clamp(kAim * growth, kFastestFall, kFastestGrowth);
}

// Divides the rest of a step into equal parts of at most `part` [s].
inline double equal_part(double remainder, double part) {
  return remainder / std::ceil(remainder / part * (1 - 1e-9));
}

}  // namespace hysteron
