// Meshes with fields for ParaView and VTK: a .vtp file per instant, a .pvd file that gives each its time.
#pragma once

#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

#include "sim/mesh/cloth_mesh.h"

namespace hysteron {

// Values of one field, `components` per vertex or per face.
struct VtkField {
  std::string name;
  int components;
  std::vector<double> values;
};

// PolyData in VTK's XML format: positions [m] and values as raw little-endian numbers behind the header, in
// double precision.  Throws Error::invalid_input where a field has not one value for each vertex or face,
// Error::system where the file cannot be written.
void write_vtp(const std::string& file, const ClothMesh& mesh, const std::vector<Eigen::Vector3d>& position,
               const std::vector<VtkField>& of_vertices, const std::vector<VtkField>& of_faces);

// Names of .vtp files beside it with their times [s].
void write_pvd(const std::string& file, const std::vector<std::pair<double, std::string>>& instants);

}  // namespace hysteron
