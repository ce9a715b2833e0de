#include "experiments/workbench/session/animation_export.h"

#include <fmt/core.h>

#include <cmath>

#include "experiments/workbench/animation/write_glb.h"
#include "experiments/workbench/animation/write_usd.h"
#include "experiments/workbench/pictures/drawing.h"
#include "render/inset.h"
#include "sim/base/error.h"
#include "sim/mesh/mesh_export.h"

namespace hysteron::experiments {
namespace {

constexpr const char* kArchivedPositions = "mesh/cloth.pc2";

std::string animation_file(MeshFormat format) {
  return format == MeshFormat::usd ? "mesh/cloth.usda" : "mesh/cloth.glb";
}

}  // namespace

bool AnimationExport::writes(MeshFormat format) {
  return format == MeshFormat::usd || format == MeshFormat::glb;
}

std::vector<std::string> AnimationExport::files(MeshFormat format) {
  return {kArchivedPositions, animation_file(format)};
}

AnimationExport::~AnimationExport() {
  if (is_written_ || times_.empty()) return;
  try {
    write();
    // An exception that ended the run is in flight, and the positions are kept.
  } catch (const std::exception&) {
    run_->forget(animation_file(format_));
  }
}

void AnimationExport::begin(Session& session) {
  run_ = &session.run();
  format_ = session.setup().options.export_format;
  const ClothMesh& mesh = session.cloth().mesh;
  const float side = render::long_side(flat_triangles(mesh.face), flat_points(mesh.rest), 3);
  scene_.rate = session.setup().options.fps;
  scene_.view = picture_view(session.setup(), session.bounds(), session.plan().floor);
  scene_.parts = {animated_cloth(mesh, session.scene().cloth, scene_.view)};
  scene_.parts[0].points_at = [file = (run_->folder() / kArchivedPositions).string()](const Instant& at) {
    return read_from_point_cache(file, at.number);
  };
  for (AnimatedPart& body : animated_bodies(session.scene(), scene_.view, side))
    scene_.parts.push_back(std::move(body));
}

void AnimationExport::record(Session& session, const Snapshot& instant) {
  if (!session.is_pictured(instant)) return;
  const auto stage = run_->stage("io");
  if (!times_.empty() && !(static_cast<float>(instant.time) > static_cast<float>(times_.back())))
    times_.pop_back();
  write_to_point_cache(run_->path(kArchivedPositions).string(), times_.size(), instant.x);
  times_.push_back(instant.time);
}

void AnimationExport::close() {
  if (times_.empty()) return;
  write();
  is_written_ = true;
  if (format_ == MeshFormat::glb) warn_of_many_targets();
}

void AnimationExport::finish(Session&, const std::string&) { run_->forget(kArchivedPositions); }

void AnimationExport::write() {
  const auto stage = run_->stage("io");
  scene_.instants.clear();
  for (std::size_t k = 0; k < times_.size(); ++k) scene_.instants.push_back({times_[k], k});
  const std::string file = run_->path(animation_file(format_)).string();
  if (format_ == MeshFormat::usd) return write_usd(file, scene_);
  leave_out_what_does_not_fit();
  write_glb(file, scene_);
}

void AnimationExport::leave_out_what_does_not_fit() {
  const std::size_t all = scene_.instants.size();
  while (glb_bytes(scene_) > kMostGlbBytes && scene_.instants.size() > 2) halve(scene_.instants);
  const std::size_t kept = scene_.instants.size();
  if (kept < all)
    run_->warn(
        fmt::format("{} has {} of {} instants, every {}th: a binary glTF file holds 4 GiB; a smaller --fps, "
                    "or --export usd",
                    animation_file(format_), kept, all, (all + kept - 2) / (kept - 1)));
}

void AnimationExport::warn_of_many_targets() const {
  const std::size_t targets = scene_.instants.size() - 1;
  if (targets <= kMostMorphTargets) return;
  const double rate =
      static_cast<double>(kMostMorphTargets) / (scene_.instants.back().time - scene_.instants.front().time);
  const std::string hint = rate >= 1 ? fmt::format("--fps {:.0f}", std::floor(rate)) : "a smaller --fps";
  run_->warn(
      fmt::format("{} has {} morph targets, one an instant after the first, and viewers in browsers "
                  "bear about {}: {} keeps no more",
                  animation_file(format_), targets, kMostMorphTargets, hint));
}

}  // namespace hysteron::experiments
