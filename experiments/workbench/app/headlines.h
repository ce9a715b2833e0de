// The numbers that each experiment is asked for, and what its repeats may draw.
#pragma once

#include <string>
#include <vector>

namespace hysteron::experiments {

struct Headlines {
  std::string experiment;
  std::vector<std::string> metrics;
  bool equilibria = false;           // found at loads that --step does not set
  bool own_mesh = false;             // the experiment cuts its mesh, whatever --mesh and --seed say
  std::string release{};             // key of how the cloth is let go, where that matters
  std::vector<std::string> paths{};  // its values; the first that is not the run's is the other path
};

// Null for an experiment without.
const Headlines* headlines_of(const std::string& experiment);

// Error::request unless the experiment has headlines, whose errors can be measured.
void check_errors(const std::string& experiment);

}  // namespace hysteron::experiments
