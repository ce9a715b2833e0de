// Chooses the device of a scene and how its linear systems are solved, where the scene leaves that open.
#pragma once

#include <string>

#include "sim/bending/curvature_operator.h"
#include "sim/scene/cloth.h"

namespace hysteron {

struct MethodChoice {
  bool gpu = false;
  // The solver of Newton's linear systems; automatic: the integrator solves none.
  Preconditioning linear_solver = Preconditioning::automatic;
  bool in_float = false;    // solves its systems in float, in a scene of double precision
  std::string reason = {};  // why the CPU is taken where there is a GPU; empty: the user chose
};

// Chooses among `gpus` GPUs and the CPU.  Throws Error::invalid_input where a GPU is asked for what it cannot
// do.
MethodChoice choose_method(const Scene& scene, const Cloth& cloth, const CurvatureOperator& op, int gpus);

// Returns the number of multiplications of a Cholesky factorisation of the matrix, whose off-diagonal blocks
// beside bending's are `couplings`.
double factorisation_work(const ClothMesh& mesh, const Adjacency& couplings, const CurvatureOperator& op);

}  // namespace hysteron
