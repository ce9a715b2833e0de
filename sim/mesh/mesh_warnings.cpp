// Warns of doubtful features of a cloth in a file.
#include <algorithm>
#include <cmath>

#include "sim/base/number_in.h"
#include "sim/mesh/corner_sets.h"
#include "sim/mesh/point_grid.h"
#include "sim/mesh/topology.h"

namespace hysteron {
namespace {

// Vertices nearer than this share of the mean edge were meant as one.  Coordinates of six digits round by
// less.
constexpr double kCoincident = 1e-3;

// Counts: "3 vertices", "1 vertex".
std::string counted(int n, const char* one, const char* several) {
  return std::to_string(n) + " " + (n == 1 ? one : several);
}

class Warnings {
 public:
  Warnings(const ClothMesh& mesh, const MeshNames& names) : mesh_(mesh), names_(names) {
    std::vector<char> seen(mesh.rest.size(), 0);
    for (std::size_t e = 0; e < mesh.edge.size(); ++e) {
      if (mesh.edge[e].interior()) continue;
      for (const int v : {mesh.edge[e].p2, mesh.edge[e].p3})
        if (!std::exchange(seen[v], 1)) boundary_.push_back(v);
    }
    std::sort(boundary_.begin(), boundary_.end());
    for (const int v : boundary_) at_.push_back(mesh.rest[v]);
    mean_ = mesh.mean_edge_in_space();
    near_ = std::pow(10, std::floor(std::log10(kCoincident * mean_)));
  }

  std::vector<std::string> all() {
    see_parts();
    see_coincident();
    see_junctions();
    see_fans();
    return std::move(found_);
  }

 private:
  const Eigen::Vector3d& from(std::size_t e) const { return mesh_.rest[mesh_.edge[e].p2]; }
  const Eigen::Vector3d& to(std::size_t e) const { return mesh_.rest[mesh_.edge[e].p3]; }
  void say(const std::string& what) { found_.push_back(names_.what + ": " + what); }

  void see_parts() {
    Sets faces(mesh_.faces());
    int parts = mesh_.faces();
    for (int e = 0; e < mesh_.interior_edges; ++e) {
      const Edge& edge = mesh_.edge[e];
      if (faces.root(edge.face0) == faces.root(edge.face1)) continue;
      faces.join(edge.face0, edge.face1);
      --parts;
    }
    const std::string hinges = counted(mesh_.interior_edges, "hinge", "hinges");
    if (parts > 1)
      say(std::to_string(mesh_.faces()) + " triangles in " + std::to_string(parts) +
          " parts that share no edge, with " + hinges);
    else if (mesh_.interior_edges == 0)
      say("one triangle with 0 hinges: it cannot bend");
  }

  void see_coincident() {
    const std::vector<int> first = nearby_representatives(at_, near_);
    int number = 0, example = 0;
    for (int i = 0; i < static_cast<int>(first.size()); ++i)
      if (first[i] != i && number++ == 0) example = i;
    if (number == 0) return;
    say(counted(number, "vertex on its boundary lies on another one",
                "vertices on its boundary lie on others") +
        ", where nothing joins the cloth (the first is " + names_.vertex(boundary_[example]) + " on " +
        names_.vertex(boundary_[first[example]]) + "): cloth.weld = " + number_text(near_) + " m joins them");
  }

  // Does point i lie within the edge?
  bool is_within(int i, std::size_t e) const {
    const Eigen::Vector3d along = to(e) - from(e), displacement = at_[i] - from(e);
    const double length = along.norm(), s = displacement.dot(along) / length;
    return s > near_ && s < length - near_ && (displacement - s / length * along).norm() < near_;
  }

  void see_junctions() {
    PointGrid grid(at_, mean_);
    for (int i = 0; i < static_cast<int>(at_.size()); ++i) grid.add(i, at_[i]);
    std::vector<std::size_t> edge_at(at_.size(), mesh_.edge.size());
    for (std::size_t e = mesh_.interior_edges; e < mesh_.edge.size(); ++e) {
      const int pieces = 1 + static_cast<int>((to(e) - from(e)).norm() / grid.width());
      for (int k = 0; k <= pieces; ++k)
        grid.around(from(e) + k * (to(e) - from(e)) / pieces, [&](int i) {
          if (is_within(i, e)) edge_at[i] = std::min(edge_at[i], e);
        });
    }
    const auto meets = [&](std::size_t e) { return e < mesh_.edge.size(); };
    const auto number = static_cast<int>(std::count_if(edge_at.begin(), edge_at.end(), meets));
    if (number == 0) return;
    const auto first = std::find_if(edge_at.begin(), edge_at.end(), meets);
    say(counted(number, "vertex lies", "vertices lie") +
        " within sides of triangles that do not end there, where nothing joins the cloth (a T-junction; the "
        "first is " +
        names_.vertex(boundary_[first - edge_at.begin()]) + " on " +
        names_.triangle(mesh_.edge[*first].face0) + "): cut those triangles there");
  }

  void see_fans() {
    Sets corners(3 * mesh_.faces());
    for (int e = 0; e < mesh_.interior_edges; ++e)
      for (const int v : {mesh_.edge[e].p2, mesh_.edge[e].p3})
        corners.join(corner_at(mesh_, mesh_.edge[e].face0, v), corner_at(mesh_, mesh_.edge[e].face1, v));
    int number = 0, first = 0;
    const Adjacency& around = mesh_.vertex_faces;
    for (int v = 0; v < mesh_.vertices(); ++v) {
      const auto begin = around.item.begin() + around.start[v],
                 end = around.item.begin() + around.start[v + 1];
      const int root = corners.root(*begin);
      if (std::all_of(begin, end, [&](int corner) { return corners.root(corner) == root; })) continue;
      if (number++ == 0) first = v;
    }
    if (number == 0) return;
    say("two fans of triangles meet in " + counted(number, "vertex", "vertices") + " alone (the first is " +
        names_.vertex(first) +
        "): they turn about it as about a joint, since bending needs an edge between them");
  }

  const ClothMesh& mesh_;
  const MeshNames& names_;
  std::vector<int> boundary_;        // vertices, ascending
  std::vector<Eigen::Vector3d> at_;  // their positions [m]
  double mean_, near_;               // mean of all edges; distance of coincident vertices [m]
  std::vector<std::string> found_;
};

}  // namespace

std::vector<std::string> mesh_warnings(const ClothMesh& mesh, const MeshNames& names) {
  return Warnings(mesh, names).all();
}

}  // namespace hysteron
