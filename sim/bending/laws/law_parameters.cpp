#include "sim/bending/laws/law_parameters.h"

#include <algorithm>
#include <limits>
#include <sstream>

#include "sim/base/error.h"
#include "sim/base/number_in.h"
#include "sim/bending/laws/every_law.h"

namespace hysteron {
namespace {

constexpr double kLargest = 1e300;

LawParams defaults(const LawEntry& law, const VirginCurve& curve, LawUse use) {
  LawParams choice;
  choice.name = law.name;
  choice.curve = law.has_faces ? curve : mean_of_faces(curve);
  choice.stack = use == LawUse::alone;
  if (use == LawUse::alone) choice.depth = 64;  // deep enough that a measured history never drops a pair
  choice.yield = curve.k0;
  choice.max_set = std::numeric_limits<double>::infinity();
  if (law.set_defaults) law.set_defaults(choice);
  return choice;
}

const LawEntry* find_law(const std::string& name) {
  for (const LawEntry& law : law_catalogue())
    if (law.name == name) return &law;
  return nullptr;
}

const LawEntry& law_named(const std::string& name) {
  if (const LawEntry* law = find_law(name)) return *law;
  std::string known;
  for (const LawEntry& law : law_catalogue()) known += (known.empty() ? "" : ", ") + law.name;
  throw Error::invalid_input("unknown law '" + name + "'; known: " + known);
}

std::vector<std::string> parameter_names(const std::vector<LawParameter>& parameters) {
  std::vector<std::string> names;
  for (const LawParameter& parameter : parameters) names.push_back(parameter.name);
  return names;
}

void check_fatigue(const LawParams& choice) {
  const double m0 = choice.curve.friction_moment();
  if (choice.fatigue.m_inf > m0)
    choice.refuse("fatigue.m-inf", "fatigue.m-inf = " + shown(choice.fatigue.m_inf) + " N must be in [0, " +
                                       shown(m0) + "] N, the friction moment (b1 - b2) k0/2");
}

}  // namespace

void ParameterText::refuse(const std::string& allowed) const {
  throw Error::invalid_input("law " + law + ": " + key + " = " + text + " must be " + allowed)
      .with_key(key, text);
}

double ParameterText::number(double low, double high, const std::string& allowed) const {
  const std::optional<double> x = number_in(text);
  if (!x || !(*x >= low && *x <= high)) refuse(allowed);
  return *x;
}

double ParameterText::positive(const std::string& unit) const {
  return number(std::numeric_limits<double>::min(), kLargest, "> 0 " + unit);
}

double ParameterText::not_negative(const std::string& unit) const {
  return number(0, kLargest, ">= 0 " + unit);
}

int ParameterText::allowed_integer(const std::vector<int>& allowed) const {
  std::string list;
  for (int a : allowed) list += (list.empty() ? "" : a == allowed.back() ? " or " : ", ") + std::to_string(a);
  const double x = number(0, kLargest, list);
  if (std::find(allowed.begin(), allowed.end(), x) == allowed.end()) refuse(list);
  return static_cast<int>(x);
}

bool ParameterText::is_second(const std::string& first, const std::string& second) const {
  if (text != first && text != second) refuse(first + " or " + second);
  return text == second;
}

namespace law_parameter {

LawParameter yield() {
  return {"yield", [](const ParameterText& t, LawParams& c) { c.yield = t.positive("1/m"); }};
}
LawParameter max_set() {
  return {"max-set", [](const ParameterText& t, LawParams& c) { c.max_set = t.not_negative("1/m"); }};
}
LawParameter weakening() {
  return {"weakening", [](const ParameterText& t, LawParams& c) { c.weakening = t.not_negative(""); }};
}
LawParameter height() {
  return {"height", [](const ParameterText& t, LawParams& c) { c.height = t.positive("m"); }};
}
LawParameter tau() {
  return {"tau", [](const ParameterText& t, LawParams& c) { c.tau = t.positive("s"); }};
}
LawParameter stops() {
  return {"stops", [](const ParameterText& t, LawParams& c) { c.stops = t.allowed_integer({4, 8, 16, 32}); }};
}

std::vector<LawParameter> with_fatigue(std::vector<LawParameter> own) {
  own.push_back(
      {"fatigue.dc", [](const ParameterText& t, LawParams& c) { c.fatigue.dc = t.positive("J/m^2"); }});
  own.push_back(
      {"fatigue.m-inf", [](const ParameterText& t, LawParams& c) { c.fatigue.m_inf = t.not_negative("N"); }});
  own.push_back({"fatigue.set",
                 [](const ParameterText& t, LawParams& c) { c.fatigue.set = t.number(0, 1, "in [0, 1]"); }});
  return own;
}

}  // namespace law_parameter

std::string shown(double x) {
  std::ostringstream text;
  text << x;
  return text.str();
}

void LawParams::refuse(const std::string& key, const std::string& what) const {
  throw Error::invalid_input("law " + name + ": " + what).with_key(key, "");
}

bool has_friction_beside_b2(const std::string& name) {
  const LawEntry* law = find_law(name);
  return law && law->has_friction_beside_b2;
}

bool has_faces(const std::string& name) {
  const LawEntry* law = find_law(name);
  return law && law->has_faces;
}

VirginCurve mean_of_faces(VirginCurve curve) {
  const Faces faces = curve.parts.faces;
  if (!faces.on()) return curve;
  const double rigidity = (1 + faces.bending) / 2, friction = (1 + faces.friction) / 2;
  const double slides = friction * (curve.b1 - curve.b2);
  curve.b2 *= rigidity;
  curve.b1 = curve.b2 + slides;
  for (Spectrum* stops : {&curve.parts.stops, &curve.parts.weft_stops})
    for (double& stiffness : stops->stiffnesses) stiffness *= friction;
  curve.parts.faces = {};
  return curve;
}

std::vector<std::string> law_parameter_names(const std::string& name) {
  const LawEntry* law = find_law(name);
  return law ? parameter_names(law->parameters) : std::vector<std::string>();
}

LawParams choose_law(const std::string& name, const VirginCurve& curve, const LawParameters& given,
                     LawUse use) {
  return choose_law(law_named(name), curve, given, use);
}

LawParams choose_law(const LawEntry& law, const VirginCurve& curve, const LawParameters& given, LawUse use) {
  LawParams choice = defaults(law, curve, use);
  for (const auto& [key, text] : given) {
    const auto known = std::find_if(law.parameters.begin(), law.parameters.end(),
                                    [&, &key = key](const LawParameter& p) { return p.name == key; });
    if (known == law.parameters.end()) {
      std::string list;
      for (const std::string& allowed : parameter_names(law.parameters))
        list += (list.empty() ? "" : ", ") + allowed;
      throw Error::invalid_input("law " + law.name + ": unknown parameter " + key + " = " + text +
                                 "; allowed: " + (list.empty() ? "none" : list))
          .with_key(key, text);
    }
    known->read({law.name, key, text, use}, choice);
  }
  // A law that may have a stack as its memory has stops instead if the user gives their number.
  const std::vector<std::string> names = parameter_names(law.parameters);
  if (given.contains("stops") && !std::ranges::count(names, "stack")) choice.stack = false;
  check_fatigue(choice);
  if (law.check) law.check(choice, use);
  return choice;
}

const std::vector<LawEntry>& law_catalogue() {
  static const std::vector<LawEntry> catalogue = law_entries(EveryLaw{});
  return catalogue;
}

}  // namespace hysteron
