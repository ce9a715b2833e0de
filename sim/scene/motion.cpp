#include "sim/scene/motion.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace hysteron {
namespace {

using Track = std::function<double(const Keyframe&)>;

double slope(const std::vector<Keyframe>& keys, std::size_t i, const Track& value) {
  return (value(keys[i + 1]) - value(keys[i])) / (keys[i + 1].time - keys[i].time);
}

// The tangent at key i is zero at the ends and where the motion turns or rests, else the harmonic mean of the
// slopes beside it.
double tangent(const std::vector<Keyframe>& keys, std::size_t i, const Track& value) {
  if (i == 0 || i + 1 == keys.size()) return 0;
  const double a = slope(keys, i - 1, value), b = slope(keys, i, value);
  return a * b > 0 ? 2 * a * b / (a + b) : 0;
}

double interpolate(const std::vector<Keyframe>& keys, double time, const Track& value) {
  if (time <= keys.front().time) return value(keys.front());
  if (time >= keys.back().time) return value(keys.back());
  std::size_t i = 0;
  while (time >= keys[i + 1].time) ++i;
  const double h = keys[i + 1].time - keys[i].time, u = (time - keys[i].time) / h;
  const double a = value(keys[i]), b = value(keys[i + 1]);
  const double ta = h * tangent(keys, i, value), tb = h * tangent(keys, i + 1, value);
  return a + u * (ta + u * (3 * (b - a) - 2 * ta - tb + u * (2 * (a - b) + ta + tb)));
}

// Motion through keyframes on a straight line is steady where there is another key on either side:
// steady_from() places keys so.
constexpr double kBeside = 1;  // [s] from the given time to the key on either side
constexpr double kFar = 1e6;   // [s] beyond any run

}  // namespace

Keyframe state_at(const Motion& motion, double time) {
  Keyframe now{time};
  if (motion.keys.empty()) return now;
  const double at = motion.cycles.said(time);
  now.angle = interpolate(motion.keys, at, [](const Keyframe& k) { return k.angle; });
  now.scale = interpolate(motion.keys, at, [](const Keyframe& k) { return k.scale; });
  for (int c = 0; c < 3; ++c)
    now.position[c] = interpolate(motion.keys, at, [c](const Keyframe& k) { return k.position[c]; });
  return now;
}

Motion steady_from(const Motion& motion, double time, const Eigen::Vector3d& velocity, double spin) {
  Motion result = motion;
  result.keys.clear();
  result.cycles = {};
  const Keyframe now = state_at(motion, time);
  for (double later : {-kBeside, 0.0, kFar, kFar + kBeside})
    result.keys.push_back(
        {time + later, now.position + later * velocity, now.angle + later * spin, now.scale});
  return result;
}

Placement placement(const Motion& motion, double time) {
  Placement result;
  if (motion.keys.empty()) return result;
  constexpr double kDegree = 3.14159265358979323846 / 180;
  const Keyframe at = state_at(motion, time);
  result.rotation = Eigen::AngleAxisd(kDegree * at.angle, motion.axis.normalized()).toRotationMatrix();
  result.scale = at.scale;
  result.translation = motion.center - result.scale * (result.rotation * motion.center) + at.position;
  return result;
}

double home_fraction(const Pin& pin, double time) {
  if (!(pin.home > 0)) return 0;
  const double u = std::clamp((time - pin.from) / pin.home, 0.0, 1.0);
  return u * u * (3 - 2 * u);
}

Eigen::Matrix3d start_rotation(const ClothShape& shape) {
  constexpr double kDegree = 3.14159265358979323846 / 180;
  const Eigen::Vector3d angle = kDegree * shape.rotation;
  return (Eigen::AngleAxisd(angle.z(), Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd(angle.y(), Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(angle.x(), Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

}  // namespace hysteron
