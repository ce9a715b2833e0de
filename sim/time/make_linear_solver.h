// Makes the scene's linear solver for a device.
#pragma once

#include <memory>
#include <type_traits>

#include "sim/bending/assembled_stiffness.h"
#include "sim/bending/bending_elements.h"
#include "sim/linear/dissected_factorisation.h"
#include "sim/linear/float_solver.h"
#include "sim/linear/multigrid_solver.h"
#include "sim/linear/sparse_factorisation.h"
#include "sim/time/body.h"

namespace hysteron {

// Makes a factorisation that suits the device: on a CPU its triangular solves are short, on a GPU its waits.
template <class Real>
std::unique_ptr<Factorisation<Real, Cpu>> make_factorisation(const Body<Real, Cpu>& body) {
  std::unique_ptr<ElementStiffness> bending;
  if (body.scene.is_implicit()) bending = std::make_unique<BendingElements<Real>>(body.bending);
  return std::make_unique<SparseFactorisation<Real>>(*body.device, body.matrix, std::move(bending));
}
template <class Real, class Device>
std::unique_ptr<Factorisation<Real, Device>> make_factorisation(const Body<Real, Device>& body) {
  Device& device = *body.device;
  std::unique_ptr<DefiniteMatrix<Real>> definite = std::make_unique<RowsAlone<Real>>(body.matrix.pattern());
  if (body.scene.is_implicit())
    definite = std::make_unique<AssembledStiffness<Real, Device>>(device, body.matrix, body.bending);
  return std::make_unique<DissectedFactorisation<Real, Device>>(device, std::move(definite));
}

// Makes conjugate gradients in a precision that may differ from the body's.
template <class Real, class BodyReal, class Device>
std::unique_ptr<LinearSolver<Real, Device>> make_gradient_solver(const Body<BodyReal, Device>& body) {
  const Scene& scene = body.scene;
  Device& device = *body.device;
  if (scene.linear_solver == Preconditioning::block_jacobi)
    return std::make_unique<BlockJacobiSolver<Real, Device>>(device, body.vertices);
  const double rigidity = scene.is_implicit() ? body.bending.law().largest_stiffness() : 0;
  return std::make_unique<MultigridSolver<Real, Device>>(
      device, body.cloth.mesh,
      make_rest_hierarchy(body.cloth.mesh, body.matrix.pattern(), body.cloth.held(scene, 0)), rigidity);
}

template <class Device>
std::unique_ptr<LinearSolver<double, Device>> make_float_solver(const Body<double, Device>& body) {
  Device& device = *body.device;
  std::unique_ptr<FloatStiffness<Device>> bending;
  if (body.scene.is_implicit()) bending = std::make_unique<FloatBending<Device>>(device, body.bending);
  return std::make_unique<FloatSolver<Device>>(device, body.matrix, make_gradient_solver<float>(body),
                                               std::move(bending));
}

// Makes the solver of a scene whose method is chosen (method_choice.h).
template <class Real, class Device>
std::unique_ptr<LinearSolver<Real, Device>> make_linear_solver(const Body<Real, Device>& body) {
  if (body.scene.linear_solver == Preconditioning::cholesky)
    return std::make_unique<CholeskySolver<Real, Device>>(*body.device, body.vertices,
                                                          make_factorisation(body));
  if constexpr (std::is_same_v<Real, double>)
    if (body.scene.solves_in_float()) return make_float_solver(body);
  return make_gradient_solver<Real>(body);
}

}  // namespace hysteron
