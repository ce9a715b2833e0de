// One exhibit of a gallery as HTML.
#pragma once

#include "experiments/workbench/pages/gallery_folders.h"
#include "experiments/workbench/pages/page.h"

namespace hysteron::experiments {

// "stability/bdf2" -> "stability-bdf2": name of its place on the page.
std::string page_anchor(const Exhibit& exhibit);

// Heading, contact sheet, metrics, pictures and plots, the command, links to the files.  Links are relative
// to the gallery.  Throws Error::invalid_input, naming the file, if a picture is broken.
std::string exhibit_html(const Exhibit& exhibit, PageForm form);

}  // namespace hysteron::experiments
