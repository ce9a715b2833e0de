// A factorisation for CholeskySolver whose solves are products: the fronts of a nested dissection are swept
// level by level (multifrontal: Duff & Reid 1983).  On a GPU a factorisation takes a launch for each tile of
// pivots that follow on one another, and a solve is three loops where the fronts have two levels.
//
// Its numbers are doubles, whatever the precision of the vectors.  All sums have a fixed order.
#pragma once

#include <memory>
#include <optional>

#include "sim/linear/cholesky_solver.h"
#include "sim/linear/front_pairs.h"
#include "sim/linear/front_sweeps.h"

namespace hysteron {

template <class Real, class Device>
class DissectedFactorisation : public Factorisation<Real, Device> {
 public:
  // Without a given shape the fastest one is chosen.
  DissectedFactorisation(Device& device, std::unique_ptr<DefiniteMatrix<Real>> definite,
                         std::optional<DissectionShape> shape = {});

  void renew(const LinearSystem<Real, Device>& system, const char* held) override;
  int refactor_threshold() const override;
  void apply(const Vec3<Real>* r, Vec3<Real>* z, PcgScalars* scalars) override;
  bool in_one_launch(OneLaunchView<Real>& view) override;
  void serialise(Archive& archive, const std::vector<char>& held) override;
  std::size_t bytes() const override;

  const TiledPlan& plan() const { return plan_; }

  // The parts; public because nvcc allows no device lambda in a private member function.
  void take_matrix(const BlockRowsView<Real>& rows);
  void fill(const char* held);
  void extend_add(int level);
  void finish(int level);

 private:
  struct Level {
    Buffer<FrontOfLevel, Device> front;
    Buffer<SweptFront, Device> swept;
    Buffer<RowAbove, Device> above;
    Buffer<SolvedRow, Device> solved;
    int tiles = 0, pivot_tiles = 0;  // largest numbers of a front
    int fronts() const { return static_cast<int>(front.size()); }
    int stride() const { return tiles * kTile; }
    std::size_t bytes() const { return total_bytes(front, swept, above, solved); }
  };

  void take_couplings(SparsityPattern couplings);
  void make_levels(const FrontTables& tables);
  void factorise(const char* held);
  FrontsView<Real> view() const;

  Device& device_;
  std::unique_ptr<DefiniteMatrix<Real>> definite_;
  DissectionShape shape_;
  BlockRows<Real, Device> matrix_;  // the factorised matrix, with the pairs
  FrontPairs<Real, Device> pairs_;
  SparsityPattern couplings_;  // of the plan; pairs that no longer touch stay until others come
  TiledPlan plan_;
  Buffer<double, Device> number_, scratch_, scale_;
  Buffer<int, Device> source_, child_row_;
  Buffer<FrontTerm, Device> term_;
  Buffer<FrontChild, Device> child_;
  Buffer<FrontBlock, Device> block_;
  Buffer<std::size_t, Device> ones_;
  std::vector<Level> level_;
  Buffer<Vec3<Real>, Device> b_;
};

}  // namespace hysteron
