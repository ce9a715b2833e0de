// Quantities of a mesh that the tests compare with formulas.
#pragma once

#include <cstdint>
#include <set>
#include <vector>

#include "sim/mesh/cloth_mesh.h"
#include "tests/sim/base/case_name.h"

namespace hysteron::test {

inline constexpr MeshFamily kFamilies[] = {MeshFamily::aligned,     MeshFamily::aligned45,
                                           MeshFamily::flipped,     MeshFamily::unionjack,
                                           MeshFamily::equilateral, MeshFamily::random};

constexpr int kMeshSizes[] = {2, 3, 7, 20, 100, 333, 1000, 4608, 20000};
constexpr double kSumRounding = 1e-12;  // of areas of up to 20,000 triangles

double total_area(const ClothMesh& mesh);         // [m^2]
double least_angle(const ClothMesh& mesh);        // [degrees]
int euler_characteristic(const ClothMesh& mesh);  // V - E + F
std::set<int> boundary_vertices(const ClothMesh& mesh);
std::uint64_t fingerprint(const ClothMesh& mesh);  // FNV-1a over the bits of vertices and triangles

}  // namespace hysteron::test
