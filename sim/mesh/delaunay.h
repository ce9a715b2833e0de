// The Delaunay triangulation of points in the plane.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace hysteron {

// Returns counter-clockwise triangles of the Delaunay triangulation of distinct points that are not all on
// one line.  The points are rounded to a grid of 2^28 steps across their extent and the predicates are exact
// there, so that the result has no rounding failures and is the same on every machine.  The convex hull is
// filled.  Points on a straight side of the hull become its vertices.
std::vector<Eigen::Vector3i> delaunay(const std::vector<Eigen::Vector2d>& points);

}  // namespace hysteron
