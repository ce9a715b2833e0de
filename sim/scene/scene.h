// What is simulated: cloth, fabric, forces, obstacles, solver settings.  Everything in SI units; a Scene is a
// plain value, read from a TOML file and flags (scene_reader.h) and printed back fully resolved into every
// manifest.  Meaning, unit, range and choices of every key stand in its line of keys.cpp, from which --help
// and the tables of docs/scenes.md come; comments here say what such a line does not.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/base/cycles.h"
#include "sim/base/enum_names.h"
#include "sim/bending/choices.h"
#include "sim/bending/laws/friction_shape.h"
#include "sim/bending/laws/law.h"
#include "sim/mesh/length_unit.h"
#include "sim/scene/obstacle_kind.h"

namespace hysteron {

struct BodyMesh;

// How a scene is simulated: choices with the names of scene files, parsed where flags and files are read.

// semi_implicit: bending explicit, membrane and contact implicit.  implicit: backward Euler; bdf2: the same
// with second order; tr_bdf2: a trapezoidal stage, then bdf2 over the rest of the step (Bank et al. 1985);
// quasi_static: equilibria; these four have every force at the end of the step or stage.
// explicit_euler: symplectic Euler, every force explicit.
enum class Integrator { semi_implicit, implicit, bdf2, tr_bdf2, quasi_static, explicit_euler };
constexpr std::array<const char*, 6> names(Integrator) {
  return {"semi-implicit", "implicit", "bdf2", "tr-bdf2", "quasi-static", "explicit"};
}

// How often semi_implicit solves: with every substep of bending, or once per step as the chapter has it.
enum class ImplicitEvery { substep, step };
constexpr std::array<const char*, 2> names(ImplicitEvery) { return {"substep", "step"}; }

// Preconditioners of conjugate gradients.  automatic: by the size and shape of the cloth
// (time/method_choice.h); cholesky: a factorisation of the whole matrix.
enum class Preconditioning { automatic, multigrid, cholesky, block_jacobi };
constexpr std::array<const char*, 4> names(Preconditioning) {
  return {"auto", "multigrid", "cholesky", "block-jacobi"};
}

// Where the membrane takes its strains along warp and weft: constant, of each triangle; nodal, what of the
// stiffness is beyond 1 kN/m of their means at nodes (membrane/membrane_nodes.h).
enum class MembraneElement { constant, nodal };
constexpr std::array<const char*, 2> names(MembraneElement) { return {"constant", "nodal"}; }

enum class DeviceChoice { automatic, cpu, cuda };
constexpr std::array<const char*, 3> names(DeviceChoice) { return {"auto", "cpu", "cuda"}; }

// double, float
enum class Precision { fp64, fp32 };
constexpr std::array<const char*, 2> names(Precision) { return {"double", "float"}; }

// Where a number of a fabric comes from.  Confidence: published, fitted, derived, assumed, or given (scene
// file or flag).
struct Provenance {
  std::string source;
  std::string confidence;
  std::optional<double> standard_error = {};  // of the number, in its unit; none: not known
};

// A measured number that is no parameter of the model: what the source prints, or what to compare results
// with.
struct PublishedNumber {
  double value = 0;
  std::string unit;
  Provenance provenance;
  std::string tester =
      "";  // of a drape: the standard whose apparatus measured it (`drape.standard`); "": not known
};

// Friction elements in the plane beside the membrane's stiffness: springs [N/m] that slip at strains, each on
// one component of Green's strain in the material axes.
struct InPlaneStops {
  Spectrum warp, weft, shear;  // of E11, E22 and 2 E12
  double shear_growth = 0;     // g: at the shear x = 2 E12 those of shear slip at r_j (1 + g |x|)

  bool empty() const { return warp.empty() && weft.empty() && shear.empty(); }
};

// What KES-FB2 printed of a fabric, where it is stated in place of b1 and b2, which follow from it: b2 = B
// and b1 = B + 2HB/k0, or with a shape of friction b1, b2, k0 and bending.stops (friction_shape.h).
struct KesFriction {
  KesPair read = {};
  FrictionShape shape = {};

  bool on() const { return shape.on(); }
  bool gives_numbers() const { return !shape.on() && read.rigidity > 0 && read.loop_width > 0; }
};

// Physics of a cloth.  Every number has its source in the fabric's file.
struct Fabric {
  std::string name = "cotton-broad";
  double b1 = 3.589e-5;
  double b2 = 1.157e-5;
  double k0 = 50;
  double weft_bending = 1;
  double bias_bending = 1;
  double weft_friction = 0;  // friction moment along weft over that along warp; 0: weft_bending^1/2
  double density = 0.1238;
  double thickness = 0.497e-3;
  double warp = 1000;
  double weft = 1000;
  double coupling = 0;
  double shear = 60;
  double damping = 1e-4;
  double friction = 0.3;
  KesFriction kes = {};
  BendingParts bending = {};
  InPlaneStops in_plane = {};

  std::map<std::string, Provenance> provenance;      // of each parameter above that it has, by its key
  std::map<std::string, PublishedNumber> published;  // B, 2HB, drape-coefficient, node-count, ... as printed

  void follow_kes();                 // what follows from `kes`, with its provenance
  VirginCurve virgin_curve() const;  // along warp; stops along weft as laws see them behind the metric
  // Half of what pictures and histograms span [1/m]: k0, or of shaped friction, which has none, where the
  // window of KES-FB2 begins.
  double friction_curvature() const;
  bool bends_alike() const { return weft_bending == 1 && bias_bending == 1 && !rubs_otherwise(); }
  // Has friction along weft a ratio of its own, which is not that of the rigidities?
  bool rubs_otherwise() const { return weft_friction > 0 && weft_friction != std::sqrt(weft_bending); }
  // Of rigidity, and of the stiffness of friction that has not slipped.
  DirectionRatios rigidity_ratios() const { return {weft_bending, bias_bending}; }
  DirectionRatios friction_ratios() const;
  double widening_of_twist() const;  // Faces::wider
};

struct ClothShape {
  std::string shape = "square";
  double length = 0.5;
  double width = 0.5;
  double radius = 0.15;
  std::string file;
  LengthUnit unit = LengthUnit::metre;
  double weld = 0;
  double texture_scale = 1;
  int subdivisions = 0;
  Eigen::Vector3d position{0, 0, 0};
  Eigen::Vector3d rotation{0, 0, 0};
  double warp_angle = 0;
  std::string start = "rest";
  int pleats = 4;
  int copies = 1;
  Eigen::Vector3d copy_offset{0, 0, 0.01};
  double copy_turn = 0;
  double copy_scatter = 0;
};

// An instant of a prescribed motion; between keys positions and angles are interpolated smoothly (velocity
// zero at keys where the motion rests).
struct Keyframe {
  double time = 0;
  Eigen::Vector3d position{0, 0, 0};
  double angle = 0;
  double scale = 1;
};

// Rotates about the axis through the centre, both of the start.
struct Motion {
  std::vector<Keyframe> keys;  // empty: at rest
  Cycles cycles;               // no key: those of the scene (scene/cycles.h), in which the keys hold again
  Eigen::Vector3d axis{0, 0, 1};
  Eigen::Vector3d center{0, 0, 0};
};

// Vertices held by hand, chosen on the flat cloth as its builder or its file places it.  A hand that takes
// hold later takes them where they are then and moves them from there.  Of hands on the same vertex the last
// one holds it.
struct Pin {
  std::string select = "box";
  Eigen::Vector3d low{0, 0, 0};
  Eigen::Vector3d high{0, 0, 0};
  Eigen::Vector3d point{0, 0, 0};
  double from = 0;
  double until = 1e30;
  double home = 0;
  double strength = 0;
  Motion motion;
};

struct Obstacle {
  ObstacleKind kind = ObstacleKind::ground;
  Eigen::Vector3d center{0, 0, 0};
  Eigen::Vector3d axis{0, 0, 1};
  Eigen::Vector3d size{0.1, 0.1, 0.1};
  double radius = 0.1;
  double height = 0.1;
  double rim = 0.001;
  double friction = -1;
  std::string body;  // obstacles of one name act as one; empty: alone
  bool visible = true;
  double from = 0;
  double until = 1e30;
  std::string file;  // of a mesh, as are those below
  LengthUnit unit = LengthUnit::metre;
  std::string sequence;
  double fps = 0;
  std::shared_ptr<const BodyMesh> mesh;  // no key: load_bodies() (scene/body.h) reads it; null: not yet
  Motion motion;                         // its axis and centre are the keys motion-axis and motion-center
};

// An order to the bending elements whose middle lies in the box on the flat cloth.
struct Command {
  CommandKind kind = CommandKind::iron;
  double time = 0;
  Eigen::Vector3d low{-1e3, -1e3, -1e3};
  Eigen::Vector3d high{1e3, 1e3, 1e3};
};

// Phases follow one another from t = 0 on; times in scene files may name them.
struct Phase {
  std::string name;
  double seconds = 1;
  bool repeat = false;
};

// Choices of the solver's that are no keys, and their values in use.
struct SolverTuning {
  // Share of e e'/|e|^2 that is taken out of the stiffness of a stop that slides (contact/sliding_stop.h),
  // far from the minimum and near it; 1: its energy's second derivative.
  double sliding_far = 0, sliding_near = 0.75;
  int friction_rounds = 20;     // Newton iterations that friction's limits follow; then they stay
  double loosest_solve = 0.1;   // largest relative residual of a linear solve (Eisenstat & Walker 1996)
  double longer = 4;            // a correction is looked for as far as this many times the last one
  double full_stiffness = 0.1;  // share of the first unbalanced force below which the full stiffness is used
};

struct Scene {
  ClothShape cloth;
  Fabric fabric;
  std::string law = "prandtl";
  std::map<std::string, std::string> param;
  BendingElement element = BendingElement::shape;
  MembraneElement membrane_element = MembraneElement::nodal;
  ForceConvention force = ForceConvention::energy;
  std::string mesh = "random";
  int triangles = 5000;
  Integrator integrator = Integrator::semi_implicit;
  double step = 1e-3;
  int substeps = 0;
  ImplicitEvery implicit_every = ImplicitEvery::substep;
  double solver_tolerance = 1e-4;
  double newton_residual = 1e-6;
  double newton_velocity = 1e-9;
  int newton_iterations = 0;
  double tolerance = 0;
  Preconditioning linear_solver = Preconditioning::automatic;
  Precision linear_precision = Precision::fp64;
  SolverTuning tuning = {};  // no key
  double ramp = 0;
  double unload = 0;
  DeviceChoice device = DeviceChoice::automatic;
  Precision precision = Precision::fp64;
  int threads = 0;
  double seconds = 1;
  int cycles = 1;
  Eigen::Vector3d gravity{0, 0, -9.81};
  double air_drag = 0;
  bool self_contact = false;
  double contact_stiffness = 0;
  unsigned seed = 1;
  std::vector<Pin> pin;
  std::vector<Obstacle> obstacle;
  std::vector<Command> command;
  std::vector<Phase> phase;
  // Where each key that is no default was set, "scene.toml:7" or "--step", for messages: by key ("step",
  // "obstacle[0].radius"), and by table ("pin[1]").
  std::map<std::string, std::string> origin;

  // Name of the phase at this time [s], the last one after all of them; "" without phases.  Of phases that
  // are gone through several times "bend, cycle 2".
  std::string phase_at(double time) const;
  // Bending as well: every force at the end of the step.
  bool is_implicit() const {
    return integrator == Integrator::implicit || integrator == Integrator::bdf2 ||
           integrator == Integrator::tr_bdf2 || integrator == Integrator::quasi_static;
  }
  // The linear systems of Newton's method, all else in double.
  bool solves_in_float() const { return precision == Precision::fp64 && linear_precision == Precision::fp32; }
  // A step ends in equilibrium with contact and pins.
  bool finds_equilibrium() const { return is_implicit() || self_contact; }
};

}  // namespace hysteron
