// A moment-curvature law on many elements at once: the loop that cloths run, on the CPU.
#pragma once

#include <memory>

#include "python/values.h"
#include "sim/bending/law_loop.h"
#include "sim/device/device.h"

namespace hysteron::python {

// Elements of one law with their histories.
class LawState {
 public:
  LawState(const LawChoice& choice, int dimension, int elements, int threads);

  int elements() const { return elements_; }
  LawState copy() const;

  // K: `dimension` numbers an element [1/m]; results of the same shape.  GIL held.
  py::array step(const Numbers& curvature, double dt, py::object out);
  py::array trial(const Numbers& curvature, double dt) const;
  py::array tangent(const Numbers& curvature, double dt) const;
  py::array stored(const Numbers& curvature) const;
  py::array friction_share(const Numbers& curvature) const;
  py::array residual() const;
  py::array dissipated() const;
  std::size_t history_bytes() const { return loop_->history_bytes(); }
  double largest_stiffness() const { return loop_->largest_stiffness(); }

 private:
  const double* checked(const Numbers& curvature) const;
  py::array_t<double> make_array(int columns, int of_each = 1) const;
  py::array measured(LawMeasure what, const double* curvature, int numbers) const;
  OperatorView<double> view() const;
  void tangents(const double* k, double dt, double* to) const;

  LawChoice choice_;
  int dimension_, elements_;
  std::unique_ptr<Cpu> cpu_;
  std::unique_ptr<LawLoop<double, Cpu>> loop_;
  // The operator that makes curvatures of themselves: an element of unit area for each, with hinges of its
  // own.
  std::vector<double> area_, coefficient_;
  std::vector<int> start_, hinge_;
};

}  // namespace hysteron::python
