// Tables of named attempts: one row of a map each.
#pragma once

#include "experiments/stability/stability.h"

namespace hysteron::experiments {

struct NamedAttempt {
  const char* name;
  Attempt (*make)();
};

template <std::size_t count>
SweepAxis axis_of(const std::string& label, const NamedAttempt (&table)[count]) {
  SweepAxis axis{label, {}};
  for (const NamedAttempt& entry : table) axis.ticks.push_back(entry.name);
  return axis;
}

inline Obstacle solid(ObstacleKind kind, const Eigen::Vector3d& center) {
  Obstacle obstacle;
  obstacle.kind = kind;
  obstacle.center = center;
  return obstacle;
}

}  // namespace hysteron::experiments
