// A fabric's file may state how the fabric looks, which has no physical effect:
//
//   [look]
//   colour = [46, 58, 92]     of the front, sRGB
//   back = [120, 128, 150]    optional: of the back; else the same hue, lighter
//   weave = "twill"           plain | twill | satin | knit
//   threads = [28, 20]        of warp and weft, or wales and courses [1/cm]
//   sheen = 0.1               of fibres that stand off, 0 to 1
//   source = "assumed"        origin of this table
#pragma once

#include <string>

#include "render/look.h"

namespace hysteron::experiments {

// Returns `look` in the colours and weave of a fabric of assets/fabrics or a file; looks that show something
// else than cloth, and fabrics without [look], change nothing.  Throws Error::invalid_input with file and
// line for an unknown key or a value out of range.
render::Look apply_fabric_look(render::Look look, const std::string& fabric);

}  // namespace hysteron::experiments
