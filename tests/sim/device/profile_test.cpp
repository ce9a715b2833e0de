// The profile of a step: as many calls as there are launches, and bytes that follow from the cloth's size.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/sim/bending/coupled_pairs.h"
#include "tests/sim/device/on_each_device.h"
#include "tests/sim/time/scenes.h"

namespace hysteron {
namespace {

constexpr int kProfiledSteps = 4;
constexpr double kVector = 3 * sizeof(double), kBlock = 9 * sizeof(double);

// Returns a square that hangs by two corners.
Scene hanging(const char* integrator, const char* device) {
  Scene scene = test::hanging_square();
  scene.law = "prandtl";
  scene.integrator = value_named<Integrator>(integrator);
  scene.device = value_named<DeviceChoice>(device);
  if (scene.is_implicit()) scene.step = 5e-3;
  return scene;
}

struct Profile {
  KernelCosts costs;
  DeviceCounts work;
  long newton = 0;
  ClothMesh mesh;
};

Profile kernel_profile(const Scene& scene) {
  const test::Trial trial(scene);
  const auto simulation = trial.after(1);  // scratch is allocated
  EXPECT_TRUE(simulation->kernel_costs().empty());
  simulation->profile();
  const DeviceCounts before = simulation->counts().device;
  const long newton = simulation->counts().newton;
  simulation->advance(kProfiledSteps);
  return {simulation->kernel_costs(), simulation->counts().device - before,
          simulation->counts().newton - newton, trial.cloth.mesh};
}

class ProfileOfSteps : public test::OnEachDevice {};
INSTANTIATE_TEST_SUITE_P(Devices, ProfileOfSteps, testing::Values("cpu", "cuda"), test::CaseName());

TEST_P(ProfileOfSteps, CountsEveryLaunchOnce) {
  for (const char* integrator : {"explicit", "semi-implicit", "implicit"}) {
    const Profile profile = kernel_profile(hanging(integrator, GetParam()));
    long calls = 0;
    for (const auto& [name, cost] : profile.costs) {
      calls += cost.calls;
      EXPECT_GT(cost.seconds, 0) << name;
    }
    EXPECT_GT(calls, 0);
    EXPECT_EQ(calls, profile.work.loops) << integrator;
  }
}

// Arrays of the cloth's size, each once: positions and direction read, trial written; all blocks of the
// matrix written, and of each triangle its rest shape (7 numbers), deformation (6) and tension (3) read, with
// the two terms of a block off the diagonal and the corners of a block on it.
TEST_P(ProfileOfSteps, StatesTheBytesOfArraysReadAndWrittenOnce) {
  const Profile profile = kernel_profile(hanging("implicit", GetParam()));
  const double vertices = profile.mesh.vertices(), faces = profile.mesh.faces(),
               edges = static_cast<double>(profile.mesh.edge.size());
  const auto bytes = [&](const char* name) {
    const KernelCost& cost = profile.costs.at(name);
    return cost.bytes / static_cast<double>(cost.calls);
  };
  EXPECT_EQ(bytes("newton: try"), 3 * vertices * kVector);
  EXPECT_EQ(bytes("membrane matrix"), (2 * edges + vertices) * kBlock + faces * 16 * sizeof(double) +
                                          sizeof(int) * (4 * edges + vertices + 1 + 3 * faces));
}

// Indices stay as they are: of blocks and, where bending is not among them as on a GPU, of its forces.
TEST_P(ProfileOfSteps, HalvesTheNumbersThatAProductReadsInFloat) {
  Scene scene = hanging("implicit", GetParam());
  scene.linear_solver = Preconditioning::multigrid;
  scene.tuning.full_stiffness = 0;  // no softening
  const auto product = [&](Precision precision) {
    scene.linear_precision = precision;
    const Profile profile = kernel_profile(scene);
    const KernelCost& cost = profile.costs.at("solve: product");
    return cost.bytes / static_cast<double>(cost.calls);
  };
  const Cloth cloth = test::Trial(scene).cloth;
  const ClothMesh& mesh = cloth.mesh;
  const std::size_t pairs =
      test::coupled_pairs(mesh, make_curvature_operator(scene.element, mesh, cloth.held(scene, 0)));
  const double rows = mesh.vertices() + 1, edges = static_cast<double>(mesh.edge.size());
  const double numbers =
      on_gpu() ? rows + static_cast<double>(pairs) : rows + 2 * edges + rows + 4 * mesh.interior_edges;
  EXPECT_EQ(2 * product(Precision::fp32) - product(Precision::fp64), sizeof(int) * numbers);
}

// The guess, at constant velocity and with the last acceleration, and one trial per iteration where none is
// shortened; nothing is evaluated again where it was evaluated last.
TEST_P(ProfileOfSteps, EvaluatesThePotentialOncePerTrial) {
  const Profile profile = kernel_profile(hanging("implicit", GetParam()));
  const long evaluated = profile.costs.at("membrane stress, tried").calls,
             tried = profile.costs.at("newton: try").calls;
  EXPECT_GE(profile.newton, kProfiledSteps);
  EXPECT_GE(tried, profile.newton);
  EXPECT_GE(evaluated, 2 * kProfiledSteps + tried);
  EXPECT_LE(evaluated, 3 * kProfiledSteps + tried);  // the first guess is taken up again where it was better
}

// Newton's method may launch, without the linear solver's own and the three of each product of bending,
//   6 per evaluation   membrane, angles, law, forces of bending, forces on vertices, sums
//   7 per iteration    matrix, softening, tangents, masses, stiffness of hinges, diagonal, correction
//   2 more on a GPU    which assembles the matrix: rates of vertices, blocks
//   1 per trial
//   12 per step        start, references of both rates, three guesses, history, losses, ledger, end, finite
TEST_P(ProfileOfSteps, LaunchesNoMoreThanItsPartsNeed) {
  const Profile profile = kernel_profile(hanging("implicit", GetParam()));
  const auto calls = [&](const char* name) { return profile.costs.at(name).calls; };
  long own = on_gpu() ? 0 : -3 * calls("bending stiffness");
  for (const auto& [name, cost] : profile.costs)
    if (!name.starts_with("solve: ") && !name.starts_with("multigrid: ") && !name.starts_with("fronts: "))
      own += cost.calls;
  EXPECT_GT(own, 0);
  EXPECT_LE(own, 6 * calls("membrane stress, tried") + (on_gpu() ? 9 : 7) * profile.newton +
                     calls("newton: try") + 12 * kProfiledSteps);
  EXPECT_EQ(profile.work.allocations, 0);
}

// Neither obstacles nor layers, no history, no damping: none of their loops runs.
TEST_P(ProfileOfSteps, HasNoLoopOfAPartThatTheSceneLacks) {
  Scene plain = hanging("implicit", GetParam());
  plain.law = "linear";
  plain.fabric.damping = 0;
  const Profile without = kernel_profile(plain);
  Scene full = hanging("implicit", GetParam());
  full.self_contact = true;
  full.obstacle = {test::sphere_at({0, 0, -10}, 0.1)};
  full.linear_precision = Precision::fp32;
  const Profile with = kernel_profile(full);
  for (const char* part : {"contact: ", "self-contact: ", "bending reference", "in float: "}) {
    const auto runs = [&](const Profile& profile) {
      return std::any_of(profile.costs.begin(), profile.costs.end(),
                         [&](const auto& cost) { return cost.first.starts_with(part); });
    };
    EXPECT_TRUE(runs(with)) << part;
    EXPECT_FALSE(runs(without)) << part;
  }
  EXPECT_LT(without.work.loops, with.work.loops);
}

}  // namespace
}  // namespace hysteron
