// Many pictures on one page: a sequence at a glance.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "render/comparison_sheet.h"
#include "render/flip.h"
#include "render/image.h"

namespace hysteron::render {

struct SheetEntry {
  Image image;
  std::string caption;  // one line over the picture
  LoopInset loop{};     // in a corner of it; empty: none
};

// Cells are equally large and show each picture whole.  `page`: without rows and columns, which it gets here;
// `metres_per_pixel`: of the pictures; 0: no scale bar.  Error::invalid_input if there are no pictures, one
// is empty, or the page is too narrow for its columns.
Image contact_sheet(const std::vector<SheetEntry>& entries, ComparisonSheet page,
                    double metres_per_pixel = 0);

// Pictures on white over each other, the darkest of each pixel, the earlier the paler: a motion in one
// picture. Error::invalid_input if there are none or their sizes differ.
Image onion_skin(const std::vector<Image>& pictures);

// `count` indices spread evenly from the first to the last of `total`: the pictures of a sequence worth a
// page.
std::vector<int> spread(int total, int count);

// `count` indices spread evenly over the way that is covered, which `moved` tells from the entry before to
// each: the first and the last are among them, and of what stands still one alone.
std::vector<int> spread_by_displacement(const std::vector<double>& moved, int count);

// Whether two pictures of one size cannot be told apart where a front page shows them, a third as large (a
// FLIP below 0.02): one of them is enough on a sheet.
bool look_alike(const Image& a, const Image& b);
// The same of pictures that are compared with several.
SeenPicture on_front_page(const Image& picture);
bool look_alike(const SeenPicture& a, const SeenPicture& b);

// Of so many, those that are like none that is kept before them; the last takes the place of those like it,
// but for the first.
std::vector<std::size_t> distinct(std::size_t count,
                                  const std::function<bool(std::size_t, std::size_t)>& are_alike);

}  // namespace hysteron::render
