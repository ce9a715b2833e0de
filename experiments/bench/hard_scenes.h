// Scenes whose steps Newton's method finds hard: scene files, and specimens that experiments build.
#pragma once

#include <string>
#include <vector>

#include "sim/scene/cloth.h"

namespace hysteron::experiments {

struct HardScene {
  std::string name;
  Scene scene;
  Cloth cloth;
};

// `fold`: the loop of `fold`, closed until its layers touch, three times.  `crease`: the specimen of `crease`
// under its plate.  `drape`: the limpest shipped fabric in the apparatus of `drape`.  Any other name: a scene
// of assets/scenes or a TOML file.  About as many triangles; device, threads and precision are those of
// `like`. Throws Error::request, Error::machine.
HardScene hard_scene(const std::string& name, int triangles, const Scene& like);
// All that are shipped: scenes of assets/scenes, then the specimens.
std::vector<std::string> hard_scene_names();

inline constexpr const char* kLimpest = "polyester-faille";

}  // namespace hysteron::experiments
