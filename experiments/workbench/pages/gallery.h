// Writes a folder of runs as one page.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/workbench/pages/page.h"

namespace hysteron::experiments {

// Returns all that exhibits_in() finds as HTML, grouped by experiment under its question, with a card each,
// below the folder's own questions (questions_html()), or the picture that the README beside the folder shows
// first.  The page works from disk without a network: pictures are linked, or embedded and shrunk.
// Everything is read from the folders, nothing is computed again, and the same folders give the same bytes.
// Throws Error::invalid_input, naming the file, if a picture, table or manifest is broken or there is nothing
// to show.
std::string gallery_page(const std::filesystem::path& folder, PageForm form = PageForm::linked);

// Writes it as FOLDER/index.html and returns that path.  Throws Error::system if it cannot be written.
std::filesystem::path write_gallery(const std::filesystem::path& folder, PageForm form = PageForm::linked);

// A page that is missing or stale.
struct StalePage {
  std::filesystem::path page;
  std::filesystem::path folder;  // `hysteron report FOLDER` writes it
  bool missing = false;
};

// Makes the page of `folder`, and that of every run below it that has a report.html, again, and compares
// them.  These are linked pages, whose bytes are the same on every machine.
// Throws what making them throws.
std::vector<StalePage> stale_pages(const std::filesystem::path& folder);

}  // namespace hysteron::experiments
