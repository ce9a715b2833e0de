// What is simulated: cloth, fabric, forces, obstacles, solver settings.  Everything in SI units; a Scene is a
// plain value, read from a TOML file and flags (scene_reader.h) and printed back fully resolved into every
// manifest.
#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sim/bending/choices.h"
#include "sim/bending/laws/command_kind.h"
#include "sim/bending/laws/law.h"
#include "sim/scene/method.h"
#include "sim/scene/obstacle_kind.h"

namespace hysteron {

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
};

// Physics of a cloth.  Every number has its source in the fabric's file.
struct Fabric {
  std::string name = "cotton-broad";
  double b1 = 3.589e-5;  // fabric.b1         initial bending rigidity [N m], >= b2
  double b2 = 1.157e-5;  // fabric.b2         bending rigidity B, slope of the straight KES-FB2 branch [N m]
  double k0 = 50;        // fabric.k0         curvature at which bending friction saturates [1/m]
  double weft_bending = 1;      // fabric.weft-bending  bending rigidity along weft over that along warp
  double bias_bending = 1;      // fabric.bias-bending  the same at 45 degrees; 4 bias >= 1 + weft
  double density = 0.1238;      // fabric.density    mass per area [kg/m^2]
  double thickness = 0.497e-3;  // fabric.thickness  [m]
  double warp = 1000;           // fabric.warp       membrane stiffness along warp [N/m]
  double weft = 1000;           // fabric.weft       membrane stiffness along weft [N/m]
  double coupling = 0;          // fabric.coupling   warp-weft coupling C_12 [N/m], C_12^2 < warp * weft
  double shear = 60;            // fabric.shear      in-plane shear stiffness [N/m]
  double damping = 1e-4;  // fabric.damping    viscosity over stiffness, of membrane and of bending (b1) [s]
  double friction = 0.3;  // fabric.friction   Coulomb coefficient against obstacles

  std::map<std::string, Provenance> provenance;      // of each parameter above, by its name
  std::map<std::string, PublishedNumber> published;  // B, 2HB, drape-coefficient, node-count, ... as printed

  VirginCurve virgin_curve() const { return {b1, b2, k0}; }  // along warp
  bool bends_alike() const { return weft_bending == 1 && bias_bending == 1; }
};

struct ClothShape {
  std::string shape = "square";       // cloth.shape       square | strip | disc | tube | file
  double length = 0.5;                // cloth.length      along warp [m] (square, strip, tube)
  double width = 0.5;                 // cloth.width       along weft [m] (strip; a square takes length)
  double radius = 0.15;               // cloth.radius      [m] (disc, tube)
  std::string file;                   // cloth.file        OBJ
  double weld = 0;                    // cloth.weld        merge vertices closer than this [m], 0 = off (file)
  Eigen::Vector3d position{0, 0, 0};  // cloth.position    of the builders' origin [m]
  Eigen::Vector3d rotation{0, 0, 0};  // cloth.rotation    Euler angles about x, y, z in this order [degree]
  double warp_angle = 0;              // cloth.warp-angle  warp direction against the x axis at rest [degree]
};

// A moment of a prescribed motion; between keys positions are interpolated smoothly (velocity zero at keys
// where the motion rests), angles about the axis likewise.
struct Keyframe {
  double time = 0;                    // [s]
  Eigen::Vector3d position{0, 0, 0};  // displacement from the start [m]
  double angle = 0;                   // rotation about the motion's axis and centre [degree]
  double scale = 1;                   // of obstacles: size over that at the start, about the motion's centre
};

struct Motion {
  std::vector<Keyframe> keys;       // empty: at rest
  Eigen::Vector3d axis{0, 0, 1};    // of the rotation
  Eigen::Vector3d center{0, 0, 0};  // of the rotation [m]
};

// Vertices held by hand: those of the rest shape inside the box or nearest to the point, from `from` to
// `until`.  A hand that takes hold later takes them where they are then and moves them from there.  Of hands
// on the same vertex the last one holds it.
struct Pin {
  std::string select = "box";      // pin.select   box | nearest | all-boundary
  Eigen::Vector3d low{0, 0, 0};    // pin.low      box corner in builder coordinates [m]
  Eigen::Vector3d high{0, 0, 0};   // pin.high
  Eigen::Vector3d point{0, 0, 0};  // pin.point    for `nearest`
  double from = 0;                 // pin.from     taken at this time [s]
  double until = 1e30;             // pin.until    released at this time [s]
  double home = 0;  // pin.home     time in which it brings them back to where they were at t = 0 [s]
  Motion motion;    // pin.keys, pin.axis, pin.center
};

struct Obstacle {
  ObstacleKind kind = ObstacleKind::ground;  // obstacle.kind
  Eigen::Vector3d center{
      0, 0, 0};  // obstacle.center [m]; ground: a point of the plane; cylinder: middle of its axis
  Eigen::Vector3d axis{0, 0, 1};        // obstacle.axis   ground: normal; cylinder, capsule: direction
  Eigen::Vector3d size{0.1, 0.1, 0.1};  // obstacle.size  box: half edges [m]
  double radius = 0.1;                  // obstacle.radius sphere, hollow sphere, cylinder, capsule [m]
  double height = 0.1;                  // obstacle.height cylinder, capsule: length of the axis [m]
  double rim = 0.001;                   // obstacle.rim    rounding of the cylinder's and box's edges [m]
  double friction = -1;                 // obstacle.friction  Coulomb coefficient; < 0: the fabric's
  bool visible = true;                  // obstacle.visible
  double from = 0;                      // obstacle.from   put there at this time [s]
  double until = 1e30;                  // obstacle.until  removed at this time [s]
  Motion motion;                        // obstacle.keys, obstacle.motion-axis, obstacle.motion-center
};

// An order to the bending elements whose middle lies in the box on the flat cloth.
struct Command {
  CommandKind kind = CommandKind::iron;   // command.kind
  double time = 0;                        // command.time  [s]
  Eigen::Vector3d low{-1e3, -1e3, -1e3};  // command.low   box corner in builder coordinates [m]
  Eigen::Vector3d high{1e3, 1e3, 1e3};    // command.high
};

// Phases follow one another from t = 0 on; times in scene files may name them.
struct Phase {
  std::string name;    // phase.name
  double seconds = 1;  // phase.seconds
};

struct Scene {
  ClothShape cloth;
  Fabric fabric;
  std::string law = "prandtl";  // law
  std::map<std::string, std::string>
      param;  // param      law parameters by name (memory, stops, recovery, ...)
  BendingElement element = BendingElement::shape;         // element
  ForceConvention force = ForceConvention::energy;        // force      chapter: hinge only
  std::string mesh = "random";                            // mesh       family of the builder, or FILE.obj
  int triangles = 5000;                                   // triangles
  Integrator integrator = Integrator::semi_implicit;      // integrator
  double step = 1e-3;                                     // step       large step hi [s]
  int substeps = 0;                                       // substeps   alpha; 0 = the least stable one
  ImplicitEvery implicit_every = ImplicitEvery::substep;  // implicit-every
  double solver_tolerance = 1e-4;  // solver-tolerance  relative residual of the implicit solve
  double newton_residual = 1e-6;   // newton-residual   unbalanced force over the weight
  double newton_velocity = 1e-9;   // newton-velocity   or: correction over the step's time [m/s]
  int newton_iterations =
      0;                 // newton-iterations  at most, then the step is taken as it is; 0: until it converges
  double tolerance = 0;  // tolerance  of positions, per part of a step [m]; 0: steps as given
  Preconditioning linear_solver = Preconditioning::multigrid;  // linear-solver
  double ramp = 0;    // ramp      quasi-static: time in which the weight grows [s]
  double unload = 0;  // unload    after it, time in which the weight falls to none [s]
  DeviceChoice device = DeviceChoice::automatic;  // device
  Precision precision = Precision::fp64;          // precision
  int threads = 0;                                // threads    0 = all cores
  double seconds = 1;                             // seconds    simulated time [s]
  Eigen::Vector3d gravity{0, 0, -9.81};           // gravity    [m/s^2]
  double air_drag = 0;                            // air-drag   linear drag per area [kg/(m^2 s)]
  bool self_contact = false;                      // self-contact  cloth cannot pass through itself
  double contact_stiffness = 0;    // contact-stiffness  per area [N/m^3]; 0 = from weight and thickness
  unsigned seed = 1;               // seed
  std::vector<Pin> pin;            // [[pin]]
  std::vector<Obstacle> obstacle;  // [[obstacle]]
  std::vector<Command> command;    // [[command]]
  std::vector<Phase> phase;        // [[phase]]
  // Where each key that is no default was set, "scene.toml:7" or "--step", for messages: by key ("step",
  // "obstacle[0].radius"), and by table ("pin[1]").
  std::map<std::string, std::string> origin;

  // Name of the phase at this time [s], the last one after all of them; "" without phases.
  std::string phase_at(double time) const;
  // Bending as well: every force at the end of the step.
  bool is_implicit() const {
    return integrator == Integrator::implicit || integrator == Integrator::bdf2 ||
           integrator == Integrator::quasi_static;
  }
};

}  // namespace hysteron
