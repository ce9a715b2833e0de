// `hysteron law`: flags of the law alone.
#include <algorithm>
#include <filesystem>

#include "experiments/law/law.h"
#include "experiments/workbench/app/experiment.h"
#include "sim/base/error.h"
#include "sim/scene/fabric_reader.h"

namespace hysteron::experiments {
namespace {

struct LawFlags {
  std::string law = "prandtl";
  std::string fabric = "cotton-broad";
  double b1 = 0, b2 = 0, k0 = 0;
  BendingParts parts;  // of the fabric
  Parameters param;
  std::string in, out;
};

using L = LawFlags;
// clang-format off
const KeyRow<LawFlags> kRows[] = {
    {"fabric", at<&L::fabric>, "", any(), "", "whose b1, b2, k0 are taken where not given, and what its file has beyond them; its stops unless b1 or k0 is given"},
    {"law", at<&L::law>, "", any(), "", "see `hysteron list laws`"},
    {"b1", at<&L::b1>, "N m", at_least(0), "", "initial bending rigidity, >= b2"},
    {"b2", at<&L::b2>, "N m", at_least(0), "", "bending rigidity of the straight branch"},
    {"k0", at<&L::k0>, "1/m", at_least(0), "", "curvature at which friction saturates"},
    {"param", at<&L::param>, "", any(), "", "parameters of the law"},
    {"in", at<&L::in>, "", any(), "", "CSV with column `curvature [1/m]`"},
    {"out", at<&L::out>, "", any(), "", "CSV with moments and energies"},
};
// clang-format on

void take_fabric(LawFlags& flags, const std::string& origin) {
  const VirginCurve curve = read_fabric(flags.fabric, origin).fabric.virgin_curve();
  flags.b1 = curve.b1;
  flags.b2 = curve.b2;
  flags.k0 = curve.k0;
  flags.parts = curve.parts;
}

// b1 and k0 by hand are friction of three numbers.
void drop_stops_unless_asked_for(const CommandLine& line, LawFlags& flags) {
  const bool by_hand = std::any_of(line.flags.begin(), line.flags.end(),
                                   [](const Flag& flag) { return flag.path == "b1" || flag.path == "k0"; });
  if (by_hand) flags.parts.stops = flags.parts.weft_stops = {};
}

int run_law(const CommandLine& line) {
  LawFlags flags;
  const Keys keys = bind(kRows, flags);
  const auto apply = [&](const Flag& flag) { assign_text(keys, flag.path, flag.text, "--" + flag.path); };
  for (const Flag& flag : line.flags) {
    if (flag.path == "fabric") apply(flag);
  }
  take_fabric(flags, "--fabric");
  for (const Flag& flag : line.flags) apply(flag);
  drop_stops_unless_asked_for(line, flags);
  if (flags.in.empty() || flags.out.empty()) throw Error::invalid_input("needs --in K.csv and --out M.csv");

  std::error_code missing;
  if (std::filesystem::equivalent(flags.in, flags.out, missing))
    throw Error::invalid_input("--out " + flags.out + " is the input: give another file")
        .with_key("out", flags.out);
  return run_law_command(
      {flags.law, {flags.b1, flags.b2, flags.k0, flags.parts}, flags.param, flags.in, flags.out});
}

}  // namespace

Experiment law() {
  return {.name = "law",
          .question = "one law alone: curvatures in, moments out (CSV)",
          .run = run_law,
          .own_keys = own_key_descriptions<kRows>};
}

}  // namespace hysteron::experiments
