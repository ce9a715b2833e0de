// Warns of cloths that were probably not meant so.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "sim/mesh/file_extension.h"
#include "sim/scene/cloth.h"
#include "sim/scene/mesh_files.h"
#include "sim/scene/shown_key.h"

namespace hysteron {
namespace {

// A cloth beyond these limits is doubtful.  They are wide enough for every specimen and garment, and so
// narrow that a cloth of 10 cm to 1 m exceeds them where centimetres or millimetres are read as metres, or
// the other way round.
constexpr double kSmallest = 5e-3;    // largest extent [m]: testers clamp specimens of 1 cm at least
constexpr double kLargest = 10;       // [m]: curtains; looms are 2 to 5 m wide
constexpr double kLightest = 1e-6;    // [kg]: 5 mm square of 0.04 kg/m^2, a light voile
constexpr double kHeaviest = 5;       // [kg]: a winter coat weighs 3 kg
constexpr double kShortestEdge = 1;   // mean, in thicknesses: shorter edges make cloth no surface any more
constexpr double kLongestEdge = 500;  // mean, in thicknesses: 25 cm of cotton, much wider than its folds
constexpr double kStretched = 0.5;    // strain of an edge at the start: weaves tear at 0.1 to 0.3

struct Size {
  double extent, weight, edge;  // [m], [kg], mean edge over the fabric's thickness

  // Returns the size of the same mesh with all lengths multiplied by `scale`.
  Size times(double scale) const { return {scale * extent, scale * scale * weight, scale * edge}; }
};

Size scene_size(const Scene& scene, const ClothMesh& mesh) {
  const int faces = mesh.faces() / scene.cloth.copies;  // one copy's faces
  Eigen::AlignedBox3d box;
  for (int f = 0; f < faces; ++f)
    for (const Eigen::Vector3d& x : mesh.corners(f)) box.extend(x);
  const double area = std::accumulate(mesh.face_area.begin(), mesh.face_area.begin() + faces, 0.0);
  return {box.sizes().maxCoeff(), scene.fabric.density * area,
          mesh.mean_edge_length() / scene.fabric.thickness};
}

bool is_within(double x, double low, double high) { return x >= low && x <= high; }

// Describes what is beyond the limits: "is 24 m long (...), weighs 56 kg (...)"; "" where nothing is.
std::string beyond(const Size& size) {
  std::vector<std::string> words;
  if (!is_within(size.extent, kSmallest, kLargest))
    words.push_back("is " + number_text(size.extent, 3) + " m long (" + number_text(kSmallest, 3) + " to " +
                    number_text(kLargest, 3) + " m would be plausible)");
  if (!is_within(size.weight, kLightest, kHeaviest))
    words.push_back("weighs " + number_text(size.weight, 3) + " kg (" + number_text(kLightest, 3) + " to " +
                    number_text(kHeaviest, 3) + " kg)");
  if (!is_within(size.edge, kShortestEdge, kLongestEdge))
    words.push_back("has edges " + number_text(size.edge, 3) + " times as long as it is thick (" +
                    number_text(kShortestEdge, 3) + " to " + number_text(kLongestEdge, 3) + ")");
  return join(words, ", ");
}

// Lists the units in which nothing is beyond the limits: "cloth.unit = centimetre would make it 0.24 m long".
std::string fitting_units(const Size& size, LengthUnit unit) {
  std::vector<std::string> fitting;
  for (std::size_t i = 0; i < names(LengthUnit{}).size(); ++i) {
    const auto other = static_cast<LengthUnit>(i);
    const Size then = size.times(in_metres(1, other) / in_metres(1, unit));
    if (other != unit && beyond(then).empty())
      fitting.push_back(enum_name(other) + (fitting.empty() ? " would make it " : " ") +
                        number_text(then.extent, 3) + " m" + (fitting.empty() ? " long" : ""));
  }
  return fitting.empty() ? "" : "cloth.unit = " + join(fitting, ", ");
}

// Warns of a size beyond the limits.  It ignores the edges of a cloth that is built, which were asked for,
// and the weight if an experiment has set the density, since no unit of length is then to blame.
std::string size_warning(const Scene& scene, const ClothMesh& mesh) {
  Size size = scene_size(scene, mesh);
  if (is_set_by_experiment(scene, "fabric.density")) size.weight = kLightest;
  const std::string file = rest_file(scene);
  if (file.empty()) size.edge = kShortestEdge;
  const std::string what = beyond(size);
  if (what.empty()) return "";
  if (file.empty()) return "the cloth " + what + ": lengths are in metres";
  const LengthUnit unit = scene.cloth.unit;
  // The rest shape of a pattern is in units of its texture, which cloth.unit does not change.
  const bool is_pattern = scene.cloth.shape == ClothOutline::pattern && !names_an_obj(scene.mesh);
  const std::string fitting = is_pattern ? "" : fitting_units(size, unit);
  return "mesh " + file + ", read in " +
         (is_pattern ? "units of cloth.texture-scale" : enum_name(unit) + "s") + ", " + what +
         (fitting.empty() ? "" : ": " + fitting);
}

// Warns of edges that no bend or stretch of a weave makes so long or short: the vertices have another order,
// or are another cloth's.
std::string stretch_warning(const Scene& scene, const ClothMesh& mesh,
                            const std::vector<Eigen::Vector3d>& start) {
  double largest = 0;
  long stretched = 0;
  for (std::size_t e = 0; e < mesh.edge.size(); ++e) {
    const double length = (start[mesh.edge[e].p3] - start[mesh.edge[e].p2]).norm();
    const double strain = length / mesh.edge_length(static_cast<int>(e)) - 1;
    stretched += strain > kStretched;
    largest = std::max(largest, strain);
  }
  if (stretched == 0) return "";
  return shown(scene, "cloth.start", scene.cloth.start, "") + " stretches " + std::to_string(stretched) +
         " edges by more than " + number_text(100 * kStretched, 3) + " %, one by " +
         number_text(100 * largest, 3) + " %: are its vertices in the order of those at rest?";
}

}  // namespace

std::vector<std::string> cloth_warnings(const Scene& scene, const ClothMesh& mesh,
                                        const std::vector<Eigen::Vector3d>& start) {
  std::vector<std::string> warnings;
  const auto add = [&](const std::string& warning) {
    if (!warning.empty()) warnings.push_back(warning);
  };
  add(size_warning(scene, mesh));
  if (!names_an_obj(scene.cloth.start)) return warnings;
  add(stretch_warning(scene, mesh, start));
  add(shown(scene, "cloth.start", scene.cloth.start, "") +
      " is a shape without a history: friction and set begin as if the cloth were bent to it once, from "
      "rest");
  return warnings;
}

}  // namespace hysteron
