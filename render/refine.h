// Finer triangles for what is computed vertex by vertex.
#pragma once

#include "render/shapes.h"

namespace hysteron::render {

// The same surface with no side longer than `longest` [m]: longer ones are halved until none is left, on both
// sides of a side alike, so that nothing gapes.  Normals of new vertices lie between those of a side's ends.
// Error::request if `longest` is not positive.
TriangleMesh refined(TriangleMesh mesh, float longest);

}  // namespace hysteron::render
