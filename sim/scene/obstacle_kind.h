// The kinds of obstacles as values, from their rows in obstacle_kinds.def.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace hysteron {

enum class ObstacleKind {
#define HYST_OBSTACLE(kind, ...) kind,
#include "sim/scene/obstacle_kinds.def"
};

inline constexpr std::array kObstacleNames = {
#define HYST_OBSTACLE(kind, ...) #kind,
#include "sim/scene/obstacle_kinds.def"
};
constexpr auto names(ObstacleKind) { return kObstacleNames; }

// The row's properties of an obstacle o.
struct ObstacleForm {
  double half_thickness;  // [m]
  bool has_axis, has_rim;
};
template <class Obstacle>
ObstacleForm obstacle_form(const Obstacle& o) {
  switch (o.kind) {
#define HYST_OBSTACLE(kind, half_thickness, has_axis, has_rim) \
  case ObstacleKind::kind:                                     \
    return {half_thickness, has_axis, has_rim};
#include "sim/scene/obstacle_kinds.def"
  }
  return {};
}

}  // namespace hysteron
