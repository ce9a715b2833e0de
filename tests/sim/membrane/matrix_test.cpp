// These tests check the membrane's matrix of a whole cloth.
#include <gtest/gtest.h>

#include <random>

#include "sim/membrane/membrane.h"
#include "tests/sim/time/scenes.h"

namespace hysteron {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kFactor = 1.3, kGeometric = 0.7;

struct Crumpled {
  test::Trial trial{test::hanging_square(300)};
  Cpu cpu{1};
  BlockRows<double, Cpu> rows{cpu, trial.cloth.mesh};
  Membrane<double, Cpu> membrane{cpu, trial.cloth.mesh, trial.scene.fabric, MembraneElement::constant, rows};
  test::Positions x = trial.cloth.mesh.rest;

  Crumpled() {
    std::mt19937 generator(5);
    std::uniform_real_distribution<double> uniform(-1e-3, 1e-3);
    for (Vector3d& p : x) p += Vector3d(uniform(generator), uniform(generator), uniform(generator));
    membrane.update(x.data(), test::Positions(x.size(), Vector3d::Zero()).data());
  }

  // Returns the matrix triangle by triangle: off the diagonal, then on it.
  std::vector<Matrix3d> expected() const {
    const ClothMesh& mesh = trial.cloth.mesh;
    const Fabric& fabric = trial.scene.fabric;
    const MembraneStiffness<double> c{fabric.warp, fabric.weft, fabric.coupling, fabric.shear};
    const std::vector<MembraneRest<double>> rest = membrane_rest(mesh);
    const std::size_t off_diagonal = rows.col().size();
    std::vector<Matrix3d> blocks(off_diagonal + x.size(), Matrix3d::Zero());
    for (int f = 0; f < mesh.faces(); ++f) {
      const auto& t = mesh.face[f];
      const Deformation<double> d = deformation(rest[f], x[t[0]], x[t[1]], x[t[2]]);
      MembraneStress<double> s = tensile_part(membrane_stress(c, green_strain(d)));
      s = {kGeometric * s.s11, kGeometric * s.s22, kGeometric * s.s12};
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          blocks[i == j ? off_diagonal + t[i] : rows.slot(t[i], t[j])] +=
              membrane_block(rest[f], c, kFactor, d, s, i, j);
    }
    return blocks;
  }

  std::vector<Matrix3d> assembled() const {
    std::vector<Matrix3d> blocks = rows.off_diagonal();
    for (const Matrix3d& block : rows.diagonal()) blocks.push_back(block);
    return blocks;
  }
};

// Each block adds what its triangles give in their order, whoever does the adding: the same bits.
TEST(MembraneMatrix, IsTheSumOfItsTrianglesGatheredByBlocksAndByColumns) {
  Crumpled by_blocks, by_columns;
  by_blocks.membrane.assemble_blocks(kFactor, kGeometric, by_blocks.rows.view());
  by_columns.membrane.assemble_columns(kFactor, kGeometric, by_columns.rows.view());
  EXPECT_GT(by_blocks.assembled()[0].norm(), 0);
  EXPECT_EQ(by_blocks.assembled(), by_blocks.expected());
  EXPECT_EQ(by_columns.assembled(), by_blocks.expected());
}

// A rigid motion of the cloth meets no force: rows of the Gauss-Newton part sum to zero.
TEST(MembraneMatrix, HasRowsThatSumToZero) {
  constexpr double kRounding = 1e-11;  // of sums of some ten blocks
  Crumpled cloth;
  cloth.membrane.assemble(kFactor, kGeometric, cloth.rows.view());
  const std::vector<Matrix3d> off_diagonal = cloth.rows.off_diagonal(), diagonal = cloth.rows.diagonal();
  const std::vector<int>& start = cloth.rows.row_ptr();
  for (std::size_t v = 0; v < diagonal.size(); ++v) {
    Matrix3d sum = diagonal[v];
    for (int j = start[v]; j < start[v + 1]; ++j) sum += off_diagonal[j];
    EXPECT_LT(sum.norm(), kRounding * diagonal[v].norm()) << "row " << v;
  }
}

}  // namespace
}  // namespace hysteron
