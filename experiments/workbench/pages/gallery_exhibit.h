// One exhibit of a gallery as HTML, and the captions that a run may leave for it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/workbench/pages/gallery_folders.h"
#include "experiments/workbench/pages/page.h"

namespace hysteron::experiments {

// A figure with its caption, for readers and for the gallery, which shows captions below its pictures.
struct FigureCaption {
  std::string file;   // in the same folder, "sheet.png"
  std::string title;  // of one line
  std::string text;   // what it shows, in sentences; one paragraph without line ends
};

// A page of Markdown beside the figures: a heading, an introduction, and each figure above its caption.
// Throws Error::system if the file cannot be written.
void write_captions(const std::filesystem::path& path, const std::string& heading,
                    const std::string& introduction, const std::vector<FigureCaption>& figures);

// "stability/bdf2" -> "stability-bdf2": name of its place on the page.
std::string page_anchor(const Exhibit& exhibit);

// Heading, contact sheet, metrics, pictures and plots, the command, links to the files.  Links are relative
// to the gallery.  Throws Error::invalid_input, naming the file, if a picture is broken.
std::string exhibit_html(const Exhibit& exhibit, PageForm form);

}  // namespace hysteron::experiments
