#include "render/look.h"

#include <string>

#include "sim/error.h"

namespace hysteron::render {

Look look_named(std::string_view name) {
  Look look;
  if (name == "cloth") return look;
  if (name == "wireframe") {
    look.show = Show::wireframe;
    look.front = {206, 214, 224};
    look.back = {216, 210, 204};
  } else if (name == "curvature") {
    look.show = Show::curvature;
  } else if (name == "friction") {
    look.show = Show::friction;
    look.map = ColorMap::sequential;
    look.value_low = 0;
  } else if (name == "silhouette") {
    look.show = Show::silhouette;
    look.backdrop_top = look.backdrop_bottom = {255, 255, 255};
  } else {
    throw Error::request("look = \"" + std::string(name) +
                         "\" is unknown; allowed: cloth, curvature, friction, wireframe, silhouette");
  }
  return look;
}

}  // namespace hysteron::render
