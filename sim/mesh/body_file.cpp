#include "sim/mesh/body_file.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include "sim/base/error.h"
#include "sim/mesh/cloth_mesh.h"
#include "sim/mesh/mesh_sequence.h"
#include "sim/mesh/obj_soup.h"
#include "sim/mesh/point_cache.h"
#include "sim/mesh/surface.h"
#include "sim/mesh/topology.h"

namespace hysteron {
namespace {

using PointList = std::vector<Eigen::Vector3d>;
using FaceList = std::vector<Eigen::Vector3i>;

// All vertices of a file, whether a face uses them or not, in the file's unit.
struct WholeMesh {
  PointList vertex;
  FaceList face;
  MeshNames names;
};

WholeMesh read_whole(const std::string& file) {
  const std::string what = "mesh " + file;
  if (names_an_obj(file)) {
    ObjSoup soup = read_obj_soup(file, what);
    if (soup.face.empty()) throw Error::invalid_input(what + ": no faces");
    return {std::move(soup.vertex),
            std::move(soup.face),
            {what, std::move(soup.face_line), std::move(soup.vertex_line)}};
  }
  Surface surface = read_whole_surface(file);
  return {std::move(surface.vertex), std::move(surface.face), {what, {}, {}}};
}

// Compares faces by their corners: quads may be cut differently, so that two triangles have the same four
// corners.
bool same_faces(const FaceList& a, const FaceList& b) {
  if (a.size() != b.size()) return false;
  const auto corners = [](const FaceList& face, std::size_t f) {
    std::set<int> all;
    for (const std::size_t g : {f, f + 1}) all.insert(face[g].begin(), face[g].end());
    return all;
  };
  for (std::size_t f = 0; f < a.size(); ++f) {
    if (a[f] == b[f]) continue;
    if (f + 1 == a.size()) return false;
    const std::set<int> quad = corners(a, f);
    if (quad.size() != 4 || quad != corners(b, f)) return false;
    ++f;
  }
  return true;
}

void check_like(const WholeMesh& first, const WholeMesh& frame) {
  if (frame.vertex.size() != first.vertex.size())
    throw Error::invalid_input(frame.names.what + ": " + std::to_string(frame.vertex.size()) +
                               " vertices, and " + first.names.what + " has " +
                               std::to_string(first.vertex.size()) + ": a sequence has those of one mesh");
  if (!same_faces(first.face, frame.face))
    throw Error::invalid_input(frame.names.what + ": its " + std::to_string(frame.face.size()) +
                               " triangles are others than the " + std::to_string(first.face.size()) +
                               " of " + first.names.what +
                               ": a sequence has the same ones in the same order");
}

struct Frames {
  std::vector<PointList> position;  // of all vertices, in the file's unit
  std::vector<std::string> name;    // of each frame, for messages
  double fps = 0;
  std::vector<double> time;  // of each frame where fps does not give it [s]
};

Frames frames_of_cache(const BodyFiles& files, const WholeMesh& first) {
  PointCache cache = read_point_cache(files.sequence);
  const std::string what = "point cache " + files.sequence;
  if (cache.frames.front().size() != first.vertex.size())
    throw Error::invalid_input(what + ": " + std::to_string(cache.frames.front().size()) + " points, and " +
                               first.names.what + " has " + std::to_string(first.vertex.size()) +
                               " vertices: it must be that of this mesh");
  Frames frames{std::move(cache.frames), {}, files.fps / cache.frames_per_sample, {}};
  if (!(files.fps > 0)) frames.time = std::move(cache.time);
  for (std::size_t f = 0; f < frames.position.size(); ++f)
    frames.name.push_back(what + ": frame " + std::to_string(f + 1));
  return frames;
}

Frames frames_of_files(const BodyFiles& files, const WholeMesh& first) {
  Frames frames{{}, {}, files.fps, {}};
  for (const std::filesystem::path& file : files_like(files.sequence)) {
    WholeMesh frame = read_whole(file.string());
    check_like(first, frame);
    frames.position.push_back(std::move(frame.vertex));
    frames.name.push_back(frame.names.what);
  }
  if (frames.position.empty())
    throw Error::invalid_input("sequence " + files.sequence +
                               ": no file has such a name; it must be a pattern of OBJ or PLY files, or a "
                               "point cache, .pc2 or .mdd");
  return frames;
}

Frames all_frames(const BodyFiles& files, const WholeMesh& first) {
  if (files.sequence.empty()) return {{first.vertex}, {first.names.what}, 0, {}};
  return names_a_point_cache(files.sequence) ? frames_of_cache(files, first) : frames_of_files(files, first);
}

// Leaves out the vertices that no face uses, and turns lengths into metres.
void compact(WholeMesh& whole, Frames& frames, LengthUnit unit) {
  std::vector<int> number(whole.vertex.size(), -1), used, line;
  for (const Eigen::Vector3i& f : whole.face)
    for (const int v : f) number[v] = 0;
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (number[v] < 0) continue;
    number[v] = static_cast<int>(used.size());
    used.push_back(static_cast<int>(v));
    if (!whole.names.vertex_line.empty()) line.push_back(whole.names.vertex_line[v]);
  }
  whole.names.vertex_line = std::move(line);
  for (Eigen::Vector3i& f : whole.face) f = {number[f[0]], number[f[1]], number[f[2]]};
  for (PointList& frame : frames.position) {
    PointList kept;
    for (const int v : used) kept.push_back(frame[v].unaryExpr([&](double x) { return in_metres(x, unit); }));
    frame = std::move(kept);
  }
}

// Throws if the first frame is not a surface, or if a later one has triangles without a normal; returns
// whether the surface is closed.
bool checked_closed(const WholeMesh& whole, const Frames& frames) {
  ClothMesh mesh;
  mesh.face = whole.face;
  MeshNames names = whole.names;
  for (std::size_t f = 0; f < frames.position.size(); ++f) {
    mesh.rest = frames.position[f];
    names.what = frames.name[f];
    if (f == 0)
      build_topology(mesh, names);
    else
      measure_areas(mesh, names);
  }
  return mesh.interior_edges == static_cast<int>(mesh.edge.size());
}

}  // namespace

BodyMesh read_body(const BodyFiles& files) {
  WholeMesh whole = read_whole(files.file);
  Frames frames = all_frames(files, whole);
  compact(whole, frames, files.unit);
  BodyMesh body;
  body.closed = checked_closed(whole, frames);
  body.face = std::move(whole.face);
  body.frames = std::move(frames.position);
  if (body.frames.size() == 1) return body;
  body.fps = frames.fps;
  body.time = std::move(frames.time);
  return body;
}

}  // namespace hysteron
