// The fixed linear map from changes of dihedral angle to curvatures, which distinguishes the bending
// elements.
#pragma once

#include <array>
#include <vector>

#include "sim/bending/choices.h"
#include "sim/mesh/cloth_mesh.h"

namespace hysteron {

// The map is K_i = sum over j of coefficient_ij * (theta_ij - theta0_ij), with D curvature components for
// each element i.  An element is a hinge (D = 1) or a face (D = 3, S = (S_xx, S_yy, sqrt2 S_xy) in the face's
// warp-weft frame).
struct CurvatureOperator {
  int dimension = 1;                // D, 1 or 3
  std::vector<double> area;         // A per element [m^2], times the mesh's bending_factor
  std::vector<double> rest_angle;   // theta0 per hinge [rad]
  Adjacency hinge;                  // rows: elements; items: hinges
  std::vector<double> coefficient;  // D numbers for each item [1/m], component by component within an item
  // This is the same map by columns (rows: hinges; items: elements), so that torques are gathered in a fixed
  // order.
  Adjacency element;
  std::vector<double> transposed;  // D numbers for each item of `element` [1/m]
  // Laws see the geometric curvatures times these factors, D per element, where a fabric bends differently
  // along warp, weft and bias; empty: 1.
  std::vector<double> metric;
  // Elasticity beside the law's, where it differs by direction otherwise than friction does, between moment
  // and curvature behind the metric: a diagonal of D numbers per element [N m]; empty: none.
  std::vector<double> elastic;
  // For hinges of a fabric whose stops differ by direction: u_xx^2 and u_yy^2 of each hinge, u the unit
  // tensor, behind the metric, of a bend across its edge; empty: no law needs it.
  std::vector<double> direction;

  int elements() const { return static_cast<int>(area.size()); }
};

// Makes the chapter's element: K = (theta - theta0)/h, A = |e| h, h the rest average height (Wong et al.
// 2013, Eq. 4.1).
CurvatureOperator make_hinge_operator(const ClothMesh& mesh);

// Makes one curvature tensor per face that reproduces uniform curvature on any mesh.  `held` marks vertices
// fixed for the whole run: a boundary edge between two held vertices is clamped, every other boundary edge is
// free.
CurvatureOperator make_shape_operator(const ClothMesh& mesh, const std::vector<char>& held);

CurvatureOperator make_curvature_operator(BendingElement element, const ClothMesh& mesh,
                                          const std::vector<char>& held);

// Gives the rigidities along weft and bias over that along warp to every law: K' = Q^1/2 K before the law, M
// = Q^1/2 M' after, with the diagonal Q = (1, weft, 2 bias - (1 + weft)/2) of (S_xx, S_yy, sqrt2 S_xy): a
// cylinder whose curved direction n is (n_x, n_y) in the warp-weft frame has rigidity b2 nu(n)^T Q nu(n).
// Along a direction of rigidity q the moments at which friction slides are sqrt(q) times, the curvatures
// 1/sqrt(q) times those along warp.  Needs 4 bias >= 1 + weft.
void stiffen(CurvatureOperator& op, const ClothMesh& mesh, double weft, double bias);

// Makes rigidities have the ratios of another Q': after stiffen() with the Q of friction, the elasticity b2
// [N m] of the elements' law becomes b2 Q'/Q along each direction, in the law's curvatures.  The sum is a
// potential, so that friction's loss stays what it is alone.  Chosen here.
void set_rigidity(CurvatureOperator& op, const ClothMesh& mesh, double b2, DirectionRatios rigidity,
                  DirectionRatios friction);

// Sets the hinges' directions for the same Q: u = Q^1/2 nu(n)/|Q^1/2 nu(n)|, n across the edge.
void set_directions(CurvatureOperator& op, const ClothMesh& mesh, double weft, double bias);

// Returns the rigidity, over that along warp, of a free strip cut at `angle` from warp [rad]: its edges carry
// no moment, so that it bends as the inverse of Q says, 1/(nu^T Q^-1 nu), and off the axes twists as it
// bends.  Along warp and weft it does not twist, and that is nu^T Q nu.
double strip_rigidity(double weft, double bias, double angle);

// Returns the angles of all hinges at the given positions [m], within (-pi, pi].
std::vector<double> hinge_angles(const ClothMesh& mesh, const std::vector<Eigen::Vector3d>& position);

// Returns the vertices p0, p1, p2, p3 of a hinge at rest [m].  Panels that are sewn together lie flat there,
// across a seam as within a panel: side by side, with the middles of the seam's two sides on each other.
std::array<Eigen::Vector3d, 4> rest_hinge(const ClothMesh& mesh, int hinge);
// Returns the angles of all hinges at rest, within (-pi, pi].
std::vector<double> rest_angles(const ClothMesh& mesh);

// Fills element/transposed from hinge/coefficient.
void transpose_rows(CurvatureOperator& op, int hinges);

}  // namespace hysteron
