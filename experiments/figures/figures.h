// Draws the chapter's moment-curvature figures, computed with the program's own laws.
#pragma once

#include <string>
#include <vector>

#include "render/plot.h"
#include "sim/scene/scene.h"

namespace hysteron::experiments {

struct Figure {
  std::string name;     // name of the files: "figure-4-3"
  std::string caption;  // says what is drawn, and where the chapter's text cannot hold as printed
  render::Plot plot;    // series' labels name the curves; marks carry the chapter's letters
  std::string columns = "curvature [1/m],moment [mN]";  // columns of its CSV file
};

// Returns Figures 4.2(a), 4.2(b), the stiffness of Eq. 4.3, Figures 4.3, 4.4(a), (b), (c), (d).  Moments are
// in mN, curvatures in 1/m.  Throws Error::invalid_input for a fabric without friction (b1 = b2), which has
// no loop, or without b2, which has no residual curvature to draw.
std::vector<Figure> chapter_figures(const Fabric& fabric);

}  // namespace hysteron::experiments
