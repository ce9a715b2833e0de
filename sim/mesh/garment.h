// Reads garments: OBJs whose vertices give the start of a cloth, and other data its rest shape.
#pragma once

#include <string>
#include <vector>

#include "sim/mesh/cloth_mesh.h"

namespace hysteron {

// Reads the cloth of an OBJ whose rest shape is its texture coordinates, `scale` metres per unit.  Where each
// vertex has one, the cloth is flat in z = 0.  Where vertices on seams have several, the islands of the
// texture are panels sewn together (ClothMesh::sewn), `rest` is the OBJ's vertices (in `unit`), and an island
// may be mirrored as a whole.  Throws as read_obj does, which takes `unit` and `warnings`, and
// Error::invalid_input where a corner has none, a triangle is turned over against its neighbours or has no
// area there, or the OBJ's triangles are more than twice or less than half as long.
ClothMesh read_pattern(const std::string& file, double weld, double scale,
                       LengthUnit unit = LengthUnit::metre, std::vector<std::string>* warnings = nullptr);

// Does an interior edge join two panels, or two sides of one?
bool is_seam(const ClothMesh& mesh, int edge);

// Returns the OBJ's vertices [m]; its triangles must be those of `mesh`.  Throws as read_obj does, and
// Error::invalid_input for other triangles, and where they are more than twice or less than half as long.
std::vector<Eigen::Vector3d> read_start(const std::string& file, double weld, const ClothMesh& mesh,
                                        LengthUnit unit = LengthUnit::metre);

}  // namespace hysteron
