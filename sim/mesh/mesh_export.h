// Meshes in motion for other programs.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "sim/mesh/cloth_mesh.h"

namespace hysteron {

// With fields for ParaView and VTK: a .vtp file per instant, a .pvd file that gives each its time.

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

// The positions as a point cache, which Blender's modifier Mesh Cache and Houdini's node Point Cache play on
// the mesh of an OBJ file.

// Writes the positions [m] of instant 0, 1, ... into a PC2 file, in single precision: instant 0 begins a new
// file, each other one follows the one before it in the file.  A file that is cut short is whole up to its
// last instant.  Throws Error::system.
void write_to_point_cache(const std::string& file, std::size_t instant,
                          const std::vector<Eigen::Vector3d>& position);
// The positions [m] of one instant of such a file, of this machine's.  Throws Error::system for a file that
// cannot be read or does not have that instant.
std::vector<Eigen::Vector3f> read_from_point_cache(const std::string& file, std::size_t instant);

}  // namespace hysteron
