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

}  // namespace hysteron
