// Shows columns of laws, fabrics, integrators or studies on any page: their colours, the line over their
// pictures, the pictures themselves.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "experiments/workbench/compare/sweep_columns.h"
#include "render/comparison_sheet.h"

namespace hysteron::experiments {

// Formats "116°", "κ 31 /m", "0.94 mN": three digits, with the SI prefix that leaves 1 to 999; zero below
// 1e-9 of the unit, which is rounding of sums.
std::string short_number(const std::string& metric, const MetricValue& value);

// Returns "elastic", "plastic", "hysteretic", "relaxing" if columns differ in their laws; else "" for all.
std::vector<std::string> column_families(const std::vector<ChildRun>& columns);
// Returns a colour for each column: for columns that differ in their laws each law's own, which two columns
// of one law share; for others colours that repeat only after 12 columns.
std::vector<render::Rgb8> column_colors(const std::vector<ChildRun>& columns);
// Formats "prandtl+fabric.damping=0.006378" for readers: "prandtl, damping 0.00638".
std::string column_text(const std::string& name);
// Returns the columns' names on sheets: `names` if there are any, else column_text().
std::vector<std::string> column_names(const std::vector<ChildRun>& columns,
                                      const std::vector<std::string>& names = {});
// Returns the columns' names on plots, with the integrator's share of what was lost if that is above 5 %.
std::vector<std::string> column_labels(const std::vector<ChildRun>& columns,
                                       const std::vector<std::string>& names = {});
// Returns a line with these shares; "" if there are none.
std::string integrators_note(const std::vector<ChildRun>& columns,
                             const std::vector<std::string>& names = {});

// Returns the columns with names, numbers, families and colours, still without cells.  `names` replace the
// columns' own if there are any.
std::vector<render::ComparisonColumn> column_heads(const std::vector<ChildRun>& columns,
                                                   const std::vector<std::string>& requested,
                                                   const std::vector<std::string>& names = {});

bool has_frames(const ChildRun& column);
const std::vector<Frames::Instant>& instants(const ChildRun& column);
// Returns the index of the picture nearest to a time [s], or of the last if the run had ended before.
std::size_t frame_at(const ChildRun& column, double time);
// Returns a picture's file; the first look's pictures are in frames/.
std::filesystem::path picture_file(const ChildRun& column, const std::string& look, std::size_t frame);

// The part of a row's pictures that has cloth in any of them, with some room; all of it if no run records
// where its cloth is.
class Crop {
 public:
  void include(const Frames::Instant& instant);
  // Includes everything that is not as white as the page.
  void include_shown(const render::Image& picture);
  // Returns the width in shares of the picture; 0 if nothing is included.
  double width() const { return std::max(0.0, box_[2] - box_[0]); }
  // Widens to this width, unless it is nearly twice the own one: rows have one scale if that wastes little.
  void widen(double width);
  render::Image of(const render::Image& picture) const;

 private:
  void reach(const std::array<double, 4>& box);

  std::array<double, 4> box_{1, 1, 0, 0};  // left, top, right, bottom in shares of the picture
};

// The moment against curvature of the column's first probe, up to a time, in the direction that bends most in
// any of the columns.  Empty if it has none.
class ProbedLoops {
 public:
  explicit ProbedLoops(const std::vector<ChildRun>& columns);
  // Returns the loop of column c; behind it in grey that of prandtl, if that is another column.
  render::LoopInset at(std::size_t c, double time) const;
  // Says by its name in column_names() whose the grey loop is; "" if there is none.
  std::string note(const std::vector<std::string>& names) const {
    return reference_ && loops_.size() > 1 ? "grey: " + names[*reference_] : "";
  }

 private:
  struct Loop {
    std::vector<double> time;
    render::Path path;
    render::Path until(double time) const;
  };
  std::vector<Loop> loops_;
  std::vector<render::Rgb8> colors_;
  std::optional<std::size_t> reference_;
  render::LoopFrame frame_;  // common axes of all loops
};

}  // namespace hysteron::experiments
