// Cusick's apparatus: a pedestal on which a disc holds the specimen, and the plate that lets its ring down.
#pragma once

#include "experiments/drape/specimen.h"

namespace hysteron::experiments {

struct DrapeChoice {
  std::string release = "lowered";  // lowered: a plate under the ring sinks; dropped: it is gone at once;
                                    // relifted: lowered, lifted flat again, lowered a second time
  double disc = 0.09;               // pedestal's radius [m]
  double lowering = 0.6;            // time in which the plate sinks [s]
  double still = 2e-3;              // settled when no vertex moves faster [m/s]
  double plate = 0.12;              // how far the plate sinks [m]

  int strokes() const { return release == "dropped" ? 0 : release == "lowered" ? 1 : 3; }  // of the plate
  double released() const { return strokes() * lowering; }  // when nothing carries the ring any more [s]
};

inline constexpr double kPedestalHeight = 0.14;  // [m]

// Pedestal, the upper disc that holds the specimen (not shown), and the plate that lets the ring down; the
// specimen is laid on the pedestal, middle on middle.
void add_apparatus(Scene& scene, const DrapeChoice& choice, const Specimen& specimen);

}  // namespace hysteron::experiments
