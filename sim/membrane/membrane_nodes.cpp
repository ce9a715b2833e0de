#include "sim/membrane/membrane_nodes.h"

#include <algorithm>
#include <cmath>

#include "sim/linear/compressed_rows.h"
#include "sim/mesh/corner_sets.h"

namespace hysteron {

namespace {

// Joins the corners of both triangles at an edge, unless it is a seam.
void join_along(const ClothMesh& mesh, const Edge& edge, Sets& sets) {
  const int ends[] = {edge.p2, edge.p3};
  int pair[2][2];
  for (int k = 0; k < 2; ++k) {
    pair[k][0] = corner_at(mesh, edge.face0, ends[k]);
    pair[k][1] = corner_at(mesh, edge.face1, ends[k]);
  }
  const auto panel_vertex = [&](int corner) { return mesh.panel[corner / 3][corner % 3]; };
  for (int k = 0; k < 2 && !mesh.panel.empty(); ++k)
    if (panel_vertex(pair[k][0]) != panel_vertex(pair[k][1])) return;
  for (int k = 0; k < 2; ++k) sets.join(pair[k][0], pair[k][1]);
}

// Numbers nodes vertex by vertex: without seams the nodes are the vertices.
void number_nodes(const ClothMesh& mesh, MembraneNodes& nodes) {
  Sets sets(3 * mesh.faces());
  for (int e = 0; e < mesh.interior_edges; ++e) join_along(mesh, mesh.edge[e], sets);
  std::vector<int> number(3 * mesh.faces(), -1);
  nodes.of_face.resize(mesh.faces());
  std::vector<std::vector<int>> faces;
  for (const int corner : mesh.vertex_faces.item) {
    int& node = number[sets.root(corner)];
    if (node < 0) {
      node = static_cast<int>(faces.size());
      faces.emplace_back();
    }
    faces[node].push_back(corner);
    nodes.of_face[corner / 3][corner % 3] = node;
  }
  nodes.faces = compressed(faces);
}

void find_rings(const ClothMesh& mesh, MembraneNodes& nodes) {
  const Adjacency& faces = nodes.faces;
  std::vector<std::vector<int>> rings(faces.start.size() - 1), corners;
  for (std::size_t n = 0; n < rings.size(); ++n)
    for (int j = faces.start[n]; j < faces.start[n + 1]; ++j)
      for (int k = 0; k < 3; ++k) rings[n].push_back(mesh.face[faces.item[j] / 3][k]);
  nodes.ring = compressed(rings);
  corners.resize(nodes.ring.item.size());
  for (std::size_t n = 0; n + 1 < faces.start.size(); ++n) {
    const auto first = nodes.ring.item.begin() + nodes.ring.start[n],
               last = nodes.ring.item.begin() + nodes.ring.start[n + 1];
    for (int j = faces.start[n]; j < faces.start[n + 1]; ++j)
      for (int k = 0; k < 3; ++k) {
        const int face = faces.item[j] / 3;
        const auto at = std::lower_bound(first, last, mesh.face[face][k]);
        corners[at - nodes.ring.item.begin()].push_back(3 * face + k);
      }
  }
  nodes.corners = compressed(corners);
}

}  // namespace

MembraneSplit split_membrane(const Fabric& fabric, MembraneElement element) {
  const MembraneStiffness<double> all{fabric.warp, fabric.weft, fabric.coupling, fabric.shear};
  const double stiffest = std::max(fabric.warp + fabric.in_plane.warp.stiffness(),
                                   fabric.weft + fabric.in_plane.weft.stiffness());
  if (element == MembraneElement::constant || stiffest <= kMaxTriangleStiffness)
    return {all, {0, 0, 0, 0}, false};
  const double warp = std::min(all.warp, kMaxTriangleStiffness),
               weft = std::min(all.weft, kMaxTriangleStiffness);
  const double most = std::sqrt((all.warp - warp) * (all.weft - weft));
  const double coupling = std::clamp(all.coupling, -most, most), kept = all.coupling - coupling;
  if (kept * kept <= warp * weft / 4)
    return {{warp, weft, kept, all.shear}, {all.warp - warp, all.weft - weft, coupling, 0}, true};
  const double fraction = kMaxTriangleStiffness / std::max(all.warp, all.weft), complement = 1 - fraction;
  return {{fraction * all.warp, fraction * all.weft, fraction * all.coupling, all.shear},
          {complement * all.warp, complement * all.weft, complement * all.coupling, 0},
          true};
}

InPlaneStops stops_of_faces(const Fabric& fabric, const MembraneSplit& split) {
  if (!split.averages) return fabric.in_plane;
  return {{}, {}, fabric.in_plane.shear, fabric.in_plane.shear_growth};
}

InPlaneStops stops_of_nodes(const Fabric& fabric, const MembraneSplit& split) {
  if (!split.averages) return {};
  return {fabric.in_plane.warp, fabric.in_plane.weft, {}};
}

MembraneNodes membrane_nodes(const ClothMesh& mesh) {
  MembraneNodes nodes;
  number_nodes(mesh, nodes);
  find_rings(mesh, nodes);
  for (std::size_t n = 0; n + 1 < nodes.faces.start.size(); ++n) {
    double area = 0;
    for (int j = nodes.faces.start[n]; j < nodes.faces.start[n + 1]; ++j)
      area += mesh.face_area[nodes.faces.item[j] / 3] / 3;
    nodes.area.push_back(area);
  }
  return nodes;
}

Adjacency membrane_couplings(const ClothMesh& mesh, const Fabric& fabric, MembraneElement element) {
  std::vector<std::vector<int>> rows(mesh.vertices());
  const auto couple = [&rows](const int* vertex, int count) {
    for (int a = 0; a < count; ++a)
      for (int b = 0; b < count; ++b)
        if (a != b) rows[vertex[a]].push_back(vertex[b]);
  };
  for (const Eigen::Vector3i& t : mesh.face) couple(t.data(), 3);
  if (split_membrane(fabric, element).averages) {
    const Adjacency ring = membrane_nodes(mesh).ring;
    for (std::size_t n = 0; n + 1 < ring.start.size(); ++n)
      couple(ring.item.data() + ring.start[n], ring.start[n + 1] - ring.start[n]);
  }
  return compressed(rows);
}

}  // namespace hysteron
