#include "sim/reference/buckled_strip.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "sim/base/error.h"

namespace hysteron {
namespace {

using Eigen::VectorXd;

constexpr int kMaxIterations = 60;
constexpr double kConverged = 1e-10;                   // of residuals, over the moment b1/L and the length
constexpr double kShortestStep = 1e-7;                 // of the clamps, over the length
constexpr double kSmallestFraction = 1e-4;             // smallest fraction of a Newton step
constexpr double kFirstRaise = 1e-3, kMaxRaise = 1e3;  // raise of the diagonal, over b1 of an element
constexpr double kPenalty = 2;                         // on the gap, over the force
constexpr double kArmijo = 0.1;                        // share of the decrease that the slope predicts
constexpr int kWeightSteps = 8;                        // in which the first shape gets its weight

}  // namespace

// Angles and force of a trial: the Lagrangian E - F (length along the line of the clamps - d)/2, its gradient
// and its Hessian, a tridiagonal matrix, and the gradient of the constraint.
struct BuckledStripTest::Trial {
  VectorXd angle;
  double force = 0;
  double energy = 0, gap = 0;  // E of half the strip; half of the strip's excess length for the distance
  // above[i] couples i and i + 1; border is minus the gradient of the gap.
  VectorXd residual, diagonal, above, border;
  double norm = 0;  // dimensionless norm of residual and gap

  // Returns the merit that a step has to lower: it is exact where the penalty is larger than the force.
  double merit(double penalty) const { return energy + penalty * std::abs(gap); }
  // Returns its derivative along a direction that closes the gap.
  double slope(const VectorXd& turn, double penalty) const {
    return (residual - force * border).dot(turn) - penalty * std::abs(gap);
  }
};

struct BuckledStripTest::Direction {
  VectorXd turn;
  double force = 0;
};

// Returns Newton's step by two solutions with the tridiagonal matrix.  Its diagonal is raised until the
// energy is convex along the constraint: the matrix has no negative pivot, or one that the border compensates
// (inertia of the bordered matrix; Nocedal & Wright 2006, section 16.2).
BuckledStripTest::Direction BuckledStripTest::direction(const Trial& at) const {
  const auto n = static_cast<int>(at.angle.size());
  const double stiff = strip_.law.initial_stiffness() / h_;
  for (double raised = 0;; raised = raised == 0 ? kFirstRaise * stiff : 4 * raised) {
    VectorXd pivot = at.diagonal.array() + raised, x = -at.residual, y = at.border;
    int negative = pivot[0] < 0;
    for (int i = 1; i < n; ++i) {
      const double fraction = at.above[i - 1] / pivot[i - 1];
      pivot[i] -= fraction * at.above[i - 1];
      x[i] -= fraction * x[i - 1];
      y[i] -= fraction * y[i - 1];
      negative += pivot[i] < 0;
    }
    for (int i = n - 1; i >= 0; --i) {
      if (i + 1 < n) x[i] -= at.above[i] * x[i + 1], y[i] -= at.above[i] * y[i + 1];
      x[i] /= pivot[i];
      y[i] /= pivot[i];
    }
    const double bordered = at.border.dot(y);
    const bool convex = negative == (bordered > 0 ? 0 : 1);
    if (!convex && raised < kMaxRaise * stiff) continue;
    const double force = (at.border.dot(x) - at.gap) / bordered;
    return {x - force * y, force};
  }
}

BuckledStripTest::BuckledStripTest(const BuckledStrip& strip, double distance, Start start)
    : strip_(strip),
      h_(strip.length / 2 / strip.elements),
      angle_(VectorXd::Zero(strip.elements - 1)),
      anchors_(Eigen::MatrixXd::Zero(strip.law.stops(), strip.elements)),
      distance_(strip.length) {
  lay(distance, start);
}

double BuckledStripTest::slope(int node) const {
  return node == 0 || node == strip_.elements ? 0 : angle_[node - 1];
}

void BuckledStripTest::assemble(Trial& t, double distance, double weight) const {
  const int n = strip_.elements;
  t.residual = t.diagonal = t.above = t.border = VectorXd::Zero(n - 1);
  t.energy = 0;
  for (int e = 0; e < n; ++e) {
    const double from = e == 0 ? 0 : t.angle[e - 1], to = e == n - 1 ? 0 : t.angle[e];
    const StopsPoint at = respond(strip_.law, anchors_.col(e).data(), (to - from) / h_);
    t.energy += h_ * (at.stored + at.dissipated);
    if (e > 0) t.residual[e - 1] -= at.response, t.diagonal[e - 1] += at.tangent / h_;
    if (e < n - 1) t.residual[e] += at.response, t.diagonal[e] += at.tangent / h_;
    if (e > 0 && e < n - 1) t.above[e - 1] = -at.tangent / h_;
  }
  t.gap = h_ - distance / 2;
  for (int i = 0; i < n - 1; ++i) {
    const double carried = weight * h_ * (strip_.length / 2 - (i + 1) * h_);
    const double sine = std::sin(t.angle[i]), cosine = std::cos(t.angle[i]);
    t.energy += carried * sine;
    t.residual[i] += carried * cosine + t.force * h_ * sine;
    t.diagonal[i] += -carried * sine + t.force * h_ * cosine;
    t.border[i] = h_ * sine;
    t.gap += h_ * cosine;
  }
  const double moment = strip_.law.initial_stiffness() / strip_.length;
  t.norm = std::hypot(t.residual.norm() / moment, t.gap / strip_.length);
}

// Solves by sequential quadratic programming (Nocedal & Wright 2006, section 18.3): steps are shortened until
// the merit falls as it should, or the residuals fall strongly, a test that rounding does not disturb near
// the end.
bool BuckledStripTest::solve(double distance, double weight) {
  Trial at;
  at.angle = angle_;
  at.force = force_;
  assemble(at, distance, weight);
  double penalty = 0;
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    if (at.norm <= kConverged) {
      angle_ = at.angle;
      force_ = at.force;
      return true;
    }
    const Direction newton_step = direction(at);
    if (!newton_step.turn.allFinite()) return false;
    penalty = std::max(penalty, kPenalty * std::abs(at.force + newton_step.force));
    const double merit = at.merit(penalty), slope = at.slope(newton_step.turn, penalty);
    Trial next = at;
    bool lower = false;
    for (double fraction = 1; !lower && fraction > kSmallestFraction; fraction /= 2) {
      next.angle = at.angle + fraction * newton_step.turn;
      next.force = at.force + fraction * newton_step.force;
      assemble(next, distance, weight);
      lower = next.merit(penalty) <= merit + kArmijo * fraction * slope || next.norm <= at.norm / 2;
    }
    if (!lower) return false;
    std::swap(at, next);
  }
  return false;
}

void BuckledStripTest::accept() {
  for (int e = 0; e < strip_.elements; ++e) {
    const double curvature = (slope(e + 1) - slope(e)) / h_;
    dissipated_ += h_ * 2 * respond(strip_.law, anchors_.col(e).data(), curvature).dissipated;
    hysteron::accept(strip_.law, anchors_.col(e).data(), curvature);
  }
}

void BuckledStripTest::lay(double distance, Start start) {
  const double half = strip_.length / 2, slack = 1 - distance / strip_.length;
  for (int i = 0; i < strip_.elements - 1; ++i)
    angle_[i] = 2 * std::sqrt(slack) * std::sin(M_PI * (i + 1) * h_ / half);
  const StopsLaw law = strip_.law;
  if (start == Start::relaxed) strip_.law.stiffnesses.assign(law.stops(), 0);
  force_ = -strip_.law.initial_stiffness() * std::pow(M_PI / half, 2);
  const int steps = strip_.weight == 0 ? 0 : kWeightSteps;
  for (int i = 0; i <= steps; ++i)
    if (!solve(distance, steps == 0 ? 0 : strip_.weight * i / steps))
      throw Error::simulation("no equilibrium of the strip was found at " + std::to_string(distance) +
                              " m between the clamps, the first distance");
  strip_.law = law;
  if (start == Start::virgin)
    accept();
  else
    for (int e = 0; e < strip_.elements; ++e) anchors_.col(e).setConstant((slope(e + 1) - slope(e)) / h_);
  distance_ = distance;
}

void BuckledStripTest::go_to(double distance, double step) {
  double size = step * strip_.length;
  while (distance_ != distance) {
    const double left = distance - distance_;
    const double next = std::abs(left) <= size ? distance : distance_ + std::copysign(size, left);
    if (solve(next, strip_.weight)) {
      accept();
      distance_ = next;
      size = std::min(2 * size, step * strip_.length);
    } else if ((size = std::min(size, std::abs(left)) / 2) < kShortestStep * strip_.length ||
               ++halvings_ > strip_.most_halvings) {
      throw Error::simulation("no equilibrium of the strip was found at " + std::to_string(next) +
                              " m between the clamps");
    }
  }
}

double BuckledStripTest::energy() const {
  double energy = 0, height = 0;
  for (int e = 0; e < strip_.elements; ++e) {
    const double curvature = (slope(e + 1) - slope(e)) / h_;
    energy += h_ * respond(strip_.law, anchors_.col(e).data(), curvature).stored;
    height = strip_.length / 2 - (e + 1) * h_;
    energy += strip_.weight * h_ * height * std::sin(slope(e + 1));
  }
  return 2 * energy;
}

double BuckledStripTest::peak_curvature() const {
  double largest = 0;
  for (int e = 0; e < strip_.elements; ++e)
    largest = std::max(largest, std::abs(slope(e + 1) - slope(e)) / h_);
  return largest;
}

double BuckledStripTest::bend() const {
  double sum = 0;
  for (int e = 0; e < strip_.elements; ++e) sum += std::abs(slope(e + 1) - slope(e));
  return 2 * sum;
}

std::vector<Eigen::Vector2d> BuckledStripTest::line() const {
  const int n = strip_.elements;
  std::vector<Eigen::Vector2d> points = {{0, 0}};
  for (int e = 0; e < n; ++e) {
    const Eigen::Vector2d from(std::cos(slope(e)), std::sin(slope(e)));
    const Eigen::Vector2d to(std::cos(slope(e + 1)), std::sin(slope(e + 1)));
    points.push_back(points.back() + h_ / 2 * (from + to));
  }
  for (int e = n - 1; e >= 0; --e) points.emplace_back(distance_ - points[e].x(), points[e].y());
  return points;
}

}  // namespace hysteron
