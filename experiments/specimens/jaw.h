// The jaws of testers, for the eye: cloth does not touch them, its pins hold it.
#pragma once

#include "sim/scene/scene.h"

namespace hysteron::experiments {

struct JawSize {
  double overhang = 0;   // beyond either edge of the cloth [m]
  double thickness = 0;  // of both halves together [m]
};

// A jaw that grips a strip along x, `width` wide from y = 0 on, from `from` to `to`; bodies are drawn smaller
// by the look's inset.
Obstacle jaw(double from, double to, double width, const JawSize& size);

}  // namespace hysteron::experiments
