// The flexing machine of De Mattia (ISO 7854, ISO 132): a specimen hangs in a loop between two clamps, one of
// which moves towards the other and returns, many times.
#pragma once

#include <vector>

#include "experiments/workbench/app/experiment.h"
#include "sim/scene/cloth.h"

namespace hysteron::experiments {

struct FoldParams {
  int cycles = 100;
  double period = 1;       // duration of a cycle [s]
  double stroke = 0.4;     // stroke of the moving clamp, over the length of cloth between the clamps
  double fatigue = 5;      // fatigue.dc of laws that have it and no own value [J/m^2]; 0: none
  bool law_alone = false;  // bends the law again and again, without cloth
  double curvature = 150;  // largest curvature of law_alone [1/m]
};

struct Fold {
  Scene scene;  // the names of its phases caption the pictures
  Cloth cloth;
  double free_length = 0;  // between the clamps' middles on the flat cloth [m]
  double rate = 0;         // watched instants per second [1/s]
  int half = 0;            // watched instants from one end of the stroke to the other
  double period = 0;       // duration of a cycle [s]
  int cycles = 0;

  // Returns the distance between the clamps' middles [m].
  double distance(double time) const;
};

// Builds a specimen of scene.cloth.length by scene.cloth.width, a tenth of which is in either clamp.  The
// clamps never return quite to the length of the cloth between them: it is not stretched, and sags.  After
// the last return the moving clamp lets go.  The step and the `rate` of watched instants [1/s] are changed so
// that half a cycle has a whole number of either.  Throws Error::invalid_input for element `hinge`: recovery
// is read from the tensors of faces.
Fold folded(const Scene& scene, const FoldParams& choice, double rate);

// Returns the nearest rate of pictures [1/s] at which both ends of every stroke are pictured; 0 stays 0.
double stroke_rate(double fps, double period);

// Sets fatigue.dc as chosen, for a law that has it and was not given a value.
void give_fatigue(Scene& scene, const FoldParams& choice);

// Chosen cycles are 1, 2, 5, 10, 20, 50, ... and the last; pictured ones 1, 10, 100, ... and the last.
bool is_chosen(int cycle, int last);
bool is_pictured(int cycle, int last);

// Reads curvatures along the specimen, averaged over its width, from those of its faces.
class FoldGauge {
 public:
  explicit FoldGauge(const Fold& fold);

  // Returns the curvature in the middle of the specimen [1/m].  `curvature` has three components per face, as
  // Simulation gives them.
  double crown(const std::vector<double>& curvature) const;
  // Returns the largest angle by which some part of the specimen bends in the crown's sense [rad]; of the
  // residual curvature, that is the angle between its limbs if it were let go.
  double largest_turn(const std::vector<double>& curvature) const;

 private:
  double along(int face, const std::vector<double>& curvature) const;  // curvature times the face's area [m]

  double width_, middle_, spacing_;
  std::vector<double> area_, x_;            // by face: area [m^2], position along the specimen [m]
  std::vector<Eigen::Vector3d> component_;  // by face: weights that give the curvature along the specimen
  std::vector<int> column_;                 // by face: its column
  int columns_;
};

}  // namespace hysteron::experiments
