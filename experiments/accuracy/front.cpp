#include "experiments/accuracy/accuracy.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "sim/base/number_in.h"
#include "sim/scene/key_table.h"

namespace hysteron::experiments {
namespace {

bool is_static(const MethodSetting& s) { return s.integrator == Integrator::quasi_static; }

std::string duration(double seconds) {
  if (seconds >= 1e-3) return fmt::format("1/{:.0f} s", 1 / seconds);
  return number_text(1e3 * seconds, 2, "ms");
}

// Names the method: "the chapter's method" is that of assets/scenes/chapter-method.toml, "the chapter's
// splitting" its order of stages with another law, element or force.
std::string method_name(const MethodSetting& s) {
  if (s.integrator != Integrator::semi_implicit || s.implicit_every != ImplicitEvery::step)
    return enum_name(s.integrator);
  return s.force == ForceConvention::chapter ? "the chapter's method" : "the chapter's splitting";
}

std::vector<std::string> setting_text(const Solution& solution, const MethodSetting& s) {
  const MethodSetting& base = solution.problem.settings.front();
  std::vector<std::string> words;
  if (is_static(base)) {
    words = {enum_name(s.element), enum_name(s.mesh)};
  } else {
    words = {method_name(s)};
    if (s.tolerance > 0) words.back() += " adaptive";
    if (s.element != base.element) words.push_back(enum_name(s.element));
    if (s.mesh != base.mesh) words.push_back(enum_name(s.mesh));
  }
  if (s.law != base.law) words.push_back(s.law);
  if (s.load != base.load) words.push_back(solution.problem.load + " = " + number_text(s.load, 6));
  if (s.precision != base.precision) words.push_back(enum_name(s.precision));
  return words;
}

// Names the group whose settings differ in the size, or in the step, alone.
std::string setting_group(const Solution& solution, const MethodSetting& s, bool in_space) {
  std::vector<std::string> words = setting_text(solution, s);
  words.push_back(in_space ? duration(s.step) : std::to_string(s.triangles) + " triangles");
  words.push_back(fmt::format("tolerance {:g}", s.tolerance));
  return join(words, ", ");
}

void add_orders(const Solution& solution, bool in_space, std::vector<Order>& orders) {
  struct Point {
    double size, error;
  };
  std::map<std::string, std::vector<Point>> groups;
  for (const Solved& s : solution.solved) {
    if (!s.found.failed.empty() || !(s.found.error > 0)) continue;
    const double size = in_space ? 1 / std::sqrt(s.found.triangles) : s.setting.step;
    if (size > 0) groups[setting_group(solution, s.setting, in_space)].push_back({size, s.found.error});
  }
  for (auto& [name, points] : groups) {
    std::sort(points.begin(), points.end(), [](const Point& a, const Point& b) { return a.size > b.size; });
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      const Point &a = points[i], &b = points[i + 1];
      const double unit = in_space ? points[0].size : 1;
      if (a.size > 1.1 * b.size)
        orders.push_back({in_space ? "space" : "time", name, a.size / unit, b.size / unit, a.error, b.error,
                          std::log(a.error / b.error) / std::log(a.size / b.size)});
    }
  }
}

}  // namespace

bool Solution::comparable(const MethodSetting& s) const {
  const MethodSetting& base = problem.settings.front();
  const bool same_mesh = s.mesh == base.mesh && s.triangles == base.triangles && s.element == base.element;
  return s.law == base.law && s.load == base.load && (!problem.reference_per_mesh || same_mesh);
}

std::vector<std::size_t> pareto_front(const Solution& solution) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < solution.solved.size(); ++i) {
    const auto& [setting, found] = solution.solved[i];
    if (solution.comparable(setting) && found.failed.empty()) order.push_back(i);
  }
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return solution.solved[a].found.seconds < solution.solved[b].found.seconds;
  });
  std::vector<std::size_t> front;
  double least = INFINITY;
  for (std::size_t i : order)
    if (solution.solved[i].found.error < least) {
      least = solution.solved[i].found.error;
      front.push_back(i);
    }
  return front;
}

std::optional<std::size_t> cheapest(const Solution& solution, double error) {
  for (std::size_t i : pareto_front(solution))
    if (solution.solved[i].found.error <= error) return i;
  return {};
}

std::vector<Order> observed_orders(const Solution& solution) {
  std::vector<Order> orders;
  if (!solution.problem.reference_per_mesh) add_orders(solution, true, orders);
  if (!is_static(solution.problem.settings.front())) add_orders(solution, false, orders);
  return orders;
}

// Labels few enough curves to colour them all: other elements, and other meshes of a motion, are one curve
// each.
std::string curve_label(const Solution& solution, const MethodSetting& setting) {
  const MethodSetting& base = solution.problem.settings.front();
  if (setting.element != base.element) return enum_name(setting.element) + ", every mesh";
  if (!is_static(base) && setting.mesh != base.mesh) return "other meshes";
  if (setting.precision != base.precision) return enum_name(setting.precision);
  return join(setting_text(solution, setting), ", ");
}

std::string describe(const Solution& solution, const MethodSetting& s) {
  std::vector<std::string> words = setting_text(solution, s);
  words.push_back(std::to_string(s.triangles) + " triangles");
  if (!is_static(s)) words.push_back(duration(s.step));
  const MethodSetting& base = solution.problem.settings.front();
  if (is_static(s) && s.step != base.step) words.push_back(fmt::format("{:.0f} load steps", 1 / s.step));
  if (s.tolerance != base.tolerance) words.push_back(fmt::format("tolerance {:g}", s.tolerance));
  return join(words, ", ");
}

}  // namespace hysteron::experiments
