#include "experiments/experiments.h"

#include <algorithm>

namespace hysteron::experiments {

const std::vector<Experiment>& experiments() {
  static const std::vector<Experiment> all = {
      {.name = "drape",
       .question = "Cusick's drape test: a disc of cloth over a pedestal",
       .run = drape,
       .simulates = true,
       .own_keys = drape_keys},
      {.name = "crease", .question = "crease recovery: fold, load, release"},
      {.name = "fold", .question = "repeated folding: loops and fatigue"},
      {.name = "crumple", .question = "crumple and release"},
      {.name = "swing",
       .question = "a clamped strip, released: energy lost to friction",
       .run = swing,
       .simulates = true},
      {.name = "compare", .question = "one scene under several laws"},
      {.name = "kes", .question = "virtual KES-FB2 pure bending"},
      {.name = "cantilever", .question = "bending length under own weight (ASTM D1388)"},
      {.name = "buckle", .question = "strip that buckles under its own weight"},
      {.name = "accuracy", .question = "bending elements against closed forms"},
      {.name = "stability", .question = "largest stable steps"},
      {.name = "bench",
       .question = "time and memory of a step: a hanging square, six laws",
       .run = bench,
       .simulates = true},
      {.name = "law",
       .question = "one law alone: curvatures in, moments out (CSV)",
       .run = law,
       .own_keys = law_keys},
      {.name = "fit", .question = "identify a fabric from a measured loop"},
      {.name = "render", .question = "picture of OBJ/PLY sequences", .names = "FILES"},
      {.name = "diff", .question = "compare two pictures", .names = "A.png B.png"},
      {.name = "report",
       .question = "write a run's folder as one page, report.html",
       .run = report,
       .names = "DIR"},
      {.name = "list",
       .question = "what there is: fabrics, laws, scenes, devices",
       .run = list,
       .names = "fabrics|laws|scenes|devices"},
  };
  return all;
}

Setup set_up(const CommandLine& line, Setup setup, const Keys& own) {
  Keys extra = bind_options(setup.options);
  extra.insert(extra.end(), own.begin(), own.end());
  for (const Flag& flag : line.flags) {
    if (flag.path == "scene") setup.options.scene = flag.text;
  }
  if (!setup.options.scene.empty()) apply_scene_file(setup.scene, setup.options.scene, extra);
  apply_flags(setup.scene, line.flags, extra);
  check_scene(setup.scene);
  check_options(setup.options);
  if (setup.options.out.empty()) setup.options.out = "out/" + line.experiment;
  return setup;
}

std::vector<KeyDescription> descriptions(const Keys& keys) {
  std::vector<KeyDescription> result;
  for (const BoundKey& key : keys) result.push_back(key.description);
  return result;
}

}  // namespace hysteron::experiments
