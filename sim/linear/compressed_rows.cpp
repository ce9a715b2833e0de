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

Adjacency neighbours_in(const ClothMesh& mesh) {
  std::vector<std::vector<int>> neighbours(mesh.vertices());
  for (const auto& f : mesh.face)
    for (int k = 0; k < 3; ++k)
      for (int l = 0; l < 3; ++l)
        if (k != l) neighbours[f[k]].push_back(f[l]);
  return compressed(neighbours);
}

int slot_in_row(const Adjacency& rows, int row, int item) {
  const auto first = rows.item.begin() + rows.start[row], last = rows.item.begin() + rows.start[row + 1];
  return static_cast<int>(std::lower_bound(first, last, item) - rows.item.begin());
}

std::vector<UpperBlock> upper_blocks(const Adjacency& pattern) {
  std::vector<UpperBlock> result;
  for (int i = 0; i + 1 < static_cast<int>(pattern.start.size()); ++i) {
    result.push_back({i, i, -1, -1});
    for (int j = pattern.start[i]; j < pattern.start[i + 1]; ++j) {
      const int column = pattern.item[j];
      if (column > i) result.push_back({i, column, j, slot_in_row(pattern, column, i)});
    }
  }
  return result;
}

}  // namespace hysteron
