// Assembles the membrane's part of an implicit matrix.  Every block gathers its triangles' terms: nothing is
// cleared first, and no store depends on another.
#include "sim/membrane/membrane.h"

namespace hysteron {
namespace {

template <class Real>
HYST_HD MembraneStress<Real> scaled(Real factor, const MembraneStress<Real>& s) {
  return {factor * s.s11, factor * s.s22, factor * s.s12};
}

// The stiffness of each triangle that the factor multiplies: its C, and with stops the tangents of those that
// hold.
template <class Real>
struct ElasticStiffness {
  MembraneStiffness<Real> c;
  HYST_HD const MembraneStiffness<Real>& of(int) const { return c; }
};
template <class Real>
struct StiffnessWithStops {
  MembraneStiffness<Real> c;
  Real fraction;  // viscosity, a part of the factor, acts on elasticity alone
  const Vec3<Real>* tangent;
  HYST_HD MembraneStiffness<Real> of(int face) const {
    const Vec3<Real> t = fraction * tangent[face];
    return {c.warp + t[0], c.weft + t[1], c.coupling, c.shear + t[2]};
  }
};

template <class Real, class Sites, class Gather>
void with_stiffness(const Sites& faces, Real fraction, const Gather& gather) {
  if (faces.has_friction())
    gather(StiffnessWithStops<Real>{faces.stiffness(), fraction, faces.friction_tangents()});
  else
    gather(ElasticStiffness<Real>{faces.stiffness()});
}

}  // namespace

template <class Real, class Device>
void Membrane<Real, Device>::assemble(Real factor, Real geometric, BlockRowsView<Real> matrix,
                                      ScalarRowsView<Real> softening) {
  if constexpr (Device::kGpu)
    assemble_columns(factor, geometric, matrix);
  else
    assemble_blocks(factor, geometric, matrix);
  if (nodes_) nodes_->stiffness.add(nodes_->sites, factor, geometric, matrix);
  if (softening.off_diagonal) assemble_softening(softening);
}

template <class Real, class Device>
void Membrane<Real, Device>::assemble_blocks(Real factor, Real geometric, BlockRowsView<Real> matrix) {
  with_stiffness(faces_, geometric / factor,
                 [&](const auto& stiffness) { gather_blocks(stiffness, factor, geometric, matrix); });
}

template <class Real, class Device>
void Membrane<Real, Device>::assemble_columns(Real factor, Real geometric, BlockRowsView<Real> matrix) {
  with_stiffness(faces_, geometric / factor,
                 [&](const auto& stiffness) { gather_columns(stiffness, factor, geometric, matrix); });
}

// A CPU computes the common values of a block's entries once.
template <class Real, class Device>
template <class Stiffness>
void Membrane<Real, Device>::gather_blocks(const Stiffness& stiffness, Real factor, Real geometric,
                                           BlockRowsView<Real> matrix) {
  const Stiffness c = stiffness;
  const MembraneBlocks<Real> blocks = this->blocks();
  const Deformation<Real>* deformed = deformation_.data();
  const MembraneStress<Real>* tension = faces_.tension();
  const std::size_t bytes = all_blocks() * sizeof(Mat3<Real>);
  for_each(
      device_,
      {"membrane matrix", bytes + total_bytes(block_sum_, vertex_start_, vertex_item_, rest_, deformation_) +
                              faces_.tension_bytes()},
      all_blocks(), HYST_KERNEL(int b) {
        const Mat3<Real> block = blocks.gather(b, Mat3<Real>(Mat3<Real>::Zero()), [&](int f, int i, int j) {
          return membrane_block(blocks.rest[f], c.of(f), factor, deformed[f], scaled(geometric, tension[f]),
                                i, j);
        });
        (b < blocks.off_diagonal ? matrix.off_diagonal[b] : matrix.diagonal[b - blocks.off_diagonal]) = block;
      });
}

// On a GPU three threads share a block, a column each: neighbours store side by side, and the common data of
// a column is read once.
template <class Real, class Device>
template <class Stiffness>
void Membrane<Real, Device>::gather_columns(const Stiffness& stiffness, Real factor, Real geometric,
                                            BlockRowsView<Real> matrix) {
  const Stiffness c = stiffness;
  const MembraneBlocks<Real> blocks = this->blocks();
  const Deformation<Real>* deformed = deformation_.data();
  const MembraneStress<Real>* tension = faces_.tension();
  const std::size_t bytes = all_blocks() * sizeof(Mat3<Real>);
  for_each(
      device_,
      {"membrane matrix", bytes + total_bytes(block_sum_, vertex_start_, vertex_item_, rest_, deformation_) +
                              faces_.tension_bytes()},
      3 * all_blocks(), HYST_KERNEL(int e) {
        const int b = e / 3, col = e % 3;
        const Vec3<Real> column = blocks.gather(b, Vec3<Real>(Vec3<Real>::Zero()), [&](int f, int i, int j) {
          return membrane_column(blocks.rest[f], c.of(f), factor, deformed[f], scaled(geometric, tension[f]),
                                 i, j, col);
        });
        Mat3<Real>& block =
            b < blocks.off_diagonal ? matrix.off_diagonal[b] : matrix.diagonal[b - blocks.off_diagonal];
        block.col(col) = column;
      });
}

template <class Real, class Device>
void Membrane<Real, Device>::assemble_softening(ScalarRowsView<Real> softening) {
  const MembraneBlocks<Real> blocks = this->blocks();
  const MembraneStress<Real>*stress = faces_.stress(), *tension = faces_.tension();
  const std::size_t bytes = all_blocks() * sizeof(Real);
  for_each(
      device_,
      {"membrane softening", bytes + total_bytes(block_sum_, vertex_start_, vertex_item_, rest_) +
                                 faces_.stress_bytes() + faces_.tension_bytes()},
      all_blocks(), HYST_KERNEL(int b) {
        const Real sum = blocks.gather(b, Real(0), [&](int f, int i, int j) {
          const MembraneStress<Real> s = stress[f], t = tension[f];
          const MembraneStress<Real> compression{s.s11 - t.s11, s.s22 - t.s22, s.s12 - t.s12};
          return geometric_stiffness(blocks.rest[f], compression, i, j);
        });
        (b < blocks.off_diagonal ? softening.off_diagonal[b] : softening.diagonal[b - blocks.off_diagonal]) =
            sum;
      });
}

template class Membrane<double, ThisDevice>;
template class Membrane<float, ThisDevice>;

}  // namespace hysteron
