#include "sim/identification/fabric_file.h"

#include <cmath>

#include "sim/base/atomic_file.h"
#include "sim/base/error.h"
#include "sim/scene/fabric_reader.h"
#include "sim/scene/key_table.h"
#include "sim/scene/scene.h"
#include "sim/scene/scene_reader.h"

namespace hysteron {
namespace {

std::string borrowed_from(const Fabric& fabric) {
  return "not measured, not this fabric's: that of " + fabric.name + ", the program's default";
}

std::string given_or_default(const std::string& name, const std::optional<double>& given, double otherwise,
                             const std::string& unit) {
  return fabric_entry(name, unit,
                      {given.value_or(otherwise), kNone, true,
                       given ? "given by hand to the fit, --fabric." + name : borrowed_from(Fabric()),
                       given ? "given" : "assumed"});
}

// Refuses what a scene would refuse of the fabric, before the file has its name.
void throw_if_unreadable(const std::string& temporary, const std::string& file) {
  Scene scene;
  try {
    scene.fabric = read_fabric(temporary, "fit").fabric;
    check_scene(scene);
  } catch (const Error& error) {
    std::string reason = error.what();
    for (std::size_t at; (at = reason.find(temporary)) != reason.npos;)
      reason.replace(at, temporary.size(), file);
    throw Error::simulation("the numbers found are no fabric's, and none is written: " + reason);
  }
}

}  // namespace

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return result + '"';
}

std::vector<std::string> borrowed_warnings(const FabricNotes& notes) {
  const Fabric default_fabric;
  std::vector<std::string> lines;
  const auto warn = [&](const std::string& name, double value, const std::string& unit) {
    lines.push_back(name + " was not given: fabric.toml holds that of another fabric, " +
                    default_fabric.name + ", " + number_text(value) + " " + unit + "; give --fabric." + name);
  };
  if (!notes.density) warn("density", default_fabric.density, "kg/m^2");
  if (!notes.thickness) warn("thickness", default_fabric.thickness, "m");
  return lines;
}

std::string fabric_entry(const std::string& name, const std::string& unit, const Estimate& from) {
  std::string text = name + " = {value = " + number_text(from.value);
  if (!unit.empty()) text += ", unit = " + quoted(unit);
  if (std::isfinite(from.standard_error)) text += ", stderr = " + number_text(from.standard_error);
  if (std::isfinite(from.low))
    text += ", range = [" + number_text(from.low) + ", " + number_text(from.high) + "]";
  return text + ", source = " + quoted(from.source) + ", confidence = " + quoted(from.confidence) + "}\n";
}

std::string fabric_text(const Identification& found, const FabricNotes& notes) {
  const std::vector<std::string> open = found.undetermined();
  std::string text = "# Written by hysteron fit.  The data " +
                     (open.empty() ? "determine b1, b2 and k0" : "do not determine " + join(open, ", ")) +
                     ".\n";
  for (const std::string& statement : found.statements) text += "# - " + statement + "\n";
  for (const std::string& warning : borrowed_warnings(notes)) text += "# - warning: " + warning + "\n";
  text +=
      "name = " + quoted(notes.name) + "\ndescription = " + quoted("identified from " + notes.from) + "\n";
  text += "\n[parameters]\n" + fabric_entry("b1", "N m", found.b1) + fabric_entry("b2", "N m", found.b2) +
          fabric_entry("k0", "1/m", found.k0);
  const Fabric default_fabric;
  text += given_or_default("density", notes.density, default_fabric.density, "kg/m^2") +
          given_or_default("thickness", notes.thickness, default_fabric.thickness, "m");
  return text;
}

void write_fabric_text(const std::filesystem::path& file, const std::string& text) {
  AtomicFile target(file.string());
  target.stream() << text;
  if (target.stream().flush()) throw_if_unreadable(target.temporary(), file.string());
  target.commit();
}

void write_fabric(const std::filesystem::path& file, const Identification& found, const FabricNotes& notes) {
  write_fabric_text(file, fabric_text(found, notes));
}

}  // namespace hysteron
