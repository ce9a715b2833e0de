#include "sim/identification/turns.h"

#include <algorithm>
#include <cmath>

namespace hysteron {
namespace {

double sign(double x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

// Returns a turn at the first row, which the law reaches from curvature `before` [1/m].
SoughtTurn first_turn(const MomentSeries& series, double before, double step) {
  const double direction = sign(series.drive[0] - before);
  return {0, direction, series.drive[0], step, -1, 0, 0};
}

// Returns the direction of the way between the turn number `turn` (0: the first row) and the next.
double direction_after(const MomentSeries& series, std::size_t turn) {
  const int from = turn == 0 ? 0 : series.turns[turn - 1];
  const int to = turn < series.turns.size() ? series.turns[turn] : series.rows() - 1;
  return sign(series.drive[to] - series.drive[from]);
}

}  // namespace

double SoughtTurn::curvature_at(double beyond) const {
  return curvature + direction * std::abs(beyond) * step;
}

std::vector<SoughtTurn> sought_turns(const MomentSeries& series, bool cycling, double least) {
  std::vector<SoughtTurn> turns;
  const std::vector<double>& k = series.drive;
  const double first = direction_after(series, 0), last = direction_after(series, series.turns.size());
  if (cycling && last * first < 0) {
    SoughtTurn turn = first_turn(series, k[k.size() - 2], std::abs(k.back() - k[k.size() - 2]));
    turn.direction = last;
    turn.curvature = last * std::max(last * k[0], last * k.back());
    turns.push_back(turn);
  } else if (!cycling && k[0] * first < 0) {
    turns.push_back(first_turn(series, 0, std::abs(k[1] - k[0])));
  }
  for (std::size_t i = 0; i < series.turns.size(); ++i) {
    const int row = series.turns[i];
    const double before = std::abs(k[row] - k[row - 1]), after = std::abs(k[row + 1] - k[row]),
                 step = std::max(before, after);
    turns.push_back(
        {row, direction_after(series, i), k[row], step, -1, 1, step > 0 ? (before - after) / (2 * step) : 0});
  }
  std::erase_if(turns, [&](const SoughtTurn& turn) { return !(turn.step > least); });
  return turns;
}

double largest_step(const std::vector<SoughtTurn>& turns) {
  double largest = 0;
  for (const SoughtTurn& turn : turns) largest = std::max(largest, turn.step);
  return largest;
}

DrivenRows with_turns(const std::vector<LawRow>& rows, int measured, const std::vector<SoughtTurn>& turns,
                      const Eigen::VectorXd& beyond) {
  DrivenRows driven;
  const auto add = [&](const LawRow& row, bool is_added) {
    driven.rows.push_back(row);
    driven.is_added.push_back(is_added);
  };
  // A turn on the way to a row takes its part of the time.
  const auto add_turn = [&](double curvature, LawRow& next) {
    const double from = driven.rows.empty() ? 0 : driven.rows.back().curvature;
    const double there = std::abs(curvature - from), back = std::abs(next.curvature - curvature);
    const double part = there + back > 0 ? there / (there + back) : 0;
    add({curvature, part * next.seconds}, true);
    next.seconds *= 1 - part;
  };
  std::size_t turn = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const int row = static_cast<int>(i) % measured;
    LawRow next = rows[i];
    if (row == 0) turn = 0;
    while (turn < turns.size()) {
      const double p = beyond[static_cast<int>(turn)];
      const int follows = turns[turn].row + (p > 0 ? 1 : 0);  // the row after the turn
      if (follows > row) break;
      if (p != 0) add_turn(turns[turn].curvature_at(p), next);
      ++turn;
    }
    add(next, false);
  }
  return driven;
}

std::vector<double> without_added(const std::vector<double>& values, const DrivenRows& driven) {
  std::vector<double> measured;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!driven.is_added[i]) measured.push_back(values[i]);
  return measured;
}

}  // namespace hysteron
