// Where a measured curvature turns between two of its rows.
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

// A turn whose place is sought: `beyond` steps beyond the row with the extreme curvature, after that row
// where `beyond` > 0, and before it where `beyond` < 0.
struct SoughtTurn {
  int row = 0;                // with the extreme curvature
  double direction = 1;       // of the way to the turn: 1 rising, -1 falling
  double curvature = 0;       // of that row, or of the last row before it where that lies farther [1/m]
  double step = 0;            // the larger one beside the row [1/m]
  double low = -1, high = 1;  // of `beyond`
  double by_even_steps = 0;   // `beyond` if all steps along the way are as long

  double curvature_at(double beyond) const;  // of the turn [1/m]
};

// The turns of a series, and its first row where the law turns there: it comes from rest, or (`cycling`) from
// the last row.  Those beside which there is a step larger than `step` [1/m].
std::vector<SoughtTurn> sought_turns(const MomentSeries& series, bool cycling, double step);

// The largest step beside a turn [1/m]; 0 without turns.
double largest_step(const std::vector<SoughtTurn>& turns);

// Rows that drive a law, measured ones and turns between them.
struct DrivenRows {
  std::vector<LawRow> rows;
  std::vector<bool> is_added;  // of each row: a turn between measured ones; empty: none is
};

// `rows`: law_rows() of the series with these turns, which has so many `measured` ones; `beyond`: one number
// a turn.
DrivenRows with_turns(const std::vector<LawRow>& rows, int measured, const std::vector<SoughtTurn>& turns,
                      const Eigen::VectorXd& beyond);

// Those of `values`, one a driven row, that belong to measured rows.
std::vector<double> without_added(const std::vector<double>& values, const DrivenRows& driven);

}  // namespace hysteron
