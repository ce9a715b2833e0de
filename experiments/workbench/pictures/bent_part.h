// The part of the cloth that is bent most, which a contact sheet shows once more from nearer by: wrinkles
// behind a knee are small in a picture of the whole leg.
#pragma once

#include <optional>
#include <vector>

#include "experiments/workbench/pictures/sheet_view.h"

namespace hysteron::experiments {

// How much a shape is bent, a number a vertex.
struct Bending {
  std::vector<float> curvature;  // [1/m]
  std::vector<double> area;      // [m^2]

  double at(std::size_t vertex) const {  // square of the curvature times the area
    return area[vertex] * curvature[vertex] * curvature[vertex];
  }
  double total() const;
};

// `xyz` has 3 numbers a vertex [m], `triangles` 3 indices each.  Throws as surface_curvature() does.
Bending bending_of(const std::vector<float>& xyz, const std::vector<int>& triangles);

// Returns a view as from `view`, but 2.5 times as near, of the part of a cell in which the cloth is bent
// most. Nothing if less than half of the bending lies in a part so small, as where cloth is bent everywhere,
// or if its folds are large enough to be seen in `view`: of 20 pixels' radius and more, root mean square.
std::optional<NearerView> bent_part(const std::vector<float>& xyz, const Bending& bending,
                                    const SheetView& view);

}  // namespace hysteron::experiments
