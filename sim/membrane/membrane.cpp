#include "sim/membrane/membrane.h"

namespace hysteron {

namespace {

template <class Real>
std::vector<MembraneRest<Real>> rest_as(const ClothMesh& mesh) {
  std::vector<MembraneRest<Real>> result;
  for (const MembraneRest<double>& r : membrane_rest(mesh)) {
    MembraneRest<Real> c;
    c.area = static_cast<Real>(r.area);
    for (int k = 0; k < 3; ++k) {
      c.b1[k] = static_cast<Real>(r.b1[k]);
      c.b2[k] = static_cast<Real>(r.b2[k]);
    }
    result.push_back(c);
  }
  return result;
}

// Lists the terms of MembraneBlocks::sum.
template <class Real, class Device>
std::vector<Eigen::Vector2i> block_terms(const ClothMesh& mesh, const BlockRows<Real, Device>& rows) {
  std::vector<Eigen::Vector2i> terms(rows.col().size(), Eigen::Vector2i(-1, -1));
  for (int v = 0; v < mesh.vertices(); ++v)
    for (int n = mesh.vertex_faces.start[v]; n < mesh.vertex_faces.start[v + 1]; ++n) {
      const int face = mesh.vertex_faces.item[n] / 3, i = mesh.vertex_faces.item[n] % 3;
      for (const int j : {(i + 1) % 3, (i + 2) % 3}) {
        Eigen::Vector2i& of = terms[rows.slot(v, mesh.face[face][j])];
        of[of[0] < 0 ? 0 : 1] = 9 * face + 3 * i + j;
      }
    }
  return terms;
}

// Returns A_f/(3 A_v) for each node's triangles.
template <class Real>
std::vector<Real> node_weights(const ClothMesh& mesh, const MembraneNodes& nodes) {
  std::vector<Real> weight;
  for (int n = 0; n < nodes.count(); ++n)
    for (int j = nodes.faces.start[n]; j < nodes.faces.start[n + 1]; ++j)
      weight.push_back(static_cast<Real>(mesh.face_area[nodes.faces.item[j] / 3] / (3 * nodes.area[n])));
  return weight;
}

template <class Real>
HYST_HD void add_share(MembraneStress<Real>& to, const MembraneStress<Real>* of_nodes,
                       const Eigen::Vector3i& nodes) {
  const MembraneStress<Real>&a = of_nodes[nodes[0]], &b = of_nodes[nodes[1]], &c = of_nodes[nodes[2]];
  to.s11 += (a.s11 + b.s11 + c.s11) / 3;
  to.s22 += (a.s22 + b.s22 + c.s22) / 3;
}

// Finds the principal stretch from the squares of the deformation of warp and weft, and their product: those
// of a triangle, or means at a node.
template <class Strains, class Real>
HYST_HD Real principal_stretch(const Strains& strains, int i, const Vec3<Real>* x) {
  const Vec3<Real> squares = strains.squares(i, x);
  const Real a = squares[0], b = squares[1], s = squares[2];
  return sqrt((a + b) / 2 + sqrt((a - b) * (a - b) / 4 + s * s)) - 1;
}

template <class Strains, class Device, class Real>
void find_stretches(Device& device, const Strains& strains, int sites, const Vec3<Real>* x, double* stretch) {
  const Strains of = strains;
  for_each(
      device, "stretch", sites,
      HYST_KERNEL(int i) { stretch[i] = static_cast<double>(principal_stretch(of, i, x)); });
}

}  // namespace

template <class Real, class Device>
Membrane<Real, Device>::Nodes::Nodes(Device& device, const ClothMesh& mesh, const Fabric& fabric,
                                     const MembraneSplit& split, const MembraneNodes& nodes,
                                     const Faces& faces, const BlockRows<Real, Device>& rows)
    : start(device, nodes.faces.start),
      item(device, nodes.faces.item),
      weight(device, node_weights<Real>(mesh, nodes)),
      area(device, std::vector<Real>(nodes.area.begin(), nodes.area.end())),
      of_face(device, nodes.of_face),
      sites(device, {faces, start.data(), item.data(), weight.data(), area.data()}, nodes.count(),
            split.nodes, fabric.damping, stops_of_nodes(fabric, split), false,
            {mesh.faces() * sizeof(Deformation<Real>) + total_bytes(start, item, weight, area),
             mesh.vertices() * sizeof(Vec3<Real>)}),
      stiffness(device, nodes, rows) {}

template <class Real, class Device>
Membrane<Real, Device>::Membrane(Device& device, const ClothMesh& mesh, const Fabric& fabric,
                                 const MembraneSplit& split, const BlockRows<Real, Device>& rows)
    : device_(device),
      vertices_(mesh.vertices()),
      rest_(device, rest_as<Real>(mesh)),
      corner_(device, mesh.face),
      vertex_start_(device, mesh.vertex_faces.start),
      vertex_item_(device, mesh.vertex_faces.item),
      block_sum_(device, block_terms(mesh, rows)),
      deformation_(device, mesh.faces()),
      faces_(device, face_strains(), mesh.faces(), split.faces, fabric.damping, stops_of_faces(fabric, split),
             !split.averages,
             {total_bytes(rest_, corner_, deformation_) + vertices_ * sizeof(Vec3<Real>),
              vertices_ * sizeof(Vec3<Real>)}) {
  if (split.averages) nodes_.emplace(device, mesh, fabric, split, membrane_nodes(mesh), face_strains(), rows);
  energy_ = Buffer<double, Device>(device, faces_.count() + (nodes_ ? nodes_->sites.count() : 0));
}

template <class Real, class Device>
void Membrane<Real, Device>::update(const Vec3<Real>* x, const Vec3<Real>* v) {
  faces_.update(x, v);
  if (!nodes_) return;
  nodes_->sites.update(x, v);
  add_nodes(true);
}

template <class Real, class Device>
void Membrane<Real, Device>::evaluate(const Vec3<Real>* x) {
  faces_.evaluate(x, energy_.data());
  if (!nodes_) return;
  nodes_->sites.evaluate(x, energy_.data() + faces_.count());
  add_nodes(false);
}

// Adds the stresses of nodes to those of their triangles, whose tension is then complete; `tension_is_apart`:
// it is not that of the whole stress.
template <class Real, class Device>
void Membrane<Real, Device>::add_nodes(bool tension_is_apart) {
  const bool apart = tension_is_apart;
  const Eigen::Vector3i* node = nodes_->of_face.data();
  const MembraneStress<Real>*of_nodes = nodes_->sites.stress(), *tension_of_nodes = nodes_->sites.tension();
  MembraneStress<Real>*stress = faces_.stress(), *tension = faces_.tension();
  for_each(
      device_,
      {"nodal stress", nodes_->of_face.bytes() + nodes_->sites.stress_bytes() + 2 * faces_.stress_bytes() +
                           faces_.tension_bytes()},
      faces_.count(), HYST_KERNEL(int f) {
        MembraneStress<Real> all = stress[f], pulls = tension[f];
        add_share(all, of_nodes, node[f]);
        if (apart) add_share(pulls, tension_of_nodes, node[f]);
        stress[f] = all;
        tension[f] = tensile_part(apart ? pulls : all);
      });
}

template <class Real, class Device>
double Membrane<Real, Device>::largest_stretch(const Vec3<Real>* x) {
  const int sites = nodes_ ? nodes_->sites.count() : faces_.count();
  if (nodes_)
    find_stretches(device_, nodes_->sites.strains(), sites, x, energy_.data());
  else
    find_stretches(device_, face_strains(), sites, x, energy_.data());
  const std::vector<double> values = energy_.download();
  double largest = 0;
  for (int i = 0; i < sites; ++i)
    largest = values[i] > largest || values[i] != values[i] ? values[i] : largest;
  return largest;
}

template <class Real, class Device>
std::size_t Membrane<Real, Device>::bytes() const {
  std::size_t sum =
      total_bytes(rest_, corner_, vertex_start_, vertex_item_, block_sum_, deformation_, energy_) +
      faces_.bytes();
  if (nodes_)
    sum += total_bytes(nodes_->start, nodes_->item, nodes_->weight, nodes_->area, nodes_->of_face) +
           nodes_->sites.bytes() + nodes_->stiffness.bytes();
  return sum;
}

template class Membrane<double, ThisDevice>;
template class Membrane<float, ThisDevice>;

}  // namespace hysteron
