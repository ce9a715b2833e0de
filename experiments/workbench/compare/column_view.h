// Columns of laws, fabrics, integrators or studies as any page shows them: their colours, the line over their
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

// "116°", "κ 31 /m", "0.94 mN": three digits, with the prefix of SI that leaves 1 to 999; zero below 1e-9 of
// the unit, where sums of doubles end.
std::string short_number(const std::string& metric, const MetricValue& value);

// "elastic", "plastic", "hysteretic", "relaxing" where columns differ in their laws; else "" of all.
std::vector<std::string> column_families(const std::vector<ChildRun>& columns);
// One for each column: of columns that differ in their laws each law's own, which two columns of one law
// share; of others colours that do not come again below 12 columns.
std::vector<render::Rgb8> column_colors(const std::vector<ChildRun>& columns);
// "prandtl+fabric.damping=0.006378" as one would write it: "prandtl, damping 0.00638".
std::string column_words(const std::string& name);
// As sheets name the columns: `names` where there are any, else column_words().
std::vector<std::string> column_names(const std::vector<ChildRun>& columns,
                                      const std::vector<std::string>& names = {});
// As plots name them: with the integrator's share of what was lost where that is above 5 %.
std::vector<std::string> column_labels(const std::vector<ChildRun>& columns,
                                       const std::vector<std::string>& names = {});
// A line that says these shares; "" where there is none.
std::string integrators_note(const std::vector<ChildRun>& columns,
                             const std::vector<std::string>& names = {});

// The columns with names, numbers, families and colours, still without cells.  `names` stand in place of the
// columns' own where there are any.
std::vector<render::ComparisonColumn> column_heads(const std::vector<ChildRun>& columns,
                                                   const std::vector<std::string>& requested,
                                                   const std::vector<std::string>& names = {});

bool has_frames(const ChildRun& column);
const std::vector<Frames::Instant>& instants(const ChildRun& column);
// The picture nearest to a time [s], the last one where the run had ended before.
std::size_t frame_at(const ChildRun& column, double time);
// The first look's pictures stand in frames/.
std::filesystem::path picture_file(const ChildRun& column, const std::string& look, std::size_t frame);

// The part of a row's pictures that has cloth in any of them, with some room; all of it where no run notes
// where its cloth is.
class Crop {
 public:
  void include(const Frames::Instant& instant);
  // All of it that is not as white as the page.
  void include_shown(const render::Image& picture);
  // In shares of the picture; 0 where nothing is included.
  double width() const { return std::max(0.0, box_[2] - box_[0]); }
  // As wide as that, unless it is nearly twice its own width: rows have one scale where that wastes little.
  void widen(double width);
  render::Image of(const render::Image& picture) const;

 private:
  void reach(const std::array<double, 4>& box);

  std::array<double, 4> box_{1, 1, 0, 0};  // left, top, right, bottom in shares of the picture
};

// Moment against curvature where the column's first probe is, up to a time, in the direction that bends most
// in any of the columns.  Empty where it has none.
class ProbedLoops {
 public:
  explicit ProbedLoops(const std::vector<ChildRun>& columns);
  // Of column c; in grey behind it that of prandtl, where that is another column.
  render::LoopInset at(std::size_t c, double time) const;
  std::string note() const { return reference_ && loops_.size() > 1 ? "grey: prandtl" : ""; }

 private:
  struct Loop {
    std::vector<double> time;
    render::Path path;
    render::Path until(double time) const;
  };
  std::vector<Loop> loops_;
  std::vector<render::Rgb8> colors_;
  std::optional<std::size_t> reference_;
  render::LoopFrame frame_;  // of all
};

}  // namespace hysteron::experiments
