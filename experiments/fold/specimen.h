// The flexing machine of De Mattia (ISO 7854, ISO 132): a specimen between two clamps, one of which goes
// towards the other, so that the cloth hangs in a loop, and returns; many times.
#pragma once

#include <vector>

#include "experiments/workbench/app/experiment.h"
#include "sim/scene/cloth.h"

namespace hysteron::experiments {

struct FoldChoice {
  int cycles = 100;
  double period = 1;       // of a cycle [s]
  double stroke = 0.4;     // of the moving clamp, share of the cloth between the clamps
  double fatigue = 5;      // fatigue.dc of laws that know it and are not given one [J/m^2]; 0: none
  bool law_alone = false;  // no cloth: the law, bent again and again
  double curvature = 150;  // its largest curvature [1/m]
};

struct Fold {
  Scene scene;  // its phases name what each picture shows
  Cloth cloth;
  double free_length = 0;  // between the clamps' middles on the flat cloth [m]
  double rate = 0;         // instants that are watched in a second
  int half = 0;            // watched instants from one end of the stroke to the other
  double period = 0;       // of a cycle [s]
  int cycles = 0;

  // Between the clamps' middles [m].
  double distance(double time) const;
};

// A specimen of scene.cloth.length by scene.cloth.width, a tenth of which is in either clamp.  The clamps
// never return quite to the length of the cloth between them: it is not stretched, and sags.  After the last
// return the moving clamp lets go.  The step and the `rate` of watched instants [1/s] are changed so that
// half a cycle has a whole number of either.  Error::invalid_input for element `hinge`: recovery is read from
// the tensors of faces.
Fold folded(const Scene& scene, const FoldChoice& choice, double rate);

// The nearest rate of pictures with which both ends of every stroke are pictured; 0 stays 0 [1/s].
double stroke_rate(double fps, double period);

// fatigue.dc as chosen, for a law that knows it and has not been given one.
void give_fatigue(Scene& scene, const FoldChoice& choice);

// The cycles worth a closer look: 1, 2, 5, 10, 20, 50, ... and the last; those worth a picture: 1, 10, 100,
// ... and the last.
bool is_chosen(int cycle, int last);
bool is_pictured(int cycle, int last);

// Reads curvatures along the specimen, averaged over its width, from those of its faces.
class FoldGauge {
 public:
  explicit FoldGauge(const Fold& fold);

  // In the middle of the specimen [1/m].  `curvature`: three components per face, as Simulation gives them.
  double crown(const std::vector<double>& curvature) const;
  // The largest angle by which some part of the specimen turns in the crown's sense [radian]: of the residual
  // curvature, the bend that would be seen between its limbs if it was let go.
  double largest_turn(const std::vector<double>& curvature) const;

 private:
  double along(int face, const std::vector<double>& curvature) const;  // curvature times area [m]

  double width_, middle_, spacing_;
  std::vector<double> area_, x_;            // of faces: area [m^2], place along the specimen [m]
  std::vector<Eigen::Vector3d> component_;  // of the curvature along the specimen
  std::vector<int> column_;                 // of each face
  int columns_;
};

}  // namespace hysteron::experiments
