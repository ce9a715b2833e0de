// The numbers of a PLY file, read by CGAL.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "sim/mesh/ply_header.h"

namespace hysteron {

struct PlyContent {
  std::vector<Eigen::Vector3d> vertex;
  std::vector<double> curvature;                // per vertex; empty: not in the file
  std::vector<std::vector<std::int64_t>> face;  // vertices of each polygon, unchecked
};

// `text` is the file with that header, which has the elements and types that `read_ply` asks for.  Throws
// Error::request, beginning with `what`, where the content does not fit the header.
PlyContent read_ply_content(const std::string& text, const PlyHeader& header, const std::string& what);

}  // namespace hysteron
