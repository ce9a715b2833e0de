// Many pictures on one page: a sequence at a glance, or one scene under several laws.
#pragma once

#include <string>
#include <vector>

#include "render/image.h"

namespace hysteron::render {

struct SheetEntry {
  Image image;
  std::string caption;  // one line below the picture
};

struct SheetLayout {
  std::string title;
  int columns = 0;   // 0: chosen so that the page comes out near 3 : 2
  int width = 1800;  // of the page [pixels]
};

// Cells are equally large and show each picture whole.  Error::request if there are no pictures, one is
// empty, or the page is too narrow for its columns.
Image contact_sheet(const std::vector<SheetEntry>& entries, const SheetLayout& layout);

// `count` indices spread evenly from the first to the last of `total`: the pictures of a sequence worth a
// page.
std::vector<int> spread(int total, int count);

}  // namespace hysteron::render
