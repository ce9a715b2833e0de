#include "experiments/drape/apparatus.h"

#include <fmt/core.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/base/error.h"
#include "sim/contact/compression.h"
#include "sim/mesh/random_points.h"
#include "sim/scene/mesh_files.h"
#include "sim/scene/shown_key.h"

namespace hysteron::experiments {
namespace {

// Tolerance of the rim over the radius.  Templates are cut to 1 mm in 150; a rim that deviates by 1 % changes
// the coefficient by 3 %.
constexpr double kRound = 0.01;

using Points = std::vector<Eigen::Vector3d>;

Points rim_points(const Cloth& cloth) {
  Points rim;
  const ClothMesh& mesh = cloth.mesh;
  for (std::size_t e = mesh.interior_edges; e < mesh.edge.size(); ++e)
    rim.push_back(cloth.start[mesh.edge[e].p2]);
  return rim;
}

// Returns the circle nearest to the points, however they are spaced: least squares of x^2 + y^2 = 2 a x + 2 b
// y + c (Kasa 1976).
Specimen circle_through(const Points& rim) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& x : rim) mean += x / static_cast<double>(rim.size());
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& x : rim) {
    const Eigen::Vector3d row(2 * (x.x() - mean.x()), 2 * (x.y() - mean.y()), 1);
    normal += row * row.transpose();
    right += row * (x - mean).head<2>().squaredNorm();
  }
  const Eigen::Vector3d abc = normal.ldlt().solve(right);
  return {std::sqrt(abc.z() + abc.head<2>().squaredNorm()),
          Eigen::Vector3d(mean.x() + abc.x(), mean.y() + abc.y(), mean.z())};
}

double cloth_area(const Cloth& cloth) {
  double area = 0;
  for (const Eigen::Vector3i& f : cloth.mesh.face)
    area += (cloth.start[f[1]] - cloth.start[f[0]]).cross(cloth.start[f[2]] - cloth.start[f[0]]).norm() / 2;
  return area;
}

// Returns why the cloth is not a disc, or "" if it is one.
std::string disc_fault(const Cloth& cloth, const Specimen& disc) {
  double nearest = INFINITY, farthest = 0, low = INFINITY, high = -INFINITY;
  for (const Eigen::Vector3d& x : cloth.start) low = std::min(low, x.z()), high = std::max(high, x.z());
  for (const Eigen::Vector3d& x : rim_points(cloth)) {
    const double r = (x - disc.middle).head<2>().norm();
    nearest = std::min(nearest, r), farthest = std::max(farthest, r);
  }
  const double slack = kRound * disc.radius;
  if (!(high - low <= slack))
    return fmt::format("it lies {:.3g} to {:.3g} m high and must lie flat", low, high);
  if (!(farthest - nearest <= 2 * slack))
    return fmt::format("its edge is {:.3g} to {:.3g} m from its middle, which must be alike to {:g} %",
                       nearest, farthest, 200 * kRound);
  const double area = cloth_area(cloth), most = std::numbers::pi * std::pow(disc.radius + slack, 2);
  if (area > most) return fmt::format("it has {:.3g} m^2 within a rim around {:.3g} m^2", area, most);
  return "";
}

std::string name_of_cloth(const Scene& scene) {
  const std::string file = rest_file(scene);
  return file.empty() ? shown(scene, "cloth.shape", enum_name(scene.cloth.shape), "") : "mesh " + file;
}

// Returns the strokes up and down that begin when the plate has let go.
Motion shaking(const DrapeParams& choice) {
  Motion motion;
  for (int k = 0; k <= 2 * choice.shakes; ++k)
    motion.keys.push_back({choice.lowered() + k * choice.period / 2, {0, 0, k % 2 ? choice.stroke : 0}});
  return motion;
}

}  // namespace

Specimen disc_specimen(const Scene& scene, const Cloth& cloth) {
  const Points rim = rim_points(cloth);
  if (rim.empty()) throw Error::invalid_input(name_of_cloth(scene) + " is no disc: it has no edge");
  const Specimen found = circle_through(rim);
  const std::string fault = disc_fault(cloth, found);
  if (!fault.empty()) {
    // A warning about the mesh may explain the fault.
    const std::string warning = cloth.warnings.empty() ? "" : "; " + cloth.warnings.front();
    throw Error::invalid_input(name_of_cloth(scene) + " is no disc: " + fault + warning);
  }
  return rest_file(scene).empty() ? Specimen{scene.cloth.radius, scene.cloth.position} : found;
}

double specimen_radius(DrapeStandard standard) { return standard == DrapeStandard::jis ? 0.127 : 0.15; }

DrapeParams drape_by_standard(DrapeStandard standard) {
  DrapeParams choice;
  choice.standard = standard;
  if (standard != DrapeStandard::jis) return choice;
  choice.release = DrapeRelease::shaken;
  choice.disc = 0.0635;
  choice.wait = 60;
  return choice;
}

bool is_own_tester(const PublishedNumber& number, const DrapeParams& choice, double specimen_radius) {
  if (number.tester != choice.standard) return false;
  const auto is_near = [](double size, double standard) {
    return std::abs(size - standard) <= kRound * standard;
  };
  const DrapeParams own = drape_by_standard(choice.standard);
  return is_near(choice.disc, own.disc) &&
         is_near(specimen_radius, experiments::specimen_radius(choice.standard)) &&
         choice.release == own.release && choice.offset == 0 && choice.curl == 0 && choice.uneven == 0 &&
         choice.shakes == own.shakes && choice.stroke == own.stroke && choice.period == own.period &&
         choice.wait == own.wait;
}

std::string other_tester_message(const Fabric& fabric, const DrapeParams& choice, double specimen_radius) {
  for (const char* name : {"drape-coefficient", "node-count"}) {
    const auto found = fabric.published.find(name);
    if (found == fabric.published.end()) continue;
    const PublishedNumber& number = found->second;
    if (!number.tester) return "the fabric's file names no tester of it (tester = iso9073 | jis)";
    if (number.tester != choice.standard)
      return "is of another tester: --drape.standard " + enum_name(*number.tester);
    if (!is_own_tester(number, choice, specimen_radius))
      return "is of other sizes or another way: --drape.standard " + enum_name(*number.tester) +
             " without drape.disc and cloth.radius, drape.release, shakes, stroke, period, wait, offset, "
             "curl and uneven";
  }
  return "";
}

std::string tilt_warning(const Scene& scene) {
  constexpr double kMost = 45, kNoticed = 0.1;  // limits of the tilt [degree]
  const Eigen::Vector3d& g = scene.gravity;
  const std::string gravity =
      shown(scene, "gravity", fmt::format("{:g} {:g} {:g}", g.x(), g.y(), g.z()), "m/s^2");
  const double tilt = std::atan2(g.head<2>().norm(), -g.z()) * 180 / std::numbers::pi;
  if (!(g.norm() > 0) || tilt > kMost)
    throw Error::invalid_input(
        gravity + fmt::format(" does not pull the specimen onto the pedestal: it must be more than 0, and "
                              "within {:g} degree of straight down (0 0 -9.81)",
                              kMost))
        .with_key("gravity", number_text(g.norm()));
  if (tilt <= kNoticed) return "";
  return fmt::format(
      "{} pulls {:.1f} degree away from straight down: the specimen hangs to one side, and no drape tester "
      "does "
      "so",
      gravity, tilt);
}

namespace {

// The plate sinks; where the ring is lifted again it waits below, rises and sinks a second time.
std::vector<Keyframe> plate_keys(const DrapeParams& choice) {
  const Eigen::Vector3d above = Eigen::Vector3d::Zero(), below(0, 0, -choice.plate);
  std::vector<Keyframe> keys = {{0, above}, {choice.lowering, below}};
  if (!choice.is_relifted()) return keys;
  const double lifts = choice.first_rest();
  keys.insert(keys.end(), {{lifts, below}, {lifts + choice.lowering, above}, {choice.lowered(), below}});
  return keys;
}

}  // namespace

void add_apparatus(Scene& scene, const DrapeParams& choice, const Specimen& specimen) {
  // The discs press the specimen by a few times its own weight: both contacts stay closed, as in the
  // apparatus, and the plate throws nothing up when it goes down.
  constexpr double kOwnWeights = 4;
  const double pressure = kOwnWeights * scene.fabric.density * scene.gravity.norm();
  const double activation_distance = distance_under(obstacle_response(scene), pressure);
  scene.cloth.position += Eigen::Vector3d(choice.offset, 0, activation_distance) - specimen.middle;
  Obstacle pedestal;
  pedestal.kind = ObstacleKind::cylinder;
  pedestal.radius = choice.disc;
  pedestal.height = kPedestalHeight;
  pedestal.center = {0, 0, -kPedestalHeight / 2};
  Obstacle clamp = pedestal;
  clamp.height = 0.01;
  clamp.center = {0, 0, 2 * activation_distance + clamp.height / 2};
  clamp.visible = false;
  if (choice.release == DrapeRelease::shaken) pedestal.motion = clamp.motion = shaking(choice);
  scene.obstacle.insert(scene.obstacle.end(), {pedestal, clamp});
  if (choice.release == DrapeRelease::dropped) return;
  Obstacle plate = clamp;
  plate.motion = {};
  plate.radius = specimen.radius + 0.01;
  plate.center = {0, 0, -plate.height / 2};
  plate.friction = 0;
  plate.motion.keys = plate_keys(choice);
  plate.until = choice.lowered();
  scene.obstacle.push_back(plate);
}

namespace {

// Returns a Gaussian field of mean 0 and variance 1 as a sum of random waves (Shinozuka & Deodatis 1991):
// wave numbers of both axes are normal with the standard deviation 1/l.
std::vector<double> random_field(const std::vector<Eigen::Vector2d>& at, double length, unsigned seed) {
  constexpr int kWaves = 400;
  Uniform uniform(seed);
  std::vector<double> field(at.size());
  for (int wave = 0; wave < kWaves; ++wave) {
    const double size = std::sqrt(-2 * std::log1p(-uniform(0, 1))) / length;  // Box & Muller 1958
    const double angle = uniform(0, 2 * std::numbers::pi), phase = uniform(0, 2 * std::numbers::pi);
    const Eigen::Vector2d number(size * std::cos(angle), size * std::sin(angle));
    for (std::size_t i = 0; i < at.size(); ++i)
      field[i] += std::sqrt(2. / kWaves) * std::cos(number.dot(at[i]) + phase);
  }
  return field;
}

}  // namespace

void make_uneven(ClothMesh& mesh, const DrapeParams& choice, unsigned seed) {
  if (choice.uneven > 0) {
    const double log_deviation = std::sqrt(std::log1p(choice.uneven * choice.uneven));
    std::vector<Eigen::Vector2d> middle(mesh.faces());
    for (int f = 0; f < mesh.faces(); ++f) {
      const auto [a, b, c] = mesh.corners(f);
      middle[f] = (a + b + c).head<2>() / 3;
    }
    mesh.bending_factor = random_field(middle, choice.uneven_length, seed);
    for (double& factor : mesh.bending_factor)
      factor = std::exp(log_deviation * factor - log_deviation * log_deviation / 2);
  }
  if (choice.curl == 0) return;
  for (Eigen::Vector3d& x : mesh.rest) {
    const double along = x.x();
    x.x() = std::sin(choice.curl * along) / choice.curl;
    x.z() += (1 - std::cos(choice.curl * along)) / choice.curl;
  }
}

void seed_folds(std::vector<Eigen::Vector3d>& start, const DrapeParams& choice, double radius) {
  if (choice.folds == 0) return;
  if (choice.release != DrapeRelease::dropped)
    throw Error::invalid_input("drape.folds needs drape.release = dropped: a plate would press them flat")
        .with_key("drape.folds", std::to_string(choice.folds));
  for (Eigen::Vector3d& x : start) {
    const double outside = std::max(0.0, (x.head<2>().norm() - choice.disc) / (radius - choice.disc));
    x.z() += kFoldSeed * outside * outside * std::cos(choice.folds * std::atan2(x.y(), x.x()));
  }
}

}  // namespace hysteron::experiments
