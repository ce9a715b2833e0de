// Problem bend: the loop of a strip in pure bending between rotating clamps is compared with that of its law
// alone.
#include <algorithm>
#include <cmath>

#include "experiments/accuracy/accuracy.h"
#include "experiments/kes/output.h"

namespace hysteron::experiments {
namespace {

constexpr int kTriangles = 340;

// Returns the largest relative difference of B, 2HB and the loop's area from the law's own reading.
double largest_reading_difference(const StripDifference& d) {
  double largest = 0;
  for (double percent : {d.rigidity, d.loop_width, d.loop_area})
    if (std::isfinite(percent)) largest = std::max(largest, std::abs(percent) / 100);
  return largest;
}

Found bend(const MethodSetting& setting) {
  const Fabric fabric = Scene{}.fabric;
  KesProtocol protocol;
  protocol.cycles = 1;
  const LawRequest law{setting.law, fabric.virgin_curve(), {}};
  StripShape shape;
  shape.mesh = enum_name(setting.mesh);
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
  found.error = largest_reading_difference(difference(test, protocol.amplitude));
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
                  "largest of |B|, |2HB|, |loop area| over the law's own - 1",
                  "the law alone through the same curvatures",
                  {},
                  bend};
  problem.load = "warp angle";
  MethodSetting base;
  base.mesh = MeshFamily::aligned;
  base.law = "prandtl";
  base.device = effort.device;
  base.triangles = effort.quick ? 96 : kTriangles;
  base.step = effort.quick ? 1.0 / 28 : 1.0 / 63;
  base.tolerance = 1e-6;
  std::vector<MethodSetting>& list = problem.settings;
  list.push_back(base);
  MethodSetting hinge = base;
  hinge.element = BendingElement::hinge;
  if (effort.quick) {
    vary(list, base, "mesh", &MethodSetting::mesh, {MeshFamily::random});
    vary(list, base, "size", &MethodSetting::triangles, {24});
    vary(list, hinge, "element", &MethodSetting::mesh, {base.mesh});
    return problem;
  }
  vary(list, base, "mesh", &MethodSetting::mesh,
       {MeshFamily::aligned45, MeshFamily::flipped, MeshFamily::unionjack, MeshFamily::equilateral,
        MeshFamily::random});
  vary(list, base, "size", &MethodSetting::triangles, {24, 96, 1360});
  for (const MeshFamily mesh : {MeshFamily::unionjack, MeshFamily::random}) {
    MethodSetting other = base;
    other.mesh = mesh;
    vary(list, other, "size", &MethodSetting::triangles, {24, 96});
  }
  const auto families = every_value<MeshFamily>();
  vary(list, hinge, "element", &MethodSetting::mesh, {families.begin(), families.end()});
  vary(list, base, "law", &MethodSetting::law, {"linear", "bilinear", "dahl", "obrien"});
  // The scalar law `wong` runs along four directions of the fabric, so its error depends on where these lie.
  MethodSetting wong = base;
  wong.law = "wong";
  vary(list, wong, "warp angle", &MethodSetting::load, {0, 11.25, 22.5, 33.75, 45});
  vary(list, base, "step", &MethodSetting::step, {1.0 / 13, 1.0 / 28});
  list.push_back(varied(base, "precision",
                        [&](MethodSetting& s) { s.precision = Precision::fp32, s.tolerance = 1e-4; }));
  return problem;
}

}  // namespace hysteron::experiments
