// A law with all its parameters, which are read from names and texts as scene files and flags give them.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "sim/bending/laws/law.h"

namespace hysteron {

using LawParameters = std::map<std::string, std::string>;

// Weakening of the friction moment with dissipated energy; fatigue.h says how.
struct FatigueParams {
  double dc = 0;     // fatigue.dc     energy per area over which M0 falls to 1/e [J/m^2]; 0: no fatigue
  double m_inf = 0;  // fatigue.m-inf  friction moment that is left in the end [N]
  double set = 1;    // fatigue.set    eta: share of the lost friction moment that becomes permanent set
  bool on() const { return dc > 0; }
};

struct LawParams {
  std::string name;
  VirginCurve curve;
  bool stack = false;       // memory     stops | stack (prandtl)
  int stops = 8;            // stops      4 | 8 | 16 | 32
  int depth = 8;            // stack      reversal points kept: 4 | 6 | 8 | 16, and 32 | 64 for a law alone
  bool reversible = false;  // recovery   masing | reversible (wong)
  FatigueParams fatigue;    // fatigue.*  (bilinear, prandtl, wong)
  double yield = 0;         // yield      curvature at which plastic flow begins [1/m]; default k0
  double max_set = 0;       // max-set    largest plastic curvature [1/m]; default: no bound
  double weakening = 1;     // weakening  w: rigidity b2/(1 + w damage) (narain, kim)
  double height = 5e-3;     // height     mean height of a hinge's triangles [m] (bridson, spring)
  double tau = 1;           // tau        time of creep or of hold [s]; 1 (terzopoulos, kim), 30 (gong)
  std::map<std::string, double> own;  // parameters that only one law has, as its header reads them

  // Returns a parameter that only this law has, or its default.
  double own_or(const std::string& parameter, double otherwise) const {
    const auto found = own.find(parameter);
    return found == own.end() ? otherwise : found->second;
  }
  // Throws Error::invalid_input about a parameter: the message has the law, and `what` is wrong.
  [[noreturn]] void refuse(const std::string& key, const std::string& what) const;
};

// A cloth has one history per element, so that its memory is kept small: `prandtl` has 8 stops by default.  A
// law alone is exact: `prandtl` has a stack of 64.
enum class LawUse { cloth, alone };

struct ParameterText;
struct LawParameter {
  std::string name;
  void (*read)(const ParameterText&, LawParams&);
};

// A law is grouped by what it keeps of a bend.
enum class LawFamily {
  elastic,     // nothing
  plastic,     // a rest curvature, beyond a yield
  hysteretic,  // what friction holds
};
constexpr std::array<const char*, 3> names(LawFamily) { return {"elastic", "plastic", "hysteretic"}; }

// The description that a law's header gives (law_description.h).
struct LawEntry {
  std::string name;
  std::string description;  // one line
  std::vector<LawParameter> parameters = {};
  bool has_friction_beside_b2 = false;  // M = b2 K + F, where the friction F does not depend on b2
  bool has_faces = false;               // follows another B and 2HB for bends with K < 0
  void (*set_defaults)(LawParams&) = nullptr;
  void (*check)(const LawParams&, LawUse) = nullptr;
  LawFamily family = LawFamily::elastic;
};

// Chooses a law and checks every value.  Throws Error::invalid_input, naming the law and the parameter, for
// unknown laws, parameters that the law does not have, and values out of range.
LawParams choose_law(const std::string& name, const VirginCurve& curve, const LawParameters& parameters,
                     LawUse use = LawUse::cloth);
LawParams choose_law(const LawEntry& law, const VirginCurve& curve, const LawParameters& parameters,
                     LawUse use = LawUse::cloth);

// Returns the names of the parameters that law `name` takes, in the order of LawParams; none for an unknown
// law.
std::vector<std::string> law_parameter_names(const std::string& name);
// Returns LawEntry::has_friction_beside_b2 of law `name`; false for an unknown law.
bool has_friction_beside_b2(const std::string& name);
bool has_faces(const std::string& name);  // likewise LawEntry::has_faces
// Returns the fabric for laws that do not follow faces that differ: with the mean of both B and of both 2HB.
VirginCurve mean_of_faces(VirginCurve curve);

// Returns all laws of the interface in the order of every_law.h.
const std::vector<LawEntry>& law_catalogue();

}  // namespace hysteron
