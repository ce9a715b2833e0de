// CPU against CUDA: the same source on both must give the same cloth.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/bending/laws/law_parameters.h"
#include "sim/mesh/intersections.h"
#include "tests/sim/base/refusal.h"
#include "tests/sim/contact/mesh_bodies.h"
#include "tests/sim/device/on_each_device.h"
#include "tests/sim/time/scenes.h"

namespace hysteron {
namespace {

using test::Trial;

constexpr int kCudaSteps = 50;

// Every part of the simulation at work: moving pin, obstacle with friction, air, damping.
Scene busy_scene(const std::string& law, const std::string& element, const std::string& integrator) {
  Scene scene = test::hanging_square(1000);
  scene.law = law;
  scene.element = value_named<BendingElement>(element);
  scene.integrator = value_named<Integrator>(integrator);
  scene.air_drag = 0.02;
  scene.solver_tolerance = 1e-10;
  scene.pin[0].motion.keys = {{0, {0, 0, 0}, 0}, {0.05, {0.01, 0, 0.02}, 10}};
  if (integrator != "explicit") scene.obstacle = {test::sphere_at({0.1, 0.05, -0.042}, 0.04)};
  if (scene.is_implicit()) {  // stiff enough that each step has one minimum, not one for each way to buckle
    scene.step = 5e-3;
    scene.fabric.b1 *= 100;
    scene.fabric.b2 *= 100;
    // Friction's limits depend on the way to the minimum, and a GPU's multigrid is not the CPU's.
    scene.linear_solver = Preconditioning::block_jacobi;
  }
  scene.newton_residual = 1e-10;
  scene.newton_velocity = 0;
  return scene;
}

std::unique_ptr<Simulation> run_on(const std::string& device, Scene scene) {
  scene.device = value_named<DeviceChoice>(device);
  return Trial(scene).after(kCudaSteps);
}

std::vector<test::Method> cuda_methods() {
  std::vector<test::Method> all;
  for (const LawEntry& law : law_catalogue()) all.push_back({law.name, "shape", "semi-implicit"});
  all.push_back({"prandtl", "hinge", "semi-implicit"});
  all.push_back({"gong", "hinge", "semi-implicit"});
  all.push_back({"prandtl", "shape", "explicit"});
  for (const char* law : {"linear", "prandtl", "kim"}) all.push_back({law, "shape", "implicit"});
  all.push_back({"prandtl", "hinge", "bdf2"});
  all.push_back({"prandtl", "hinge", "tr-bdf2"});
  return all;
}

class BothDevices : public test::OnGpuWith<test::Method> {};
INSTANTIATE_TEST_SUITE_P(Cases, BothDevices, testing::ValuesIn(cuda_methods()), test::CaseName());

// Sums run in another order and division and roots round differently; the solver's tolerance hides the rest.
TEST_P(BothDevices, AgreeOnEveryPosition) {
  // gong's clock starts again by the sign of a motion, however small: rounding decides where cloth rests.
  const double kAgreement = GetParam().law == "gong" ? 1e-7 : 1e-9;  // [m]
  const Scene scene = busy_scene(GetParam().law, GetParam().element, GetParam().integrator);
  const auto cpu = run_on("cpu", scene), gpu = run_on("cuda", scene);
  EXPECT_EQ(gpu->device().substr(0, 4), "cuda");
  const double distance = test::farthest(cpu->positions(), gpu->positions());
  EXPECT_GT(test::farthest(cpu->positions(), Trial(scene).cloth.start), 1e-3);
  EXPECT_LT(distance, kAgreement);
  EXPECT_LT(gpu->ledger().remainder_relative, 1e-9);
  EXPECT_EQ(gpu->limits().substeps, cpu->limits().substeps);
}

TEST_P(BothDevices, GpuGivesTheSameBitsTwice) {
  const Scene scene = busy_scene(GetParam().law, GetParam().element, GetParam().integrator);
  EXPECT_EQ(run_on("cuda", scene)->state_hash(), run_on("cuda", scene)->state_hash());
}

class Gpu : public test::OnGpu {};

TEST_F(Gpu, TiresAndObeysCommandsAsTheCpuDoes) {
  Scene scene = busy_scene("prandtl", "shape", "semi-implicit");
  scene.param = {{"fatigue.dc", "1e-3"}};
  scene.command = {{.time = 0.02, .low = {0.1, -1, -1}}};
  const auto cpu = run_on("cpu", scene), gpu = run_on("cuda", scene);
  EXPECT_LT(test::farthest(cpu->positions(), gpu->positions()), 1e-9);
  EXPECT_NE(gpu->ledger().commands, 0);
  EXPECT_NEAR(gpu->ledger().commands, cpu->ledger().commands, 1e-6 * std::abs(cpu->ledger().commands));
}

std::vector<test::Method> every_integrator() {
  std::vector<test::Method> all;
  for (const char* name : {"semi-implicit", "explicit", "implicit", "tr-bdf2"})
    all.push_back({"prandtl", "shape", name});
  return all;
}

// Stops along warp and weft, branches and a set, on hinges and faces.
TEST_F(Gpu, BendsAFabricOfManyPartsAsTheCpuDoes) {
  for (const char* element : {"hinge", "shape"}) {
    Scene scene = busy_scene("chapman", element, "semi-implicit");
    scene.fabric.bending = test::all_parts();
    const auto cpu = run_on("cpu", scene), gpu = run_on("cuda", scene);
    const double lost = cpu->ledger().bending_friction;
    EXPECT_GT(lost, 0) << element;
    EXPECT_NEAR(gpu->ledger().bending_friction, lost, 1e-6 * lost) << element;
    EXPECT_LT(test::farthest(cpu->positions(), gpu->positions()), 1e-9) << element;
    EXPECT_EQ(run_on("cuda", scene)->state_hash(), gpu->state_hash()) << element;
  }
}

// Expects positions, losses and residual curvatures of both devices to agree, and the GPU's bits to repeat.
void expect_bent_alike(const Scene& scene, const std::string& element) {
  constexpr double kNear = 1e-6;  // of the largest: histories of cloth that agrees to 1e-9 m
  const auto cpu = run_on("cpu", scene), gpu = run_on("cuda", scene);
  EXPECT_LT(test::farthest(cpu->positions(), gpu->positions()), 1e-9) << element;
  const double lost = cpu->ledger().bending_friction;
  EXPECT_NEAR(gpu->ledger().bending_friction, lost, 1e-6 * lost) << element;
  const std::vector<double> there = cpu->residual_curvature(), here = gpu->residual_curvature();
  const double largest = std::abs(*std::ranges::max_element(there, {}, [](double k) { return std::abs(k); }));
  ASSERT_EQ(here.size(), there.size());
  for (std::size_t i = 0; i < here.size(); ++i) ASSERT_NEAR(here[i], there[i], kNear * largest) << element;
  EXPECT_EQ(run_on("cuda", scene)->state_hash(), gpu->state_hash()) << element;
}

// The fabric has elasticity beside its friction, on hinges of every direction and on faces.
TEST_F(Gpu, RubsOtherwiseAlongWeftAsTheCpuDoes) {
  for (const char* element : {"hinge", "shape"}) {
    Scene scene = busy_scene("prandtl", element, "semi-implicit");
    scene.fabric.weft_friction = 3;
    expect_bent_alike(scene, element);
  }
}

// The back has another B and another 2HB, the excess along directions of its own, on hinges and faces.
TEST_F(Gpu, BendsAFabricWhoseFacesDifferAsTheCpuDoes) {
  for (const char* element : {"hinge", "shape"}) {
    Scene scene = busy_scene("prandtl", element, "semi-implicit");
    scene.fabric.weft_friction = 0.8;
    scene.fabric.bending.faces = {1.4, 0.7};
    expect_bent_alike(scene, element);
  }
}

class InPlaneFrictionOnBothDevices : public test::OnGpuWith<test::Method> {};
INSTANTIATE_TEST_SUITE_P(Integrators, InPlaneFrictionOnBothDevices, testing::ValuesIn(every_integrator()),
                         test::CaseName());

TEST_P(InPlaneFrictionOnBothDevices, LosesTheSameToTheSameCloth) {
  Scene scene = busy_scene(GetParam().law, GetParam().element, GetParam().integrator);
  scene.fabric.weft = 5e3;  // with means at nodes
  scene.fabric.in_plane = {{{1e-4}, {300}}, {{1e-4, 1e-3}, {200, 80}}, {{5e-4, 3e-3}, {90, 40}}, 20};
  const auto cpu = run_on("cpu", scene), gpu = run_on("cuda", scene);
  const double lost = cpu->ledger().membrane_friction;
  EXPECT_GT(lost, 0);
  EXPECT_NEAR(gpu->ledger().membrane_friction, lost, 1e-6 * lost);
  EXPECT_LT(test::farthest(cpu->positions(), gpu->positions()), 1e-9);
  EXPECT_EQ(run_on("cuda", scene)->state_hash(), gpu->state_hash());
}

TEST_F(Gpu, InSinglePrecisionStaysNearTheCpusDouble) {
  constexpr double kNear = 1e-4;  // [m], as on the CPU
  Scene scene = busy_scene("prandtl", "shape", "semi-implicit");
  scene.obstacle.clear();
  scene.solver_tolerance = 1e-5;
  const auto exact = run_on("cpu", scene)->positions();
  scene.precision = Precision::fp32;
  EXPECT_LT(test::farthest(run_on("cuda", scene)->positions(), exact), kNear);
}

// A pin leads the end of a strip over until it lies on the other one.  Explicit bending's substeps grow with
// the square of the fineness.
Scene folding_strip(const std::string& integrator) {
  Scene scene = test::free_square(integrator == "implicit" ? 600 : 100);
  scene.cloth.shape = ClothOutline::strip;
  scene.cloth.length = 0.06;
  scene.cloth.width = 0.02;
  scene.integrator = value_named<Integrator>(integrator);
  scene.self_contact = true;
  scene.step = 5e-3;
  scene.law = "prandtl";
  scene.newton_residual = 1e-9;
  const Pin clamp = test::pin_in({-1, -1, -1}, {0.02, 1, 1});
  Pin moving_pin = test::pin_in({0.05, -1, -1}, {1, 1, 1});
  moving_pin.motion.axis = {0, -1, 0};
  moving_pin.motion.center = {0.035, 0, 0.005};
  moving_pin.motion.keys = {{0, {0, 0, 0}, 0}, {0.2, {0, 0, 0}, 180}, {0.25, {0, 0, -0.0096}, 180}};
  scene.pin = {clamp, moving_pin};
  return scene;
}

class SelfContactOnBothDevices : public test::OnGpuWith<const char*> {};

INSTANTIATE_TEST_SUITE_P(Integrators, SelfContactOnBothDevices,
                         ::testing::Values("implicit", "semi-implicit"), test::CaseName());

void expect_folded_alike(const Scene& scene) {
  constexpr double kAgreement = 1e-6;  // [m]
  const auto cpu = run_on("cpu", scene), gpu = run_on("cuda", scene), again = run_on("cuda", scene);
  EXPECT_GT(cpu->ledger().contact, 0);
  const double distance = test::farthest(cpu->positions(), gpu->positions());
  EXPECT_LT(distance, kAgreement);
  EXPECT_EQ(gpu->state_hash(), again->state_hash());
  EXPECT_LT(gpu->ledger().remainder_relative, 1e-9);
  const Trial trial(scene);
  EXPECT_TRUE(intersecting_triangles(trial.cloth.mesh.face, gpu->positions()).empty());
}

TEST_P(SelfContactOnBothDevices, FoldsAlikeAndTwiceTheSame) {
  expect_folded_alike(folding_strip(GetParam()));
}

// Pairs come and go, some of which ask for another plan.  In `semi-implicit` bending is not in the matrix.
TEST_P(SelfContactOnBothDevices, FoldsAlikeWithAFactorisation) {
  Scene scene = folding_strip(GetParam());
  scene.linear_solver = Preconditioning::cholesky;
  expect_folded_alike(scene);
}

// A plate of triangles drives off with its sheet.
TEST_F(Gpu, CarriesClothOnABodyOfTrianglesAsTheCpuDoes) {
  constexpr double kAgreement = 1e-6;  // [m]
  for (const Preconditioning solver : {Preconditioning::multigrid, Preconditioning::cholesky}) {
    Scene scene = test::on_plate(0, 0.3, Integrator::tr_bdf2).scene;
    scene.newton_residual = 1e-9;
    scene.linear_solver = solver;
    scene.obstacle[0].motion.keys = {{0, {0, 0, 0}, 0}, {0.2, {0.01, 0, 0.01}, 0}};
    const auto cpu = run_on("cpu", scene), gpu = run_on("cuda", scene), again = run_on("cuda", scene);
    EXPECT_GT(cpu->ledger().obstacle_work, 0);
    EXPECT_LT(test::farthest(cpu->positions(), gpu->positions()), kAgreement);
    EXPECT_EQ(gpu->state_hash(), again->state_hash());
  }
}

// The vertices that yield, and by how much, are the same on both but for rounding; on one device, to the bit.
TEST_F(Gpu, PinchesClothBetweenBodiesOfTrianglesAsTheCpuDoes) {
  const double t = Fabric{}.thickness;
  const Scene scene = test::between_plates(Integrator::tr_bdf2, -t, 0.1).scene;
  const auto cpu = run_on("cpu", scene), gpu = run_on("cuda", scene), again = run_on("cuda", scene);
  EXPECT_GT(gpu->counts().pinched, 0);
  EXPECT_NEAR(gpu->counts().pinch_depth, cpu->counts().pinch_depth, 0.1 * t);
  EXPECT_EQ(gpu->state_hash(), again->state_hash());
}

// Returns a strip that swings by one end.
Scene swinging_strip() {
  Scene scene = busy_scene("prandtl", "shape", "implicit");
  scene.cloth.shape = ClothOutline::strip;
  scene.cloth.width = 0.03;
  scene.triangles = 600;
  scene.pin.resize(1);
  scene.obstacle.clear();
  scene.linear_solver = Preconditioning::cholesky;
  return scene;
}

TEST_F(Gpu, FactorisesAsTheCpuDoes) {
  constexpr double kAgreement = 1e-9;  // [m], of solves to 1e-10
  const Scene scene = swinging_strip();
  const auto cpu = run_on("cpu", scene), gpu = run_on("cuda", scene);
  EXPECT_LT(test::farthest(cpu->positions(), gpu->positions()), kAgreement);
  EXPECT_EQ(run_on("cuda", scene)->state_hash(), gpu->state_hash());
  // Both keep theirs until another is worth it, which differs.
  EXPECT_LT(gpu->counts().linear, 2 * cpu->counts().linear);
}

TEST_F(Gpu, FactorisesInSinglePrecisionNearTheCpusDouble) {
  constexpr double kNear = 1e-4;  // [m], as with other solvers
  Scene scene = swinging_strip();
  scene.solver_tolerance = 1e-5;
  scene.newton_residual = 1e-4;
  const auto exact = run_on("cpu", scene)->positions();
  scene.precision = Precision::fp32;
  EXPECT_LT(test::farthest(run_on("cuda", scene)->positions(), exact), kNear);
}

TEST_F(Gpu, GoesOnWithASavedFactorisationBitForBit) {
  for (const bool layers : {false, true}) {
    Scene scene = layers ? folding_strip("implicit") : swinging_strip();
    scene.linear_solver = Preconditioning::cholesky;
    scene.device = DeviceChoice::cuda;
    const Trial trial(scene);
    const auto first = trial.after(kCudaSteps - 3), second = trial.simulation();
    second->load(first->save());
    for (const auto& each : {first.get(), second.get()}) each->advance(7);
    EXPECT_EQ(first->state_hash(), second->state_hash()) << layers;
    EXPECT_EQ(first->counts().linear, second->counts().linear) << layers;
  }
}

TEST(Device, ListNamesTheCpuAndTheGpuOrWhyThereIsNone) {
  const auto list = device_list();
  ASSERT_GE(list.size(), 2u);
  EXPECT_EQ(list[0].substr(0, 4), "cpu:");
  EXPECT_EQ(list[1].substr(0, 5), "cuda:");
  std::string reason;
  if (gpu_count(reason) == 0) {
    EXPECT_TRUE(test::says(list[1], reason));
  }
}

TEST(Device, CudaWithoutAGpuIsTheMachinesFailureInOneLine) {
  std::string reason;
  if (gpu_count(reason) > 0) GTEST_SKIP() << "there is a GPU";
  Trial trial(test::hanging_square());
  trial.scene.device = DeviceChoice::cuda;
  EXPECT_TRUE(test::says(test::refusal([&] { trial.simulation(); }, 1), reason));
  trial.scene.device = DeviceChoice::automatic;
  EXPECT_EQ(trial.simulation()->device().substr(0, 3), "cpu");
}

}  // namespace
}  // namespace hysteron
