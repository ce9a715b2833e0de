#include "sim/scene/cycles.h"

#include <algorithm>
#include <cmath>

#include "sim/base/error.h"
#include "sim/scene/motion.h"
#include "sim/scene/shown_key.h"

namespace hysteron {
namespace {

constexpr double kNever = 1e30;  // [s], the value of `until` for "never"

std::string table_path(const std::string& list, std::size_t i) {
  return list + "[" + std::to_string(i) + "]";
}

void check_phases_that_repeat(const Scene& scene) {
  bool began = false, ended = false;
  for (std::size_t i = 0; i < scene.phase.size(); ++i) {
    if (scene.phase[i].repeat && ended)
      throw Error::invalid_input(table_path("phase", i) + ".repeat = true (" +
                                 key_origin(scene, table_path("phase", i)) +
                                 "): phases that repeat must follow one another, and " +
                                 table_path("phase", i - 1) + " before it does not");
    began |= scene.phase[i].repeat;
    ended = began && !scene.phase[i].repeat;
  }
  if (scene.cycles > 1 && !began)
    throw Error::invalid_input(shown(scene, "cycles", std::to_string(scene.cycles), "") +
                               " must be 1 without [[phase]] tables that have repeat = true")
        .with_key("cycles", std::to_string(scene.cycles));
}

// Refuses what would have to happen again in each cycle: a pin that takes hold, an obstacle that appears, a
// command.
void check_happens_before(const Scene& scene, const std::string& path, const std::string& key, double time) {
  const double start = scene_cycles(scene).start;
  if (time <= start || time >= kNever) return;
  const std::string of = path + "." + key;
  throw Error::invalid_input(of + " = " + number_text(time, 6, "s") + " (" +
                             key_origin(scene, of, key_origin(scene, path)) +
                             ") must be <= " + number_text(start, 6, "s") + ", where the first of " +
                             shown(scene, "cycles", std::to_string(scene.cycles), "") +
                             " begins: it happens once, and only motions come again")
      .with_key(of, number_text(time));
}

// Refuses a motion that does not end each cycle where it begins, beyond rounding: it would jump.
void check_comes_back(const Scene& scene, const std::string& path, const Motion& motion) {
  constexpr double kRounding = 1e-9;
  Motion once = motion;
  once.cycles = {};
  const Cycles cycles = scene_cycles(scene);
  const Placement first = placement(once, cycles.start), last = placement(once, cycles.once_over());
  const double turned = Eigen::AngleAxisd(first.rotation.transpose() * last.rotation).angle();
  const double moved = (last(motion.center) - first(motion.center)).norm();
  const double scaled = std::abs(last.scale / first.scale - 1);
  if (std::max({turned, moved, scaled}) <= kRounding) return;
  constexpr double kDegrees = 180 / 3.14159265358979323846;
  throw Error::invalid_input(
      path + ".keys (" + key_origin(scene, path) + ") must come back from " +
      number_text(cycles.start, 6, "s") + " to " + number_text(cycles.once_over(), 6, "s") + ", which " +
      shown(scene, "cycles", std::to_string(scene.cycles), "") + " repeat: they end " +
      number_text(moved, 3) + " m, " + number_text(kDegrees * turned, 3) + " degree and " +
      number_text(100 * scaled, 3) + " % of the size beside where they begin")
      .with_key(path + ".keys", "");
}

}  // namespace

Cycles scene_cycles(const Scene& scene) {
  Cycles cycles{0, 0, scene.cycles};
  for (const Phase& phase : scene.phase) {
    if (phase.repeat)
      cycles.length += phase.seconds;
    else if (cycles.length == 0)
      cycles.start += phase.seconds;
  }
  return cycles.length > 0 ? cycles : Cycles{};
}

int cycle_at(const Scene& scene, double time) {
  const Cycles cycles = scene_cycles(scene);
  if (cycles.length == 0) return 0;
  const bool ends_with_them = scene.phase.back().repeat;
  return ends_with_them && time >= cycles.end_of(cycles.count) ? cycles.count : cycles.at(time);
}

double phases_end(const Scene& scene) {
  double end = 0;
  for (const Phase& phase : scene.phase) end += phase.seconds;
  const Cycles cycles = scene_cycles(scene);
  return end + (cycles.count - 1) * cycles.length;
}

void repeat_motions(Scene& scene) {
  const Cycles cycles = scene_cycles(scene);
  for (Pin& pin : scene.pin) pin.motion.cycles = cycles;
  for (Obstacle& obstacle : scene.obstacle) obstacle.motion.cycles = cycles;
}

void check_cycles(const Scene& scene) {
  check_phases_that_repeat(scene);
  if (!scene_cycles(scene).repeat()) return;
  const auto check_table = [&](const auto& item, const std::string& path) {
    check_happens_before(scene, path, "from", item.from);
    check_happens_before(scene, path, "until", item.until);
    check_comes_back(scene, path, item.motion);
  };
  for (std::size_t i = 0; i < scene.pin.size(); ++i) check_table(scene.pin[i], table_path("pin", i));
  for (std::size_t i = 0; i < scene.obstacle.size(); ++i)
    check_table(scene.obstacle[i], table_path("obstacle", i));
  for (std::size_t i = 0; i < scene.command.size(); ++i)
    check_happens_before(scene, table_path("command", i), "time", scene.command[i].time);
}

void check_cycles(const Scene& scene, const BodyMesh& body, const std::string& path) {
  constexpr double kRounding = 1e-6;  // of its size: point caches have seven digits
  const Cycles cycles = scene_cycles(scene);
  if (!cycles.repeat() || !body.moves()) return;
  const std::vector<Eigen::Vector3d> first = body.positions(cycles.start),
                                     last = body.positions(cycles.once_over());
  Eigen::AlignedBox3d box;
  double farthest = 0;
  for (std::size_t v = 0; v < first.size(); ++v) {
    box.extend(first[v]);
    farthest = std::max(farthest, (last[v] - first[v]).norm());
  }
  if (farthest <= kRounding * box.diagonal().norm()) return;
  throw Error::invalid_input(path + ".sequence must come back from " + number_text(cycles.start, 6, "s") +
                             " to " + number_text(cycles.once_over(), 6, "s") + ", which " +
                             shown(scene, "cycles", std::to_string(scene.cycles), "") +
                             " repeat: a vertex ends " + number_text(farthest, 3) +
                             " m beside where it begins")
      .with_origin(key_origin(scene, path + ".sequence", key_origin(scene, path)));
}

}  // namespace hysteron
