// Whether pages still say what their folders say.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace hysteron::experiments {

// A page that is missing or stale.
struct StalePage {
  std::filesystem::path page;
  std::filesystem::path folder;  // `hysteron report FOLDER` writes it
  bool missing = false;
};

// Makes the page of `folder`, and that of every run below it that has a report.html, again, and compares:
// linked pages, whose bytes are the same on every machine.
// Throws what making them throws.
std::vector<StalePage> stale_pages(const std::filesystem::path& folder);

}  // namespace hysteron::experiments
