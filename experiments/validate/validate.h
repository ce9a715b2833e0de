// What `hysteron validate` is asked for.
#pragma once

#include <string>

#include "experiments/workbench/app/options.h"

namespace hysteron::experiments {

struct ValidateFlags {
  std::string parts = "spread";
  std::string fabrics = "cotton-broad,wool-tropical,polyester-tropical,polyester-faille";
  std::string law = "prandtl", device = "cpu";
  std::string standard = "published";  // whose apparatus drapes are made on
  std::string recorded = "results";    // folder of results that are drawn
  double triangles = 6000, step = 1.0 / 120, tolerance = 1e-5;
  double seconds = 0;  // longest of a drape; 0: as the drape has it
  int samples = 8;     // of each fabric's uncertain numbers
  int draws = 3;       // meshes for the mean of a drape in a budget
  unsigned seed = 1;   // of the samples
  Options options;
};

}  // namespace hysteron::experiments
