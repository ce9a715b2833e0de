// Checks the times of a table's rows.
#pragma once

#include <vector>

#include "sim/base/csv.h"
#include "sim/base/number_in.h"

namespace hysteron {

// Throws Table::refusal for the first row whose time [s] is before that of the row above it.
inline void check_time_rises(const Table& table, const std::vector<double>& time) {
  for (std::size_t row = 1; row < time.size(); ++row)
    if (!(time[row] >= time[row - 1]))
      throw table.refusal(row, "time = " + number_text(time[row], {.unit = "s"}) +
                                   " must be >= " + number_text(time[row - 1], {.unit = "s"}) +
                                   ", the time of the row before");
}

}  // namespace hysteron
