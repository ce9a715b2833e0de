// Computes the membrane of a whole cloth on one device: stresses by triangle and node, forces and implicit
// matrix by vertex.
#pragma once

#include <optional>

#include "sim/membrane/membrane_sites.h"
#include "sim/membrane/nodal_stiffness.h"

namespace hysteron {

// Returns the rest geometry of every face in its warp-weft frame.
std::vector<MembraneRest<double>> membrane_rest(const ClothMesh& mesh);

// Returns the largest eigenvalue of M^-1 K of the unstretched membrane, whose stops hold [1/s^2], without
// damping.  `mass` is per vertex [kg].
double membrane_spectral_radius(const ClothMesh& mesh, const Fabric& fabric, MembraneElement element,
                                const std::vector<double>& mass, const std::vector<char>& held);

template <class Real>
struct MembraneForceView {
  const int* start;  // n + 1 row starts, one row per vertex
  const int* item;   // 3*face + corner
  const MembraneRest<Real>* rest;
  const Deformation<Real>* deformation;
  const MembraneStress<Real>* stress;
  HYST_HD Vec3<Real> at(int vertex) const {
    Vec3<Real> f = Vec3<Real>::Zero();
    for (int j = start[vertex]; j < start[vertex + 1]; ++j) {
      const int face = item[j] / 3;
      f += membrane_force(rest[face], deformation[face], stress[face], item[j] % 3);
    }
    return f;
  }
};

// The terms of triangles in the blocks of an implicit matrix, each of which gathers its own: off-diagonal
// blocks first, then the diagonal ones.  A term is numbered 9 * face + 3 * i + j for corners i and j.
template <class Real>
struct MembraneBlocks {
  int off_diagonal;  // number of off-diagonal blocks
  // The terms of each off-diagonal block: an edge has one triangle, then -1, or two.
  const Eigen::Vector2i* sum;
  const int *start, *item;  // for each diagonal block: rows of 3 * face + corner
  const MembraneRest<Real>* rest;

  // Adds term(face, i, j) over block b to `value`, in the order of the row's triangles.
  template <class Value, class Term>
  HYST_HD Value gather(int b, Value value, const Term& term) const {
    if (b < off_diagonal) {
      for (int k = 0; k < 2 && sum[b][k] >= 0; ++k)
        value += term(sum[b][k] / 9, sum[b][k] % 9 / 3, sum[b][k] % 3);
      return value;
    }
    const int v = b - off_diagonal;
    for (int j = start[v]; j < start[v + 1]; ++j) value += term(item[j] / 3, item[j] % 3, item[j] % 3);
    return value;
  }
};

template <class Real, class Device>
class Membrane {
 public:
  // `rows` has to have the couplings of membrane_couplings().
  Membrane(Device& device, const ClothMesh& mesh, const Fabric& fabric, MembraneElement element,
           const BlockRows<Real, Device>& rows)
      : Membrane(device, mesh, fabric, split_membrane(fabric, element), rows) {}

  // Computes strains and stresses (elastic, of friction, and viscous of `velocity`) at `position` (n vertices
  // each); forces() then gathers them.
  void update(const Vec3<Real>* position, const Vec3<Real>* velocity);
  MembraneForceView<Real> forces() const {
    return {vertex_start_.data(), vertex_item_.data(), rest_.data(), deformation_.data(), faces_.stress()};
  }
  // Sets matrix = factor * Gauss-Newton stiffness + geometric * stiffness of the tension at the last update,
  // to which callers add mass and contact.  The part of compression is negative semidefinite and goes to
  // `softening`, unless that is null.
  void assemble(Real factor, Real geometric, BlockRowsView<Real> matrix, ScalarRowsView<Real> softening = {});
  // These are parts of assemble(); public because nvcc allows no device lambda in a private member function.
  void assemble_blocks(Real factor, Real geometric, BlockRowsView<Real> matrix);
  void assemble_columns(Real factor, Real geometric, BlockRowsView<Real> matrix);
  void assemble_softening(ScalarRowsView<Real> softening);
  template <class Stiffness>
  void gather_blocks(const Stiffness& stiffness, Real factor, Real geometric, BlockRowsView<Real> matrix);
  template <class Stiffness>
  void gather_columns(const Stiffness& stiffness, Real factor, Real geometric, BlockRowsView<Real> matrix);
  void add_nodes(bool tension_is_apart);
  Real damping() const { return faces_.damping(); }  // viscous over elastic stiffness [s]

  // These serve implicit steps. begin_step() fixes the reference of strain rates: (1 + e) E(now) - e
  // E(before), e the extrapolation (`before` may be null if e = 0). evaluate() sets forces(), energies() of
  // elastic, frictional and viscous stress, and the input of assemble(), at `position` (n vertices [m]).
  void begin_step(const StepFormula& formula, const Vec3<Real>* now, const Vec3<Real>* before) {
    each([&](auto& sites, double*) { sites.begin_step(formula, now, before); });
  }
  void evaluate(const Vec3<Real>* position);
  const double* energies() const { return energy_.data(); }  // one per triangle, then one per node [J]
  int energies_count() const { return static_cast<int>(energy_.size()); }
  // Returns viscous over elastic stiffness of a step: the factor of assemble() is 1 + this.
  Real viscous_factor() const { return faces_.viscous_factor(); }
  void add_viscous_loss() {  // for the last evaluated step
    each([](auto& sites, double*) { sites.add_viscous_loss(); });
  }

  // These serve friction in the plane: they accept positions, those of the start without a loss.  They do
  // nothing without stops.
  bool has_friction() const { return faces_.has_friction() || (nodes_ && nodes_->sites.has_friction()); }
  void start_friction(const Vec3<Real>* position) { accept(position, true); }
  void commit_friction(const Vec3<Real>* position) { accept(position, false); }
  double friction_loss() const {  // since the start [J]
    return faces_.friction_loss() + (nodes_ ? nodes_->sites.friction_loss() : 0);
  }

  // Saves or loads the state that outlives a step: losses and the memory of friction; stresses follow from
  // positions.
  void serialise(Archive& archive) {
    each([&](auto& sites, double*) { sites.serialise(archive); });
  }

  double stored_energy(const Vec3<Real>* position) {  // [J]
    each([&](auto& sites, double* energy) { sites.find_stored(position, energy); });
    return energy_.sum();
  }
  void add_viscous_loss(const Vec3<Real>* velocity, Real step) {  // with the geometry of the last update
    each([&](auto& sites, double*) { sites.add_viscous_loss(velocity, step); });
  }
  double viscous_loss() const {  // since the start [J]
    return faces_.viscous_loss() + (nodes_ ? nodes_->sites.viscous_loss() : 0);
  }
  // Returns the largest principal stretch minus 1, of a triangle or of the means at a node.
  double largest_stretch(const Vec3<Real>* position);
  std::size_t force_bytes() const {  // bytes that readers of forces() touch
    return total_bytes(vertex_start_, vertex_item_, rest_, deformation_) + faces_.stress_bytes();
  }
  std::size_t bytes() const;  // does not count friction's history
  std::size_t history_bytes() const {
    return faces_.history_bytes() + (nodes_ ? nodes_->sites.history_bytes() : 0);
  }

 private:
  using Faces = FaceStrains<Real>;
  // These exist with nodes alone.
  struct Nodes {
    Nodes(Device& device, const ClothMesh& mesh, const Fabric& fabric, const MembraneSplit& split,
          const MembraneNodes& nodes, const Faces& faces, const BlockRows<Real, Device>& rows);

    Buffer<int, Device> start, item;
    Buffer<Real, Device> weight, area;
    Buffer<Eigen::Vector3i, Device> of_face;
    MembraneSites<NodeStrains<Real>, Device> sites;
    NodalStiffness<Real, Device> stiffness;
  };

  Membrane(Device& device, const ClothMesh& mesh, const Fabric& fabric, const MembraneSplit& split,
           const BlockRows<Real, Device>& rows);
  Faces face_strains() { return {rest_.data(), corner_.data(), deformation_.data()}; }
  MembraneBlocks<Real> blocks() const {
    return {static_cast<int>(block_sum_.size()), block_sum_.data(), vertex_start_.data(), vertex_item_.data(),
            rest_.data()};
  }
  int all_blocks() const { return static_cast<int>(block_sum_.size()) + vertices_; }
  void accept(const Vec3<Real>* position, bool is_start) {
    each([&](auto& sites, double*) { sites.commit_friction(position, is_start); });
  }
  // Calls visit(sites, their energies), with triangles and then with nodes.
  template <class Visit>
  void each(const Visit& visit) {
    visit(faces_, energy_.data());
    if (nodes_) visit(nodes_->sites, energy_.data() + faces_.count());
  }

  Device& device_;
  int vertices_;
  Buffer<MembraneRest<Real>, Device> rest_;
  Buffer<Eigen::Vector3i, Device> corner_;
  Buffer<int, Device> vertex_start_, vertex_item_;
  Buffer<Eigen::Vector2i, Device> block_sum_;  // MembraneBlocks::sum
  Buffer<Deformation<Real>, Device> deformation_;
  MembraneSites<Faces, Device> faces_;
  std::optional<Nodes> nodes_;
  Buffer<double, Device> energy_;
};

}  // namespace hysteron
