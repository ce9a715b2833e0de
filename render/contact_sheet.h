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
  std::string caption;    // one line over the picture
  LoopInset loop{};       // inset in a corner of the picture; empty: none
  float enlargement = 1;  // over the page's scale; another one stands behind the caption
};

// Draws cells that are equally large and show each picture whole.  `page` has no rows and columns, which it
// gets here; `metres_per_pixel` is the pictures' scale (0: no scale bar).  Error::invalid_input if there are
// no pictures, one is empty, or the page is too narrow for its columns.
Image contact_sheet(const std::vector<SheetEntry>& entries, ComparisonSheet page,
                    double metres_per_pixel = 0);

// Lays pictures on white over each other, the darkest of each pixel, the earlier the paler: a motion in one
// picture. Error::invalid_input if there are none or their sizes differ.
Image onion_skin(const std::vector<Image>& pictures);

// Returns `count` indices spread evenly from the first to the last of `total` pictures.
std::vector<int> spread(int total, int count);

// Returns at most `count` indices spread evenly over the distance covered; `moved` is the distance from the
// entry before to each.  The first and the last are among them; a standstill gives one.
std::vector<int> spread_by_displacement(const std::vector<double>& moved, int count);

// Returns true if two pictures of one size cannot be told apart at a third of their size, as a front page
// shows them (FLIP below 0.02): one of them is enough on a sheet.
bool look_alike(const Image& a, const Image& b);
// Prepares a picture that look_alike() compares with several others.
SeenPicture on_front_page(const Image& picture);
bool look_alike(const SeenPicture& a, const SeenPicture& b);

// Returns those of `count` items that are like none kept before them; the last one replaces those like it,
// but for the first.
std::vector<std::size_t> distinct(std::size_t count,
                                  const std::function<bool(std::size_t, std::size_t)>& are_alike);

}  // namespace hysteron::render
