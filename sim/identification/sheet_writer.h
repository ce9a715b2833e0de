// Writes the fabric's file of a sheet, number by number: published, derived or assumed, each with its rule.
#pragma once

#include <string>
#include <vector>

#include "sim/identification/fabric_file.h"
#include "sim/identification/laboratory_sheet.h"
#include "sim/scene/key_table.h"

namespace hysteron {

class SheetWriter {
 public:
  explicit SheetWriter(const LaboratorySheet& of) : sheet(of) {}

  void entry(const std::string& name, const std::string& unit, const Estimate& number) {
    parameters += fabric_entry(name, unit, number);
  }
  void published(const std::string& name, const std::string& unit, double value, const std::string& row) {
    entry(name, unit, {value, kNone, true, "the sheet's " + row + ", in SI", "published"});
  }
  void derived(const std::string& name, const std::string& unit, double value, const std::string& rule) {
    entry(name, unit, {value, kNone, true, rule, "derived"});
  }
  void suppose(const std::string& name, const std::string& unit, double value, double low, double high,
               const std::string& why) {
    entry(name, unit, {value, kNone, false, why, "assumed", low, high});
    assumed.push_back(name + " = " + number_text(value, 4) + (unit.empty() ? "" : " " + unit) + ", between " +
                      number_text(low, 4) + " and " + number_text(high, 4) + ": " + why);
  }
  // Assumes for the bias, which no sheet has, the mean of warp and weft.
  void suppose_bias(double weft);
  // Writes density, thickness of the row of that name and friction; assumed where the sheet has none.
  void write_rest(const std::string& thickness);
  // Derives warp or weft such that the load T [N/m] stretches the cloth by e: T = k (e + e^2/2) (1 + e).
  void derive_stiffness(const std::string& name, double load, double e, const std::string& rule) {
    derived(name, "N/m", load / ((e + e * e / 2) * (1 + e)), rule);
  }
  // Tells that k0, which no sheet has, is assumed.
  void tell_k0(const Estimate& k0, const std::string& why);
  // Writes measured drapes, which `drape` and `validate` compare with theirs.
  void write_drapes();
  // Returns the fabric.  `flag` is "fit --kes-sheet"; `description` says where the sheet comes from.
  SheetFabric fabric(const std::string& flag, const std::string& description) const;

  const LaboratorySheet& sheet;
  std::string parameters, tables;
  std::string published_table;  // lines of [published]
  std::vector<std::string> assumed;
};

}  // namespace hysteron
