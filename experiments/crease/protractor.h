// The crease angle as it is read off a specimen: its profile, the lines through its limbs, and the angle
// between them, drawn to scale.
#pragma once

#include <string>
#include <vector>

#include "experiments/crease/specimen.h"
#include "experiments/workbench/compare/comparison_page.h"
#include "render/plot.h"

namespace hysteron::experiments {

// A specimen in profile; lengths in mm, x along the clamped limb and z up.
struct CreasedStrip {
  std::string name, color;   // "prandtl", "#RRGGBB"
  std::vector<double> x, z;  // of the strip's middle line [mm]
  Limbs limbs;               // [mm], y = 0
};

CreasedStrip creased_strip(const std::string& name, const std::string& color, const Crease& crease,
                           const std::vector<Eigen::Vector3d>& positions);
// Profiles with equal scales along x and z; of each the lines through its limbs to where they meet, an arc
// between them and, beside it, the angle in whole degrees.
render::Plot protractor_plot(const std::string& title, const std::vector<CreasedStrip>& strips);

// profile.csv, the middle line, and limbs.csv, the points that each limb's direction is taken from.
void write_profile(Run& run, const CreasedStrip& strip);
// plot_protractor of a comparison: the columns' profiles at the end beside their moments against curvature
// where they are probed.  No plot where no column has a profile.
void plot_protractor(Run& run, const ComparisonPage& page, const std::vector<ChildRun>& columns);

}  // namespace hysteron::experiments
