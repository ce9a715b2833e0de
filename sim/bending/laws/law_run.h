// One law alone, driven through a list of curvatures: what `hysteron law` and the fits stand on.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sim/bending/laws/law_parameters.h"

namespace hysteron {

class Archive;

struct LawRequest {
  std::string name = "prandtl";  // one of law_catalogue()
  VirginCurve curve;
  LawParameters parameters;
};

// One accepted step.  The first row starts from rest (K = 0, no history).
struct LawRow {
  double curvature = 0;  // [1/m]
  double seconds = 1;    // time that the step takes [s]
  bool edit = false;     // after the step the rest curvature is set to the current one (grinspun-edit)
};

// One value per row.
struct LawRun {
  std::vector<double> moment;      // [N]
  std::vector<double> tangent;     // dM/dK of the step [N m]
  std::vector<double> stored;      // recoverable energy [J/m^2]
  std::vector<double> dissipated;  // lost since rest [J/m^2]; `wong`: work of friction since rest
  std::vector<double> relaxed;     // what of it relaxing branches have lost [J/m^2]; empty: there are none
};

// Drives the law through `rows` in double precision, D = 1; parameters as in choose_law() for a law alone.
// Laws that cannot be edited ignore `edit`.  Throws Error::invalid_input as choose_law() does.
LawRun run_law(const LawRequest& request, const std::vector<LawRow>& rows);

// Whether the time of its steps changes what the law does: it creeps, ages with the time it is held, or has
// branches that relax.  Throws as run_law() does.
bool takes_time(const LawRequest& request);

// Rigidity on the tensor over the law's own b2: 1, or what four directions make of it (four_directions.h).
// Throws as run_law() does.
double rigidity_on_the_tensor(const LawChoice& choice);

// What an accepted step leaves.
struct LawPoint {
  double moment = 0;      // [N]
  double stored = 0;      // recoverable energy [J/m^2]
  double dissipated = 0;  // lost since rest [J/m^2]; `wong`: work of friction since rest
  double relaxed = 0;     // what of it relaxing branches have lost [J/m^2]
};

// A law with its memory on the way, a step at a time, for histories too long to be kept.  A copy goes on from
// the same state by itself.
class LawWalk {
 public:
  explicit LawWalk(const LawRequest& request);  // at rest, as run_law(); Error::invalid_input likewise
  ~LawWalk();
  LawWalk(const LawWalk& other);
  LawWalk(LawWalk&&) noexcept;

  LawPoint to(const LawRow& row);
  double residual() const;         // curvature at which the moment is zero now [1/m]
  double friction_moment() const;  // M0 that fatigue has left [N]; NaN for a law without fatigue
  double permanent_set() const;    // K_p of fatigue or of a fabric's set [1/m]; 0 of other laws

  void serialise(Archive& archive);  // its memory, for one that goes on from there

  struct State;  // of some law

 private:
  std::unique_ptr<State> state_;
};

}  // namespace hysteron
