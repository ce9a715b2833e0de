// What follows from solved settings: which are worth their time, and the orders at which errors fall.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/accuracy/accuracy.h"

namespace hysteron::experiments {

struct Solved {
  Setting setting;
  Found found;
};

// A problem's settings, in their order, solved.
struct Solution {
  Problem problem;
  std::vector<Solved> solved;

  // Whether the setting answers the same question as the base: the same law and load, and the same mesh where
  // each mesh has a reference of its own.
  bool comparable(const Setting& setting) const;
};

// Indices of the comparable settings that no other one beats in both error and time, fastest first.
std::vector<std::size_t> pareto_front(const Solution& solution);

// The fastest comparable setting with at most this error.
std::optional<std::size_t> cheapest(const Solution& solution, double error);

// Between two settings that differ in nothing but size or step.
struct Order {
  std::string in;           // space | time
  std::string group;        // what they share
  double from = 0, to = 0;  // cells' size relative to the coarsest of the group; or steps [s]
  double error_from = 0, error_to = 0;
  double order = 0;
};
std::vector<Order> observed_orders(const Solution& solution);

// "bdf2, 1/120 s", "shape, random, 512 triangles": what the problem's settings differ in.
std::string describe(const Solution& solution, const Setting& setting);
// A curve of the plot: neither size nor step.
std::string curve_label(const Solution& solution, const Setting& setting);

}  // namespace hysteron::experiments
