// The source of a picture: a simulated cloth, or one from a file.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "experiments/workbench/app/experiment.h"
#include "experiments/workbench/pictures/archived_geometry.h"
#include "sim/device/gl_positions.h"
#include "sim/scene/cloth.h"
#include "sim/time/simulation.h"

namespace hysteron::experiments {

class FrameSource {
 public:
  virtual ~FrameSource() = default;
  virtual const DrawnMesh& mesh() const = 0;
  virtual double time() const = 0;             // [s]
  virtual std::vector<float> positions() = 0;  // x, y, z of each vertex [m]
  // Returns one value per vertex, in looks that show a value; none in others.
  virtual std::vector<float> values(const std::string& look) = 0;
  // False for look "difference" if the run to subtract has no instant of this time; the values are then 0.
  virtual bool has_values(const std::string&) const { return true; }
  // Returns the area that each vertex represents in means over the cloth [m^2].
  virtual std::vector<double> vertex_areas() const = 0;
  virtual int cuda_device() const { return -1; }
  // Shares positions as Simulation::share_positions() does.
  virtual std::unique_ptr<GlPositions> share_positions(unsigned gl_buffer, int gl_device,
                                                       std::string& reason) = 0;
};

// Returns warp and weft coordinates of each vertex of the cloth at rest, 2 per vertex [m].  Panels that are
// sewn together have none: a vertex on a seam is at several places of the pattern.
std::vector<float> pattern_coordinates(const ClothMesh& mesh, const ClothShape& shape);
// Returns the mesh for pictures; its quantum is a fraction of the mean edge.
DrawnMesh drawn_mesh(const ClothMesh& mesh, const ClothShape& shape);

// Returns a third of the area of the triangles around each vertex, in their current shape [m^2]; `triangles`
// has 3 indices each, `xyz` 3 numbers a vertex [m].
std::vector<double> vertex_areas(const std::vector<int>& triangles, const std::vector<float>& xyz);

// Returns the curvature at each vertex of a shape whose rest shape is not kept [1/m].  Throws as
// surface_curvature() does.
std::vector<float> shape_curvature(const std::vector<float>& xyz, const std::vector<int>& triangles);

// `reference` is the folder of the run that look "difference" subtracts; "": none.  Cloth and simulation must
// outlive the result.
std::unique_ptr<FrameSource> simulated(const Scene& scene, const Cloth& cloth, Simulation& simulation,
                                       const std::string& reference);

// Throws Error::invalid_input if `reference` is no such folder, or of a run with other triangles or another
// rest shape; never for "".
void check_reference(const std::string& reference, const ClothMesh& mesh, const ClothShape& shape);

// Cloth from a file, one instant after the other.  The kept data must outlive it.
class ArchivedSource : public FrameSource {
 public:
  ArchivedSource(const DrawnMesh& mesh, const std::vector<ArchivedState>& instants)
      : mesh_(mesh), instants_(instants) {}

  void go_to(std::size_t instant) { now_ = instant; }

  const DrawnMesh& mesh() const override { return mesh_; }
  double time() const override { return instants_[now_].time; }
  std::vector<float> positions() override { return instants_[now_].xyz; }
  // Returns kept values, or the curvature of the shape if it was not kept.  Throws Error::invalid_input for
  // other values that were not.
  std::vector<float> values(const std::string& look) override;
  // Returns the areas at the first instant, because the cloth at rest was not kept.
  std::vector<double> vertex_areas() const override {
    return experiments::vertex_areas(mesh_.triangles, instants_.front().xyz);
  }
  std::unique_ptr<GlPositions> share_positions(unsigned, int, std::string& reason) override {
    reason = "kept geometry";
    return nullptr;
  }

 private:
  const DrawnMesh& mesh_;
  const std::vector<ArchivedState>& instants_;
  std::size_t now_ = 0;
};

}  // namespace hysteron::experiments
