// The apparatus of drape tests (Cusick 1968; ISO 9073-9, JIS L 1096): a pedestal on which a disc holds the
// specimen, the plate that lowers its free ring, the shaking of the Japanese test, and the specimen.
#pragma once

#include <array>
#include <string>

#include "sim/scene/cloth.h"

namespace hysteron::experiments {

// The disc of cloth that is draped, as it lies before the test.
struct Specimen {
  double radius;                       // [m]
  Eigen::Vector3d middle = {0, 0, 0};  // [m]
};

// Measures the specimen where the cloth starts; generated cloth has its scene's radius and position.  Throws
// Error::invalid_input unless it is a disc that lies flat.
Specimen disc_specimen(const Scene& scene, const Cloth& cloth);

// How the overhanging ring is released.  lowered: a plate under it sinks; dropped: the plate is gone at once;
// relifted: lowered, lifted flat again, lowered a second time; shaken: lowered, then pedestal and disc go up
// and down.
enum class DrapeRelease { lowered, dropped, relifted, shaken };
constexpr std::array<const char*, 4> names(DrapeRelease) {
  return {"lowered", "dropped", "relifted", "shaken"};
}

struct DrapeParams {
  DrapeStandard standard = DrapeStandard::iso9073;  // it sets sizes and release
  DrapeRelease release = DrapeRelease::lowered;
  int folds = 0;                // dropped: of the flat ring, which begin the folds; 0: none
  double disc = 0.09;           // pedestal's radius [m]
  double lowering = 3;          // time in which the plate sinks [s]
  double pause = 1;             // relifted: at rest below, before the plate lifts the ring [s]
  int shakes = 3;               // of these strokes:
  double stroke = 0.03;         // how far up [m]
  double period = 0.5;          // up and down [s]
  double wait = 0;              // at rest, until the shadow is read [s]
  double still = 2e-3;          // settled when no vertex moves faster [m/s]
  double plate = 0.12;          // how far the plate sinks [m]
  double offset = 0;            // of the specimen's middle from the pedestal's axis, along warp [m]
  double curl = 0;              // curvature along warp with which the specimen is at rest [1/m]
  double uneven = 0;            // standard deviation of the rigidity along the cloth, over its mean
  double uneven_length = 0.02;  // over which the rigidity stays alike [m]

  bool is_relifted() const { return release == DrapeRelease::relifted; }
  int strokes() const {
    return release == DrapeRelease::dropped ? 0 : is_relifted() ? 3 : 1;
  }                                                       // of the plate
  double first_rest() const { return lowering + pause; }  // relifted: when the plate begins to lift [s]
  double lowered() const {                                // when nothing carries the ring any more [s]
    return strokes() * lowering + (is_relifted() ? pause : 0);
  }
  double released() const { return lowered() + (release == DrapeRelease::shaken ? shakes * period : 0); }
};

// The radius of a standard's specimen [m], and its parameters: `iso9073` has the defaults, with a specimen of
// 30 cm on a disc of 18 cm; `jis` has one of 25.4 cm on 12.7 cm, shaken three times and read after a minute
// (a Japanese teaching page on the tester; stroke and period, which no source states, are chosen here).
double specimen_radius(DrapeStandard standard);
DrapeParams drape_by_standard(DrapeStandard standard);

// True if a published number was measured on this tester: the fabric's file names its standard, with the
// sizes and the release of that standard.
bool is_own_tester(const PublishedNumber& number, const DrapeParams& choice, double specimen_radius);
// Returns why the fabric's published drape is not comparable with this one, and which tester to ask for; ""
// if it is, or if none is published.
std::string other_tester_message(const Fabric& fabric, const DrapeParams& choice, double specimen_radius);

// Throws Error::invalid_input unless gravity pulls the specimen onto the pedestal, within 45 degrees of
// straight down.  Returns the warning of any tilt, or "".
std::string tilt_warning(const Scene& scene);

inline constexpr double kPedestalHeight = 0.14;  // [m]

// Adds the pedestal, the upper disc that holds the specimen (not shown), and the plate that lowers the ring;
// the specimen is centred on the pedestal.
void add_apparatus(Scene& scene, const DrapeParams& choice, const Specimen& specimen);

// Height of the initial folds [m]: six of them strain the rim by 0.2 % at most; at half a millimetre, folds
// merge.
inline constexpr double kFoldSeed = 2e-3;
// Makes the disc as uneven as real specimens are.  Rigidities vary along the cloth, drawn by the seed from a
// lognormal field whose correlation falls as exp(-d^2/(2 l^2)) with the distance d, l = uneven_length; and
// the cloth curls: its rest shape is a cylinder, concave above if the curl is positive.
void make_uneven(ClothMesh& mesh, const DrapeParams& choice, unsigned seed);

// Raises the ring in `folds` waves, highest at the rim by `kFoldSeed`, so that equilibria under different
// methods are compared with the same folds.
void seed_folds(std::vector<Eigen::Vector3d>& start, const DrapeParams& choice, double radius);

}  // namespace hysteron::experiments
