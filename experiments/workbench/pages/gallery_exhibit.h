// Shows the contents of a folder of results as HTML, in the order of a reader's interest, with captions that
// a run may leave for it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/workbench/app/manifest.h"
#include "experiments/workbench/pages/page.h"

namespace hysteron::experiments {

// A subfolder that holds a run, or pictures and tables without one.
struct Exhibit {
  std::string name;  // its path in the gallery, "stability/bdf2"
  std::filesystem::path folder;
  std::optional<Manifest> manifest;
  std::vector<Exhibit> parts;  // runs in its subfolders, which it summarises

  // Returns the manifest's, without one the first word of the name: "speed".
  std::string experiment() const;
  bool has_pictures() const;
};

struct ExhibitGroup {
  std::string experiment;
  std::vector<Exhibit> exhibits;  // those with pictures first, else by name
};

// Returns a gallery's subfolders by experiment: first those with pictures, then those with measurements.  The
// subfolders of one without a manifest stand beside it, those of a run are its parts; empty folders and those
// of sequences (frames/, frames-LOOK/, film/, mesh/) are passed over.  Throws Error::invalid_input, naming
// the file, if a manifest is broken or if there is nothing to show.
std::vector<ExhibitGroup> exhibits_in(const std::filesystem::path& gallery);

// A figure with its caption, for readers and for the gallery, which shows captions below its pictures.
struct FigureCaption {
  std::string file;   // file in the same folder, "sheet.png"
  std::string title;  // one line
  std::string text;   // description in sentences; one paragraph without line ends
};

// Writes Markdown beside the figures: a heading, an introduction, and each figure above its caption.
// Throws Error::system if the file cannot be written.
void write_captions(const std::filesystem::path& path, const std::string& heading,
                    const std::string& introduction, const std::vector<FigureCaption>& figures);

// Returns the name of its place on the page: "stability/bdf2" -> "stability-bdf2".
std::string page_anchor(const Exhibit& exhibit);

// Returns a card with a small picture and the first answer, which unfolds to contact sheet, metrics,
// pictures, plots, command and links to the files; without pictures and numbers it has these links alone.
// Links are relative to the gallery.  Throws Error::invalid_input, naming the file, if a picture is broken.
std::string exhibit_html(const Exhibit& exhibit, PageForm form);

}  // namespace hysteron::experiments
