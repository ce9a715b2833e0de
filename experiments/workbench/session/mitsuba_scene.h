// Writes a picture's scene for the path tracer Mitsuba 3 (Jakob et al. 2022), whose plugins and parameters
// are those of https://mitsuba.readthedocs.io: it adds the last per cent of light that a rasteriser leaves
// out.
#pragma once

#include <string>
#include <vector>

#include "experiments/workbench/pictures/picture_view.h"
#include "render/shapes.h"

namespace hysteron::experiments {

// Returns the XML of a scene: the cloth in the file `cloth`, diffuse on both sides; `bodies`, a file for each
// visible obstacle and "" for others, placed as at `time` [s]; key light, sky and floor of a figure.  The
// ground is the grey floor by whose light cloth is drawn, not the page; where no surface is, the picture is
// transparent.
std::string mitsuba_scene(const PictureView& view, const Scene& scene, double time, const std::string& cloth,
                          const std::vector<std::string>& bodies);

// Writes an obstacle's surface, before it is placed, as a PLY file; it is shrunk as in pictures below cloth
// whose triangles have sides of length `side` [m].  Throws Error::system.
void write_body(const std::string& file, const render::TriangleMesh& body, const render::Look& look,
                float side);

}  // namespace hysteron::experiments
