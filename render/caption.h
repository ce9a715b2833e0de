// Lettering on pictures: captions, scale bars, colour bars.  Everything is drawn on the CPU into an Image and
// grows with its height, so that a thumbnail and a print carry the same proportions.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "render/color_map.h"
#include "render/image.h"

namespace hysteron::render {

enum class Corner { top_left, top_right, bottom_left, bottom_right };
inline bool is_right(Corner corner) { return corner == Corner::top_right || corner == Corner::bottom_right; }
inline bool is_bottom(Corner corner) {
  return corner == Corner::bottom_left || corner == Corner::bottom_right;
}

// The colour of a text and the height of its capitals [pixels].
struct TextStyle {
  Rgb8 color{38, 40, 44};
  float size = 16;
};

// Letter height and margin that suit a picture: 1/45 of its height (1/80 of its width, if that is less) and
// 1/30 of its height, at least 9 and 6 pixels.
float text_size(const Image& image);
int margin(const Image& image);

// Width of one line in pixels.  Text is UTF-8; what the font lacks is drawn as its empty box.
float text_width(std::string_view text, float size);
// Draws one line with the left end of its baseline at (x, y), blended in linear light.
void draw_text(Image& image, std::string_view text, float x, float y, const TextStyle& style);
// Draws a filled rectangle; its edges may fall between pixels.
void draw_rectangle(Image& image, float left, float top, float right, float bottom, const Rgb8& color);

// Draws lines separated by '\n' in a corner, the first a little larger.  Lines that are too long are broken
// between words, then set smaller; those that still do not fit inside the margins are left out.
void draw_caption(Image& image, std::string_view text, Corner corner);

// Writes a length with the unit that leaves a number from 1 to below 1000: "5 cm".
std::string length_text(double metres);
// Returns the length, 1, 2 or 5 times a power of ten [m], whose bar is nearest to a sixth of the picture's
// width.
double scale_bar_length(const Image& image, double metres_per_pixel);
// Draws a bar of scale_bar_length() with its label ("5 cm"); `note` says in which plane it holds ("at the
// cloth's centre").  The label is set smaller if it would leave its half of the picture.  Returns the bar's
// length in pixels. Error::invalid_input if metres_per_pixel is not positive.
double draw_scale_bar(Image& image, double metres_per_pixel, Corner corner, std::string_view note = "");

struct ColorBar {
  ColorMap map = ColorMap::diverging;
  double low = -1, high = 1;  // values at the ends
  std::string label;          // name of the quantity, e.g. "curvature"
  std::string unit;           // e.g. "1/m"; empty for a pure number
  int ticks = 5;              // number of ticks at equal steps, both ends included, at least 2
};

// The place of a colour bar [pixels]; the columns of its ticks show exactly the colours of the ticks' values.
struct ColorBarPlace {
  int left = 0, top = 0, width = 0, height = 0;  // the coloured rectangle; all 0 if the picture has no room
  std::vector<int> tick_columns;
};

// Draws a horizontal bar with ticks, label and unit.  Error::invalid_input unless low < high.
ColorBarPlace draw_color_bar(Image& image, const ColorBar& bar, Corner corner);

}  // namespace hysteron::render
