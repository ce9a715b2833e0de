// Choices of the solver's that are no keys, and their values in use.
#pragma once

namespace hysteron {

struct SolverTuning {
  // Share of e e'/|e|^2 that is taken out of the stiffness of a stop that slides (contact/sliding_stop.h),
  // far from the minimum and near it; 1: its energy's second derivative.
  double sliding_far = 0, sliding_near = 0.75;
  int friction_rounds = 20;     // Newton iterations that friction's limits follow; then they stay
  double loosest_solve = 0.1;   // largest relative residual of a linear solve (Eisenstat & Walker 1996)
  double longer = 4;            // a correction is looked for as far as this many times the last one
  double full_stiffness = 0.1;  // share of the first unbalanced force below which the full stiffness is used
};

}  // namespace hysteron
