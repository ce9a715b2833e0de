#include "experiments/workbench/app/time_left.h"

#include <cmath>

namespace hysteron::experiments {

std::string time_left(long done, long all, double seconds, bool at_most) {
  constexpr long kFewSteps = 5;  // the first are slower: buffers, threads, shaders
  if (done < kFewSteps || done >= all) return "";
  const long left =
      std::lround(std::ceil(seconds * static_cast<double>(all - done) / static_cast<double>(done)));
  const long minutes = (left + 30) / 60;
  std::string text = std::to_string(left) + " s";
  if (left >= 90) text = std::to_string(minutes) + " min";
  if (minutes >= 60) text = std::to_string(minutes / 60) + " h " + std::to_string(minutes % 60) + " min";
  return std::string(at_most ? "  at most " : "  ") + text + " left";
}

}  // namespace hysteron::experiments
