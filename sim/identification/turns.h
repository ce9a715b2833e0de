// Finds where a measured curvature turns between two of its rows.
//
//   K          x          The tester turns at x, and its rows lie before and after.  A law that is driven
//            o   .        through the rows turns at the largest one and knows nothing of the way beyond:
//          .       o      its branch back begins late, and its friction seems to turn sooner (a smaller k0).
//        o           .
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/identification/series.h"

namespace hysteron {

// A turn whose place is sought: `beyond` steps beyond the row with the extreme curvature, after that row if
// `beyond` > 0, before it if `beyond` < 0.
struct SoughtTurn {
  int row = 0;                // the row with the extreme curvature
  double direction = 1;       // of the way to the turn: 1 rising, -1 falling
  double curvature = 0;       // at that row, or at the last row before it if that lies farther [1/m]
  double step = 0;            // the larger one beside the row [1/m]
  double low = -1, high = 1;  // bounds of `beyond`
  double by_even_steps = 0;   // `beyond` if all steps along the way are equally long

  double curvature_at(double beyond) const;  // of the turn [1/m]
};

// Returns the turns of a series beside which a step is larger than `step` [1/m], and its first row where the
// law turns there: it comes from rest, or (`cycling`) from the last row.
std::vector<SoughtTurn> sought_turns(const MomentSeries& series, bool cycling, double step);

// Returns the largest step beside a turn [1/m]; 0 without turns.
double largest_step(const std::vector<SoughtTurn>& turns);

// The rows that drive a law, measured ones and turns between them.
struct DrivenRows {
  std::vector<LawRow> rows;
  std::vector<bool> is_added;  // for each row: true for a turn between measured ones; empty: none is
};

// Inserts turns into `rows`, the law_rows() of the series, which has so many `measured` ones; `beyond` has
// one number per turn.
DrivenRows with_turns(const std::vector<LawRow>& rows, int measured, const std::vector<SoughtTurn>& turns,
                      const Eigen::VectorXd& beyond);

// Returns those of `values`, one per driven row, that belong to measured rows.
std::vector<double> without_added(const std::vector<double>& values, const DrivenRows& driven);

}  // namespace hysteron
