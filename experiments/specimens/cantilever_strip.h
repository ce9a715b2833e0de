// A strip clamped level at one end that sags under its own weight: the cloth of the cantilever test, and what
// the elastica says of it.
#pragma once

#include "sim/reference/elastica.h"
#include "sim/reference/kes_in_plane.h"
#include "sim/scene/cloth.h"
#include "sim/time/timetable.h"

namespace hysteron::experiments {

struct CantileverStrip {
  Scene scene;
  Cloth cloth;
  double length = 0;  // that hangs over, from the middle of the clamp's columns [m]

  // Middle of the free end seen from the clamp, in the strip's own axes: forward, down [m].
  Eigen::Vector2d free_end(const std::vector<Eigen::Vector3d>& x) const;
};

// Makes the scene's cloth a strip of its family that hangs over by `length`, scene.cloth.width wide, of about
// scene.triangles triangles, and clamps it; pins of the scene are replaced.  Error::invalid_input for
// impossible meshes.
CantileverStrip overhang(Scene scene, double length);

// Whether weft runs along the scene's strip, which lies along x, rather than warp.
bool lies_along_weft(const Scene& scene);

// Bending rigidity of the scene's strip, which lies along x, over that along warp.
double rigidity_along(const Scene& scene);
// The virgin curve of the strip's direction: that along weft has stops of its own where the fabric does.
// Error::invalid_input for a strip between warp and weft of such a fabric.
VirginCurve strip_curve(const Scene& scene);
// Whether it has one: not between warp and weft of a fabric with stops along both.
bool has_strip_curve(const Scene& scene);
// The same with the rigidity of that direction in its numbers: moments and curvatures are the strip's own.
VirginCurve curve_along(const Scene& scene);
// The same for a strip that is cut along warp or weft.
VirginCurve curve_along(const Fabric& fabric, Along along, const std::string& law = "prandtl");

// The same strip as a curve, with its law, its rigidity and weight.
HeavyStrip strip_elastica(const Scene& scene, double length);

// Error::invalid_input for what no elastica is compared with: a weight that does not pull the strip towards
// its underside, within 30 degrees along it; one that does not grow, or by too many steps; a strip that hangs
// straight down.
void check_cantilever(const Scene& scene);

// Fraction of the weight at a time of quasi-static runs (Scene::ramp, Scene::unload).
double load_at(const Scene& scene, double time);
// Steps from the start to the whole weight, at which one of them ends.
Timetable loading(const Scene& scene);
// Takes them.  Error::simulation unless the weight is whole then.
void load_wholly(const Scene& scene, Simulation& simulation);

// Half the overhang at which the chord of the sagging strip falls to 41.5 degrees below the clamp (ASTM
// D1388, ISO 9073-7) [m]: of the curve, and of the cloth, whose search starts at `first` [m].
// Error::simulation where a bounded search finds none.
double elastica_bending_length(const Scene& scene);
double cloth_bending_length(const Scene& scene, double first);

}  // namespace hysteron::experiments
