// This header tries a membrane on its mesh at positions: energy, forces, and its matrix as a dense one.
#pragma once

#include <numeric>
#include <vector>

#include "sim/membrane/membrane.h"

namespace hysteron::test {

struct Sheet {
  using Positions = std::vector<Eigen::Vector3d>;

  ClothMesh mesh;
  Fabric fabric;
  Cpu cpu{1};
  BlockRows<double, Cpu> rows;
  Membrane<double, Cpu> membrane;

  Sheet(const ClothMesh& of, const Fabric& with, MembraneElement element = MembraneElement::nodal)
      : mesh(of),
        fabric(with),
        rows(cpu, membrane_couplings(mesh, fabric, element)),
        membrane(cpu, mesh, fabric, element, rows) {}

  void try_at(const Positions& x) {
    membrane.begin_step(StepFormula::statics(1), x.data(), nullptr);
    membrane.evaluate(x.data());
  }
  double energy() const {
    return std::accumulate(membrane.energies(), membrane.energies() + membrane.energies_count(), 0.0);
  }
  Positions forces() const {
    Positions f;
    for (int i = 0; i < mesh.vertices(); ++i) f.push_back(membrane.forces().at(i));
    return f;
  }
  Eigen::MatrixXd matrix() {
    membrane.assemble(1, 1, rows.view());  // stops count by the second factor; at rest there is no tension
    const int n = mesh.vertices();
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(3 * n, 3 * n);
    for (int i = 0; i < n; ++i) {
      all.block<3, 3>(3 * i, 3 * i) = rows.view().diagonal[i];
      for (int j = rows.row_ptr()[i]; j < rows.row_ptr()[i + 1]; ++j)
        all.block<3, 3>(3 * i, 3 * rows.col()[j]) = rows.view().off_diagonal[j];
    }
    return all;
  }
};

}  // namespace hysteron::test
