// What is pictured: a cloth that is simulated, or one that was kept.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "experiments/workbench/app/experiment.h"
#include "experiments/workbench/pictures/kept_geometry.h"
#include "sim/device/gl_positions.h"
#include "sim/scene/cloth.h"
#include "sim/time/simulation.h"

namespace hysteron::experiments {

class Subject {
 public:
  virtual ~Subject() = default;
  virtual const DrawnMesh& mesh() const = 0;
  virtual double time() const = 0;             // [s]
  virtual std::vector<float> positions() = 0;  // x, y, z of each vertex [m]
  // One a vertex, in looks that show a value; none in others.
  virtual std::vector<float> values(const std::string& look) = 0;
  // False of look "difference" where the run to subtract has no instant of this time: its values are 0 then.
  virtual bool has_values(const std::string&) const { return true; }
  // That each vertex stands for in means over the cloth [m^2].
  virtual std::vector<double> vertex_areas() const = 0;
  virtual int cuda_device() const { return -1; }
  // As Simulation::share_positions().
  virtual std::unique_ptr<GlPositions> share_positions(unsigned gl_buffer, int gl_device,
                                                       std::string& reason) = 0;
};

// Warp and weft coordinates of each vertex where the cloth lies at rest, 2 a vertex [m].  None of panels that
// are sewn together: a vertex on a seam is at several places of the pattern.
std::vector<float> pattern_coordinates(const ClothMesh& mesh, const ClothShape& shape);
// As pictures draw it; its quantum is a fraction of the mean edge.
DrawnMesh drawn_mesh(const ClothMesh& mesh, const ClothShape& shape);

// A third of the triangles around each vertex, as they lie now [m^2].
std::vector<double> vertex_areas(const std::vector<int>& triangles, const std::vector<float>& xyz);

// `reference`: the folder of the run that look "difference" subtracts; "": none.  Cloth and simulation must
// outlive it.
std::unique_ptr<Subject> simulated(const Scene& scene, const Cloth& cloth, Simulation& simulation,
                                   const std::string& reference);

// Throws Error::invalid_input where `reference` is no such folder, or of a run with other triangles or
// another rest shape; of "" never.
void check_reference(const std::string& reference, const ClothMesh& mesh, const ClothShape& shape);

// Cloth as it was kept, one instant after the other.  What was kept must outlive it.
class KeptSubject : public Subject {
 public:
  KeptSubject(const DrawnMesh& mesh, const std::vector<KeptState>& instants)
      : mesh_(mesh), instants_(instants) {}

  void go_to(std::size_t instant) { now_ = instant; }

  const DrawnMesh& mesh() const override { return mesh_; }
  double time() const override { return instants_[now_].time; }
  std::vector<float> positions() override { return instants_[now_].xyz; }
  // Curvature that was not kept is that of the shape.  Throws Error::invalid_input for other values that were
  // not.
  std::vector<float> values(const std::string& look) override;
  // Those of the first instant: the cloth at rest was not kept.
  std::vector<double> vertex_areas() const override {
    return experiments::vertex_areas(mesh_.triangles, instants_.front().xyz);
  }
  std::unique_ptr<GlPositions> share_positions(unsigned, int, std::string& reason) override {
    reason = "kept geometry";
    return nullptr;
  }

 private:
  const DrawnMesh& mesh_;
  const std::vector<KeptState>& instants_;
  std::size_t now_ = 0;
};

}  // namespace hysteron::experiments
