// The bodies of a picture, as they are drawn and as they cast shadows.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "render/camera.h"
#include "render/gl/program.h"
#include "render/inset.h"
#include "render/shadow_maps.h"
#include "render/shapes.h"
#include "render/static_mesh.h"

namespace hysteron::render {

// These lengths decide how much smaller than they are obstacles are drawn (inset.h) [m].
struct ObstacleFit {
  float cloth_side;                    // long_side() of the cloth
  float least_inset;                   // Look::obstacle_inset
  std::optional<float> ground_height;  // what stands there keeps standing
};

class Obstacles {
 public:
  explicit Obstacles(const GlFunctions& gl);

  // Adds a mesh whose triangles face outward and returns the obstacle's number.  `caster` is the same surface
  // in fewer triangles, for its shadows.
  int add(const TriangleMesh& mesh, const Eigen::Matrix4f& placement, const TriangleMesh* caster);
  // The following ask for an obstacle's number; Error::invalid_input if there is no such obstacle.
  void reshape(int number, const TriangleMesh& mesh, const TriangleMesh* caster);  // keeps its placement
  void move(int number, const Eigen::Matrix4f& placement);
  void show(int number, bool visible);

  // Returns the box around the given one, if any, and all visible obstacles [m].
  std::optional<Box> merged(std::optional<Box> box) const;
  // Returns all of the obstacles that decides the light on a scene, as numbers to compare.
  std::vector<float> state() const;

  // Draws the visible obstacles with the program in use, setting "model", "keep" and "inset".
  void draw(const Program& program, const ObstacleFit& fit) const;
  void draw_casters(const Program& program, const ObstacleFit& fit) const;
  // Computes the light of the room at every vertex from up-to-date maps; draw() passes it on.
  void update_sky(const ShadowMaps& shadows, const ObstacleFit& fit) const;

 private:
  struct Obstacle {
    StaticMesh mesh, caster;  // `mesh` is drawn, fine enough for the room's light; `caster` casts shadows
    Box box;                  // bounds of the mesh before its placement [m]
    BodyMeasure measure;
    bool closed;
    Eigen::Matrix4f placement;
    bool visible = true;
    int shapes = 1;  // number of shapes so far
  };

  Obstacle& at(int number);
  Obstacle made(const TriangleMesh& mesh, const Eigen::Matrix4f& placement, const TriangleMesh* caster) const;
  void draw_meshes(StaticMesh Obstacle::*mesh, const Program& program, const ObstacleFit& fit) const;
  static void place(const Program& program, const Obstacle& obstacle, const ObstacleFit& fit);
  // Returns the placement of a body that is drawn smaller by `inset` [m] on all sides, stretched upright so
  // that one that stands on the ground keeps standing.
  static Eigen::Matrix4f standing(const Obstacle& obstacle, float inset,
                                  const std::optional<float>& ground_height);

  const GlFunctions* gl_;
  Program sky_program_;
  std::vector<Obstacle> obstacles_;
};

}  // namespace hysteron::render
