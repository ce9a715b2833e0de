#include "experiments/workbench/session/animation.h"

#include <algorithm>

namespace hysteron::experiments {

std::size_t most_morph_targets(std::size_t vertices) {
  return std::clamp<std::size_t>(kMostMorphBytes / (kMorphBytes * vertices), 1, kMostMorphTargets);
}

void Animation::add(double time, const std::vector<Eigen::Vector3d>& x) {
  const bool later = frames_.empty() || static_cast<float>(time) > static_cast<float>(frames_.back().time);
  const bool last_is_between = !frames_.empty() && (instants_ - 1) % stride_ != 0;
  if (!later || last_is_between) frames_.pop_back();
  if (later) ++instants_;
  ClothFrame& next = frames_.emplace_back(ClothFrame{time, {}});
  next.xyz.reserve(3 * x.size());
  for (const Eigen::Vector3d& at : x)
    for (const double c : at) next.xyz.push_back(static_cast<float>(c));
  if (frames_.size() <= 1 + most_morph_targets(x.size())) return;
  std::vector<ClothFrame> kept;
  for (std::size_t k = 0; k < frames_.size(); ++k)
    if (k % 2 == 0 || k + 1 == frames_.size()) kept.push_back(std::move(frames_[k]));
  frames_ = std::move(kept);
  stride_ *= 2;
}

void Animation::visit(Archive& archive) {
  archive(instants_);
  archive(stride_);
  frames_.resize(archive.size(frames_.size()));
  for (ClothFrame& frame : frames_) {
    archive(frame.time);
    archive(frame.xyz);
  }
}

}  // namespace hysteron::experiments
