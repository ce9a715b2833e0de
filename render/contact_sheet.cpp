#include "render/contact_sheet.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "render/flip.h"
#include "sim/base/error.h"

namespace hysteron::render {
namespace {

Image front_page_copy(const Image& cell) {
  constexpr int kSmaller = 3;
  return shrink(cell, std::max(1, cell.width() / kSmaller), std::max(1, cell.height() / kSmaller));
}

}  // namespace

Image contact_sheet(const std::vector<SheetEntry>& entries, ComparisonSheet page, double metres_per_pixel) {
  if (entries.empty()) throw Error::invalid_input("contact sheet: there are no pictures");
  page.in_sequence = true;
  page.rows = {{"", "", metres_per_pixel}};
  const auto is_enlarged = [](const SheetEntry& entry) { return entry.enlargement != 1; };
  if (std::ranges::any_of(entries, is_enlarged)) page.scale_note += "; × n: n times as large";
  for (const SheetEntry& entry : entries) {
    if (entry.image.empty())
      throw Error::invalid_input("contact sheet: the picture \"" + entry.caption + "\" is empty");
    const std::string scale = is_enlarged(entry) ? fmt::format(" (× {:g})", entry.enlargement) : "";
    page.columns.push_back({entry.caption + scale, {}, {}, "", {{entry.image, "", entry.loop}}});
  }
  return draw_comparison(page);
}

Image onion_skin(const std::vector<Image>& pictures) {
  constexpr double kPalest = 0.72;  // share of white in the first picture
  if (pictures.empty()) throw Error::invalid_input("onion skin: there are no pictures");
  Image over = pictures.back();
  for (std::size_t i = 0; i + 1 < pictures.size(); ++i) {
    const Image& one = pictures[i];
    if (one.width() != over.width() || one.height() != over.height() || one.channels() != over.channels())
      throw Error::invalid_input("onion skin: the pictures differ in size");
    const double pale = kPalest * (1 - static_cast<double>(i) / static_cast<double>(pictures.size() - 1));
    for (std::size_t k = 0; k < over.pixels().size(); ++k)
      over.pixels()[k] =
          std::min(over.pixels()[k],
                   static_cast<std::uint8_t>(std::lround(one.pixels()[k] * (1 - pale) + 255 * pale)));
  }
  return over;
}

std::vector<int> spread(int total, int count) {
  std::vector<int> indices;
  const int kept = std::min(total, count);
  for (int i = 0; i < kept; ++i)
    indices.push_back(kept == 1 ? total - 1 : static_cast<int>(std::lround(i * (total - 1.0) / (kept - 1))));
  return indices;
}

std::vector<int> spread_by_displacement(const std::vector<double>& moved, int count) {
  std::vector<double> distance_so_far;  // distance moved up to each entry
  for (double step : moved)
    distance_so_far.push_back((distance_so_far.empty() ? 0 : distance_so_far.back() + step));
  std::vector<int> indices;
  const int last = static_cast<int>(moved.size()) - 1;
  if (last < 0 || count < 1) return indices;
  for (int i = 0; i < count - 1; ++i) {
    const double wanted = distance_so_far.back() * i / (count - 1);
    const auto after = std::lower_bound(distance_so_far.begin(), distance_so_far.end(), wanted);
    int nearest = static_cast<int>(after - distance_so_far.begin());
    if (nearest > 0 && wanted - distance_so_far[nearest - 1] < distance_so_far[nearest] - wanted) --nearest;
    if (nearest < last && (indices.empty() || nearest > indices.back())) indices.push_back(nearest);
  }
  indices.push_back(last);
  return indices;
}

SeenPicture on_front_page(const Image& picture) { return seen_picture(front_page_copy(picture)); }

bool look_alike(const SeenPicture& a, const SeenPicture& b) {
  constexpr double kAlike = 0.02;  // FLIP below which pictures look alike
  return flip(a, b) < kAlike;
}

bool look_alike(const Image& a, const Image& b) { return look_alike(on_front_page(a), on_front_page(b)); }

std::vector<std::size_t> distinct(std::size_t count,
                                  const std::function<bool(std::size_t, std::size_t)>& are_alike) {
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < count; ++i) {
    const auto is_alike = [&](std::size_t other) { return are_alike(i, other); };
    if (i + 1 == count && kept.size() > 1)
      kept.erase(std::remove_if(kept.begin() + 1, kept.end(), is_alike), kept.end());
    if (std::none_of(kept.begin(), kept.end(), is_alike)) kept.push_back(i);
  }
  return kept;
}

}  // namespace hysteron::render
