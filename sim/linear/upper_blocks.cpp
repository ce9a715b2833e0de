#include "sim/linear/upper_blocks.h"

#include <algorithm>

namespace hysteron {

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
