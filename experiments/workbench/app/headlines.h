// The headlines of an experiment are its main results; they also say how its repeats for --errors differ.
#pragma once

#include <string>
#include <vector>

namespace hysteron::experiments {

inline constexpr bool kNoErrors = false;  // value of Headline::has_errors

struct Headline {
  const char* metric;
  const char* words;       // name in words: "length of ridges"
  const char* unit;        // unit in which it is shown
  const char* format;      // fmt format if its errors are unknown
  double scale = 1;        // factor from the metric's unit to the shown one
  bool has_errors = true;  // true if --errors repeats the run for it
};

struct Headlines {
  std::vector<Headline> all{};       // in the order in which they are shown
  bool equilibria = false;           // true if found at loads that --step does not set
  bool own_mesh = false;             // true if the experiment builds its mesh, whatever --mesh and --seed say
  std::string release{};             // key of how the cloth is let go, if that matters
  std::vector<std::string> paths{};  // values of that key; the first that is not the run's is the other path
  bool requested = false;            // each scene file requests its own metrics (Manifest::requested_metrics)

  // Returns those whose errors can be measured.
  std::vector<std::string> with_errors() const;
};

// Returns the headlines; none if the experiment has none or is not in the catalogue.
const Headlines& experiment_headlines(const std::string& experiment);

// True if the metric is a headline of any experiment.
bool is_asked_for(const std::string& metric);

// Throws Error::invalid_input unless errors of the experiment's headlines can be measured.
void check_errors(const std::string& experiment);

}  // namespace hysteron::experiments
