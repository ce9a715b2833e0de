// A scene: cloth, fabric, forces, obstacles, solver settings.  Everything is in SI units.  A Scene is a plain
// value, read from a TOML file and flags (scene_reader.h) and printed back fully resolved into every
// manifest.  The meaning, unit, range and choices of every key stand in its line of keys.cpp, from which
// --help and the tables of docs/scenes.md come; comments here give units and what such a line does not say.
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

// Choices of the method, with the names of scene files.

// semi_implicit treats bending explicitly, membrane and contact implicitly. implicit is backward Euler; bdf2
// is its second-order two-step form; tr_bdf2 is a trapezoidal stage, then bdf2 over the rest of the step
// (Bank et al. 1985); quasi_static finds equilibria; these four take every force at the end of the step or
// stage. explicit_euler is symplectic Euler with every force explicit.
enum class Integrator { semi_implicit, implicit, bdf2, tr_bdf2, quasi_static, explicit_euler };
constexpr std::array<const char*, 6> names(Integrator) {
  return {"semi-implicit", "implicit", "bdf2", "tr-bdf2", "quasi-static", "explicit"};
}

// semi_implicit solves with every substep of bending, or once per step as the chapter does.
enum class ImplicitEvery { substep, step };
constexpr std::array<const char*, 2> names(ImplicitEvery) { return {"substep", "step"}; }

// Preconditioners of conjugate gradients: automatic chooses by the size and shape of the cloth
// (time/method_choice.h), cholesky factorises the whole matrix.
enum class Preconditioning { automatic, multigrid, cholesky, block_jacobi };
constexpr std::array<const char*, 4> names(Preconditioning) {
  return {"auto", "multigrid", "cholesky", "block-jacobi"};
}

// The membrane takes its strains along warp and weft from each triangle (constant), or as means at nodes for
// the part of the stiffness beyond 1 kN/m (nodal; membrane/membrane_nodes.h).
enum class MembraneElement { constant, nodal };
constexpr std::array<const char*, 2> names(MembraneElement) { return {"constant", "nodal"}; }

enum class DeviceChoice { automatic, cpu, cuda };
constexpr std::array<const char*, 3> names(DeviceChoice) { return {"auto", "cpu", "cuda"}; }

// A device that is named, for what chooses none by itself.
enum class NamedDevice { cpu, cuda };
constexpr std::array<const char*, 2> names(NamedDevice) { return {"cpu", "cuda"}; }
constexpr DeviceChoice device_choice(NamedDevice device) {
  return device == NamedDevice::cpu ? DeviceChoice::cpu : DeviceChoice::cuda;
}

// fp64 is double, fp32 float.
enum class Precision { fp64, fp32 };
constexpr std::array<const char*, 2> names(Precision) { return {"double", "float"}; }

// This is where a number of a fabric comes from.  Its confidence is published, fitted, derived, assumed, or
// given (scene file or flag).
struct Provenance {
  std::string source;
  std::string confidence;
  std::optional<double> standard_error = {};  // in the number's unit; none: not known
};

// The standard of a drape test, which names its apparatus: ISO 9073-9 or JIS L 1096.
enum class DrapeStandard { iso9073, jis };
constexpr std::array<const char*, 2> names(DrapeStandard) { return {"iso9073", "jis"}; }

// A measured number that is no parameter of the model: the source prints it, or results are compared with it.
struct PublishedNumber {
  double value = 0;  // in `unit`
  std::string unit;
  Provenance provenance;
  std::optional<DrapeStandard> tester = {};  // of a drape (`drape.standard`); none: not known
};

// Friction elements in the plane beside the membrane's stiffness: springs [N/m] that slip at strains [-],
// each on one component of Green's strain in the material axes.
struct InPlaneStops {
  Spectrum warp, weft, shear;  // on E11, E22 and 2 E12
  double shear_growth = 0;     // g: at the shear x = 2 E12 those of shear slip at r_j (1 + g |x|)

  bool empty() const { return warp.empty() && weft.empty() && shear.empty(); }
};

// These numbers of KES-FB2 replace b1 and b2, which follow from them: b2 = B and b1 = B + 2HB/k0, or with a
// shape of friction b1, b2, k0 and bending.stops (friction_shape.h).
struct KesFriction {
  KesPair read = {};  // B [N m], 2HB [N]
  FrictionShape shape = {};

  bool on() const { return shape.on(); }
  bool gives_numbers() const { return !shape.on() && read.rigidity > 0 && read.loop_width > 0; }
};

// The physics of a cloth.  The fabric's file states the source of every number.
struct Fabric {
  std::string name = "cotton-broad";
  double b1 = 3.589e-5;         // [N m], rigidity at first bending
  double b2 = 1.157e-5;         // [N m], rigidity B of the straight branch
  double k0 = 50;               // [1/m], curvature at which friction saturates
  double weft_bending = 1;      // rigidity along weft over that along warp
  double bias_bending = 1;      // rigidity at 45 degrees over that along warp
  double weft_friction = 0;     // friction moment along weft over that along warp; 0: weft_bending^1/2
  double density = 0.1238;      // [kg/m^2]
  double thickness = 0.497e-3;  // [m]
  double warp = 1000;           // [N/m], membrane stiffness
  double weft = 1000;           // [N/m], membrane stiffness
  double coupling = 0;          // [N/m], membrane coupling C12
  double shear = 60;            // [N/m], in-plane shear stiffness
  double damping = 1e-4;        // [s], viscosity over stiffness
  double friction = 0.3;        // Coulomb coefficient
  KesFriction kes = {};
  BendingParts bending = {};
  InPlaneStops in_plane = {};

  std::map<std::string, Provenance> provenance;  // the provenance of each parameter that has one, by its key
  std::map<std::string, PublishedNumber> published;  // B, 2HB, drape-coefficient, node-count, ... as printed

  void follow_kes();                 // derives the numbers that follow from `kes`, with provenance
  VirginCurve virgin_curve() const;  // along warp; weft_stops behind the metric, as laws see them
  // Returns half of the range of pictures and histograms [1/m]: k0, or for shaped friction, which has no k0,
  // the curvature at which the window of KES-FB2 begins.
  double friction_curvature() const;
  bool bends_alike() const { return weft_bending == 1 && bias_bending == 1 && !rubs_otherwise(); }
  // Does friction along weft have a ratio of its own, which is not that of the rigidities?
  bool rubs_otherwise() const { return weft_friction > 0 && weft_friction != std::sqrt(weft_bending); }
  // Return the ratios of rigidity, and of the stiffness of friction that has not slipped.
  DirectionRatios rigidity_ratios() const { return {weft_bending, bias_bending}; }
  DirectionRatios friction_ratios() const;
  double widening_of_twist() const;  // the value of Faces::wider
};

// The outline of a cloth: of a built mesh, or of an OBJ, whose vertices (file) or texture coordinates
// (pattern) are the rest shape.
enum class ClothOutline { square, strip, disc, tube, file, pattern };
constexpr std::array<const char*, 6> names(ClothOutline) {
  return {"square", "strip", "disc", "tube", "file", "pattern"};
}

struct ClothShape {
  ClothOutline shape = ClothOutline::square;
  double length = 0.5;   // [m], along warp
  double width = 0.5;    // [m], along weft
  double radius = 0.15;  // [m], of the disc, tube, knot's loops or pleats' turns
  std::string file;
  LengthUnit unit = LengthUnit::metre;
  double weld = 0;           // [m], vertices closer than this are merged
  double texture_scale = 1;  // [m], length of a unit of texture coordinates
  int subdivisions = 0;
  Eigen::Vector3d position{0, 0, 0};  // [m]
  Eigen::Vector3d rotation{0, 0, 0};  // [degree], about x, y, z in this order
  double warp_angle = 0;              // [degree], of warp against the rest shape's x axis
  std::string start = "rest";
  int pleats = 4;
  int copies = 1;
  Eigen::Vector3d copy_offset{0, 0, 0.01};  // [m], from one copy to the next
  double copy_turn = 0;                     // [degree], largest random turn of a copy
  double copy_scatter = 0;                  // [m], largest random offset of a copy

  bool is_rectangle() const { return shape == ClothOutline::square || shape == ClothOutline::strip; }
  double side_along_weft() const {
    return shape == ClothOutline::square ? length : width;
  }  // of a rectangle [m]
  bool is_of_file() const { return shape == ClothOutline::file || shape == ClothOutline::pattern; }
};

// An instant of a prescribed motion; positions and angles are interpolated smoothly between keys (with
// velocity zero at keys where the motion rests).
struct Keyframe {
  double time = 0;                    // [s]
  Eigen::Vector3d position{0, 0, 0};  // [m], displacement from the start
  double angle = 0;                   // [degree]
  double scale = 1;                   // size over that at the start
};

// A prescribed motion: it rotates about the axis through the centre, both those of the start.
struct Motion {
  std::vector<Keyframe> keys;  // empty: at rest
  Cycles cycles{};             // no key: the scene's cycles (scene/cycles.h), in which the keys hold again
  Eigen::Vector3d axis{0, 0, 1};
  Eigen::Vector3d center{0, 0, 0};  // [m]
};

// Which vertices of the rest shape a pin holds: those in its box, the one nearest to its point, or those of
// boundary edges.
enum class PinSelection { box, nearest, all_boundary };
constexpr std::array<const char*, 3> names(PinSelection) { return {"box", "nearest", "all-boundary"}; }

// Pinned vertices, chosen on the flat cloth as its builder or its file places it.  A pin that takes hold
// later takes its vertices where they are then and moves them from there.  Where pins share a vertex the last
// one holds it.
struct Pin {
  PinSelection select = PinSelection::box;
  Eigen::Vector3d low{0, 0, 0};    // [m], corner of the box
  Eigen::Vector3d high{0, 0, 0};   // [m], opposite corner
  Eigen::Vector3d point{0, 0, 0};  // [m], for select = "nearest"
  double from = 0;                 // [s]
  double until = 1e30;             // [s]; 1e30: never
  double home = 0;                 // [s], time to return to the start; 0: it does not
  double strength = 0;             // [N], largest force of the whole pin; 0: no limit
  Motion motion;
};

struct Obstacle {
  ObstacleKind kind = ObstacleKind::ground;
  Eigen::Vector3d center{0, 0, 0};  // [m]
  Eigen::Vector3d axis{0, 0, 1};
  Eigen::Vector3d size{0.1, 0.1, 0.1};  // [m], half edges of the box
  double radius = 0.1;                  // [m]
  double height = 0.1;                  // [m]
  double rim = 0.001;                   // [m], radius of rounded edges
  double friction = -1;                 // Coulomb coefficient; negative: the fabric's
  std::string body;                     // obstacles of one name act as one; empty: alone
  bool visible = true;
  double from = 0;      // [s]
  double until = 1e30;  // [s]; 1e30: never
  std::string file;     // for a mesh, as are the fields below
  LengthUnit unit = LengthUnit::metre;
  std::string sequence;
  double fps = 0;                        // [1/s], frames of the sequence; 0: the file's times
  std::shared_ptr<const BodyMesh> mesh;  // no key: load_bodies() (scene/body.h) reads it; null: not yet
  Motion motion;                         // its axis and centre are the keys motion-axis and motion-center
};

// An event of the bending elements whose middle lies in the box on the flat cloth.
struct SceneEvent {
  CommandKind kind = CommandKind::iron;
  double time = 0;                        // [s]
  Eigen::Vector3d low{-1e3, -1e3, -1e3};  // [m], corner of the box
  Eigen::Vector3d high{1e3, 1e3, 1e3};    // [m], opposite corner
};

// Phases follow one another from t = 0 on; times in scene files may name them.
struct Phase {
  std::string name;
  double seconds = 1;  // [s]
  bool repeat = false;
};

// The solver's constants, which are no keys.
struct SolverTuning {
  // The share of e e'/|e|^2 that is taken out of the stiffness of a sliding stop (contact/sliding_stop.h),
  // far from the minimum and near it; 1 would give its energy's second derivative.
  double sliding_far = 0, sliding_near = 0.75;
  int friction_rounds = 20;     // friction's limits follow this many Newton iterations, then stay
  double loosest_solve = 0.1;   // largest relative residual of a linear solve (Eisenstat & Walker 1996)
  double longer = 4;            // the line search goes up to this many times the last correction
  double full_stiffness = 0.1;  // below this share of the first unbalanced force the full stiffness is used
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
  double step = 1e-3;  // [s]
  int substeps = 0;
  ImplicitEvery implicit_every = ImplicitEvery::substep;
  double solver_tolerance = 1e-4;  // relative residual
  double newton_residual = 1e-6;   // unbalanced force over weight and reactions
  double newton_velocity = 1e-9;   // [m/s], root mean square correction over the step's time
  int newton_iterations = 0;
  double tolerance = 0;  // [m], position error of a step's parts; 0: off
  Preconditioning linear_solver = Preconditioning::automatic;
  Precision linear_precision = Precision::fp64;
  SolverTuning tuning = {};  // no key
  double ramp = 0;           // [s], in which the weight grows
  double unload = 0;         // [s], in which it falls to zero; 0: it stays
  DeviceChoice device = DeviceChoice::automatic;
  Precision precision = Precision::fp64;
  int threads = 0;
  double seconds = 1;  // [s]
  int cycles = 1;
  Eigen::Vector3d gravity{0, 0, -9.81};  // [m/s^2]
  double air_drag = 0;                   // [kg/(m^2 s)]
  bool self_contact = false;
  double contact_stiffness = 0;  // [N/m^3], of obstacles; 0: that of layers of cloth
  unsigned seed = 1;
  std::vector<Pin> pin;
  std::vector<Obstacle> obstacle;
  std::vector<SceneEvent> command;
  std::vector<Phase> phase;
  // Messages use where each key that is not at its default was set, "scene.toml:7" or "--step", by key
  // ("step", "obstacle[0].radius") and by table ("pin[1]").
  std::map<std::string, std::string> origin;

  // Returns the name of the phase at `time` [s], the last one after all of them, "bend, cycle 2" if phases
  // repeat; "" without phases.
  std::string phase_at(double time) const;
  // Takes every force, bending's too, at the end of the step.
  bool is_implicit() const {
    return integrator == Integrator::implicit || integrator == Integrator::bdf2 ||
           integrator == Integrator::tr_bdf2 || integrator == Integrator::quasi_static;
  }
  // Solves the linear systems of Newton's method in float, and all else in double.
  bool solves_in_float() const { return precision == Precision::fp64 && linear_precision == Precision::fp32; }
  // Does a step end in equilibrium with contact and pins?
  bool finds_equilibrium() const { return is_implicit() || self_contact; }
};

}  // namespace hysteron
