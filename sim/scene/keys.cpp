#include "sim/scene/keys.h"

#include <nlohmann/json.hpp>

#include "sim/base/error.h"
#include "sim/bending/laws/law_parameters.h"
#include "sim/scene/assets.h"
#include "sim/scene/cycles.h"
#include "sim/scene/fabric_reader.h"
#include "sim/scene/mesh_files.h"
#include "sim/scene/shown_key.h"

namespace hysteron {
namespace {

using Json = nlohmann::ordered_json;
using S = Scene;
using C = ClothShape;
using F = Fabric;
using B = BendingParts;
using P = InPlaneStops;

// clang-format off
// Keys of a cloth have these traits in common, so have those of a fabric, of the solver and of the machine.
constexpr KeyTraits kCloth{.group = KeyGroup::scene};
constexpr KeyTraits kClothFile{.group = KeyGroup::scene, .file = NamesFile::one};
constexpr KeyTraits kFabric{.group = KeyGroup::fabric};
constexpr KeyTraits kBending{.group = KeyGroup::fabric, .takers = Takers::laws};
constexpr KeyTraits kFabricName{.group = KeyGroup::fabric, .takers = Takers::laws, .in_columns = InColumns::list, .file = NamesFile::one, .flag = "fabric"};
constexpr KeyTraits kLaw{.group = KeyGroup::fabric, .in_columns = InColumns::list};
constexpr KeyTraits kSolver{.group = KeyGroup::solver};
constexpr KeyTraits kIntegrator{.group = KeyGroup::solver, .in_columns = InColumns::list};
constexpr KeyTraits kMachine{.scope = Scope::run, .group = KeyGroup::running};
constexpr KeyTraits kThreads{.scope = Scope::run, .group = KeyGroup::running, .in_columns = InColumns::leave};

constexpr const char* kMovable = "cloth.start != *.obj and cloth.shape != pattern";
constexpr const char* kMovableWords = "a cloth whose start no file says";
constexpr const char* kNewton = "integrator = implicit | bdf2 | tr-bdf2 | quasi-static or self-contact";
constexpr const char* kNewtonWords = "--integrator implicit, bdf2, tr-bdf2 or quasi-static, or --self-contact";

const KeyRow<Scene> kSceneRows[] = {
    {"cloth.shape", at<&S::cloth, &C::shape>, "", any(), "outline of the cloth; file: an OBJ; pattern: the texture coordinates of an OBJ, whose islands are panels sewn along their seams, and which starts where its vertices are", kCloth},
    {"cloth.length", at<&S::cloth, &C::length>, "m", positive(), "along warp (square, strip, tube)", kCloth.needing("cloth.shape = square | strip | tube and mesh != *.obj", "--cloth.shape square, strip or tube")},
    {"cloth.width", at<&S::cloth, &C::width>, "m", positive(), "along weft (strip; a square takes cloth.length)", kCloth.needing("cloth.shape = strip and mesh != *.obj", "--cloth.shape strip")},
    {"cloth.radius", at<&S::cloth, &C::radius>, "m", positive(), "of the disc, the tube, the loops of a knot or the turns of pleats", kCloth.needing("cloth.shape = disc | tube and mesh != *.obj or cloth.start = knot | pleats", "--cloth.shape disc or tube, or --cloth.start knot or pleats")},
    {"cloth.file", at<&S::cloth, &C::file>, "", any(), "OBJ of the rest shape (file), or with it as texture coordinates (pattern)", kClothFile.needing("cloth.shape = file | pattern")},
    {"cloth.unit", at<&S::cloth, &C::unit>, "", any(), "of length in the OBJs of cloth.file, cloth.start and mesh", kCloth},
    {"cloth.weld", at<&S::cloth, &C::weld>, "m", at_least(0), "vertices of an OBJ closer than this are merged; 0: none are", kCloth.needing("cloth.shape = file | pattern or mesh = *.obj or cloth.start = *.obj", "a cloth that is read from an OBJ")},
    {"cloth.texture-scale", at<&S::cloth, &C::texture_scale>, "m", positive(), "pattern: length of a unit of the texture coordinates", kCloth.needing("cloth.shape = pattern and mesh != *.obj", "--cloth.shape pattern")},
    {"cloth.subdivisions", at<&S::cloth, &C::subdivisions>, "", between(0, 8), "how many times each triangle is cut into four, a finer mesh where a file has the triangles", kCloth},
    {"cloth.position", at<&S::cloth, &C::position>, "m", any(), "of the rest shape's origin at the start", kCloth},
    {"cloth.rotation", at<&S::cloth, &C::rotation>, "degree", any(), "about x, y, z in this order at the start", kCloth},
    {"cloth.warp-angle", at<&S::cloth, &C::warp_angle>, "degree", any(), "warp direction against the rest shape's x axis, or the first texture coordinate of an OBJ", kCloth},
    {"cloth.start", at<&S::cloth, &C::start>, "", any(), "shape at the start: rest, that at rest; knot, a strip in an open overhand knot of two loops; pleats, a strip or square laid in pleats; or an OBJ of the same triangles, FILE.obj", kClothFile},
    {"cloth.pleats", at<&S::cloth, &C::pleats>, "", between(2, 1000), "layers of the pleats", kCloth.needing("cloth.start = pleats")},
    {"cloth.copies", at<&S::cloth, &C::copies>, "", between(1, 1000), "as many cloths of this shape, which share the triangles", kCloth},
    {"cloth.copy-offset", at<&S::cloth, &C::copy_offset>, "m", any(), "from one copy to the next, at rest and at the start: pins tell copies apart by it", kCloth.needing("cloth.copies > 1")},
    {"cloth.copy-turn", at<&S::cloth, &C::copy_turn>, "degree", between(0, 180), "each copy starts turned by up to this, at random, about z through its middle", kCloth.needing(kMovable, kMovableWords)},
    {"cloth.copy-scatter", at<&S::cloth, &C::copy_scatter>, "m", at_least(0), "each copy starts moved by up to this, at random, along x and along y", kCloth.needing(kMovable, kMovableWords)},
    {"fabric.name", at<&S::fabric, &F::name>, "", any(), "a fabric of assets/fabrics or a file; loads all its numbers", kFabricName},
    {"fabric.b1", at<&S::fabric, &F::b1>, "N m", at_least(0), "bending rigidity at first bending, >= fabric.b2", kBending},
    {"fabric.b2", at<&S::fabric, &F::b2>, "N m", at_least(0), "bending rigidity B, slope of the straight branch of the KES-FB2 curve", kBending},
    {"fabric.k0", at<&S::fabric, &F::k0>, "1/m", at_least(0), "curvature at which bending friction saturates", kBending},
    {"fabric.kes-b", at<&S::fabric, &F::kes, &KesFriction::read, &KesPair::rigidity>, "N m", at_least(0), "B of KES-FB2, with kes-2hb in place of b1 and b2: b2 = B, b1 = B + 2HB/k0", kBending},
    {"fabric.kes-2hb", at<&S::fabric, &F::kes, &KesFriction::read, &KesPair::loop_width>, "N", at_least(0), "2HB of KES-FB2, with kes-b", kBending},
    {"fabric.stops-median", at<&S::fabric, &F::kes, &KesFriction::shape, &FrictionShape::median>, "1/m", between(0, 1000), "with kes-b and kes-2hb: curvature at which half of the friction has slipped, in place of k0; 0: as k0 or bending.stops say", kBending},
    {"fabric.stops-spread", at<&S::fabric, &F::kes, &KesFriction::shape, &FrictionShape::spread>, "", between(0, 4), "standard deviation of the logarithm of that curvature", kBending},
    {"fabric.weft-bending", at<&S::fabric, &F::weft_bending>, "", positive(), "bending rigidity along weft over that along warp", kFabric},
    {"fabric.weft-friction", at<&S::fabric, &F::weft_friction>, "", at_least(0), "friction moment along weft over that along warp, which laws with friction beside b2 follow; 0: the root of weft-bending, as one law along all directions has it", kFabric},
    {"fabric.back-bending", at<&S::fabric, &F::bending, &B::faces, &Faces::bending>, "", positive(), "prandtl, linear: bending rigidity B of bends to the back, K < 0, over that of bends to the face, K > 0, where the side from which triangles run counter-clockwise becomes concave; other laws have the mean of both", kBending},
    {"fabric.back-friction", at<&S::fabric, &F::bending, &B::faces, &Faces::friction>, "", positive(), "prandtl: friction moment of bends to the back over that of bends to the face, which b1, b2 and k0 or bending.stops have", kBending},
    {"fabric.bias-bending", at<&S::fabric, &F::bias_bending>, "", positive(), "bending rigidity at 45 degrees over that along warp; 4 times it >= 1 + weft-bending; where it is not stated, or only assumed, the mean of 1 and weft-bending", kFabric},
    {"fabric.density", at<&S::fabric, &F::density>, "kg/m^2", positive(), "mass per area", kFabric},
    {"fabric.thickness", at<&S::fabric, &F::thickness>, "m", positive(), "thickness", kFabric},
    {"fabric.warp", at<&S::fabric, &F::warp>, "N/m", positive(), "membrane stiffness along warp", kFabric},
    {"fabric.weft", at<&S::fabric, &F::weft>, "N/m", positive(), "membrane stiffness along weft", kFabric},
    {"fabric.coupling", at<&S::fabric, &F::coupling>, "N/m", any(), "membrane coupling C12 of warp and weft; its square < warp times weft", kFabric},
    {"fabric.shear", at<&S::fabric, &F::shear>, "N/m", at_least(0), "in-plane shear stiffness", kFabric},
    {"fabric.damping", at<&S::fabric, &F::damping>, "s", at_least(0), "viscosity over stiffness, of the membrane and of bending (b1)", kFabric},
    {"fabric.friction", at<&S::fabric, &F::friction>, "", at_least(0), "Coulomb coefficient against obstacles and itself", kFabric},
    {"fabric.bending.stops.thresholds", at<&S::fabric, &F::bending, &B::stops, &Spectrum::thresholds>, "1/m", positive(), "prandtl, chapman: curvatures at which friction elements slip, ascending; none: b1, b2 and k0 say how", kBending},
    {"fabric.bending.stops.stiffnesses", at<&S::fabric, &F::bending, &B::stops, &Spectrum::stiffnesses>, "N m", positive(), "of these elements, beside fabric.b2", kBending},
    {"fabric.bending.stops.weft.thresholds", at<&S::fabric, &F::bending, &B::weft_stops, &Spectrum::thresholds>, "1/m", positive(), "the same for bends along weft; none: as fabric.weft-bending has it", kBending},
    {"fabric.bending.stops.weft.stiffnesses", at<&S::fabric, &F::bending, &B::weft_stops, &Spectrum::stiffnesses>, "N m", positive(), "the same for bends along weft", kBending},
    {"fabric.bending.branches.times", at<&S::fabric, &F::bending, &B::branches, &RelaxingBranches::times>, "s", positive(), "chapman: times in which viscoelastic branches relax, ascending", kBending},
    {"fabric.bending.branches.stiffnesses", at<&S::fabric, &F::bending, &B::branches, &RelaxingBranches::stiffnesses>, "N m", positive(), "of these branches, beside fabric.b2", kBending},
    {"fabric.bending.set.yield", at<&S::fabric, &F::bending, &B::set, &PermanentSet::yield>, "1/m", at_least(0), "prandtl, chapman: curvature over fabric.b2 times which a moment leaves permanent set", kBending},
    {"fabric.bending.set.hardening", at<&S::fabric, &F::bending, &B::set, &PermanentSet::hardening>, "N m", at_least(0), "by which that moment rises with the set; 0: no set", kBending},
    {"fabric.membrane.stops.warp.thresholds", at<&S::fabric, &F::in_plane, &P::warp, &Spectrum::thresholds>, "", positive(), "strains at which friction elements of stretch along warp slip, ascending; none: elastic", kFabric},
    {"fabric.membrane.stops.warp.stiffnesses", at<&S::fabric, &F::in_plane, &P::warp, &Spectrum::stiffnesses>, "N/m", positive(), "of these elements, beside fabric.warp", kFabric},
    {"fabric.membrane.stops.weft.thresholds", at<&S::fabric, &F::in_plane, &P::weft, &Spectrum::thresholds>, "", positive(), "strains at which friction elements of stretch along weft slip, ascending; none: elastic", kFabric},
    {"fabric.membrane.stops.weft.stiffnesses", at<&S::fabric, &F::in_plane, &P::weft, &Spectrum::stiffnesses>, "N/m", positive(), "of these elements, beside fabric.weft", kFabric},
    {"fabric.membrane.stops.shear.thresholds", at<&S::fabric, &F::in_plane, &P::shear, &Spectrum::thresholds>, "", positive(), "strains at which friction elements of in-plane shear slip, ascending; none: elastic", kFabric},
    {"fabric.membrane.stops.shear.stiffnesses", at<&S::fabric, &F::in_plane, &P::shear, &Spectrum::stiffnesses>, "N/m", positive(), "of these elements, beside fabric.shear", kFabric},
    {"fabric.membrane.stops.shear.growth", at<&S::fabric, &F::in_plane, &P::shear_growth>, "", between(0, 1e3), "by which those strains grow with the shear that the cloth has, per unit of it: r (1 + growth |shear|); 0: they do not", kFabric},
    {"law", at<&S::law>, "", any(), "moment-curvature law", kLaw},
    {"param", at<&S::param>, "", any(), "parameters of the law by name; the table [param] of a file", kFabric},
    {"element", at<&S::element>, "", any(), "bending element", kFabric},
    {"membrane.element", at<&S::membrane_element>, "", any(), "where strains along warp and weft are taken: constant, of each triangle, which locks if they are stiff; nodal, beyond 1 kN/m their means at nodes", kCloth},
    {"force", at<&S::force>, "", any(), "bending force convention (chapter: hinge only)", kFabric},
    {"mesh", at<&S::mesh>, "", any(), "family: aligned, aligned-45, flipped, unionjack, equilateral or random; or an OBJ of the rest shape, FILE.obj", kClothFile},
    {"triangles", at<&S::triangles>, "", between(1, 1e8), "about this many triangles", kCloth.needing("cloth.shape != file | pattern and mesh != *.obj", "a cloth whose mesh is built, not read from a file")},
    {"integrator", at<&S::integrator>, "", any(), "time integration", kIntegrator},
    {"step", at<&S::step>, "s", {0, 1, true}, "large time step", kSolver},
    {"substeps", at<&S::substeps>, "", between(0, 1e6), "explicit bending steps per large step; 0: the smallest stable number", kSolver.needing("integrator = semi-implicit | explicit")},
    {"implicit-every", at<&S::implicit_every>, "", any(), "implicit solve once per substep, or per step as the chapter has it", kSolver.needing("integrator = semi-implicit")},
    {"solver-tolerance", at<&S::solver_tolerance>, "", {0, 0.1, true}, "relative residual of the implicit solve", kSolver.needing("integrator = semi-implicit")},
    {"newton-residual", at<&S::newton_residual>, "", {0, 1, true}, "implicit, bdf2, tr-bdf2, quasi-static: unbalanced force over weight and reactions at which a step has converged", kSolver.needing(kNewton, kNewtonWords)},
    {"newton-velocity", at<&S::newton_velocity>, "m/s", at_least(0), "implicit, bdf2, tr-bdf2: or the mean correction over the step's time", kSolver.needing(kNewton, kNewtonWords)},
    {"newton-iterations", at<&S::newton_iterations>, "", between(0, 1e6), "implicit, bdf2, tr-bdf2: most iterations, after which the step is taken as it is and what is unbalanced is booked; 0: until it converges, in parts where it does not", kSolver.needing("integrator = implicit | bdf2 | tr-bdf2 or integrator = semi-implicit and self-contact", "--integrator implicit, bdf2 or tr-bdf2, or semi-implicit with --self-contact")},
    {"tolerance", at<&S::tolerance>, "m", at_least(0), "semi-implicit, implicit, bdf2, tr-bdf2: divides steps into parts, each with an estimated position error below this; 0: off", kSolver},
    {"ramp", at<&S::ramp>, "s", at_least(0), "quasi-static: time in which the weight grows to its full value", kSolver.needing("integrator = quasi-static")},
    {"unload", at<&S::unload>, "s", at_least(0), "quasi-static: time after the ramp in which the weight falls to zero; 0: it stays", kSolver.needing("integrator = quasi-static")},
    {"linear-solver", at<&S::linear_solver>, "", any(), "implicit, bdf2, tr-bdf2, quasi-static: preconditioner of conjugate gradients", kSolver.needing(kNewton, kNewtonWords)},
    {"linear-precision", at<&S::linear_precision>, "", any(), "implicit, bdf2, tr-bdf2, quasi-static, with precision = double: of conjugate gradients; state, forces and energies stay double", kSolver.needing("precision = double and integrator = implicit | bdf2 | tr-bdf2 | quasi-static or precision = double and self-contact", "--precision double and --integrator implicit, bdf2, tr-bdf2 or quasi-static, or --self-contact")},
    {"device", at<&S::device>, "", any(), "where the simulation runs; as a flag also cuda:N, GPU N of several", kMachine},
    {"precision", at<&S::precision>, "", any(), "of the simulation", kSolver},
    {"threads", at<&S::threads>, "", between(0, 1024), "CPU threads; 0: OMP_NUM_THREADS, else all cores", kThreads},
    {"seconds", at<&S::seconds>, "s", at_least(0), "simulated time", kCloth},
    {"cycles", at<&S::cycles>, "", between(1, 1000), "how often the phases with repeat are gone through, one time after the other", kCloth},
    {"gravity", at<&S::gravity>, "m/s^2", between(-1e4, 1e4), "acceleration", kCloth},
    {"air-drag", at<&S::air_drag>, "kg/(m^2 s)", at_least(0), "linear drag per area", kCloth},
    {"self-contact", at<&S::self_contact>, "", any(), "cloth cannot pass through itself", kCloth},
    {"contact-stiffness", at<&S::contact_stiffness>, "N/m^3", at_least(0), "of obstacles, per area, pressed in by a fifth of the thickness; 0: that of layers", kCloth},
    {"seed", at<&S::seed>, "", at_least(0), "of random meshes", kCloth.needing("mesh = random and cloth.shape != file | pattern or cloth.copy-turn > 0 or cloth.copy-scatter > 0", "--mesh random, --cloth.copy-turn or --cloth.copy-scatter")},
};

const KeyRow<Pin> kPinRows[] = {
    {"select", at<&Pin::select>, "", any(), "which vertices of the rest shape are held"},
    {"low", at<&Pin::low>, "m", any(), "corner of the box"},
    {"high", at<&Pin::high>, "m", any(), "opposite corner of the box, >= low"},
    {"point", at<&Pin::point>, "m", any(), "the nearest vertex to this is held (nearest)"},
    {"from", at<&Pin::from>, "s", at_least(0), "held from this time on, at their positions then"},
    {"until", at<&Pin::until>, "s", at_least(0), "released at this time; 1e30: never"},
    {"home", at<&Pin::home>, "s", at_least(0), "time in which they return to where they were at the start; 0: they do not"},
    {"strength", at<&Pin::strength>, "N", at_least(0), "largest force on all that it holds, which then lags behind; 0: none, they go all the way that the cloth leaves free"},
    {"axis", at<&Pin::motion, &Motion::axis>, "", any(), "of the motion's rotation"},
    {"center", at<&Pin::motion, &Motion::center>, "m", any(), "of the motion's rotation"},
};

const KeyRow<Obstacle> kObstacleRows[] = {
    {"kind", at<&Obstacle::kind>, "", any(), "solid; hollow: a sphere with the cloth inside; mesh: a body of triangles, those of a file"},
    {"center", at<&Obstacle::center>, "m", any(), "ground: a point of the plane; mesh: where the origin of its file is; others: the middle"},
    {"axis", at<&Obstacle::axis>, "", any(), "ground: normal; cylinder, capsule, torus: direction; box: that of its edges along z, with which it is turned"},
    {"size", at<&Obstacle::size>, "m", positive(), "of the box: half edges"},
    {"radius", at<&Obstacle::radius>, "m", positive(), "of sphere, hollow, cylinder and capsule; of the torus to the middle of its wire"},
    {"height", at<&Obstacle::height>, "m", positive(), "of cylinder and capsule: length of the axis; of the torus: thickness of its wire"},
    {"rim", at<&Obstacle::rim>, "m", at_least(0), "of cylinder and box: radius of the rounded edges"},
    {"file", at<&Obstacle::file>, "", any(), "mesh: OBJ or PLY of its triangles", {.file = NamesFile::one}},
    {"unit", at<&Obstacle::unit>, "", any(), "mesh: of length in its files"},
    {"sequence", at<&Obstacle::sequence>, "", any(), "mesh: where its vertices are from frame to frame: OBJ or PLY files of the same triangles by a pattern, \"walk/*.obj\", in the order of their names, or a point cache, .pc2 or .mdd; none: it is rigid", {.file = NamesFile::pattern}},
    {"fps", at<&Obstacle::fps>, "1/s", at_least(0), "mesh: frames of the sequence a second, the first one at t = 0; 0: as the times of an .mdd say"},
    {"friction", at<&Obstacle::friction>, "", at_least(-1), "Coulomb coefficient; negative: the fabric's"},
    {"body", at<&Obstacle::body>, "", any(), "name that obstacles share which act as one, their union: a limb of two capsules; none: each by itself"},
    {"visible", at<&Obstacle::visible>, "", any(), "drawn in pictures"},
    {"from", at<&Obstacle::from>, "s", at_least(0), "appears at this time"},
    {"until", at<&Obstacle::until>, "s", at_least(0), "removed at this time; 1e30: never"},
    {"motion-axis", at<&Obstacle::motion, &Motion::axis>, "", any(), "of the motion's rotation"},
    {"motion-center", at<&Obstacle::motion, &Motion::center>, "m", any(), "of the motion's rotation"},
};

const KeyRow<SceneEvent> kCommandRows[] = {
    {"kind", at<&SceneEvent::kind>, "", any(), "iron: removes all bends and permanent set; edit: the present shape becomes the rest shape (law grinspun-edit)"},
    {"time", at<&SceneEvent::time>, "s", at_least(0), "when"},
    {"low", at<&SceneEvent::low>, "m", any(), "corner of the box that contains the elements, on the flat cloth"},
    {"high", at<&SceneEvent::high>, "m", any(), "opposite corner of the box, >= low"},
};

const KeyRow<Phase> kPhaseRows[] = {
    {"name", at<&Phase::name>, "", any(), "for captions, and for times: \"hang\", \"hang + 0.2\""},
    {"seconds", at<&Phase::seconds>, "s", positive(), "how long it lasts"},
    {"repeat", at<&Phase::repeat>, "", any(), "gone through as often as cycles says, with the others that repeat; they follow one another"},
};

const KeyRow<Keyframe> kKeyframeRows[] = {
    {"time", at<&Keyframe::time>, "s", at_least(0), "ascending from one keyframe to the next"},
    {"position", at<&Keyframe::position>, "m", any(), "displacement from the start"},
    {"angle", at<&Keyframe::angle>, "degree", any(), "rotation about the motion's axis and centre"},
    {"scale", at<&Keyframe::scale>, "", positive(), "of an obstacle: size over that at the start, about the motion's centre"},
};
// clang-format on

// Writes an array of tables, with the keyframes of those that move.
template <class Item>
Json tables_json(std::vector<Item> items, Keys (*bind_one)(Item&)) {
  Json tables = Json::array();
  for (Item& item : items) {
    tables.push_back(to_json(bind_one(item)));
    if constexpr (requires { item.motion; })
      tables.back()["keys"] = tables_json(item.motion.keys, bind_keyframe);
  }
  return tables;
}

Json provenance_json(const Fabric& fabric) {
  Json all = Json::object();
  for (const auto& [name, from] : fabric.provenance) {
    all[name] = {{"source", from.source}, {"confidence", from.confidence}};
  }
  return all;
}

Json published_json(const Fabric& fabric) {
  Json all = Json::object();
  for (const auto& [name, number] : fabric.published) {
    all[name] = {{"value", number.value},
                 {"unit", number.unit},
                 {"source", number.provenance.source},
                 {"confidence", number.provenance.confidence}};
    if (number.tester) all[name]["tester"] = enum_name(*number.tester);
  }
  return all;
}

constexpr std::string_view kFabricPrefix = "fabric.";

void note_origin(Scene& scene, const std::string& path, const std::string& origin) {
  scene.origin[path] = origin;
  if (path.starts_with(kFabricPrefix))
    scene.fabric.provenance[path.substr(kFabricPrefix.size())] = {origin, "given"};
}

// Loads the fabric of that name, and the places of its numbers.
void load_fabric(Scene& scene, const std::string& name, const std::string& origin) {
  std::erase_if(scene.origin, [](const auto& entry) { return entry.first.starts_with(kFabricPrefix); });
  FabricFile loaded = read_fabric(name, origin);
  scene.fabric = std::move(loaded.fabric);
  for (const auto& [key, place] : loaded.place) scene.origin["fabric." + key] = place;
  scene.origin["fabric.name"] = origin;
}

// Returns the file, or "--" for the command line, of an origin, without its line.
std::string source_of(const std::string& origin) {
  return origin.starts_with("--") ? "--" : origin.substr(0, origin.rfind(':'));
}

bool stand_together(const Scene& scene, const std::string& key, const std::string& other) {
  const auto a = scene.origin.find("fabric." + key), b = scene.origin.find("fabric." + other);
  return a != scene.origin.end() && b != scene.origin.end() && source_of(a->second) == source_of(b->second);
}

// Keeps one statement of friction where the fabric has no shape of it: b1 or k0 takes the place of stops that
// were set elsewhere, and stops that of b1 and k0.  If one file states both, check_fabric_lists() compares
// them.
void reconcile_stops(const std::string& set, Scene& scene) {
  Fabric& fabric = scene.fabric;
  const bool stops = set == "bending.stops.thresholds" || set == "bending.stops.stiffnesses";
  if (fabric.bending.stops.empty()) return;
  if (set == "b1" || set == "k0") {
    const double given = set == "b1" ? fabric.b1 : fabric.k0;
    Fabric follows = fabric;
    follow_stops(follows);
    if (stand_together(scene, set, "bending.stops.thresholds") ||
        given == (set == "b1" ? follows.b1 : follows.k0))
      return;
    fabric.bending.stops = fabric.bending.weft_stops = {};
  } else if (stops || set == "b2") {
    if (!stand_together(scene, set, "b1") && !stand_together(scene, set, "k0")) follow_stops(fabric);
  }
}

// Are the numbers that were set just those that follow from KES-FB2's pair, as in a scene that was written
// out?
bool follows_from_pair(const Fabric& fabric) {
  Fabric follows = fabric;
  follows.follow_kes();
  return follows.b1 == fabric.b1 && follows.b2 == fabric.b2 && follows.k0 == fabric.k0 &&
         follows.bending.stops.thresholds == fabric.bending.stops.thresholds &&
         follows.bending.stops.stiffnesses == fabric.bending.stops.stiffnesses;
}

// Notes that one source states the pair and other numbers than follow from it: check_scene() refuses it,
// unless a shape, which may be set later, makes these numbers follow.
void note_numbers_beside_pair(Scene& scene) {
  const Fabric& fabric = scene.fabric;
  if (fabric.kes.on()) scene.origin.erase(kSaidTwice);
  if (!fabric.kes.gives_numbers()) return;
  Fabric follows = fabric;
  follows.follow_kes();
  const auto note = [&](const std::string& key) {
    scene.origin[kSaidTwice] =
        "fabric." + key +
        " and fabric.kes-b with fabric.kes-2hb say two frictions: b1 and b2 follow from "
        "the pair and k0 (" +
        key_origin(scene, "fabric." + key) + ")";
  };
  if (!fabric.bending.stops.empty() && stand_together(scene, "bending.stops.thresholds", "kes-b"))
    note("bending.stops.thresholds");
  // In a fabric's file with the pair, b1 and b2 follow from it and have the place of kes-b.
  const auto is_stated = [&](const std::string& key) {
    return key_origin(scene, "fabric." + key) != key_origin(scene, "fabric.kes-b") &&
           stand_together(scene, key, "kes-b");
  };
  if (fabric.b2 != follows.b2 && is_stated("b2")) note("b2");
  if (fabric.b1 != follows.b1 && is_stated("b1")) note("b1");
}

// Keeps the statement of friction that was set last: KES-FB2's pair, with k0 or a shape, or b1 with b2 and
// k0, or stops.  Setting a number that already follows from the present statement changes nothing.
void reconcile_friction(bool was_shaped, const std::string& set, Scene& scene) {
  Fabric& fabric = scene.fabric;
  if (set.starts_with("kes-") || set == "stops-median" || set == "stops-spread") {
    if (was_shaped && !fabric.kes.on()) fabric.bending.stops = {};
    note_numbers_beside_pair(scene);
    return fabric.follow_kes();
  }
  if (set == "k0" && fabric.kes.gives_numbers()) return fabric.follow_kes();
  const bool numbers = set == "b1" || set == "b2" || set == "k0";
  const bool stops = set == "bending.stops.thresholds" || set == "bending.stops.stiffnesses";
  if (!numbers && !stops) return;
  if (!fabric.kes.on() && !fabric.kes.gives_numbers()) return reconcile_stops(set, scene);
  if (follows_from_pair(fabric)) return fabric.follow_kes();
  note_numbers_beside_pair(scene);
  const bool shaped = fabric.kes.on();
  fabric.kes = {};
  if (numbers && shaped) fabric.bending.stops = {};
  if (stops) reconcile_stops(set, scene);
}

// Makes the bias ratio follow weft unless someone has stated it; a fabric's file that only assumes it has
// not.
void keep_bias_between(const std::string& set, Fabric& fabric) {
  if (set != "weft-bending") return;
  const auto bias = fabric.provenance.find("bias-bending");
  if (bias == fabric.provenance.end() || bias->second.confidence == "assumed") follow_weft(fabric);
}

// Adds the names of the laws, which law_catalogue() alone lists.
void name_laws(KeyDescription& key) {
  for (const LawEntry& law : law_catalogue()) key.choices.push_back(law.name);
}

}  // namespace

Keys bind_scene(Scene& scene) {
  Keys keys = bind(kSceneRows, scene);
  for (BoundKey& key : keys) {
    if (key.description.path == "law") name_laws(key.description);
  }
  return keys;
}
std::string key_of_flag(const std::string& flag) {
  for (const KeyRow<Scene>& row : kSceneRows)
    if (flag == row.traits.flag) return row.path;
  return flag;
}

std::string flag_of_key(const std::string& path) {
  for (const KeyRow<Scene>& row : kSceneRows)
    if (*row.traits.flag && path == row.path) return row.traits.flag;
  return path;
}

Keys bind_pin(Pin& pin) { return bind(kPinRows, pin); }
Keys bind_obstacle(Obstacle& obstacle) { return bind(kObstacleRows, obstacle); }
Keys bind_command(SceneEvent& command) { return bind(kCommandRows, command); }
Keys bind_phase(Phase& phase) { return bind(kPhaseRows, phase); }
Keys bind_keyframe(Keyframe& keyframe) { return bind(kKeyframeRows, keyframe); }

std::vector<KeyDescription> scene_keys() {
  Scene scene;
  std::vector<KeyDescription> descriptions;
  for (const BoundKey& key : bind_scene(scene)) descriptions.push_back(key.description);
  return descriptions;
}

void set_key(Scene& scene, const BoundKey& key, const Value& value, const std::string& origin) {
  const std::string& path = key.description.path;
  const bool was_shaped = scene.fabric.kes.on();
  assign(key, value, origin);
  if (path == "fabric.name") return load_fabric(scene, std::string(scene.fabric.name), origin);
  note_origin(scene, path, origin);
  if (path == "cycles" && !scene.phase.empty() && !is_given(scene, "seconds"))
    scene.seconds = phases_end(scene);
  if (!path.starts_with(kFabricPrefix)) return;
  const std::string set = path.substr(kFabricPrefix.size());
  reconcile_friction(was_shaped, set, scene);
  keep_bias_between(set, scene.fabric);
}

void set_key(Scene& scene, const std::string& path, const std::string& text, const std::string& origin) {
  const Keys keys = bind_scene(scene);
  const BoundKey& key = find_key(keys, key_of_flag(path), origin);
  set_key(scene, key, parse_text(key.description, text), origin);
}

Json to_json(const Scene& scene) {
  Scene copy = scene;
  for (const MeshFile& mesh : mesh_files(copy)) *mesh.path = asset_name(*mesh.path);
  Json tree = to_json(bind_scene(copy));
  tree["fabric"]["provenance"] = provenance_json(scene.fabric);
  tree["fabric"]["published"] = published_json(scene.fabric);
  tree["pin"] = tables_json(scene.pin, bind_pin);
  tree["obstacle"] = tables_json(copy.obstacle, bind_obstacle);
  tree["command"] = tables_json(scene.command, bind_command);
  tree["phase"] = tables_json(scene.phase, bind_phase);
  tree["origin"] = scene.origin;
  return tree;
}

}  // namespace hysteron
