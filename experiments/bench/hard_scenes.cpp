#include "experiments/bench/hard_scenes.h"

#include "experiments/crease/specimen.h"
#include "experiments/drape/apparatus.h"
#include "experiments/fold/specimen.h"
#include "experiments/workbench/app/experiment.h"
#include "sim/scene/assets.h"
#include "sim/scene/scene_reader.h"

namespace hysteron::experiments {
namespace {

// That of an experiment before any flag.
Scene scene_of(const char* experiment, int triangles, const Scene& like) {
  Scene scene = experiment_named(experiment).defaults().scene;
  scene.triangles = triangles;
  scene.device = like.device;
  scene.threads = like.threads;
  scene.precision = like.precision;
  return scene;
}

HardScene folding(int triangles, const Scene& like) {
  FoldChoice choice;
  choice.cycles = 3;
  choice.stroke = 0.92;
  Scene scene = scene_of("fold", triangles, like);
  scene.self_contact = true;
  Fold fold = folded(scene, choice, experiment_named("fold").defaults().options.fps);
  return {"fold", fold.scene, std::move(fold.cloth)};
}

HardScene creasing(int triangles, const Scene& like) {
  const CreaseChoice choice;
  const Scene scene = scene_of("crease", triangles, like);
  Crease crease = creased(scene, choice, loaded_plate(scene, choice));
  return {"crease", crease.scene, std::move(crease.cloth)};
}

HardScene draping(int triangles, const Scene& like) {
  constexpr double kHangs = 0.4;  // after the plate [s]
  const DrapeChoice choice;
  Scene scene = scene_of("drape", triangles, like);
  apply_flags(scene, {{"fabric", kLimpest}});
  scene.seconds = choice.released() + kHangs;
  add_apparatus(scene, choice, {scene.cloth.radius});
  return {"drape", scene, make_cloth(scene)};
}

}  // namespace

std::vector<std::string> hard_scene_names() {
  std::vector<std::string> names = list_assets("scenes");
  names.insert(names.end(), {"crease", "drape", "fold"});
  return names;
}

HardScene hard_scene(const std::string& name, int triangles, const Scene& like) {
  if (name == "fold") return folding(triangles, like);
  if (name == "crease") return creasing(triangles, like);
  if (name == "drape") return draping(triangles, like);
  Scene scene = default_scene("cotton-broad-k50");
  apply_scene_file(scene, name, {}, {"metric"});  // which are of the scene's own run
  scene.triangles = triangles;
  scene.device = like.device;
  scene.threads = like.threads;
  scene.precision = like.precision;
  check_scene(scene);
  return {name, scene, make_cloth(scene)};
}

}  // namespace hysteron::experiments
