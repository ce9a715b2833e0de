// What stands in a folder of results, in the order in which a reader wants it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/workbench/app/manifest.h"

namespace hysteron::experiments {

// A subfolder that holds a run, or pictures and tables without one.
struct Exhibit {
  std::string name;  // its path in the gallery, "stability/bdf2"
  std::filesystem::path folder;
  std::optional<Manifest> manifest;
  std::vector<Exhibit> parts;  // runs in its subfolders, of which it is the summary

  // The manifest's, without one the first word of the name: "speed".
  std::string experiment() const;
  bool has_pictures() const;
};

struct ExhibitGroup {
  std::string experiment;
  std::vector<Exhibit> exhibits;  // those with pictures first, else by name
};

// Subfolders of a gallery's folder by experiment: first what is to be looked at, then what is measured.  The
// subfolders of one without a manifest stand beside it, those of a run are its parts; empty folders and those
// of sequences (frames/, frames-LOOK/, film/, mesh/) are passed over.  Throws Error::invalid_input, naming
// the file, if a manifest is broken or if there is nothing to show.
std::vector<ExhibitGroup> exhibits_in(const std::filesystem::path& gallery);

}  // namespace hysteron::experiments
