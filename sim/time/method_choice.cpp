#include "sim/time/method_choice.h"

#include <algorithm>
#include <cmath>

#include "sim/base/error.h"
#include "sim/linear/elimination.h"
#include "sim/membrane/membrane_nodes.h"

namespace hysteron {

namespace {

// A factorisation pays up to this many multiplications per vertex (docs/performance.md, "Strips and small
// meshes"): they grow with the square of a strip's width in vertices, not with its length; a multigrid
// iteration's grow with neither.
constexpr double kWorkOfVertex = 3e4, kSoft = 1e3;  // kSoft: threads for which that holds [N/m]
// The same holds on a GPU for all threads softer than 10 kN/m; stiffer ones raise it as below.  Measured on
// an H200 with 10 kN/m, multigrid's time of a step over the factorisation's is 1.4, 1.8 and 5.5 for creases
// of 480, 1,600 and 4,000 triangles, 1.2 and 1.0 for folds of 2,496 and 4,992, and 1.1, 0.73 and 0.46 for
// squares of 1,000, 2,000 and 4,608; with 1 kN/m 1.4, 1.8 and 3.9; 1.3 and 1.1; 0.82, 0.72 and 0.43.
constexpr double kGpuWorkOfVertex = 5.8e4, kGpuStiff = 1e4;  // kGpuStiff [N/m]
// Up to this many multiplications in all, one core keeps up with a GPU, which takes some 2 ms for any step.
constexpr double kCpuWork = 2e6;
// Larger cloths would take seconds to order.
constexpr int kMaxVertices = 10000;

// Returns the factor by which threads stiffer than `soft` [N/m] raise that limit: multigrid then takes more
// iterations, a factorisation does not.  Measured in `drape --quick`, seconds of multigrid over those of
// factorisations: for 600 triangles 0.66 at 1 kN/m and 1.15 at 10, for 1,200 1.13 at 10 and 1.67 at 100, for
// 2,400 0.57 at 10 and 0.86 at 100.
double stiffness_share(const Fabric& fabric, double soft) {
  constexpr double kPower = 0.35;
  return std::pow(std::max(1.0, std::max(fabric.warp, fabric.weft) / soft), kPower);
}

bool solves_with_newton(const Scene& scene) {
  return scene.is_implicit() || (scene.self_contact && scene.integrator == Integrator::semi_implicit);
}

}  // namespace

double factorisation_work(const ClothMesh& mesh, const Adjacency& couplings, const CurvatureOperator& op) {
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
  return plan_elimination(list.take()).multiplications;
}

MethodChoice choose_method(const Scene& scene, const Cloth& cloth, const CurvatureOperator& op, int gpus) {
  MethodChoice choice;
  choice.gpu = scene.device != DeviceChoice::cpu && gpus > 0;
  if (!solves_with_newton(scene)) return choice;
  choice.linear_solver = scene.linear_solver;
  choice.in_float = scene.solves_in_float();
  if (scene.linear_solver == Preconditioning::cholesky && choice.in_float)
    throw Error::invalid_input(
        "linear-precision = float is of conjugate gradients: linear-solver = cholesky must be auto, "
        "multigrid or block-jacobi");
  if (scene.linear_solver != Preconditioning::automatic) return choice;
  choice.linear_solver = Preconditioning::multigrid;
  if (choice.in_float || cloth.mesh.vertices() > kMaxVertices) return choice;
  const double work = factorisation_work(
      cloth.mesh, membrane_couplings(cloth.mesh, scene.fabric, scene.membrane_element), op);
  const double most = kWorkOfVertex * stiffness_share(scene.fabric, kSoft) * cloth.mesh.vertices();
  if (choice.gpu && scene.device == DeviceChoice::automatic && work <= std::min(most, kCpuWork)) {
    choice.reason = "device = auto takes the CPU, which is faster than a GPU for so small a cloth";
    choice.gpu = false;
  }
  const double most_of_gpu =
      kGpuWorkOfVertex * stiffness_share(scene.fabric, kGpuStiff) * cloth.mesh.vertices();
  if (work <= (choice.gpu ? most_of_gpu : most)) choice.linear_solver = Preconditioning::cholesky;
  return choice;
}

}  // namespace hysteron
