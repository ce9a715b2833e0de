#include "experiments/experiments.h"

#include <algorithm>

#include "experiments/errors.h"

namespace hysteron::experiments {

const std::vector<Experiment>& experiments() {
  static const std::vector<Experiment> all = {
      {.name = "drape",
       .question = "Cusick's drape test: a disc of cloth over a pedestal",
       .run = drape,
       .simulates = true,
       .own_keys = drape_keys,
       .defaults = drape_defaults},
      {.name = "crease",
       .question = "crease recovery (ISO 2313): fold, load, release",
       .run = crease,
       .simulates = true,
       .own_keys = crease_keys,
       .defaults = crease_defaults},
      {.name = "fold",
       .question = "repeated folding (De Mattia): loops and fatigue",
       .run = fold,
       .simulates = true,
       .own_keys = fold_keys,
       .defaults = fold_defaults},
      {.name = "crumple",
       .question = "crushed, opened, spread and hung: wrinkles that stay",
       .run = crumple,
       .simulates = true,
       .own_keys = crumple_keys,
       .defaults = crumple_defaults},
      {.name = "swing",
       .question = "a clamped strip, released: energy lost to friction",
       .run = swing,
       .simulates = true,
       .defaults = swing_defaults},
      {.name = "compare",
       .question = "one scene under several laws, fabrics or integrators, on one page",
       .run = compare,
       .simulates = true,
       .own_keys = compare_keys,
       .names = "drape|swing|crease|fold|crumple|SCENE"},
      {.name = "kes",
       .question = "virtual KES-FB2 pure bending of laws alone: B, 2HB, residual curvature, loops",
       .run = kes,
       .own_keys = kes_keys},
      {.name = "cantilever",
       .question = "a strip that sags, beside the elastica; bending length (ASTM D1388)",
       .run = cantilever,
       .simulates = true,
       .own_keys = cantilever_keys,
       .defaults = cantilever_defaults},
      {.name = "buckle",
       .question = "strip that buckles under its own weight, upright or on its edge",
       .run = buckle,
       .simulates = true,
       .own_keys = buckle_keys,
       .defaults = buckle_defaults},
      {.name = "accuracy",
       .question = "error against run time, against references of their own; orders; the cheapest settings",
       .run = accuracy,
       .own_keys = accuracy_keys},
      {.name = "validate",
       .question = "the model against measurements: drape coefficients, bending lengths",
       .run = validate,
       .own_keys = validate_keys},
      {.name = "stability",
       .question = "maps of what stays stable, over stiffness, step, mesh and extreme scenes",
       .run = stability,
       .own_keys = stability_keys},
      {.name = "bench",
       .question = "time and memory of a step: a hanging square, three laws",
       .run = bench,
       .simulates = true,
       .own_keys = bench_keys,
       .defaults = bench_defaults},
      {.name = "law",
       .question = "one law alone: curvatures in, moments out (CSV)",
       .run = law,
       .own_keys = law_keys},
      {.name = "fit",
       .question = "identify a fabric from a measured loop, virgin curve, KES pair or profile",
       .run = fit,
       .own_keys = fit_keys},
      {.name = "render",
       .question = "pictures of OBJ/PLY sequences of any simulator, side by side in one look and camera",
       .run = render_files,
       .own_keys = render_keys,
       .names = "FILES"},
      {.name = "diff",
       .question = "how far two pictures, or two folders of them, differ",
       .run = diff,
       .own_keys = diff_keys,
       .names = "A.png B.png"},
      {.name = "report",
       .question = "write a run's folder as one page, report.html; a folder of runs as a gallery, index.html",
       .run = report,
       .own_keys = report_keys,
       .names = "DIR"},
      {.name = "figures",
       .question = "the chapter's Figures 4.2(b), 4.3 and 4.4 from the program's own laws",
       .run = figures,
       .own_keys = figures_keys},
      {.name = "list",
       .question = "what there is: fabrics, laws, scenes, devices",
       .run = list,
       .names = "fabrics|laws|scenes|devices"},
  };
  return all;
}

std::string last_text(const std::vector<Flag>& flags, const std::string& path, const std::string& otherwise) {
  std::string text = otherwise;
  for (const Flag& flag : flags)
    if (flag.path == path) text = flag.text;
  return text;
}

Setup set_up(const CommandLine& line, Setup setup, const Keys& own,
             const std::function<void(Setup&)>& quick) {
  Keys extra = bind_options(setup.options);
  extra.insert(extra.end(), own.begin(), own.end());
  setup.options.scene = last_text(line.flags, "scene", setup.options.scene);
  if (!setup.options.scene.empty()) apply_scene_file(setup.scene, setup.options.scene, extra);
  apply_flags(setup.scene, line.flags, extra);
  if (setup.options.quick && quick) {
    quick(setup);  // which may ask what the flags say
    apply_flags(setup.scene, line.flags, extra);
  }
  check_scene(setup.scene);
  check_options(setup.options);
  if (setup.options.errors) check_errors(line.experiment);
  if (setup.options.out.empty()) setup.options.out = "out/" + line.experiment;
  return setup;
}

std::vector<KeyDescription> descriptions(const Keys& keys) {
  std::vector<KeyDescription> result;
  for (const BoundKey& key : keys) result.push_back(key.description);
  return result;
}

void set_keys(const CommandLine& line, const Keys& keys, const std::function<void()>& quick) {
  const auto apply = [&] {
    for (const Flag& flag : line.flags) {
      if (flag.path == "fabric" || flag.path.starts_with("fabric.")) continue;
      const std::string origin = "--" + flag.path;
      const BoundKey& key = find_key(keys, flag.path, origin);
      assign(key, parse_text(key.description, flag.text), origin);
    }
  };
  apply();
  if (!quick || !*std::get<bool*>(find_key(keys, "quick", "--quick").field)) return;
  quick();
  apply();
}

std::vector<KeyDescription> fabric_keys() {
  static const std::vector<std::string> kNames = {"fabric.name", "fabric.b1", "fabric.b2", "fabric.k0"};
  std::vector<KeyDescription> keys = scene_keys();
  std::erase_if(
      keys, [](const KeyDescription& key) { return !std::count(kNames.begin(), kNames.end(), key.path); });
  return keys;
}

Fabric fabric_of(const std::string& name_or_file, const std::vector<Flag>& flags) {
  std::vector<Flag> own = {{"fabric", name_or_file}};
  for (const Flag& flag : flags) {
    if (flag.path.starts_with("fabric.")) own.push_back(flag);
  }
  Scene scene;
  apply_flags(scene, own);
  check_scene(scene);
  return scene.fabric;
}

}  // namespace hysteron::experiments
