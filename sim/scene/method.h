// How a scene is simulated: choices with the names of scene files, parsed where flags and files are read.
#pragma once

#include <array>

#include "sim/base/enum_names.h"

namespace hysteron {

// semi_implicit: bending explicit, membrane and contact implicit.  implicit: backward Euler; bdf2: the same
// with second order; tr_bdf2: a trapezoidal stage, then bdf2 over the rest of the step (Bank et al. 1985);
// quasi_static: equilibria; these four have every force at the end of the step or stage.
// explicit_euler: symplectic Euler, every force explicit.
enum class Integrator { semi_implicit, implicit, bdf2, tr_bdf2, quasi_static, explicit_euler };
constexpr std::array<const char*, 6> names(Integrator) {
  return {"semi-implicit", "implicit", "bdf2", "tr-bdf2", "quasi-static", "explicit"};
}

// How often semi_implicit solves: with every substep of bending, or once per step as the chapter has it.
enum class ImplicitEvery { substep, step };
constexpr std::array<const char*, 2> names(ImplicitEvery) { return {"substep", "step"}; }

// Preconditioners of conjugate gradients.  automatic: by the size and shape of the cloth
// (time/method_choice.h); cholesky: a factorisation of the whole matrix, on the CPU.
enum class Preconditioning { automatic, multigrid, cholesky, block_jacobi };
constexpr std::array<const char*, 4> names(Preconditioning) {
  return {"auto", "multigrid", "cholesky", "block-jacobi"};
}

// Where the membrane takes its strains along warp and weft: constant, of each triangle; nodal, what of the
// stiffness is beyond 1 kN/m of their means at nodes (membrane/membrane_nodes.h).
enum class MembraneElement { constant, nodal };
constexpr std::array<const char*, 2> names(MembraneElement) { return {"constant", "nodal"}; }

enum class DeviceChoice { automatic, cpu, cuda };
constexpr std::array<const char*, 3> names(DeviceChoice) { return {"auto", "cpu", "cuda"}; }

// double, float
enum class Precision { fp64, fp32 };
constexpr std::array<const char*, 2> names(Precision) { return {"double", "float"}; }

}  // namespace hysteron
