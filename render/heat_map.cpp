#include "render/heat_map.h"

#include <algorithm>

#include "render/gnuplot.h"
#include "sim/base/error.h"

namespace hysteron::render {
namespace {

// Lengths are in pixels.
constexpr int kTop = 136, kRight = 24, kGapX = 20, kGapY = 44;
constexpr int kBesideLabel = 52, kBelowLabel = 54;  // room of the axes' labels
constexpr int kLetter = 8;                          // width of a tick's letter
constexpr int kLegend = 78, kSwatch = 15, kLegendLetter = 9, kLegendGap = 34;
constexpr int kMinMap = 380, kMinPage = 1000;  // least widths of a map and of all maps together
constexpr double kHalfCell = 0.47;             // half side of a cell's colour, in cells: the rest is the grid

std::size_t longest(const std::vector<std::string>& words) {
  std::size_t most = 0;
  for (const std::string& word : words) most = std::max(most, word.size());
  return most;
}

// Returns the width of a map [pixels], with room for its title.
int map_width(const HeatMaps& page) {
  return std::max(kMinMap, page.cell_width * static_cast<int>(page.x.ticks.size()));
}

bool upright(const HeatMaps& page) {
  return longest(page.x.ticks) * kLetter * page.x.ticks.size() > static_cast<std::size_t>(map_width(page));
}

gnuplot::PanelPage layout(const HeatMaps& page) {
  const int count = static_cast<int>(page.maps.size());
  const int below = upright(page) ? static_cast<int>(longest(page.x.ticks)) * kLetter : kLetter * 2;
  const int columns = std::clamp(page.columns, 1, count);
  const int left = kBesideLabel + kLetter * static_cast<int>(longest(page.y.ticks) + 1);
  const int spare = kMinPage - columns * (map_width(page) + kGapX);
  return {count,
          columns,
          map_width(page),
          page.cell_height * static_cast<int>(page.y.ticks.size()),
          left,
          kRight + std::max(0, spare),
          kTop,
          kBelowLabel + below,
          kGapX,
          kGapY};
}

// Draws a swatch and a name for each kind, in a row below the subtitle.
std::string legend(const HeatMaps& page, const gnuplot::PanelPage& at) {
  std::string script;
  int x = at.left;
  for (const CellKind& kind : page.kinds) {
    script += "set object rectangle from " + at.point(x, kLegend + kSwatch) + " to " +
              at.point(x + kSwatch, kLegend) + " fillcolor rgb '" + kind.color +
              "' fillstyle solid noborder\n";
    script +=
        gnuplot::text_at(kind.name, at.point(x + kSwatch + 7, kLegend + kSwatch / 2.0), "left font ',13'");
    x += kSwatch + kLegendGap + kLegendLetter * static_cast<int>(kind.name.size());
  }
  return script;
}

std::string tick_list(const std::vector<std::string>& ticks, bool shown) {
  std::string list;
  for (std::size_t i = 0; i < ticks.size(); ++i)
    list += std::string(i ? ", " : "") + gnuplot::label_text(shown ? ticks[i] : "") + " " + std::to_string(i);
  return "(" + list + ")";
}

// Writes `$cellsI` with middle and colour, and `$textsI` with middle and text of each cell.
std::string cell_blocks(const HeatMaps& page, int index) {
  std::string cells = "$cells" + std::to_string(index) + " << END\n",
              texts = "$texts" + std::to_string(index) + " << END\n";
  const auto& rows = page.maps[index].rows;
  for (std::size_t j = 0; j < rows.size(); ++j) {
    for (std::size_t i = 0; i < rows[j].size(); ++i) {
      const HeatMapCell& cell = rows[j][i];
      const std::string at = std::to_string(i) + " " + std::to_string(j) + " ";
      if (cell.kind >= 0) cells += at + "0x" + page.kinds[cell.kind].color.substr(1) + "\n";
      texts += at + gnuplot::data_text(cell.text) + "\n";
    }
  }
  return cells + "END\n" + texts + "END\n";
}

std::string map_commands(const HeatMaps& page, const gnuplot::PanelPage& at, int index) {
  const HeatMap& map = page.maps[index];
  const std::string i = std::to_string(index);
  std::string script = at.margins(index) + "set xtics " + (upright(page) ? "rotate by 90 right " : "") +
                       tick_list(page.x.ticks, at.lowest(index)) + "\nset ytics " +
                       tick_list(page.y.ticks, at.first_column(index)) + "\nset title " +
                       gnuplot::label_text(map.title) + " font ',13' offset 0,-0.6\n";
  const std::string half = gnuplot::number(kHalfCell);
  const std::string plot = "plot $cells" + i + " using 1:2:(" + half + "):(" + half +
                           "):3 with boxxyerror fs solid noborder lc rgb variable, $texts" + i +
                           " using 1:2:3 with labels font ',10' textcolor rgb '#222222'\n";
  return script + plot + "unset label\nunset object\n";
}

std::string common_commands(const HeatMaps& page) {
  const auto range = [](const char* axis, std::size_t cells) {
    return std::string("set ") + axis + "range [-0.5:" + gnuplot::number(cells - 0.5) + "]\n";
  };
  return "set border 15 lw 1 lc rgb '#AAAAAA'\nset tics nomirror out scale 0 font ',12' textcolor rgb "
         "'#444444'\nunset key\nset datafile missing 'NaN'\n" +
         range("x", page.x.ticks.size()) + range("y", page.y.ticks.size());
}

void require_fitting(const std::filesystem::path& base, const HeatMaps& page) {
  gnuplot::require_something(base, page.maps.size());
  for (const HeatMap& map : page.maps) {
    const bool fits = map.rows.size() == page.y.ticks.size() &&
                      std::all_of(map.rows.begin(), map.rows.end(),
                                  [&](const auto& row) { return row.size() == page.x.ticks.size(); });
    if (fits) continue;
    throw Error::invalid_input("plot " + base.string() + ": map \"" + map.title + "\" must have " +
                               std::to_string(page.y.ticks.size()) + " rows of " +
                               std::to_string(page.x.ticks.size()) + " cells");
  }
}

}  // namespace

void write_heat_maps(const std::filesystem::path& base, const HeatMaps& page) {
  require_fitting(base, page);
  const gnuplot::PanelPage at = layout(page);
  std::string data, drawing = "set multiplot\n" +
                              gnuplot::page_texts(at, page.title, page.subtitle, page.x.label, page.y.label) +
                              legend(page, at);
  for (int i = 0; i < at.count; ++i) {
    data += cell_blocks(page, i);
    drawing += map_commands(page, at, i);
  }
  gnuplot::write_both(base, at.width(), at.height(), data + common_commands(page),
                      drawing + "unset multiplot\n");
}

}  // namespace hysteron::render
