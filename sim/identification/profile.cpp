#include "sim/identification/profile.h"

#include <algorithm>
#include <cmath>

#include "sim/base/csv.h"
#include "sim/base/error.h"
#include "sim/identification/curve.h"
#include "sim/identification/least_squares.h"
#include "sim/identification/solve.h"
#include "sim/scene/key_table.h"

namespace hysteron {

namespace {

constexpr double kGravity = 9.81;  // [m/s^2] as in the scenes
constexpr int kTableRows = 50;

// The virgin curve has no memory of its own: `pabst` is it.
Identification identify_table(const MomentTable& table, const std::string& name,
                              const Assumptions& assumptions) {
  MomentSeries series;
  series.name = name;
  series.curvature = series.drive = table.curvature;
  series.moment = table.moment;
  CurveQuestion question;
  question.law.name = "pabst";
  question.assumptions = assumptions;
  return identify_curve(series, question);
}

void check_table(const MomentTable& table, const std::string& name) {
  const double bend = *std::max_element(table.curvature.begin(), table.curvature.end());
  if (!(bend > 0)) throw Error::invalid_input(name + ": the strip does not bend down: it has no curvature");
  check_rigidity(table.moment.back() / bend, "moment over curvature at the clamp of " + name);
}

// The table's moments by the law found.
std::vector<double> moments_by(const Identification& found, const MomentTable& table) {
  std::vector<LawRow> rows;
  for (double k : table.curvature) rows.push_back({k});
  return run_law({found.law, found.curve(), {}}, rows).moment;
}

void say_how(const SmoothProfile& line, double scatter, const Identification& from_table,
             Identification& result) {
  result.further.emplace_back("profile_length_m", line.parameters[3]);
  result.further.emplace_back("profile_scatter_m", scatter);
  result.further.emplace_back("table_b1_N_m", from_table.b1.value);
  result.further.emplace_back("table_b2_N_m", from_table.b2.value);
  result.further.emplace_back("table_k0_per_m", from_table.k0.value);
  result.statements.push_back(
      "the strip was only loaded: that it comes back by another curve, 2HB = (b1 - b2) k0 apart, is the "
      "law's "
      "reading of its bend and not seen in the data");
  result.statements.push_back(
      "a strip of this fabric hangs " + rounded(1e3 * scatter) +
      " mm (rms) from the points; moments and curvatures of the data are those of a smooth "
      "line with " +
      std::to_string(line.terms()) + " terms, through which alone b1 = " + rounded(from_table.b1.value) +
      " N m, b2 = " + rounded(from_table.b2.value) + " N m, k0 = " + rounded(from_table.k0.value) + "/m");
}

}  // namespace

MomentTable moment_table(const SmoothProfile& line, double weight) {
  const std::vector<Eigen::Vector2d> points = centre_line(line);
  const double length = line.parameters[3], step = length / kSegments;
  MomentTable table;
  double beyond = 0, moment_of_beyond = 0;  // length beyond s, and its integral of x
  const int stride = kSegments / kTableRows;
  for (int i = kSegments - 1; i >= 0; --i) {
    beyond += step;
    moment_of_beyond += step * (points[i].x() + points[i + 1].x()) / 2;
    if (i % stride) continue;
    table.curvature.push_back(bend(line, static_cast<double>(i) / kSegments) / length);
    table.moment.push_back(weight * (moment_of_beyond - beyond * points[i].x()));
  }
  return table;
}

Identification identify_profile(const Profile& profile, double density, const Assumptions& assumptions) {
  const SmoothProfile line = smooth(profile);
  const double weight = density * kGravity;
  const MomentTable table = moment_table(line, weight);
  check_table(table, profile.name);
  const Identification from_table = identify_table(table, profile.name, assumptions);

  const VirginCurve first = from_table.curve();
  const StripModel model(profile, line, weight,
                         {first.b2, std::max(first.b1 - first.b2, 0.01 * first.b1), first.k0, {}, 0});
  Solution solution = solve(model);
  solution.iterations += line.iterations + from_table.iterations;
  Identification result;
  result.law = "pabst";
  identify(model, assumptions, "shape of the sagging strip in " + profile.name, solution, result);
  result.curvature = table.curvature;
  result.moment = table.moment;
  result.model = moments_by(result, table);
  say_how(line, model.scatter(solution.used), from_table, result);
  return result;
}

// The smooth centre line of a sagging cantilever.

namespace {

constexpr int kFewestPoints = 12;
constexpr double kShortest = 5e-3, kLongest = 2;  // [m] of a strip: otherwise other units
constexpr int kMaxTerms = 10;
constexpr double kBackwards = 0.02;  // noise of x in a strip that hangs straight down, over its span
constexpr int kNear = 8;             // segments searched to both sides of where a point lies by its chord

// A sagging strip runs on to the right or down, never back to the left.
void check_order(const Profile& profile, const Table& table) {
  const auto& p = profile.points;
  const double span = (p.back() - p.front()).norm();
  double furthest = p[0].x();
  for (std::size_t i = 1; i < p.size(); ++i) {
    const Eigen::Vector2d increment = p[i] - p[i - 1];
    furthest = std::max(furthest, p[i].x());
    if (increment.x() - increment.y() > 0 && p[i].x() > furthest - kBackwards * span) continue;
    throw table.refusal(
        i, "the point " + number_text(p[i].x()) + ", " + number_text(p[i].y()) + " m lies back from " +
               number_text(p[i - 1].x()) + ", " + number_text(p[i - 1].y()) +
               " m, the row before: a profile goes from the clamp to the free end, on or down");
  }
}

void check_profile(const Profile& profile, const Table& table) {
  const auto refused = [&](const std::string& what) {
    return Error::invalid_input(table.file + ": " + what).with_experiment(table.reader);
  };
  const auto& p = profile.points;
  if (static_cast<int>(p.size()) < kFewestPoints) {
    throw refused(std::to_string(p.size()) + " points, at least " + std::to_string(kFewestPoints) +
                  " are needed");
  }
  const double span = (p.back() - p.front()).norm();
  if (span < kShortest || span > kLongest) {
    throw refused("the profile spans " + number_text(span) + " m, must be in [" + number_text(kShortest) +
                  ", " + number_text(kLongest) + "] m; x and y are metres");
  }
  check_order(profile, table);
  if (p.back().y() < p.front().y()) return;
  throw refused("the free end is at y = " + number_text(p.back().y()) + " m, not below the clamp's " +
                number_text(p.front().y()) + " m; y points up, the strip sags");
}

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

// Angle by which the line turns along segment i, to the left positive [rad].
double turn(const std::vector<Eigen::Vector2d>& line, int i) {
  const int before = std::max(i - 1, 0), after = std::min(i + 1, static_cast<int>(line.size()) - 2);
  const Eigen::Vector2d from = line[before + 1] - line[before], to = line[after + 1] - line[after];
  return cross(from, to) / (from.norm() * to.norm() * (after - before));
}

// Distance of a point from the line near the segment `about`, left of the line positive.  Segments are arcs:
// an arc bulges by turn * length / 8 to the outside of its chord.
double distance(const std::vector<Eigen::Vector2d>& line, const Eigen::Vector2d& point, int about) {
  double nearest = INFINITY, signed_distance = 0;
  const int last = static_cast<int>(line.size()) - 2;
  for (int i = std::max(0, about - kNear); i <= std::min(last, about + kNear); ++i) {
    const Eigen::Vector2d along = line[i + 1] - line[i], to = point - line[i];
    const double at = std::clamp(to.dot(along) / along.squaredNorm(), 0.0, 1.0);
    const double away = (to - at * along).squaredNorm();
    if (away >= nearest) continue;
    nearest = away;
    signed_distance = cross(along, to) / along.norm() + turn(line, i) * along.norm() * at * (1 - at) / 2;
  }
  return signed_distance;
}

Eigen::VectorXd start_parameters(const Profile& profile, int terms) {
  const auto& p = profile.points;
  double length = 0;
  for (std::size_t i = 1; i < p.size(); ++i) length += (p[i] - p[i - 1]).norm();
  Eigen::VectorXd start = Eigen::VectorXd::Zero(4 + terms);
  start[0] = p[0].x();
  start[1] = p[0].y();
  start[3] = length;
  const Eigen::Vector2d chord = p.back() - p.front();
  start[4] = -3 * std::atan2(chord.y(), chord.x());
  return start;
}

}  // namespace

Profile read_profile(const std::filesystem::path& file, const std::string& reader) {
  const Table table = read_csv(file, {"x [m]", "y [m]"}, {}, reader);
  Profile profile{file.filename().string(), {}};
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    profile.points.emplace_back(table.number(i, "x [m]"), table.number(i, "y [m]"));
  check_profile(profile, table);
  return profile;
}

std::vector<double> chord_fractions(const Profile& profile) {
  std::vector<double> fractions = {0};
  for (std::size_t i = 1; i < profile.points.size(); ++i)
    fractions.push_back(fractions.back() + (profile.points[i] - profile.points[i - 1]).norm());
  for (double& fraction : fractions) fraction /= fractions.back();
  return fractions;
}

double bend(const SmoothProfile& line, double t) {
  const double u = 2 * t - 1;
  double sum = 0, before = u, now = 1;  // Chebyshev: T_-1 = u, T_0 = 1
  for (int j = 0; j < line.terms(); ++j) {
    sum += line.parameters[4 + j] * now;
    const double next = (j == 0 ? u : 2 * u * now - before);
    before = now;
    now = next;
  }
  return (1 - t) * (1 - t) * sum;
}

std::vector<Eigen::Vector2d> centre_line(const SmoothProfile& line) {
  const double step = 1.0 / kSegments, length = line.parameters[3];
  double angle = line.parameters[2], before = bend(line, 0);
  std::vector<Eigen::Vector2d> points = {line.parameters.head<2>()};
  for (int i = 0; i < kSegments; ++i) {
    const double after = bend(line, (i + 1) * step), middle = bend(line, (i + 0.5) * step);
    const double half_way = angle - (5 * before + 8 * middle - after) * step / 24;  // Simpson, to the middle
    angle -= (before + 4 * middle + after) * step / 6;
    points.emplace_back(points.back() +
                        length * step * Eigen::Vector2d(std::cos(half_way), std::sin(half_way)));
    before = after;
  }
  return points;
}

Eigen::VectorXd distances(const std::vector<Eigen::Vector2d>& line, const Profile& profile,
                          const std::vector<int>& about) {
  const int n = static_cast<int>(profile.points.size());
  Eigen::VectorXd result(n + 2);
  for (int i = 0; i < n; ++i) result[i] = distance(line, profile.points[i], about[i]);
  const Eigen::Vector2d first = line[1] - line[0], last = line[kSegments] - line[kSegments - 1];
  result[n] = first.dot(profile.points.front() - line.front()) / first.norm();
  result[n + 1] = last.dot(profile.points.back() - line.back()) / last.norm();
  return result;
}

SmoothProfile smooth_with(const Profile& profile, const Eigen::VectorXd& start) {
  std::vector<int> about;
  for (const double fraction : chord_fractions(profile))
    about.push_back(static_cast<int>(fraction * kSegments));
  SmoothProfile line;
  const auto residuals = [&](const Eigen::VectorXd& parameters) {
    SmoothProfile trial;
    trial.parameters = parameters;
    return Eigen::VectorXd(distances(centre_line(trial), profile, about) / start[3]);
  };
  const Eigen::VectorXd wide = Eigen::VectorXd::Constant(start.size(), 1e3);
  const LeastSquares fit = minimize(residuals, start, -wide, wide);
  line.parameters = fit.parameters;
  line.iterations = fit.iterations;
  const auto freedom = std::max<double>(1, static_cast<double>(fit.residuals.size() - start.size()));
  line.scatter = start[3] * std::sqrt(fit.residuals.squaredNorm() / freedom);
  return line;
}

SmoothProfile smooth(const Profile& profile) {
  const int rows = static_cast<int>(profile.points.size()) + 2;
  SmoothProfile best, line;
  double least = INFINITY;
  int iterations = 0;
  for (int terms = 1; terms <= std::min(kMaxTerms, rows / 4); ++terms) {
    Eigen::VectorXd start = start_parameters(profile, terms);
    if (terms > 1) start.head(line.parameters.size()) = line.parameters;
    line = smooth_with(profile, start);
    iterations += line.iterations;
    const double n = rows, parameters = 4 + terms;
    const double criterion =
        n * std::log(line.scatter * line.scatter * (n - parameters) / n) + 2 * parameters;
    if (criterion >= least) continue;
    least = criterion;
    best = line;
  }
  best.iterations = iterations;
  return best;
}

namespace {

// No point of a profile is known better than kBestAccuracy times this share of the length.
constexpr double kScale = 0.1;

// Curvature of the virgin curve at a moment >= 0.
double curvature_at(const VirginCurve& c, double moment) {
  if (moment >= c.elastic_limit_moment()) return (moment - c.friction_moment()) / c.b2;
  return 2 * moment / (c.b1 + std::sqrt(c.b1 * c.b1 + 4 * c.c1() * moment));
}

}  // namespace

std::vector<Eigen::Vector2d> hanging_strip(const VirginCurve& curve, double weight, double length,
                                           const StripEnd& end, int segments) {
  const double h = length / segments;
  std::vector<Eigen::Vector2d> points = {end.place};
  double angle = end.angle, lever = 0;  // lever: integral of x over the length beyond
  for (int i = 0; i < segments; ++i) {
    const double beyond = i * h;
    const auto bend_at = [&](double x, double length_beyond, double integral) {
      return curvature_at(curve, std::max(0.0, weight * (integral - length_beyond * x)));
    };
    const Eigen::Vector2d at = points.back();
    const double x_middle = at.x() - std::cos(angle) * h / 2;
    const double lever_middle = lever + (at.x() + x_middle) / 2 * h / 2;
    const double middle = angle + bend_at(at.x(), beyond, lever) * h / 2;
    points.push_back(at - h * Eigen::Vector2d(std::cos(middle), std::sin(middle)));
    lever += (at.x() + 4 * x_middle + points.back().x()) / 6 * h;
    angle += bend_at(x_middle, beyond + h / 2, lever_middle) * h;
  }
  std::reverse(points.begin(), points.end());
  return points;
}

StripModel::StripModel(const Profile& profile, const SmoothProfile& line, double weight,
                       const CurvePoint& start)
    : CurveModel(std::max(bend(line, 0) / line.parameters[3], 1e-6), 1),
      profile_(profile),
      weight_(weight),
      length_(line.parameters[3]),
      start_(start) {
  for (const double fraction : chord_fractions(profile))
    about_.push_back(static_cast<int>(fraction * kSegments));
  slope_ = start.b2 + start.g;
  const std::vector<Eigen::Vector2d> points = centre_line(line);
  const Eigen::Vector2d last = points[kSegments] - points[kSegments - 1], end = points.back() / length_;
  start_.nuisance = Eigen::Vector4d(end.x(), end.y(), std::atan2(last.y(), last.x()), 0);
}

Eigen::VectorXd StripModel::residuals(const CurvePoint& point) const {
  const Eigen::VectorXd& n = point.nuisance;
  const StripEnd end{length_ * n.head<2>(), n[2]};
  const std::vector<Eigen::Vector2d> strip =
      hanging_strip(point.curve(), weight_, length_ * std::exp(n[3]), end, kSegments);
  return distances(strip, profile_, about_) / (kScale * length_);
}

double StripModel::scatter(const CurvePoint& point) const {
  const auto n = static_cast<int>(profile_.points.size());
  return kScale * length_ * std::sqrt(residuals(point).head(n).squaredNorm() / n);
}

}  // namespace hysteron
