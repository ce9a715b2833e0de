// Instants of a run that its contact sheet may show: the shapes themselves, so that they can be framed by
// what they turn out to be.
#pragma once

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "render/loop_inset.h"
#include "sim/base/archive.h"

namespace hysteron::experiments {

struct KeptInstant {
  double time = 0;            // [s]
  std::vector<float> xyz;     // [m], x, y, z of each vertex
  std::vector<float> values;  // one a vertex, in looks that show one
  std::string caption;
  render::Path loop;  // of a probe up to here
};

class KeptInstants {
 public:
  // Keeps it, and of too many lets that one go that is nearest to the one before it; the first and the last
  // stay.  Returns how far the vertices are from those of the instant added before, root mean square [m].
  double add(KeptInstant instant);
  bool empty() const { return all_.empty(); }
  const KeptInstant& last() const { return all_.back(); }
  const std::vector<KeptInstant>& all() const { return all_; }
  // `count` of those up to a time [s], apart by what moves between them.
  std::vector<KeptInstant> chosen(int count, double until = INFINITY) const;
  void serialise(Archive& archive);

 private:
  static constexpr std::size_t kMax = 48;

  std::vector<KeptInstant> all_;
  std::vector<double> moved_;  // of each from the one before [m]
  std::vector<float> last_;    // of the instant added before
};

}  // namespace hysteron::experiments
