// What makes a run doubtful although it goes on: a sentence each, for its warnings.
#pragma once

#include <string>
#include <vector>

#include "sim/time/simulation.h"

namespace hysteron::experiments {

// Before the first step: a membrane that locks (sim/membrane/locking.h), layers or obstacles that press
// already.
std::vector<std::string> doubts_at_start(const Scene& scene, const Cloth& cloth, Simulation& simulation);

// Says that the law does not follow a friction of the fabric's own along weft; "" where it does, or there is
// none.
std::string weft_friction_warning(const Fabric& fabric, const std::string& law);

// Says that the mesh has a tenth more or fewer triangles than were asked for, since its rows and columns must
// be whole and some specimens need more; "" where it has not.  `asked` and `origin` are those of the key
// triangles.
std::string triangle_count_warning(int asked, const std::string& origin, int triangles);

// After the last: cloth that stretched as none does (`stretched`: largest principal stretch minus 1), or went
// so far that the precision no longer resolves it.  `x`: its positions [m].
std::vector<std::string> doubts_at_end(const Scene& scene, const Cloth& cloth,
                                       const std::vector<Eigen::Vector3d>& x, double stretched);

// Of what holds floats in the world's coordinates, pictures and point caches: where these round the start so
// far from the origin that it shows; "" where they do not.
std::string drawing_words(const Scene& scene, const Cloth& cloth);

// Where the integrator took more than a quarter of all energy that was dissipated; "" where it did not.  The
// step [s] that would do is an estimate, the share being taken to fall as the step does: it is not named
// where it would be less than a hundredth of the one taken, nor of cloth that dissipates nothing itself.
std::string integrator_words(double fraction, double step);

}  // namespace hysteron::experiments
