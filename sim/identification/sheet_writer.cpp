#include "sim/identification/sheet_writer.h"

#include "sim/scene/scene.h"

namespace hysteron {
void SheetWriter::suppose_bias(double weft) {
  const double mean = (1 + weft) / 2;
  constexpr double kLowBias = 0.54, kHighBias = 1.42;
  suppose(
      "bias-bending", "", mean, kLowBias * mean, kHighBias * mean,
      "no strip was bent along the bias: the mean of warp and weft; the range is that of the 16th to 84th "
      "percentiles of 251 measured fabrics (Feng, Huang, Xu, Wang 2022)");
}

void SheetWriter::write_rest(const std::string& thick) {
  const Fabric other;
  if (sheet.has("W")) {
    published("density", "kg/m^2", sheet.mean("W"), "W");
  } else {
    suppose("density", "kg/m^2", other.density, other.density / 2, 2 * other.density,
            "not in the sheet, which makes every drape a guess: weigh a square of the cloth");
  }
  if (sheet.has(thick)) {
    published("thickness", "m", sheet.mean(thick), thick);
  } else {
    suppose("thickness", "m", other.thickness, other.thickness / 2, 2 * other.thickness,
            "not in the sheet; contact alone depends on it");
  }
  if (sheet.has("MIU")) {
    const double miu = sheet.mean("MIU");
    entry("friction", "",
          {miu, kNone, true, "MIU against the tester's wires, taken for every solid", "derived", miu / 2,
           2 * miu});
  } else {
    suppose("friction", "", 0.3, 0.1, 0.6, "not in the sheet: usual of cloth on a smooth solid");
  }
}

void SheetWriter::tell_k0(const Estimate& k0, const std::string& why) {
  assumed.push_back("k0 = " + number_text(k0.value, 4) + " 1/m, between " + number_text(k0.low, 4) + " and " +
                    number_text(k0.high, 4) + ": " + why);
}

void SheetWriter::write_drapes() {
  for (const auto& [row, tester] : {std::pair{kDrapeOfJis.name, "jis"}, {kDrapeOfIso.name, "iso9073"}})
    if (sheet.has(row))
      published_table += "drape-coefficient = {value = " + number_text(100 * sheet.mean(row), 6) +
                         ", unit = \"%\", source = \"the sheet's " + row +
                         "\", confidence = \"published\", tester = \"" + tester + "\"}\n";
}

SheetFabric SheetWriter::fabric(const std::string& flag, const std::string& description) const {
  SheetFabric result;
  result.text = "# Written by hysteron " + flag + ".\nname = " + quoted(sheet.name) + "\ndescription = \"" +
                description + "\"\n";
  if (!published_table.empty()) result.text += "\n[published]\n" + published_table;
  result.text += "\n[parameters]\n" + parameters + tables;
  result.assumed = assumed;
  return result;
}

}  // namespace hysteron
