// Exports meshes in motion for other programs.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "sim/mesh/cloth_mesh.h"

namespace hysteron {

// ParaView and VTK read meshes with fields: a .vtp file per instant, and a .pvd file that gives each its
// time.

// The values of one field, `components` per vertex or per face.
struct VtkField {
  std::string name;
  int components;
  std::vector<double> values;
};

// Writes PolyData in VTK's XML format: positions [m] and values as raw little-endian numbers behind the
// header, in double precision.  Throws Error::invalid_input where a field has not one value for each vertex
// or face, Error::system where the file cannot be written.
void write_vtp(const std::string& file, const ClothMesh& mesh, const std::vector<Eigen::Vector3d>& position,
               const std::vector<VtkField>& of_vertices, const std::vector<VtkField>& of_faces);

// Writes the names of .vtp files beside it with their times [s].
void write_pvd(const std::string& file, const std::vector<std::pair<double, std::string>>& instants);

// A point cache has the positions alone; Blender's modifier Mesh Cache and Houdini's node Point Cache play it
// on the mesh of an OBJ file.

// Writes the positions [m] of instant 0, 1, ... into a PC2 file, in single precision: instant 0 begins a new
// file, each other one follows the one before it in the file.  A file that is cut short is whole up to its
// last instant.  Throws Error::system.
void write_to_point_cache(const std::string& file, std::size_t instant,
                          const std::vector<Eigen::Vector3d>& position);
// Returns the positions [m] of one instant of such a file, written on a machine like this.  Throws
// Error::system for a file that cannot be read or lacks that instant.
std::vector<Eigen::Vector3f> read_from_point_cache(const std::string& file, std::size_t instant);

}  // namespace hysteron
