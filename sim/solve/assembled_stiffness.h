// The whole matrix of an implicit step, assembled on the host: membrane, masses and contact as they are, and
// bending's Gauss-Newton stiffness J^T C^T (A dM/dK) C J element by element.
#pragma once

#include <Eigen/SparseCore>

#include "sim/bending/bending.h"
#include "sim/device/cpu.h"
#include "sim/solve/block_rows.h"

namespace hysteron {

class AssembledStiffness {
 public:
  AssembledStiffness(const ClothMesh& mesh, const CurvatureOperator& op);

  // Lower triangle, three scalar rows a vertex; rows of held vertices are those of the identity.
  template <class Real>
  const Eigen::SparseMatrix<double>& assemble(Cpu& cpu, const BlockRowsView<Real>& matrix,
                                              const StiffnessView<Real>& bending, const char* held);
  std::size_t bytes() const;

 private:
  template <class Real>
  void compute_gradients(Cpu& cpu, const StiffnessView<Real>& bending);
  template <class Real>
  void fill_column(int v, const BlockRowsView<Real>& matrix, const StiffnessView<Real>& bending,
                   const char* held);
  void build_stencils(const ClothMesh& mesh);
  void build_pattern(const ClothMesh& mesh);
  // Where block (row, column) of the lower triangle begins in the scalar columns: its first row's place.
  void add_block(int column, int place, const Eigen::Matrix3d& block);

  const CurvatureOperator op_;
  std::vector<Eigen::Vector4i> corner_;  // of each hinge
  Adjacency stencil_;                    // rows: elements; items: their vertices, ascending
  std::vector<int> local_;               // 4 per item of op.hinge: position of its corners in the stencil
  Adjacency vertex_stencil_;             // rows: vertices; items: positions in stencil_.item
  std::vector<int> element_of_;          // per item of stencil_
  std::vector<double> gradient_;         // 3 D per item of stencil_: d curvature/d position
  Adjacency lower_;                      // rows: vertices; items: vertices of the lower triangle, without i
  Eigen::SparseMatrix<double> lower_matrix_;
};

}  // namespace hysteron
