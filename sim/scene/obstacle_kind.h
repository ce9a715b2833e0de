// The kinds of obstacles.  To add one: a value and its name here, its signed distance
// (sim/contact/signed_distance.h), its half thickness (scene_checks.cpp) and its mesh (the scene's renderer);
// what is missing does not compile.
#pragma once

#include <array>

namespace hysteron {

// Solids; hollow: all but a sphere, with the cloth inside.
enum class ObstacleKind { ground, sphere, hollow, cylinder, box, capsule };
constexpr std::array<const char*, 6> names(ObstacleKind) {
  return {"ground", "sphere", "hollow", "cylinder", "box", "capsule"};
}

}  // namespace hysteron
