#include "sim/bending/law_run.h"

#include <sstream>

#include "sim/bending/linear.h"
#include "sim/bending/pabst.h"
#include "sim/bending/prandtl_stack.h"
#include "sim/bending/prandtl_stops.h"
#include "sim/bending/wong.h"
#include "sim/error.h"

namespace hysteron {
namespace {

constexpr int kDefaultStack = 64;  // deep enough that a measured history never drops a pair
constexpr int kDefaultStops = 8;   // virgin error M0/(4 N^2) = 0.39 % of M0

template <class Law>
LawRun drive(const Law& law, const std::vector<LawRow>& rows) {
  LawRun run;
  History<double, Law::kHistory> history;
  double dissipated = 0;
  for (const LawRow& row : rows) {
    const Vec<double, 1> curvature(row.curvature);
    run.tangent.push_back(law.tangent(curvature, history)(0, 0));
    const auto step = law.step(curvature, history);
    history = step.history;
    dissipated += step.dissipated;
    run.moment.push_back(step.moment[0]);
    run.stored.push_back(step.stored);
    run.dissipated.push_back(dissipated);
  }
  return run;
}

std::string shown(const LawParameter& value) {
  if (const auto* word = std::get_if<std::string>(&value)) return *word;
  std::ostringstream text;
  text << std::get<double>(value);
  return text.str();
}

[[noreturn]] void refuse(const LawRequest& request, const std::string& key, const std::string& allowed) {
  throw Error::request("law " + request.name + ": " + key + " = " + shown(request.parameters.at(key)) +
                       " must be " + allowed);
}

void allow_only(const LawRequest& request, const std::vector<std::string>& keys) {
  for (const auto& [key, value] : request.parameters) {
    bool known = false;
    std::string list;
    for (const std::string& allowed : keys) {
      known = known || key == allowed;
      list += (list.empty() ? "" : ", ") + allowed;
    }
    if (!known) {
      throw Error::request("law " + request.name + ": unknown parameter " + key + " = " + shown(value) +
                           "; allowed: " + (list.empty() ? "none" : list));
    }
  }
}

std::string word(const LawRequest& request, const std::string& key, const std::string& first,
                 const std::string& second) {
  const auto found = request.parameters.find(key);
  if (found == request.parameters.end()) return first;
  const std::string value = shown(found->second);
  if (value != first && value != second) refuse(request, key, first + " (default) or " + second);
  return value;
}

double number(const LawRequest& request, const std::string& key, int otherwise, const std::string& allowed) {
  const auto found = request.parameters.find(key);
  if (found == request.parameters.end()) return otherwise;
  if (!std::holds_alternative<double>(found->second)) refuse(request, key, allowed);
  return std::get<double>(found->second);
}

LawRun run_linear(const LawRequest& request, const std::vector<LawRow>& rows) {
  allow_only(request, {});
  return drive(Linear<double, 1>::make(request.curve), rows);
}

LawRun run_pabst(const LawRequest& request, const std::vector<LawRow>& rows) {
  allow_only(request, {});
  return drive(Pabst<double, 1>::make(request.curve), rows);
}

LawRun run_wong(const LawRequest& request, const std::vector<LawRow>& rows) {
  allow_only(request, {"recovery"});
  const bool reversible = word(request, "recovery", "masing", "reversible") == "reversible";
  return drive(Wong<double>::make(request.curve, reversible ? Recovery::kReversible : Recovery::kMasing),
               rows);
}

LawRun run_stack(const LawRequest& request, const std::vector<LawRow>& rows) {
  const std::string allowed = "4, 8, 16, 32 or 64";
  const double depth = number(request, "stack", kDefaultStack, allowed);
  if (depth == 4) return drive(PrandtlStack<double, 4>::make(request.curve), rows);
  if (depth == 8) return drive(PrandtlStack<double, 8>::make(request.curve), rows);
  if (depth == 16) return drive(PrandtlStack<double, 16>::make(request.curve), rows);
  if (depth == 32) return drive(PrandtlStack<double, 32>::make(request.curve), rows);
  if (depth == 64) return drive(PrandtlStack<double, 64>::make(request.curve), rows);
  refuse(request, "stack", allowed);
}

LawRun run_stops(const LawRequest& request, const std::vector<LawRow>& rows) {
  const std::string allowed = "4, 8, 16 or 32";
  const double stops = number(request, "stops", kDefaultStops, allowed);
  if (stops == 4) return drive(PrandtlStops<double, 1, 4>::make(request.curve), rows);
  if (stops == 8) return drive(PrandtlStops<double, 1, 8>::make(request.curve), rows);
  if (stops == 16) return drive(PrandtlStops<double, 1, 16>::make(request.curve), rows);
  if (stops == 32) return drive(PrandtlStops<double, 1, 32>::make(request.curve), rows);
  refuse(request, "stops", allowed);
}

LawRun run_prandtl(const LawRequest& request, const std::vector<LawRow>& rows) {
  allow_only(request, {"memory", "stack", "stops"});
  return word(request, "memory", "stack", "stops") == "stops" ? run_stops(request, rows)
                                                              : run_stack(request, rows);
}

// The one list of laws: its name, its line, and what runs it (null: announced, not built).
struct KnownLaw {
  const char* name;
  const char* description;
  LawRun (*run)(const LawRequest&, const std::vector<LawRow>&);
};
constexpr KnownLaw kLaws[] = {
    {"linear", "M = b2 K, no memory (Baraff & Witkin 1998)", run_linear},
    {"bridson", "(2 b2/h) sin(K h/2), no memory (Bridson et al. 2003)", nullptr},
    {"spring", "flexion springs across the hinge, matched to b2 K at K0 (mass-spring model)", nullptr},
    {"pabst", "virgin curve without memory (Pabst et al. 2008, Breen et al. 1992)", run_pabst},
    {"bilinear", "one stop at K0 beside b2 (Anandjiwala & Leaf 1991)", nullptr},
    {"wong", "quadratic loop, last reversal remembered (Wong, Eqs. 4.2, 4.4, 4.5)", run_wong},
    {"prandtl", "quadratic loop, all reversals remembered (Prandtl-Ishlinskii; Iwan 1966)", run_prandtl},
    {"grinspun-edit", "rest curvature set on command (Grinspun et al. 2003)", nullptr},
    {"terzopoulos", "viscoplastic rest curvature above a yield moment (Terzopoulos & Fleischer 1988)",
     nullptr},
    {"obrien", "plastic rest curvature above a yield curvature (O'Brien et al. 2002)", nullptr},
    {"kim", "rest curvature creeps above a threshold, with loss of stiffness (Kim et al. 2011)", nullptr},
    {"narain", "plastic rest curvature with weakening (Narain et al. 2013)", nullptr},
    {"dahl", "friction that relaxes exponentially to M0 (Miguel et al. 2013)", nullptr},
    {"gong", "friction anchor and plastic rest curvature with hold time (Gong et al. 2025)", nullptr},
};

}  // namespace

const std::vector<LawEntry>& law_catalogue() {
  static const std::vector<LawEntry> catalogue = [] {
    std::vector<LawEntry> entries;
    for (const KnownLaw& law : kLaws) entries.push_back({law.name, law.description, law.run != nullptr});
    return entries;
  }();
  return catalogue;
}

LawRun run_law(const LawRequest& request, const std::vector<LawRow>& rows) {
  std::string built;
  const KnownLaw* found = nullptr;
  for (const KnownLaw& law : kLaws) {
    if (law.run) built += (built.empty() ? "" : ", ") + std::string(law.name);
    if (request.name == law.name) found = &law;
  }
  if (!found) throw Error::request("law: unknown law '" + request.name + "'; built: " + built);
  if (!found->run) throw Error::request("law: '" + request.name + "' is not built yet; built: " + built);
  return found->run(request, rows);
}

}  // namespace hysteron
