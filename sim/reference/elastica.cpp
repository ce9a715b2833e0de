// With the weight w per area and the length L, at distance s from the clamp the law's moment balances the
// weight beyond,
//   M(K(s)) = load * w * int_s^L [(x(t) - x(s)) cos(tilt) - (y(t) - y(s)) sin(tilt)] dt,
//   x' = cos theta, y' = sin theta, theta' = K, theta(0) = 0.
// Curvatures are at the segments' middles; Newton's method solves for all of them with the whole Jacobian.
#include "sim/reference/elastica.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "sim/base/error.h"
#include "sim/bending/law_loop.h"

namespace hysteron {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kSeconds = 1;       // of a step, for laws with a clock [s]
constexpr double kBalanced = 1e-12;  // unbalanced moment over w L^2 load
constexpr int kMaxNewtonSteps = 60, kMaxHalvings = 30;
constexpr int kMaxLoadSteps = 5000;  // from one load to the next

// The law at `count` points with a history each.
class Points {
 public:
  Points(const LawRequest& law, double rigidity, int count)
      : cpu_(1),
        factor_(std::sqrt(rigidity)),
        loop_(make_law_loop<double>(cpu_, choose_law(law.name, law.curve, law.parameters), 1, count)),
        area_(count, 1.0),
        coefficient_(count, factor_),
        item_(count),
        start_(count + 1),
        moment_(count),
        tangent_(count),
        energy_(count) {
    for (int i = 0; i <= count; ++i) start_[i] = i;
    for (int i = 0; i < count; ++i) item_[i] = i;
  }
  // Computes M and dM/dK at these curvatures, from the accepted history.
  void look(const VectorXd& curvature, VectorXd& moment, VectorXd& tangent) {
    loop_->trial(cpu_, view(), curvature.data(), {kSeconds, kSeconds, 0, nullptr}, moment_.data(),
                 energy_.data());
    loop_->tangents(cpu_, view(), curvature.data(), {kSeconds, kSeconds, 0, nullptr}, tangent_.data());
    moment = factor_ * moment_;
    tangent = factor_ * factor_ * tangent_;
  }
  void accept(const VectorXd& curvature) {
    loop_->commit(cpu_, view(), curvature.data(), kSeconds, {0, nullptr, nullptr}, moment_.data());
  }

 private:
  OperatorView<double> view() const {
    return {static_cast<int>(area_.size()), area_.data(), start_.data(), item_.data(), coefficient_.data()};
  }
  Cpu cpu_;
  double factor_;  // from the strip's curvatures to the law's
  std::unique_ptr<LawLoop<double, Cpu>> loop_;
  std::vector<double> area_, coefficient_;
  std::vector<int> item_, start_;
  VectorXd moment_, tangent_;
  std::vector<double> energy_;
};

// The sum over the segments beyond a place, along one axis: their first moment, and its derivative by the
// curvatures.
struct Beyond {
  double first = 0;
  Eigen::RowVectorXd moves;

  explicit Beyond(int n) : moves(Eigen::RowVectorXd::Zero(n)) {}
  void add(double length, double middle, const Eigen::RowVectorXd& middle_moves) {
    first += length * middle;
    moves += length * middle_moves;
  }
};

// The curve and the moments of its weight for load 1, with their derivatives by the curvatures.
struct Curve {
  VectorXd node_angle;
  std::vector<Eigen::Vector2d> node;
  VectorXd moment;
  MatrixXd by_curvature;
};

Curve deflection_curve(const VectorXd& h, const VectorXd& curvature, double weight, double tilt) {
  const int n = static_cast<int>(h.size());
  Curve c{VectorXd::Zero(n + 1), {{0, 0}}, VectorXd(n), MatrixXd(n, n)};
  // These are the derivatives of the angles at the segments' middles, and of these middles, forward and down.
  MatrixXd turn = MatrixXd::Zero(n, n), forward_moves(n, n), down_moves(n, n);
  VectorXd forward(n), down(n), middle_angle(n);
  Eigen::RowVectorXd node_forward = Eigen::RowVectorXd::Zero(n), node_down = node_forward;
  for (int i = 0; i < n; ++i) {
    middle_angle[i] = c.node_angle[i] + h[i] / 2 * curvature[i];
    c.node_angle[i + 1] = c.node_angle[i] + h[i] * curvature[i];
    turn.row(i).head(i) = h.head(i).transpose();
    turn(i, i) = h[i] / 2;
    const double cosine = std::cos(middle_angle[i]), sine = std::sin(middle_angle[i]);
    forward[i] = c.node[i].x() + h[i] / 2 * cosine;
    down[i] = c.node[i].y() + h[i] / 2 * sine;
    forward_moves.row(i) = node_forward - h[i] / 2 * sine * turn.row(i);
    down_moves.row(i) = node_down + h[i] / 2 * cosine * turn.row(i);
    node_forward -= h[i] * sine * turn.row(i);
    node_down += h[i] * cosine * turn.row(i);
    c.node.push_back(c.node[i] + h[i] * Eigen::Vector2d(cosine, sine));
  }
  // The sums go from the free end: the length beyond, and its first moments.
  const double across = weight * std::cos(tilt), along = weight * std::sin(tilt);
  double length = 0;
  Beyond ahead(n), below(n);
  for (int i = n - 1; i >= 0; --i) {
    const double own = h[i] * h[i] / 8;  // of the outer half of the segment itself, about its middle
    const double cosine = std::cos(middle_angle[i]), sine = std::sin(middle_angle[i]);
    c.moment[i] = across * (ahead.first - length * forward[i] + own * cosine) -
                  along * (below.first - length * down[i] + own * sine);
    c.by_curvature.row(i) =
        across * (ahead.moves - length * forward_moves.row(i) - own * sine * turn.row(i)) -
        along * (below.moves - length * down_moves.row(i) + own * cosine * turn.row(i));
    length += h[i];
    ahead.add(h[i], forward[i], forward_moves.row(i));
    below.add(h[i], down[i], down_moves.row(i));
  }
  return c;
}

class Solver {
 public:
  explicit Solver(const HeavyStrip& strip)
      : strip_(strip),
        points_(strip.law, strip.rigidity, strip.segments),
        h_(strip.segments),
        curvature_(VectorXd::Zero(strip.segments)) {
    const auto end = [&](int i) {  // ends at u = i/n are dense at the clamp, where heavy strips bend
      const double u = static_cast<double>(i) / strip.segments;
      return strip.length * u * (0.2 + 0.8 * u);
    };
    for (int i = 0; i < strip.segments; ++i) h_[i] = end(i + 1) - end(i);
  }

  // Goes from the accepted load to another.
  void go_to(double load, double longest) {
    double step = longest;
    for (int steps = 0, halvings = 0; load_ != load; ++steps) {
      const double next =
          std::abs(load - load_) <= step ? load : load_ + std::clamp(load - load_, -step, step);
      if (solve(next)) {
        load_ = next;
      } else {
        step /= 2;
        ++halvings;
      }
      if (load_ != load && (halvings > kMaxHalvings || steps > kMaxLoadSteps))
        throw Error::simulation("no equilibrium of the heavy strip was found at load " +
                                std::to_string(next));
    }
  }

  SaggingStrip state() const {
    const Curve c = deflection_curve(h_, curvature_, strip_.weight, strip_.tilt);
    SaggingStrip result;
    result.load = load_;
    result.arc = {0};
    for (int i = 0; i < strip_.segments; ++i) result.arc.push_back(result.arc.back() + h_[i]);
    result.line = c.node;
    result.angle.assign(c.node_angle.begin(), c.node_angle.end());
    result.curvature.assign(curvature_.begin(), curvature_.end());
    return result;
  }

 private:
  // Solves by Newton's method with steps shortened until the unbalanced moment falls.
  bool solve(double load) {
    const double scale = kBalanced * strip_.weight * strip_.length * strip_.length * std::max(1.0, load);
    VectorXd k = curvature_, moment, tangent;
    Curve c = deflection_curve(h_, k, strip_.weight, strip_.tilt);
    points_.look(k, moment, tangent);
    VectorXd residual = moment - load * c.moment;
    for (int iteration = 0; iteration < kMaxNewtonSteps; ++iteration) {
      if (residual.lpNorm<Eigen::Infinity>() <= scale) {
        points_.accept(k);
        curvature_ = k;
        return true;
      }
      MatrixXd jacobian = -load * c.by_curvature;
      jacobian.diagonal() += tangent;
      const VectorXd newton_step = jacobian.partialPivLu().solve(-residual);
      const double before = residual.norm();
      bool lower = false;
      for (double fraction = 1; !lower && fraction > 1e-4; fraction /= 2) {
        const VectorXd tried = k + fraction * newton_step;
        c = deflection_curve(h_, tried, strip_.weight, strip_.tilt);
        points_.look(tried, moment, tangent);
        residual = moment - load * c.moment;
        lower = residual.norm() < before;
        if (lower) k = tried;
      }
      if (!lower) return false;
    }
    return false;
  }

  HeavyStrip strip_;
  Points points_;
  VectorXd h_, curvature_;
  double load_ = 0;
};

}  // namespace

double SaggingStrip::chord_angle() const { return std::atan2(line.back().y(), line.back().x()); }

std::vector<SaggingStrip> sagging_strips(const HeavyStrip& strip, const std::vector<double>& loads,
                                         int steps) {
  double largest = 0;
  for (double load : loads) largest = std::max(largest, std::abs(load));
  Solver solver(strip);
  std::vector<SaggingStrip> result;
  for (double load : loads) {
    solver.go_to(load, largest / steps);
    result.push_back(solver.state());
  }
  return result;
}

}  // namespace hysteron
