// The pictures of an exhibit.
#pragma once

#include "experiments/workbench/pages/gallery_folders.h"
#include "experiments/workbench/pages/page.h"

namespace hysteron::experiments {

// The contact sheet over the full width, what else was drawn and plotted beside each other, frames to be
// played.  "" if there is nothing.  Throws Error::request, naming the file, if a picture is broken.
std::string pictures_html(const Exhibit& exhibit, PageForm form);

}  // namespace hysteron::experiments
