// What a run needs of the host's memory, estimated before any of it is taken.
#pragma once

#include <string>

#include "experiments/workbench/app/experiment.h"

namespace hysteron::experiments {

// [bytes]; fitted to peaks of resident memory (docs/performance.md): 0.9 to 2 times what runs on a CPU take.
struct MemoryNeed {
  double program = 0;    // without any cloth
  double cloth = 0;      // mesh, bending elements, state, and what building them takes
  double history = 0;    // of the law
  double solver = 0;     // matrices, preconditioner
  double contact = 0;    // of the cloth with itself
  double pictures = 0;   // OpenGL without a GPU, pictures that wait to be written
  double animation = 0;  // instants that wait for the end of the run

  double total() const { return program + cloth + history + solver + contact + pictures + animation; }
};

// Of a run whose cloth has so many triangles.
MemoryNeed memory_need(const Setup& setup, double triangles);
// "about 87 MB of memory, 0 of them for pictures"
std::string text_of(const MemoryNeed& need);

// Throws Error::request where such a cloth needs more than --max-memory or, without it, than this machine
// has.
void check_memory(const Setup& setup, double triangles);
// The same before the cloth is built; of one from a file, what reading that takes.
void check_memory(const Setup& setup);

}  // namespace hysteron::experiments
