// Tables of runs, whose times differ from one time to the next.
#pragma once

#include <algorithm>
#include <string>

#include "sim/base/csv.h"
#include "tests/experiments/folder.h"

namespace hysteron::experiments {

inline Table without_column(Table table, const std::string& name) {
  const auto at = std::find(table.head.begin(), table.head.end(), name) - table.head.begin();
  table.head.erase(table.head.begin() + at);
  for (auto& row : table.rows) row.erase(row.begin() + at);
  return table;
}

// Expects all but times to be the same: metrics, hashes, exit codes and reasons.
inline void expect_same(const Table& a, const Table& b) {
  const Table one = without_column(a, "wall_s"), other = without_column(b, "wall_s");
  EXPECT_EQ(one.head, other.head);
  EXPECT_EQ(one.rows, other.rows);
}

}  // namespace hysteron::experiments
