#include "sim/time/method_choice.h"

#include <algorithm>
#include <cmath>

#include "sim/base/error.h"
#include "sim/linear/elimination.h"
#include "sim/membrane/membrane_nodes.h"

namespace hysteron {

namespace {

// Multiplications of a factorisation for each vertex, up to which it pays (docs/performance.md, "Strips and
// small meshes"): they grow with the square of a strip's width in vertices, not with its length, and a
// multigrid iteration's with neither.
constexpr double kWorkOfVertex = 3e4;
// A GPU's factorisation is the better by so much more of it.
constexpr double kGpuShare = 1.5;
// The same in all, up to which one core keeps up with a GPU, which takes some 2 ms for any step.
constexpr double kCpuWork = 2e6;
// Ordering larger cloths would take seconds.
constexpr int kMaxVertices = 10000;

// By which stiff threads raise it: multigrid then takes more iterations, a factorisation does not.  Seconds
// of multigrid over those of factorisations in `drape --quick`: of 600 triangles 0.66 at 1 kN/m and 1.15 at
// 10, of 1,200 1.13 at 10 and 1.67 at 100, of 2,400 0.57 at 10 and 0.86 at 100.
double stiffness_share(const Fabric& fabric) {
  constexpr double kSoft = 1e3, kPower = 0.35;  // [N/m]
  return std::pow(std::max(1.0, std::max(fabric.warp, fabric.weft) / kSoft), kPower);
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
  const double most = kWorkOfVertex * stiffness_share(scene.fabric) * cloth.mesh.vertices();
  if (choice.gpu && scene.device == DeviceChoice::automatic && work <= std::min(most, kCpuWork)) {
    choice.reason = "device = auto takes the CPU, which is faster than a GPU for so small a cloth";
    choice.gpu = false;
  }
  if (work <= (choice.gpu ? kGpuShare : 1) * most) choice.linear_solver = Preconditioning::cholesky;
  return choice;
}

}  // namespace hysteron
