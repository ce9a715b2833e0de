#include "sim/linear/compressed_rows.h"

#include <algorithm>

namespace hysteron {

Adjacency compressed(std::vector<std::vector<int>>& rows) {
  Adjacency result;
  result.start.push_back(0);
  for (auto& row : rows) {
    std::sort(row.begin(), row.end());
    row.erase(std::unique(row.begin(), row.end()), row.end());
    result.item.insert(result.item.end(), row.begin(), row.end());
    result.start.push_back(static_cast<int>(result.item.size()));
  }
  return result;
}

std::vector<UpperBlock> upper_blocks(const Adjacency& pattern) {
  std::vector<UpperBlock> result;
  for (int i = 0; i + 1 < static_cast<int>(pattern.start.size()); ++i) {
    result.push_back({i, i, -1, -1});
    for (int j = pattern.start[i]; j < pattern.start[i + 1]; ++j) {
      const int column = pattern.item[j];
      if (column < i) continue;
      const auto first = pattern.item.begin() + pattern.start[column],
                 last = pattern.item.begin() + pattern.start[column + 1];
      result.push_back(
          {i, column, j, static_cast<int>(std::lower_bound(first, last, i) - pattern.item.begin())});
    }
  }
  return result;
}

}  // namespace hysteron
