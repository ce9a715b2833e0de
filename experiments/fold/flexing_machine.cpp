#include "experiments/fold/flexing_machine.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hysteron::experiments {
namespace {

constexpr double kMillimetre = 1e-3;

// Returns how far the cloth hangs from the clamps along gravity, or lies from them without gravity [m].
double farthest(const std::vector<Eigen::Vector3d>& x, const Eigen::Vector3d& gravity) {
  double distance = 0;
  for (const Eigen::Vector3d& p : x) {
    const double drop = gravity.z() > 0 ? p.z() : gravity.z() < 0 ? -p.z() : std::abs(p.z());
    distance = std::max(distance, drop);
  }
  return distance;
}

}  // namespace

FlexingMachine::FlexingMachine(const Fold& fold, Session& session)
    : fold_(fold),
      session_(session),
      gauge_(fold),
      material_(law_in_cloth(fold.scene)),
      cycles_(session.run().path("cycles.csv"),
              {"cycle", "recovery_angle [degree]", "set_curvature [1/m]", "largest_curvature [1/m]",
               "sag [mm]", "bending_friction [J]", "crown_dissipated [J/m^2]"}),
      materials_(session.run().path("material.csv"),
                 {"cycle", "M0 [N]", "2HB [N]", "permanent_set [1/m]", "crown_dissipated_in_all [J/m^2]"}) {}

std::vector<std::string> FlexingMachine::columns() {
  return {"clamp_distance [m]", "crown_curvature [1/m]", "crown_moment [N]"};
}

// Between two watched instants the law is continued on a copy, for this row alone.
std::vector<double> FlexingMachine::measure(const Snapshot& instant) const {
  const double curvature = gauge_.crown(session_.simulation().curvature());
  LawPoint crown = crown_;
  if (instant.time > time_) {
    LawWalk walk = material_;
    crown = walk.to({curvature, instant.time - time_});
  }
  return {fold_.distance(instant.time), curvature, crown.moment};
}

void FlexingMachine::watch(const Snapshot& instant) {
  curvature_ = gauge_.crown(session_.simulation().curvature());
  largest_ = std::max(largest_, std::abs(curvature_));
  if (instant.time > 0) crown_ = material_.to({curvature_, instant.time - time_});
  time_ = instant.time;
  reading_.lowest = farthest(instant.x, fold_.scene.gravity) / kMillimetre;
  add_to_loops();
  const int period = 2 * fold_.half, cycle = count_ / period;
  if (cycle > 0 && cycle <= fold_.cycles && count_ % period == 0) end_cycle(cycle);
  ++count_;
}

// Adds the state to its cycle's loop; a return ends one cycle and begins the next.
void FlexingMachine::add_to_loops() {
  const int period = 2 * fold_.half;
  const auto add = [&](int cycle, bool begins) {
    if (cycle < 1 || cycle > fold_.cycles || !is_pictured(cycle, fold_.cycles)) return;
    if (begins) loops_.push_back({"cycle " + std::to_string(cycle), {}, {}});
    loops_.back().add(curvature_, 1e3 * crown_.moment);
  };
  const bool returned = count_ % period == 0;
  if (returned) add(count_ / period, false);
  add(count_ / period + 1, returned);
}

void FlexingMachine::end_cycle(int cycle) {
  const std::vector<double> residual = session_.simulation().residual_curvature();
  const double lost = session_.simulation().ledger().bending_friction;
  reading_.recovery_angle = 180 - gauge_.largest_turn(residual) * 180 / std::numbers::pi;
  reading_.set = gauge_.crown(residual);
  reading_.sag = reading_.lowest;
  cycles_.row({static_cast<double>(cycle), reading_.recovery_angle, reading_.set, largest_, reading_.sag,
               lost - lost_, crown_.dissipated - crown_lost_});
  if (is_chosen(cycle, fold_.cycles)) {
    reading_.material = test_material(material_, curvature_);
    materials_.row({static_cast<double>(cycle), reading_.material.friction, reading_.material.loop_width,
                    reading_.material.permanent_set, crown_.dissipated});
  }
  ended_ = cycle;
  lost_ = lost;
  crown_lost_ = crown_.dissipated;
  largest_ = curvature_;
}

bool FlexingMachine::pictured(double time) const {
  const double half_step = fold_.scene.step / 2, stroke = fold_.period / 2;
  if (time >= fold_.scene.seconds - half_step) return true;
  const int strokes = static_cast<int>(std::lround(time / stroke));
  if (strokes == 0 || strokes > 2 * fold_.cycles || std::abs(time - strokes * stroke) > half_step)
    return false;
  return is_pictured((strokes - 1) / 2 + 1, fold_.cycles);
}

std::string FlexingMachine::progress(const Snapshot& instant) const {
  return fmt::format("t = {:.3f} s  cycles {}  crown {:.0f} 1/m  recovery {:.1f} degree", instant.time,
                     ended_, curvature_, reading_.recovery_angle);
}

void FlexingMachine::serialise(Archive& archive) {
  for (int* number : {&count_, &ended_}) archive(*number);
  for (double* number : {&curvature_, &largest_, &lost_, &crown_lost_, &time_}) archive(*number);
  archive(crown_);
  archive(reading_);
  material_.serialise(archive);
  cycles_.serialise(archive);
  materials_.serialise(archive);
  loops_.resize(archive.size(loops_.size()));
  for (render::Series& loop : loops_) {
    archive(loop.label);
    archive(loop.x);
    archive(loop.y);
  }
}

void FlexingMachine::finish() {
  cycles_.finish();
  materials_.finish();
}

}  // namespace hysteron::experiments
