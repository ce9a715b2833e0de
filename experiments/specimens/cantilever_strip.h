// A strip clamped level at one end that sags under its own weight: the cloth of the cantilever test, and what
// the elastica says of it.
#pragma once

#include "sim/reference/elastica.h"
#include "sim/scene/cloth.h"

namespace hysteron::experiments {

struct CantileverStrip {
  Scene scene;
  Cloth cloth;
  double length = 0;  // that hangs over, from the middle of the clamp's columns [m]

  // Middle of the free end seen from the clamp: forward, down [m].
  Eigen::Vector2d free_end(const std::vector<Eigen::Vector3d>& x) const;
};

// Makes the scene's cloth a strip of its family that hangs over by `length`, scene.cloth.width wide, of about
// scene.triangles triangles, and clamps it; pins of the scene are replaced.  Error::invalid_input for
// impossible meshes.
CantileverStrip overhang(Scene scene, double length);

// Bending rigidity of the scene's strip, which lies along x, over that along warp.
double rigidity_along(const Scene& scene);

// The same strip as a curve, with its law, its rigidity and weight.
HeavyStrip strip_elastica(const Scene& scene, double length);

// Share of the weight at a time of quasi-static runs (Scene::ramp, Scene::unload).
double load_at(const Scene& scene, double time);

// Half the overhang at which the chord of the sagging strip falls to 41.5 degrees below the clamp (ASTM
// D1388, ISO 9073-7) [m]: of the curve, and of the cloth, whose search starts at `first` [m].
double elastica_bending_length(const Scene& scene);
double cloth_bending_length(const Scene& scene, double first);

}  // namespace hysteron::experiments
