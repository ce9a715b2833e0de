#include "experiments/notes/notes.h"

#include <algorithm>
#include <utility>

#include "experiments/workbench/app/command_line.h"
#include "experiments/workbench/app/manifest_file.h"

namespace hysteron::experiments {
namespace {

using NotesOf = Notes (*)(const Manifest&);
constexpr std::pair<const char*, NotesOf> kNotes[] = {
    {"drape", drape_notes},   {"swing", swing_notes},       {"crease", crease_notes},
    {"fold", fold_notes},     {"crumple", crumple_notes},   {"cantilever", cantilever_notes},
    {"buckle", buckle_notes}, {"run", scene_notes},         {"kes", kes_notes},
    {"fit", fit_notes},       {"validate", validate_notes}, {"compare", compare_notes},
    {"sweep", sweep_notes}};

}  // namespace

Notes notes_on(const Manifest& manifest) {
  const auto* const found = std::find_if(std::begin(kNotes), std::end(kNotes), [&](const auto& entry) {
    return manifest.experiment == entry.first;
  });
  // A sweep notes which of its runs failed; other incomplete runs have only their error to report.
  const bool is_study = manifest.experiment == "sweep";
  if (found == std::end(kNotes) || (!manifest.complete && !is_study)) return {};
  Notes notes = found->second(manifest);
  std::erase(notes, "");
  if (notes.size() > kMostNotes) notes.resize(kMostNotes);
  return notes;
}

std::string closing_notes(const std::filesystem::path& folder) {
  const Manifest manifest = read_manifest(folder / "manifest.json");
  std::string text;
  Notes notes = notes_on(manifest);
  const std::filesystem::path fabric = folder / "fabric.toml";
  if (manifest.complete && manifest.experiment == "fit" && std::filesystem::exists(fabric)) {
    notes.resize(std::min(notes.size(), kMostNotes - 1));
    notes.push_back("drape it: hysteron drape --errors " + shell_text({"--fabric", fabric.string()}));
  }
  for (const std::string& note : notes) text += "note: " + note + "\n";
  return text;
}

}  // namespace hysteron::experiments
