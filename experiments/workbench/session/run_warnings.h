// Finds what makes a run doubtful although it goes on, and returns a sentence for each as its warnings.
#pragma once

#include <string>
#include <vector>

#include "sim/time/simulation.h"

namespace hysteron::experiments {

// Checks before the first step for a membrane that locks (sim/membrane/locking.h), and for layers or
// obstacles that press already.
std::vector<std::string> warnings_at_start(const Scene& scene, const Cloth& cloth, Simulation& simulation);

// Warns if the law does not follow a friction of the fabric's own along weft; "" if it does, or there is
// none.
std::string weft_friction_warning(const Fabric& fabric, const std::string& law);

// Warns if the mesh has a tenth more or fewer triangles than requested, since its rows and columns must be
// whole and some specimens need more; "" otherwise.  `asked` and `origin` are those of the key triangles.
std::string triangle_count_warning(int asked, const std::string& origin, int triangles);

// Checks after the last step for cloth that stretched as none does (`stretched` is the largest principal
// stretch minus 1), or went so far that the precision no longer resolves it.  `x` are its positions [m].
std::vector<std::string> warnings_at_end(const Scene& scene, const Cloth& cloth,
                                         const std::vector<Eigen::Vector3d>& x, double stretched);

// Warns if pictures and point caches, which hold floats in world coordinates, visibly round a start far from
// the origin; "" otherwise.
std::string drawing_text(const Scene& scene, const Cloth& cloth);

}  // namespace hysteron::experiments
