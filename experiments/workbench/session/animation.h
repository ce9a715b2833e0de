// The instants of a run that its animated export keeps.
#pragma once

#include "sim/base/archive.h"
#include "sim/mesh/gltf.h"

namespace hysteron::experiments {

// A viewer holds a morph target for each instant, and its weight in a uniform and itself in a layer of a
// texture, of which OpenGL ES 3 (and WebGL 2) guarantees 256 each, other uniforms included.
inline constexpr std::size_t kMostMorphTargets = 200;
inline constexpr std::size_t kMostMorphBytes = 256'000'000;  // in a file, which graphics memory holds as well

class Animation {
 public:
  // An instant at `time` [s]; one that is not later than the last takes its place.  Where there are more than
  // viewers bear, every second one goes, and from then on every second one comes in; the first and the last
  // always stay.
  void add(double time, const std::vector<Eigen::Vector3d>& x);
  const std::vector<ClothFrame>& frames() const { return frames_; }
  std::size_t instants() const { return instants_; }  // that were added
  void visit(Archive& archive);

 private:
  std::vector<ClothFrame> frames_;
  std::uint64_t instants_ = 0, stride_ = 1;  // every stride-th is kept, and the last
};

// Morph targets of a cloth of so many vertices at most, at least one.
std::size_t most_morph_targets(std::size_t vertices);

}  // namespace hysteron::experiments
