// Phases that are gone through several times: what follows for times, motions and bodies of triangles.
#pragma once

#include "sim/base/cycles.h"
#include "sim/mesh/body_mesh.h"
#include "sim/scene/scene.h"

namespace hysteron {

// When the phases that repeat are gone through; one cycle without length where there are none.
Cycles scene_cycles(const Scene& scene);
// The cycle at this time, the first being 1; 0 before and after them.  The end of a scene that ends with its
// last cycle belongs to that.
int cycle_at(const Scene& scene, double time);
// Sum of all phases, with all cycles [s].
double phases_end(const Scene& scene);

// Has the motions of pins and obstacles repeat.
void repeat_motions(Scene& scene);

// Throws Error::invalid_input, naming the key, for more than one cycle without phases that repeat; for phases
// that repeat with others between them; and with several cycles for motions that do not come back, hands and
// obstacles that come or go, and commands, from the first cycle on.
void check_cycles(const Scene& scene);
// The same for a body that does not come back to where its first cycle begins, but for a millionth of its
// size.
void check_cycles(const Scene& scene, const BodyMesh& body, const std::string& path);

}  // namespace hysteron
