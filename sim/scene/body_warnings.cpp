// Warns of doubtful bodies of a scene, and describes all of them.
#include <Eigen/Geometry>
#include <algorithm>

#include "sim/base/error.h"
#include "sim/base/number_in.h"
#include "sim/mesh/intersections.h"
#include "sim/mesh/mesh_sequence.h"
#include "sim/mesh/point_cache.h"
#include "sim/scene/body.h"

namespace hysteron {
namespace {

constexpr double kFarthest = 0.2;  // the farthest way in a frame, over the body's diagonal
constexpr double kFastest = 50;    // the largest plausible speed [m/s]: that of a whip's tip; limbs reach 20

// Names an obstacle: "obstacle[0], mesh torso.obj".
std::string named(const Obstacle& o, std::size_t number) {
  return "obstacle[" + std::to_string(number) + "], mesh " + o.file;
}

Eigen::AlignedBox3d box_of(const BodyMesh& body) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& x : body.frames.front()) box.extend(x);
  return box;
}

// Returns the volume [m^3] by the divergence theorem, as the sum of signed tetrahedra with their tips in the
// middle of the box.
double signed_volume(const BodyMesh& body) {
  const std::vector<Eigen::Vector3d>& x = body.frames.front();
  const Eigen::Vector3d middle = box_of(body).center();
  double volume = 0;
  for (const Eigen::Vector3i& f : body.face)
    volume += (x[f[0]] - middle).cross(x[f[1]] - middle).dot(x[f[2]] - middle) / 6;
  return volume;
}

// Returns the frames that are checked, evenly spread, the first and the last among them: fewer for larger
// bodies.
std::vector<std::size_t> looked_at(const BodyMesh& body) {
  constexpr std::size_t kMostFrames = 12, kTriangles = 100000;  // kTriangles: the most of all frames together
  const std::size_t last = body.frames.size() - 1,
                    looks = std::min({body.frames.size(), kMostFrames,
                                      std::max<std::size_t>(1, kTriangles / body.face.size())});
  std::vector<std::size_t> frames;
  for (std::size_t k = 0; k < looks; ++k) frames.push_back(looks > 1 ? k * last / (looks - 1) : 0);
  return frames;
}

std::string crossing_warning(const BodyMesh& body) {
  for (const std::size_t frame : looked_at(body)) {
    const auto pairs = intersecting_triangles(body.face, body.frames[frame]);
    if (pairs.empty()) continue;
    std::string text = "passes through itself in its ";
    text += frame == 0 ? "first frame"
                       : "frame " + std::to_string(frame + 1) +
                             ", at t = " + number_text(body.time_of(frame), 4) + " s";
    return text + ": triangles " + pairs_text(pairs) + ": cloth that comes between them is pinched";
  }
  return "";
}

std::string facing_warning(const BodyMesh& body) {
  const double volume = body.closed ? signed_volume(body) : 0;
  if (!(volume < 0)) return "";
  return "has triangles that face inward (signed volume " + number_text(volume, 3) +
         " m^3): it is a hollow with the cloth inside; where it is a solid, turn its faces over";
}

struct Jump {
  std::size_t frame = 0;  // the vertex moves from this frame to the next one
  int vertex = 0;
  double distance = 0;  // [m]
};

// Returns the vertex that moves farthest from this frame to the next one.
Jump farthest_way(const BodyMesh& body, std::size_t frame) {
  Jump jump{frame};
  for (int v = 0; v < body.vertices(); ++v) {
    const double distance = (body.frames[frame + 1][v] - body.frames[frame][v]).norm();
    if (distance > jump.distance) jump = {frame, v, distance};
  }
  return jump;
}

std::string jump_warning(const BodyMesh& body) {
  if (!body.moves()) return "";
  const double diagonal = box_of(body).diagonal().norm();
  std::vector<Jump> jumps;
  for (std::size_t f = 0; f + 1 < body.frames.size(); ++f) {
    const Jump jump = farthest_way(body, f);
    const double seconds = body.time_of(f + 1) - body.time_of(f);
    if (jump.distance > kFarthest * diagonal || jump.distance > kFastest * seconds) jumps.push_back(jump);
  }
  if (jumps.empty()) return "";
  const Jump worst = *std::ranges::max_element(jumps, {}, &Jump::distance);
  const double begin = body.time_of(worst.frame), seconds = body.time_of(worst.frame + 1) - begin;
  return "jumps: vertex " + std::to_string(worst.vertex) + " goes " + number_text(worst.distance, 3) +
         " m from frame " + std::to_string(worst.frame + 1) + " to frame " + std::to_string(worst.frame + 2) +
         ", at t = " + number_text(begin, 4) + " s, with " + number_text(worst.distance / seconds, 3) +
         " m/s, " + number_text(100 * worst.distance / diagonal, 3) + " % of the body's diagonal" +
         (jumps.size() > 1 ? " (the farthest of " + std::to_string(jumps.size()) + " such ways)" : "") +
         ": is a frame missing, or fps another?";
}

// Names the files that a sequence lacks, by the gaps in their numbers.
std::string numbering_warning(const Obstacle& o) {
  if (o.sequence.empty() || names_a_point_cache(o.sequence)) return "";
  std::vector<std::string> words;
  for (const std::filesystem::path& file : files_like(o.sequence)) words.push_back(file.string());
  if (words.size() < 2) return "";
  const MeshSequence sequence = mesh_sequences(words).front();
  if (sequence.number.empty())
    return "has frames in the order of their names, which are not numbered: " + sequence.unnumbered;
  const auto& number = sequence.number;
  for (std::size_t i = 2; i < number.size(); ++i)
    if (number[i] - number[i - 1] != number[1] - number[0])
      return "has frames of uneven numbers, which follow each other evenly: after " +
             sequence.files[i - 1].filename().string() + " comes " + sequence.files[i].filename().string();
  return "";
}

std::string extent_text(const Eigen::Vector3d& size) {
  return number_text(size.x(), 3) + " x " + number_text(size.y(), 3) + " x " + number_text(size.z(), 3) +
         " m";
}

}  // namespace

std::vector<std::string> body_warnings(const Scene& scene) {
  std::vector<std::string> warnings;
  for (std::size_t i = 0; i < scene.obstacle.size(); ++i) {
    const Obstacle& o = scene.obstacle[i];
    if (!is_body(o) || !o.mesh) continue;
    for (const std::string& warning :
         {crossing_warning(*o.mesh), facing_warning(*o.mesh), jump_warning(*o.mesh), numbering_warning(o)})
      if (!warning.empty()) warnings.push_back(named(o, i) + ", " + warning);
  }
  return warnings;
}

std::vector<std::string> body_lines(const Scene& scene) {
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < scene.obstacle.size(); ++i) {
    const Obstacle& o = scene.obstacle[i];
    if (!is_body(o) || !o.mesh) continue;
    const BodyMesh& body = *o.mesh;
    lines.push_back(named(o, i) + ": " + std::to_string(body.faces()) + " triangles, " +
                    std::to_string(body.vertices()) + " vertices, " + (body.closed ? "closed" : "open") +
                    ", " + extent_text(box_of(body).sizes()) +
                    (body.moves() ? ", " + std::to_string(body.frames.size()) + " frames in " +
                                        number_text(body.time_of(body.frames.size() - 1), 4) + " s"
                                  : ", rigid"));
  }
  return lines;
}

}  // namespace hysteron
