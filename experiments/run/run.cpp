// `hysteron run` simulates a user's scene exactly as its file describes it.
#include <fmt/core.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "experiments/workbench/app/case.h"
#include "experiments/workbench/app/manifest_file.h"
#include "experiments/workbench/app/scene_source.h"
#include "experiments/workbench/pictures/drawing.h"
#include "experiments/workbench/session/session.h"
#include "sim/base/error.h"
#include "sim/scene/shown_key.h"

namespace hysteron::experiments {
namespace {

constexpr const char* kSceneName = "scene_name";  // key in the manifest

Setup defaults() {
  Setup setup;
  setup.scene = default_scene();
  setup.own_tables = {"metric"};
  return setup;
}

constexpr int kQuickTriangles = 500;

void limit_to_quick(Setup& setup) {
  setup.scene.triangles = std::min(setup.scene.triangles, kQuickTriangles);
  setup.options.fps = std::min(setup.options.fps, 10.0);
}

// Turns a scene given as an argument into a --scene flag.
CommandLine with_scene(CommandLine line) {
  if (line.positionals.size() > 1)
    throw Error::invalid_input("takes one scene, not " + std::to_string(line.positionals.size()));
  refuse_two_scenes(line);
  if (!line.positionals.empty()) line.flags.push_back({"scene", line.positionals.front()});
  line.positionals.clear();
  if (last_text(line.flags, "scene", "").empty())
    throw Error::invalid_input(
        "needs a scene: a TOML file, one of `hysteron list scenes`, or the manifest of a run");
  return line;
}

bool has_built_mesh(const Scene& scene) {
  const bool from_file = scene.cloth.is_of_file();
  return !from_file && !scene.mesh.ends_with(".obj");
}

// Sets up the run and warns if --quick leaves the simulation as long as it was.
Setup set_up_run(const CommandLine& line) {
  int asked = 0;  // number of triangles without --quick
  Setup setup = set_up(line, defaults(), {}, [&](Setup& quick) {
    asked = quick.scene.triangles;
    limit_to_quick(quick);
  });
  const bool is_built = has_built_mesh(setup.scene);
  if (setup.options.quick && (!is_built || setup.scene.triangles == asked))
    setup.unread.push_back("--quick simulates no less: " +
                           (is_built ? shown(setup.scene, "triangles", asked, "") + " is kept"
                                     : std::string("the triangles of a file are kept")) +
                           ", and only pictures and recorded instants are fewer and smaller");
  return setup;
}

std::string scene_stem(const std::string& scene) {
  const std::filesystem::path path(scene);
  return path.filename() == "manifest.json" ? path.parent_path().filename().string() : path.stem().string();
}

// Returns the scene's name for titles, which a repetition in another folder shares.  For a manifest it is the
// scene that its run was first asked for, or the experiment that has changed it since.
std::string scene_name(const std::string& scene) {
  if (!scene.ends_with(".json")) return scene_stem(scene);
  const Manifest manifest = read_manifest(scene);
  for (const auto& [key, value] : manifest.own)
    if (key == kSceneName && value->is_string()) return value->get<std::string>();
  std::string first;
  if (manifest.experiment == "run" && manifest.spec) {
    for (const auto& [path, text] : manifest.spec->flags)
      if (path == "scene") first = text;
    if (!manifest.spec->positionals.empty()) first = manifest.spec->positionals.front();
  }
  return first.empty() || first.ends_with(".json") ? manifest.experiment : scene_stem(first);
}

render::Box box_at_start(const Scene&, const Cloth& cloth) {
  return render::bounding_box(flat_points(cloth.start));
}

class SceneCase : public Case {
 public:
  explicit SceneCase(const CommandLine& given) {
    line = with_scene(given);
    scene_ = last_text(line->flags, "scene", "");
    setup = set_up_run(*line);
    if (last_text(line->flags, "out", "").empty()) setup.options.out = "out/run-" + scene_stem(scene_);
  }
  RunPlan plan(Session& session) override {
    const std::string name = scene_name(scene_);
    session.run().note(kSceneName, name);
    RunPlan plan;
    plan.title = name + ": " + setup.scene.fabric.name + ", law " + setup.scene.law;
    plan.progress = [this](const Snapshot& m) {
      return fmt::format("t = {:.3f} s  {}", m.time, setup.scene.phase_at(m.time));
    };
    return plan;
  }
  void conclude(Session&) override {}  // a scene's metrics are those that it requests

 private:
  std::string scene_;  // file, name or manifest
};

}  // namespace

Experiment run_scenes() {
  return {.name = "run",
          .question = "a scene of one's own, as its file has it",
          .case_of = case_of<SceneCase>,
          .simulates = true,
          .defaults = defaults,
          .frame = box_at_start,
          .positionals = "SCENE",
          .headlines = {.requested = true}};
}

}  // namespace hysteron::experiments
