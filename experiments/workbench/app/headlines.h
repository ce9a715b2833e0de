// The numbers that an experiment is asked for, and what its repeats may draw.
#pragma once

#include <string>
#include <vector>

namespace hysteron::experiments {

inline constexpr bool kNoErrors = false;  // of Headline::has_errors

struct Headline {
  const char* metric;
  const char* words;       // "length of ridges"
  const char* unit;        // that it is shown in
  const char* format;      // of fmt, where its errors are not known
  double scale = 1;        // from the metric's unit to the one that is shown
  bool has_errors = true;  // --errors repeats the run for it
};

struct Headlines {
  std::vector<Headline> all{};       // in the order in which they are shown
  bool equilibria = false;           // found at loads that --step does not set
  bool own_mesh = false;             // the experiment cuts its mesh, whatever --mesh and --seed say
  std::string release{};             // key of how the cloth is let go, where that matters
  std::vector<std::string> paths{};  // its values; the first that is not the run's is the other path
  bool requested = false;            // each scene file asks for its own metrics (Manifest::requested_metrics)

  // Those whose errors can be measured.
  std::vector<std::string> with_errors() const;
};

// None of an experiment without, or that is not in the catalogue.
const Headlines& experiment_headlines(const std::string& experiment);

// Whether the metric is a headline of any experiment.
bool is_asked_for(const std::string& metric);

// Error::invalid_input unless errors of the experiment's headlines can be measured.
void check_errors(const std::string& experiment);

}  // namespace hysteron::experiments
