// On which device a scene runs and how its linear systems are solved, where the scene leaves that open.
#pragma once

#include <string>

#include "sim/bending/curvature_operator.h"
#include "sim/scene/cloth.h"

namespace hysteron {

struct MethodChoice {
  bool gpu = false;
  // Of Newton's method; automatic: the integrator does without.
  Preconditioning linear_solver = Preconditioning::automatic;
  bool in_float = false;    // its systems, in a scene of double precision
  std::string reason = {};  // why the CPU where there is a GPU; empty: no choice of ours
};

// `gpus`: how many there are.  Error::invalid_input where a GPU is asked for what it cannot do.
MethodChoice choose_method(const Scene& scene, const Cloth& cloth, const CurvatureOperator& op, int gpus);

// Multiplications of a Cholesky factorisation of the matrix, whose off-diagonal blocks beside bending's are
// `couplings`.
double factorisation_work(const ClothMesh& mesh, const Adjacency& couplings, const CurvatureOperator& op);

}  // namespace hysteron
