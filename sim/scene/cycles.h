// Phases that a scene goes through several times: the cycles of its times, motions and bodies of triangles.
#pragma once

#include "sim/base/cycles.h"
#include "sim/mesh/body_mesh.h"
#include "sim/scene/scene.h"

namespace hysteron {

// Returns when the repeating phases are gone through; one cycle without length where there are none.
Cycles scene_cycles(const Scene& scene);
// Returns the cycle at `time` [s], the first being 1; 0 before and after them.  The end of a scene that ends
// with its last cycle belongs to that cycle.
int cycle_at(const Scene& scene, double time);
// Returns the sum of all phases, with all cycles [s].
double phases_end(const Scene& scene);

// Makes the motions of pins and obstacles repeat.
void repeat_motions(Scene& scene);

// Throws Error::invalid_input, naming the key, for more than one cycle without phases that repeat; for phases
// that repeat with others between them; and with several cycles for motions that do not come back, pins and
// obstacles that come or go, and commands, from the first cycle on.
void check_cycles(const Scene& scene);
// Throws likewise for a body that misses its place at the beginning of its first cycle by more than a
// millionth of its size.
void check_cycles(const Scene& scene, const BodyMesh& body, const std::string& path);

}  // namespace hysteron
