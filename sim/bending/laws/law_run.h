// Drives one law alone through a list of curvatures, for `hysteron law` and the fits.
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

// The results, one value per row.
struct LawRun {
  std::vector<double> moment;      // [N]
  std::vector<double> tangent;     // dM/dK of the step [N m]
  std::vector<double> stored;      // recoverable energy [J/m^2]
  std::vector<double> dissipated;  // lost since rest [J/m^2]; `wong`: work of friction since rest
  std::vector<double> relaxed;  // the part of it that relaxing branches have lost [J/m^2]; empty: no branches
};

// Drives the law through `rows` in double precision, with D = 1; parameters are as in choose_law() for a law
// alone.  Laws that cannot be edited ignore `edit`.  Throws Error::invalid_input as choose_law() does.
LawRun run_law(const LawRequest& request, const std::vector<LawRow>& rows);

// Does the time of its steps change the law's response? It does if the law creeps, ages with the time it is
// held, or has branches that relax.  Throws as run_law() does.
bool takes_time(const LawRequest& request);

// Returns the rigidity on the tensor over the law's own b2: 1, or the factor of four directions
// (four_directions.h).  Throws as run_law() does.
double rigidity_on_the_tensor(const LawParams& choice);

// The state after an accepted step.
struct LawPoint {
  double moment = 0;      // [N]
  double stored = 0;      // recoverable energy [J/m^2]
  double dissipated = 0;  // lost since rest [J/m^2]; `wong`: work of friction since rest
  double relaxed = 0;     // the part of it that relaxing branches have lost [J/m^2]
};

// Drives a law one step at a time, for histories too long to be stored.  A copy goes on from the same state
// independently.
class LawWalk {
 public:
  explicit LawWalk(const LawRequest& request);  // starts at rest; throws as run_law() does
  ~LawWalk();
  LawWalk(const LawWalk& other);
  LawWalk(LawWalk&&) noexcept;

  LawPoint to(const LawRow& row);
  double residual() const;         // curvature at which the moment is zero now [1/m]
  double friction_moment() const;  // M0 that fatigue has left [N]; NaN for a law without fatigue
  double permanent_set() const;    // K_p of fatigue or of a fabric's set [1/m]; 0 for other laws

  void serialise(Archive& archive);  // saves or loads its memory

  struct State;  // depends on the law's type

 private:
  std::unique_ptr<State> state_;
};

}  // namespace hysteron
