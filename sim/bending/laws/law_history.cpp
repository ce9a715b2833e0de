#include "sim/bending/laws/law_history.h"

#include "sim/bending/laws/law_visit.h"

namespace hysteron {

int history_size(const LawChoice& choice, int dimension) {
  int size = 0;
  const auto take = [&]<class Law>(const Law&) { size = Law::kHistory; };
  if (dimension == 1)
    visit_groups<double, 1, ClothMemory>(LawGroups{}, choice, take);
  else
    visit_groups<double, 3, ClothMemory>(LawGroups{}, choice, take);
  return size;
}

}  // namespace hysteron
