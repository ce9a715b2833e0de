// The scene's linear solver for a device.
#pragma once

#include <memory>

#include "sim/linear/multigrid_solver.h"
#include "sim/scene/cloth.h"

namespace hysteron {

// rigidity: the largest slope of the bending law [N m].
template <class Real, class Device>
std::unique_ptr<LinearSolver<Real, Device>> make_linear_solver(Device& device, const Scene& scene,
                                                               const Cloth& cloth, double rigidity) {
  if (scene.linear_solver == Preconditioning::block_jacobi)
    return std::make_unique<BlockJacobiSolver<Real, Device>>(device, cloth.mesh.vertices());
  return std::make_unique<MultigridSolver<Real, Device>>(
      device, cloth.mesh, make_rest_hierarchy(cloth.mesh, cloth.held(scene, 0)), rigidity);
}

}  // namespace hysteron
