// Pure bending: the loop of a strip between rotating clamps against that of its law alone.
#include <algorithm>
#include <cmath>

#include "experiments/accuracy/accuracy.h"
#include "experiments/kes/strip_output.h"

namespace hysteron::experiments {
namespace {

constexpr int kTriangles = 340;

// Of B, 2HB and the loop's area, the largest relative difference from the law's own reading.
double largest_of(const StripDifference& d) {
  double largest = 0;
  for (double percent : {d.rigidity, d.loop_width, d.loop_area})
    if (std::isfinite(percent)) largest = std::max(largest, std::abs(percent) / 100);
  return largest;
}

Found bend(const Setting& setting) {
  const Fabric fabric = Scene{}.fabric;
  KesProtocol protocol;
  protocol.cycles = 1;
  const LawRequest law{setting.law, fabric.virgin_curve(), {}};
  StripShape shape;
  shape.mesh = setting.mesh;
  shape.element = setting.element;
  shape.triangles = setting.triangles;
  shape.warp_angle = setting.load;
  shape.steps = static_cast<int>(std::lround(1 / setting.step));
  ClampedStrip strip = clamped_strip(shape, law, fabric, protocol);
  strip.scene.device = setting.device;
  strip.scene.precision = setting.precision;
  if (setting.tolerance > 0) strip.scene.newton_residual = setting.tolerance;
  const StripTest test = test_strip(strip, law, protocol);
  Found found;
  found.value = test.reading.rigidity;
  found.reference = test.law_reading.rigidity;
  found.error = largest_of(difference(test, protocol.amplitude));
  found.triangles = strip.cloth.mesh.faces();
  found.steps = static_cast<long>(strip.walk.rows.size()) - 1;
  found.bytes = test.bytes;
  found.seconds = test.seconds;
  return found;
}

}  // namespace

Problem bend_problem(const Effort& effort) {
  Problem problem{"bend",
                  "Pure bending to 2.5 per cm and back: a strip's loop",
                  "B [N m]",
                  "largest of |B|, |2HB|, |loop area| over the law's own - 1",
                  "the law alone through the same curvatures",
                  {},
                  bend};
  problem.load = "warp angle";
  Setting base;
  base.mesh = "aligned";
  base.law = "prandtl";
  base.device = effort.device;
  base.triangles = effort.quick ? 96 : kTriangles;
  base.step = effort.quick ? 1.0 / 28 : 1.0 / 63;
  base.tolerance = 1e-6;
  std::vector<Setting>& list = problem.settings;
  list.push_back(base);
  for (const char* mesh : {"aligned-45", "flipped", "unionjack", "equilateral", "random"})
    if (!effort.quick || std::string(mesh) == "random")
      list.push_back(varied(base, "mesh", [&](Setting& s) { s.mesh = mesh; }));
  for (const char* mesh : {"aligned", "unionjack", "random"})
    for (int triangles : {24, 96, 1360}) {
      if (effort.quick && (triangles > 96 || std::string(mesh) != "aligned")) continue;
      if (triangles == base.triangles || (triangles > kTriangles && std::string(mesh) != "aligned")) continue;
      list.push_back(varied(base, "size", [&](Setting& s) { s.mesh = mesh, s.triangles = triangles; }));
    }
  for (const char* mesh : {"aligned", "aligned-45", "flipped", "unionjack", "equilateral", "random"})
    if (!effort.quick || std::string(mesh) == "aligned")
      list.push_back(
          varied(base, "element", [&](Setting& s) { s.element = BendingElement::hinge, s.mesh = mesh; }));
  if (effort.quick) return problem;
  for (const char* law : {"linear", "bilinear", "dahl", "obrien"})
    list.push_back(varied(base, "law", [&](Setting& s) { s.law = law; }));
  // Laws of scalar form run along four directions of the fabric: as good as where these lie.
  for (double angle : {0.0, 11.25, 22.5, 33.75, 45.0})
    list.push_back(varied(base, "warp angle", [&](Setting& s) { s.law = "wong", s.load = angle; }));
  for (double step : {1.0 / 13, 1.0 / 28})
    list.push_back(varied(base, "step", [&](Setting& s) { s.step = step; }));
  list.push_back(
      varied(base, "precision", [&](Setting& s) { s.precision = Precision::fp32, s.tolerance = 1e-4; }));
  return problem;
}

}  // namespace hysteron::experiments
