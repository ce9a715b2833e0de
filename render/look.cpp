#include "render/look.h"

#include <string>

#include "sim/base/error.h"

namespace hysteron::render {

namespace {

// Near white stands for values in these looks, so the paper must be darker.
void shade_backdrop(Look& look) { look.backdrop_top = look.backdrop_bottom = {224, 225, 226}; }

}  // namespace

const std::vector<std::string>& look_names() {
  static const std::vector<std::string> kNames = {"cloth",     "grid",       "clay",     "curvature",
                                                  "residual",  "difference", "friction", "height",
                                                  "wireframe", "silhouette"};
  return kNames;
}

Look look_named(std::string_view name) {
  Look look;
  look.backdrop_top = look.backdrop_bottom = {255, 255, 255};
  look.back = {149, 169, 193};
  if (name == "cloth") return look;
  if (name == "grid") {
    look.grid = 0.01f;
  } else if (name == "clay") {
    look.front = look.back = {198, 192, 184};
    look.weave = look.sheen = 0;
  } else if (name == "wireframe") {
    look.show = Show::wireframe;
    look.front = {206, 214, 224};
    look.back = {216, 210, 204};
  } else if (name == "curvature" || name == "residual" || name == "difference") {
    look.show = Show::curvature;
    shade_backdrop(look);
  } else if (name == "friction" || name == "height") {
    look.show = Show::friction;
    look.map = ColorMap::sequential;
    look.value_low = 0;
    shade_backdrop(look);
  } else if (name == "silhouette") {
    look.show = Show::silhouette;
    look.backdrop_top = look.backdrop_bottom = {255, 255, 255};
  } else {
    std::string all;
    for (const std::string& known : look_names()) all += (all.empty() ? "" : ", ") + known;
    throw Error::invalid_input("look = \"" + std::string(name) + "\" is unknown; allowed: " + all);
  }
  return look;
}

}  // namespace hysteron::render
