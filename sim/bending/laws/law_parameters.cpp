#include "sim/bending/laws/law_parameters.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>

#include "sim/base/error.h"

namespace hysteron {
namespace {

using Words = std::vector<std::string>;

// What is being read, for messages.
struct Reading {
  LawChoice& choice;
  LawUse use;
  std::string key, text;

  [[noreturn]] void refuse(const std::string& allowed) const {
    throw Error::request("law " + choice.name + ": " + key + " = " + text + " must be " + allowed)
        .of(key, text);
  }

  double number(double low, double high, const std::string& allowed) const {
    double x = 0;
    const char* end = text.data() + text.size();
    const auto [stop, failure] = std::from_chars(text.data(), end, x);
    if (failure != std::errc() || stop != end || !(x >= low && x <= high)) refuse(allowed);
    return x;
  }
  double positive(const std::string& unit) const {
    return number(std::numeric_limits<double>::min(), kLargest, "> 0 " + unit);
  }
  double not_negative(const std::string& unit) const { return number(0, kLargest, ">= 0 " + unit); }

  int one_of(const std::vector<int>& allowed) const {
    std::string list;
    for (int a : allowed)
      list += (list.empty() ? "" : a == allowed.back() ? " or " : ", ") + std::to_string(a);
    const double x = number(0, kLargest, list);
    if (std::find(allowed.begin(), allowed.end(), x) == allowed.end()) refuse(list);
    return static_cast<int>(x);
  }
  bool is_second(const std::string& first, const std::string& second) const {
    if (text != first && text != second) refuse(first + " or " + second);
    return text == second;
  }

  static constexpr double kLargest = 1e300;
};

struct Parameter {
  const char* name;
  Words laws;
  void (*read)(const Reading&);
};

const std::vector<Parameter>& parameters() {
  static const Words with_fatigue = {"bilinear", "wong", "prandtl"};
  static const std::vector<Parameter> all = {
      {"memory", {"prandtl"}, [](const Reading& r) { r.choice.stack = r.is_second("stops", "stack"); }},
      {"stops",
       {"prandtl"},
       [](const Reading& r) {
         r.choice.stops = r.one_of({4, 8, 16, 32});
       }},
      {"stack",
       {"prandtl"},
       [](const Reading& r) {
         r.choice.depth = r.use == LawUse::alone ? r.one_of({4, 6, 8, 16, 32, 64}) : r.one_of({4, 6, 8, 16});
       }},
      {"recovery",
       {"wong"},
       [](const Reading& r) { r.choice.reversible = r.is_second("masing", "reversible"); }},
      {"fatigue.dc", with_fatigue, [](const Reading& r) { r.choice.fatigue.dc = r.positive("J/m^2"); }},
      {"fatigue.m-inf", with_fatigue, [](const Reading& r) { r.choice.fatigue.m_inf = r.not_negative("N"); }},
      {"fatigue.set", with_fatigue,
       [](const Reading& r) { r.choice.fatigue.set = r.number(0, 1, "in [0, 1]"); }},
      {"yield",
       {"obrien", "kim", "narain", "gong"},
       [](const Reading& r) { r.choice.yield = r.positive("1/m"); }},
      {"max-set",
       {"obrien", "kim", "narain"},
       [](const Reading& r) { r.choice.max_set = r.not_negative("1/m"); }},
      {"weakening", {"kim", "narain"}, [](const Reading& r) { r.choice.weakening = r.not_negative(""); }},
      {"height", {"bridson", "spring"}, [](const Reading& r) { r.choice.height = r.positive("m"); }},
      {"tau", {"terzopoulos", "kim", "gong"}, [](const Reading& r) { r.choice.tau = r.positive("s"); }},
  };
  return all;
}

bool takes(const Parameter& parameter, const std::string& law) {
  return std::find(parameter.laws.begin(), parameter.laws.end(), law) != parameter.laws.end();
}

LawChoice defaults(const std::string& name, const VirginCurve& curve, LawUse use) {
  constexpr double kHoldTimeOfGong = 30;  // [s] (Gong et al. 2025)
  LawChoice choice;
  choice.name = name;
  choice.curve = curve;
  choice.stack = use == LawUse::alone;
  if (use == LawUse::alone) choice.depth = 64;  // deep enough that a measured history never drops a pair
  choice.yield = curve.k0;
  choice.max_set = std::numeric_limits<double>::infinity();
  if (name == "gong") choice.tau = kHoldTimeOfGong;
  return choice;
}

std::string shown(double x) {
  std::ostringstream text;
  text << x;
  return text.str();
}

// What concerns several numbers at once.
void check(const LawChoice& choice, LawUse use) {
  const auto refuse = [&](const std::string& key, double value, const std::string& why) {
    throw Error::request("law " + choice.name + ": " + key + " = " + shown(value) + why)
        .of(key, shown(value));
  };
  const double m0 = choice.curve.friction_moment();
  if (choice.fatigue.m_inf > m0) {
    refuse("fatigue.m-inf", choice.fatigue.m_inf,
           " N must be in [0, " + shown(m0) + "] N, the friction moment (b1 - b2) k0/2");
  }
  if (choice.fatigue.on() && choice.name == "prandtl" && use == LawUse::cloth) {
    if (choice.stack && choice.depth != 8) refuse("stack", choice.depth, " must be 8 with fatigue");
    if (!choice.stack && choice.stops != 8 && choice.stops != 16)
      refuse("stops", choice.stops, " must be 8 or 16 with fatigue");
  }
  if ((choice.name == "kim" || choice.name == "narain") && choice.yield == 0)
    throw Error::request("law " + choice.name + ": yield must be given and > 0 1/m where k0 is 0")
        .of("yield", "0");
  if (choice.name == "spring") {
    // Folded, the springs are 9/(k0 height)^2 times as rigid as where they are matched: here 90,000 times.
    constexpr double kLeast = 0.01;
    const double angle = choice.curve.k0 * choice.height;
    if (!(angle >= kLeast && angle < 2 * std::numbers::pi)) {
      refuse("height", choice.height,
             " m and k0 = " + shown(choice.curve.k0) +
                 " 1/m must give a hinge angle k0 * height in [0.01, 2 pi), where the springs are matched; "
                 "folded "
                 "further, springs matched at a smaller one are so stiff that they crush the triangles");
    }
  }
}

}  // namespace

std::vector<std::string> law_parameter_names(const std::string& name) {
  Words names;
  for (const Parameter& p : parameters())
    if (takes(p, name)) names.push_back(p.name);
  return names;
}

LawChoice choose_law(const std::string& name, const VirginCurve& curve, const LawParameters& given,
                     LawUse use) {
  std::string known;
  bool found = false;
  for (const LawEntry& law : law_catalogue()) {
    known += (known.empty() ? "" : ", ") + law.name;
    found = found || law.name == name;
  }
  if (!found) throw Error::request("unknown law '" + name + "'; known: " + known);

  LawChoice choice = defaults(name, curve, use);
  for (const auto& [key, text] : given) {
    const auto& all = parameters();
    const auto p = std::find_if(all.begin(), all.end(), [&, &key = key](const Parameter& q) {
      return key == q.name && takes(q, name);
    });
    if (p == all.end()) {
      std::string list;
      for (const std::string& allowed : law_parameter_names(name))
        list += (list.empty() ? "" : ", ") + allowed;
      throw Error::request("law " + name + ": unknown parameter " + key + " = " + text +
                           "; allowed: " + (list.empty() ? "none" : list))
          .of(key, text);
    }
    p->read({choice, use, key, text});
  }
  check(choice, use);
  return choice;
}

const std::vector<LawEntry>& law_catalogue() {
  static const std::vector<LawEntry> catalogue = {
      {"linear", "M = b2 K, no memory (Baraff & Witkin 1998)"},
      {"bridson", "(2 b2/h) sin(K h/2), no memory (Bridson et al. 2003)"},
      {"spring", "flexion springs across the hinge, matched to b2 K at K0 (mass-spring model)"},
      {"pabst", "virgin curve without memory (Pabst et al. 2008, Breen et al. 1992)"},
      {"bilinear", "one stop at K0 beside b2 (Anandjiwala & Leaf 1991)"},
      {"wong", "quadratic loop, last reversal remembered (Wong, Eqs. 4.2, 4.4, 4.5)"},
      {"prandtl", "quadratic loop, all reversals remembered (Prandtl-Ishlinskii; Iwan 1966)"},
      {"grinspun-edit", "rest curvature set on command (Grinspun et al. 2003)"},
      {"terzopoulos", "viscoplastic rest curvature above a yield moment (Terzopoulos & Fleischer 1988)"},
      {"obrien", "plastic rest curvature above a yield curvature (O'Brien et al. 2002)"},
      {"kim", "rest curvature creeps above a threshold, with loss of stiffness (Kim et al. 2011)"},
      {"narain", "plastic rest curvature with weakening (Narain et al. 2013)"},
      {"dahl", "friction that relaxes exponentially to M0 (Miguel et al. 2013)"},
      {"gong", "friction anchor and plastic rest curvature with hold time (Gong et al. 2025)"},
  };
  return catalogue;
}

}  // namespace hysteron
