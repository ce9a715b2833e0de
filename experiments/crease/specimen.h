// The crease recovery specimen of ISO 2313 and AATCC 66: a pin folds it, a plate loads it and lets it go.
// Soft variants are wrapped around a rod, or pleated and pulled flat.
#pragma once

#include <array>

#include "experiments/workbench/app/experiment.h"
#include "sim/bending/laws/law_run.h"
#include "sim/scene/cloth.h"

namespace hysteron::experiments {

enum class CreaseFold { plate, rod, pleat };
constexpr std::array<const char*, 3> names(CreaseFold) { return {"plate", "rod", "pleat"}; }

// A slow release goes from equilibrium to equilibrium, a quick one lets go in motion.
enum class CreaseRelease { slow, quick };
constexpr std::array<const char*, 2> names(CreaseRelease) { return {"slow", "quick"}; }

// The standard that sets load and times.
enum class CreaseStandard { none, iso2313, aatcc66 };
constexpr std::array<const char*, 3> names(CreaseStandard) { return {"none", "iso2313", "aatcc66"}; }

struct CreaseParams {
  CreaseFold fold = CreaseFold::plate;
  CreaseRelease release = CreaseRelease::slow;
  double force = 10;     // force of the plate [N] (ISO 2313)
  double radius = 0.01;  // radius of the rod [m]
  double pleat = 60;     // angle between the limbs of the pleated specimen at rest [degree]
  double hold = 0.2;     // time under the whole load [s]
  double lift = 1;       // time in which the plate of a slow release rises [s]
  double recovery = 1;   // time to recover [s]
  CreaseStandard standard = CreaseStandard::none;
  double grow_after = 0;  // time of rest after which a step is twice the scene's [s]; 0: steps do not grow

  // Returns the time in which the plate rises [s]; after a quick release that is a tenth of a second.
  double lifting() const { return release == CreaseRelease::slow ? lift : 0.1; }
};

// Returns the load and times of a standard, with steps that grow:
//   iso2313   10 N for 5 min, read after 5 min (ISO 2313-2)
//   aatcc66   500 g for 5 min, read after 5 min (AATCC 66)
CreaseParams by_standard(CreaseStandard standard);

// The times at which the phases of the test end [s].
struct CreaseTimes {
  double folded, pressed, released, lifted, end;
};

// A limb of the specimen in profile: the middles of the parts of it that are nearest to the fold and to its
// end [m].
struct Limb {
  Eigen::Vector3d inner, outer;
  Eigen::Vector3d direction() const { return (outer - inner).normalized(); }  // away from the fold
};
struct Limbs {
  Limb near, far;
  double opening() const;  // angle between them: 0 folded flat, 180 straight [degree]
};

struct Crease {
  Scene scene;
  Cloth cloth;
  CreaseTimes times;
  double rest_turn = 0;                 // angle of a pleat's bend at rest [degree]
  std::vector<double> time_steps = {};  // lengths of the steps [s]; if empty, the scene's step
  double limb_part = 0.2;  // share of the length at either end from which the limbs' directions are taken

  // Returns the force of the plate on the cloth at these positions [N]; 0 without a plate.
  double plate_force(const std::vector<Eigen::Vector3d>& x, double time) const;
  Limbs limbs(const std::vector<Eigen::Vector3d>& x) const;
  double opening(const std::vector<Eigen::Vector3d>& x) const { return limbs(x).opening(); }  // [degree]
  // Returns the middle of each column of vertices across the strip, from the clamp to the far end [m].
  std::vector<Eigen::Vector3d> profile(const std::vector<Eigen::Vector3d>& x) const;
  double along(std::size_t vertex) const;  // the strip, at rest and flat [m]
};

// Predicts the crease from the law alone: each triangle is bent along the strip as the specimen was until its
// load had gone, and then let go, so that it carries no moment.  Bends that the rising load makes in the
// limbs are included.
class LawOfCrease {
 public:
  explicit LawOfCrease(const Crease& crease);  // must outlive this object

  // Takes a step [s] in which every triangle is bent to its curvature along the strip [1/m].
  void bend(const std::vector<double>& along, double seconds);
  void let_go(double seconds);  // takes a step in which no triangle carries a moment
  double opening() const;       // angle between the limbs if let go now [degree]
  void serialise(Archive& archive);

 private:
  const Crease& crease_;
  std::vector<LawWalk> triangles_;
};

// Returns the lengths of the steps [s] from the start to the end.  They are the scene's while anything moves;
// under the load and after release they grow with the time t since that phase began, step (1 + t/grow_after),
// as relaxation and recovery slow down.  Each phase ends with a step.
std::vector<double> growing_steps(const CreaseTimes& times, double step, double grow_after);

// Builds a specimen of scene.cloth.length by scene.cloth.width whose elements are at most a thickness long
// across the crease, which is in its middle.  Its near limb is clamped on a plane; a pin takes the end of the
// far limb over by 180 degrees, then a plate presses both down until its underside is `plate` above the
// plane [m], stays, and goes.  There is no gravity, as the standards turn its moment away.
Crease creased(const Scene& scene, const CreaseParams& choice, double plate);

// Builds a strip whose near limb is clamped; a pin wraps the rest halfway around a rod, holds it there, and
// lets go as the rod is taken away.  Its limbs are `scene.cloth.length` long in all, excluding the part
// around the rod.
Crease wrapped(const Scene& scene, const CreaseParams& choice);
// Builds a strip that is at rest with a sharp pleat in its middle: a pin opens it until it is straight, holds
// it there, and lets go.
Crease pleated(const Scene& scene, const CreaseParams& choice);

// Returns the mesh that the three specimens share; columns across the crease are at most a thickness wide up
// to `fine` [m] from it.
ClothMesh crease_specimen(const Scene& scene, double fine);
// Returns the clamp that holds the near limb for the whole test.
Pin crease_clamp(const Scene& scene);

// Finds by pressing the height of the plate's underside at which it first bears the force [m].
double loaded_plate(const Scene& scene, const CreaseParams& choice);

}  // namespace hysteron::experiments
