// Keeps instants of a run that its contact sheet may show, as shapes, so that they can be framed by their
// final extent.
#pragma once

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "render/loop_inset.h"
#include "sim/base/archive.h"

namespace hysteron::experiments {

struct ArchivedInstant {
  double time = 0;            // [s]
  std::vector<float> xyz;     // x, y, z of each vertex [m]
  std::vector<float> values;  // one per vertex, in looks that show a value
  std::string caption;
  render::Path loop;  // path of a probe up to here
};

class ArchivedInstants {
 public:
  // Adds an instant, and if there are too many drops the one nearest to its predecessor; the first and the
  // last stay.  Returns how far the vertices are from those of the instant added before, root mean square
  // [m].
  double add(ArchivedInstant instant);
  bool empty() const { return all_.empty(); }
  const ArchivedInstant& last() const { return all_.back(); }
  const std::vector<ArchivedInstant>& all() const { return all_; }
  // Returns `count` of the instants up to a time [s], spread by displacement.
  std::vector<ArchivedInstant> chosen(int count, double until = INFINITY) const;
  void serialise(Archive& archive);

 private:
  static constexpr std::size_t kMax = 48;

  std::vector<ArchivedInstant> all_;
  std::vector<double> moved_;  // displacement of each from its predecessor [m]
  std::vector<float> last_;    // vertices of the instant added before
};

}  // namespace hysteron::experiments
