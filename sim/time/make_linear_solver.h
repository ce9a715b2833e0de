// The scene's linear solver for a device.
#pragma once

#include <memory>

#include "sim/bending/bending_elements.h"
#include "sim/contact/pair_elements.h"
#include "sim/linear/cholesky_solver.h"
#include "sim/linear/multigrid_solver.h"
#include "sim/time/body.h"

namespace hysteron {

template <class Real>
std::unique_ptr<LinearSolver<Real, Cpu>> make_cholesky_solver(const Body<Real, Cpu>& body) {
  std::unique_ptr<ElementStiffness> bending, self_contact;
  if (body.scene.is_implicit()) bending = std::make_unique<BendingElements<Real>>(body.bending);
  if (body.self_contact) self_contact = std::make_unique<PairElements<Real>>(*body.self_contact);
  return std::make_unique<CholeskySolver<Real>>(*body.device, body.matrix, std::move(bending),
                                                std::move(self_contact));
}

// Of a scene whose choice is made (method_choice.h).
template <class Real, class Device>
std::unique_ptr<LinearSolver<Real, Device>> make_linear_solver(const Body<Real, Device>& body) {
  const Scene& scene = body.scene;
  Device& device = *body.device;
  if constexpr (!Device::kGpu)
    if (scene.linear_solver == Preconditioning::cholesky) return make_cholesky_solver(body);
  if (scene.linear_solver == Preconditioning::block_jacobi)
    return std::make_unique<BlockJacobiSolver<Real, Device>>(device, body.vertices);
  const double rigidity = scene.is_implicit() ? body.bending.law().largest_stiffness() : 0;
  return std::make_unique<MultigridSolver<Real, Device>>(
      device, body.cloth.mesh, make_rest_hierarchy(body.cloth.mesh, body.cloth.held(scene, 0)), rigidity);
}

}  // namespace hysteron
