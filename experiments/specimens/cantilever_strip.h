// A strip clamped level at one end that sags under its own weight: the cloth of the cantilever test, and its
// elastica.
#pragma once

#include "sim/reference/elastica.h"
#include "sim/reference/kes_in_plane.h"
#include "sim/scene/cloth.h"
#include "sim/time/timetable.h"

namespace hysteron::experiments {

struct CantileverStrip {
  Scene scene;
  Cloth cloth;
  double length = 0;  // overhang from the middle of the clamp's columns [m]

  // Returns the middle of the free end relative to the clamp, in the strip's own axes: forward, down [m].
  Eigen::Vector2d free_end(const std::vector<Eigen::Vector3d>& x) const;
};

// Makes the scene's cloth a strip of its mesh family that hangs over by `length` [m], scene.cloth.width wide,
// of about scene.triangles triangles, and clamps it; pins of the scene are replaced.  Throws
// Error::invalid_input for impossible meshes.
CantileverStrip overhang(Scene scene, double length);

// True if weft rather than warp runs along the scene's strip, which lies along x.
bool lies_along_weft(const Scene& scene);

// Returns the bending rigidity of the scene's strip, which lies along x, over that along warp.
double rigidity_along(const Scene& scene);
// Returns the virgin curve of the strip's direction: that along weft has stops of its own if the fabric has
// them.  Throws Error::invalid_input for a strip between warp and weft of such a fabric.
VirginCurve strip_curve(const Scene& scene);
// True if there is such a curve, as there is not between warp and weft of a fabric with stops along both.
bool has_strip_curve(const Scene& scene);
// Returns the same curve scaled by the rigidity of that direction: moments and curvatures are the strip's
// own.
VirginCurve curve_along(const Scene& scene);
// Returns the same for a strip that is cut along warp or weft.
VirginCurve curve_along(const Fabric& fabric, Along along, const std::string& law = "prandtl");

// Returns the same strip as a curve, with its law, rigidity and weight.
HeavyStrip strip_elastica(const Scene& scene, double length);

// Throws Error::invalid_input for strips that no elastica is compared with: the weight does not pull towards
// the underside within 30 degrees along the strip, does not grow, or grows by too many steps; or the strip
// hangs straight down.
void check_cantilever(const Scene& scene);

// Returns the fraction of the weight at a time of quasi-static runs (Scene::ramp, Scene::unload).
double load_at(const Scene& scene, double time);
// Returns the steps from the start to the whole weight, at which one of them ends.
Timetable loading(const Scene& scene);
// Takes these steps.  Throws Error::simulation unless the whole weight acts then.
void load_wholly(const Scene& scene, Simulation& simulation);

// Returns half the overhang at which the chord of the sagging strip falls to 41.5 degrees below the clamp
// (ASTM D1388, ISO 9073-7) [m], for the curve, and for the cloth, whose search starts at `first` [m]. Throws
// Error::simulation if a bounded search finds none.
double elastica_bending_length(const Scene& scene);
double cloth_bending_length(const Scene& scene, double first);

}  // namespace hysteron::experiments
