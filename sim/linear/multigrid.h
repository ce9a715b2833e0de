// Preconditions the implicit solve by inverted diagonal blocks plus multigrid on the rest shape's coarser
// levels.
//
//   P r = w D^-1 r + I V(I^T r)      D   diagonal blocks, bending included;  I  interpolation from level 1
//                                    V   one V(2,2)-cycle on levels 1, 2, ... with damped block-Jacobi
//   A_1 = I^T A I + bending S_1 x 1  A   mass, membrane and contact;  S  the plates of RestHierarchy
//   A_l+1 = I_l^T A_l I_l            less half of the plate; down to what the device inverts densely
//
// The membrane couples the whole cloth within a step, so that conjugate gradients with D alone take
// iterations in proportion to the number of vertices along a side; with P their number hardly grows.  The
// finest level is smoothed additively (Bramble, Pasciak, Xu 1990): that saves products with the bending
// operator, whose rows are by far the longest.  Bending acts on the coarse levels as an isotropic plate at
// rest: exact for flat cloth, and elsewhere too small beside the membrane to matter.
#pragma once

#include <optional>
#include <vector>

#include "sim/linear/dense_inverse.h"

namespace hysteron {

template <class Real, class Device>
class Multigrid : public Preconditioner<Real, Device> {
 public:
  Multigrid(Device& device, const ClothMesh& mesh, const RestHierarchy& hierarchy);

  // Follows a new linearisation, in the matrix's units:
  //   matrix            mass, membrane and contact; only read now
  //   bending_diagonal  n diagonal blocks of the bending stiffness, at least those of the hinges; null: none
  //   bending           rigidity in the matrix's units: b1 for mass/step^2 + stiffness
  //   held              n flags of rows that apply() leaves zero; read by apply() too
  void rebuild(BlockRowsView<Real> matrix, const Mat3<Real>* bending_diagonal, Real bending,
               const char* held);
  // Renews the finest level and keeps the coarse levels of the last rebuild(), which held the same rows.
  void renew_finest(BlockRowsView<Real> matrix, const Mat3<Real>* bending_diagonal) {
    invert_diagonal(matrix, bending_diagonal, held_, inverse_.data());
  }
  void apply(const Vec3<Real>* r, Vec3<Real>* z, PcgScalars* scalars = nullptr) override;
  bool step_and_apply(const Advance<Real>& step, Vec3<Real>* z, PcgScalars* scalars) override;
  // Returns the number of iterations that take about as long as new coarse levels.
  double refactor_threshold() const { return 2 + (dense_ ? dense_->refactor_threshold() : 0); }
  bool in_one_launch(OneLaunchView<Real>& view) override;
  std::size_t bytes() const override;
  int levels() const { return 1 + coarse(); }

  // The parts of the above; public because nvcc allows no device lambda in a private member function.
  void invert_diagonal(BlockRowsView<Real> matrix, const Mat3<Real>* added, const char* held,
                       Mat3<Real>* inverse);
  void find_eigenvalue(CoarseLevel<Real, Device>& level);
  void combine(const Combination<Real>& combination, PcgScalars* scalars);

 private:
  Combination<Real> combination(const Vec3<Real>* r, Vec3<Real>* z, const PcgScalars* scalars) const;
  int coarse() const { return static_cast<int>(level_.size()); }  // number of coarse levels
  int swept() const { return coarse() - (dense_ ? 1 : 0); }
  template <class Vector>
  void descend(const Vector& residual, const PcgScalars* scalars);
  void ascend(const PcgScalars* scalars);
  // Views for one launch.
  bool has_view_from(int first) const;
  CycleView<Real> view_from(int first);
  // Makes the coarse matrix from that of the next finer level, and a plate of that rigidity; held may be
  // null.
  void coarsen(BlockRowsView<Real> finer, const char* held, Real rigidity, CoarseLevel<Real, Device>& level);
  void sweep(CoarseLevel<Real, Device>& level, const int* stop);  // sweeps twice, from y to y

  Device& device_;
  int vertices_;
  const char* held_ = nullptr;
  Buffer<Mat3<Real>, Device> inverse_;
  std::vector<CoarseLevel<Real, Device>> level_;
  std::optional<DenseInverse<Real, Device>> dense_;  // of the last level; none: it is swept like the others
};

}  // namespace hysteron
