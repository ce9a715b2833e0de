#include "sim/time/method_choice.h"

#include <algorithm>
#include <cmath>

#include "sim/base/error.h"
#include "sim/linear/dissection.h"
#include "sim/membrane/membrane_nodes.h"

namespace hysteron {

namespace {

// Multiplications of a factorisation for each vertex, up to which it pays (docs/performance.md, "Strips and
// small meshes"): they grow with the square of a strip's width in vertices, not with its length, and a
// multigrid iteration's with neither.
constexpr double kWorkOfVertex = 3e4;
// The same in all, up to which one core keeps up with a GPU, which takes some 10 ms for any step.
constexpr double kCpuWork = 5e7;
// Ordering larger cloths would take seconds.
constexpr int kMaxVertices = 10000;

// By which stiff threads raise it: multigrid then takes more iterations, a factorisation does not.  Seconds
// of multigrid over those of factorisations in `drape --quick` of 2,400 and 6,000 triangles: 0.66 and 0.52 at
// 1 kN/m, 0.68 and 1.09 at 10 kN/m, 1.39 and 2.06 at 100 kN/m.
double stiffness_share(const Fabric& fabric) {
  constexpr double kSoft = 1e3, kPower = 0.6;  // [N/m]
  return std::pow(std::max(1.0, std::max(fabric.warp, fabric.weft) / kSoft), kPower);
}

// Whether linear-solver = auto factorises on a GPU where that pays on the CPU, too, and what its
// factorisation may take there [us].
constexpr bool kFactorisesOnGpu = false;
constexpr double kGpuRenewal = 500;

// Of the matrix whose off-diagonal blocks beside bending's are `couplings`.
Couplings couplings_of(const ClothMesh& mesh, const Adjacency& couplings, const CurvatureOperator& op) {
  CouplingList list(couplings);
  for (int e = 0; e < op.elements(); ++e) {
    std::vector<int> vertices;
    for (int j = op.hinge.start[e]; j < op.hinge.start[e + 1]; ++j) {
      const Edge& edge = mesh.edge[op.hinge.item[j]];
      vertices.insert(vertices.end(), {edge.p0, edge.p1, edge.p2, edge.p3});
    }
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    list.add(vertices);
  }
  return list.take();
}

bool solves_with_newton(const Scene& scene) {
  return scene.is_implicit() || (scene.self_contact && scene.integrator == Integrator::semi_implicit);
}

// As the scene asks.
void take_factorisation(const Scene& scene, MethodChoice& choice) {
  if (choice.in_float)
    throw Error::invalid_input(
        "linear-precision = float is of conjugate gradients: linear-solver = cholesky must be auto, "
        "multigrid or block-jacobi");
  if (!choice.gpu || scene.device != DeviceChoice::automatic) return;
  choice.reason = "device = auto takes the CPU for linear-solver = cholesky";
  choice.gpu = false;
}

}  // namespace

double factorisation_work(const ClothMesh& mesh, const Adjacency& couplings, const CurvatureOperator& op) {
  return plan_elimination(couplings_of(mesh, couplings, op)).multiplications;
}

MethodChoice choose_method(const Scene& scene, const Cloth& cloth, const CurvatureOperator& op, int gpus) {
  MethodChoice choice;
  choice.gpu = scene.device != DeviceChoice::cpu && gpus > 0;
  if (!solves_with_newton(scene)) return choice;
  choice.linear_solver = scene.linear_solver;
  choice.in_float = scene.solves_in_float();
  if (scene.linear_solver == Preconditioning::cholesky) take_factorisation(scene, choice);
  if (scene.linear_solver != Preconditioning::automatic) return choice;
  choice.linear_solver = Preconditioning::multigrid;
  const bool may_take_cpu = scene.device != DeviceChoice::cuda,
             may_factorise = !choice.in_float && cloth.mesh.vertices() <= kMaxVertices;
  if (!may_factorise || !(may_take_cpu || kFactorisesOnGpu)) return choice;
  const Couplings couplings =
      couplings_of(cloth.mesh, membrane_couplings(cloth.mesh, scene.fabric, scene.membrane_element), op);
  const double work = plan_elimination(couplings).multiplications;
  if (work > kWorkOfVertex * stiffness_share(scene.fabric) * cloth.mesh.vertices()) return choice;
  if (!choice.gpu || (may_take_cpu && work <= kCpuWork)) {
    choice.linear_solver = Preconditioning::cholesky;
    if (choice.gpu)
      choice.reason = "device = auto takes the CPU, which is faster than a GPU for so small a cloth";
    choice.gpu = false;
  } else if (kFactorisesOnGpu &&
             plan_dissection(couplings, choose_shape(couplings)).cost.renewal <= kGpuRenewal) {
    choice.linear_solver = Preconditioning::cholesky;
  }
  return choice;
}

}  // namespace hysteron
