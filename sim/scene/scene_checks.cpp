// Checks that concern several keys at once; single values are checked where they are read.
#include <algorithm>
#include <cmath>

#include "sim/base/error.h"
#include "sim/bending/laws/law_parameters.h"
#include "sim/mesh/file_extension.h"
#include "sim/scene/body.h"
#include "sim/scene/cycles.h"
#include "sim/scene/fabric_limits.h"
#include "sim/scene/mesh_files.h"
#include "sim/scene/motion.h"
#include "sim/scene/scene_reader.h"
#include "sim/scene/shown_key.h"
#include "sim/scene/start_shape.h"

namespace hysteron {
namespace {

// Refuses with the place where that key or table was set.
Error key_refusal(const Scene& scene, const std::string& key, const std::string& what) {
  return Error::invalid_input(what).with_origin(key_origin(scene, key));
}

// Names an entry of a list: "pin[0]".
std::string path_in(const std::string& list, std::size_t i) { return list + "[" + std::to_string(i) + "]"; }

template <class Item>
void check_each(const Scene& scene, const std::vector<Item>& items, const std::string& list,
                void (*check)(const Scene&, const Item&, const std::string& path)) {
  for (std::size_t i = 0; i < items.size(); ++i) check(scene, items[i], path_in(list, i));
}

bool is_flag(const std::string& origin) { return origin.starts_with("--"); }

// Refuses a number of KES-FB2's friction that says nothing without another one.
[[noreturn]] void refuse_kes_number(const Scene& scene, const std::string& key, double value,
                                    const std::string& unit, const std::string& what) {
  throw refused_value(scene, key, value, unit, what);
}

// Requires both B and 2HB, or neither, where no shape of friction stands beside them.
void check_kes_pair(const Scene& scene) {
  const KesPair& read = scene.fabric.kes.read;
  const bool has_stops =
      is_flag(key_origin(scene, "fabric.bending.stops.thresholds"));  // set in place of the pair
  const auto check_zero = [&](const std::string& key, double value, double other, const std::string& unit,
                              const std::string& instead) {
    const bool is_meant = other > 0 || (is_flag(key_origin(scene, key)) && !has_stops);
    if (value == 0 && is_given(scene, key) && is_meant)
      refuse_kes_number(scene, key, value, unit, "must be > 0" + instead);
  };
  check_zero("fabric.kes-2hb", read.loop_width, read.rigidity, "N",
             ": for a fabric without friction take law = linear, or fabric.b1 = fabric.b2");
  check_zero("fabric.kes-b", read.rigidity, read.loop_width, "N m", "");
  const std::string both = " beside it: both stand for b1 and b2";
  if (read.rigidity > 0 && read.loop_width == 0)
    refuse_kes_number(scene, "fabric.kes-b", read.rigidity, "N m", "needs fabric.kes-2hb" + both);
  if (read.loop_width > 0 && read.rigidity == 0)
    refuse_kes_number(scene, "fabric.kes-2hb", read.loop_width, "N", "needs fabric.kes-b" + both);
}

// Checks the shape of friction: it has a median and a spread, and the pair says how much friction has that
// shape.
void check_kes_shape(const Scene& scene) {
  const KesFriction& kes = scene.fabric.kes;
  const double median = kes.shape.median, spread = kes.shape.spread;
  if (!kes.on()) {
    if (spread > 0 && !is_given(scene, "fabric.stops-median"))
      refuse_kes_number(scene, "fabric.stops-spread", spread, "",
                        "needs fabric.stops-median beside it, the curvature that it spreads around");
    return;
  }
  const auto need = [&](const std::string& key, double value, const std::string& why) {
    if (value == 0 && !is_given(scene, key))
      refuse_kes_number(scene, "fabric.stops-median", median, "1/m", "needs " + key + " beside it" + why);
  };
  need("fabric.stops-spread", spread, ", the standard deviation of its logarithm");
  need("fabric.kes-b", kes.read.rigidity, " and fabric.kes-2hb, whose friction it shapes");
  need("fabric.kes-2hb", kes.read.loop_width, ", whose friction it shapes");
}

// Checks a fabric whose face and back differ: which elements and laws allow it, and how far from flat it
// changes sides.
void check_faces(const Scene& scene) {
  const Fabric& f = scene.fabric;
  const Faces& faces = f.bending.faces;
  if (!faces.on()) return;
  const bool bends = faces.bending != 1;
  const std::string key = bends ? "fabric.back-bending" : "fabric.back-friction";
  const auto refuse = [&](const std::string& of, double value, const std::string& what) {
    throw refused_value(scene, of, value, "", what);
  };
  const double value = bends ? faces.bending : faces.friction;
  if (f.bending.set.on())
    refuse(key, value, "goes without fabric.bending.set, whose rest curvature has no side");
  if (!f.bending.weft_stops.empty())
    refuse(key, value, "goes with one friction along all directions: without fabric.bending.stops.weft");
  if (!has_faces(scene.law)) return;  // other laws take the mean of both sides
  const VirginCurve curve = f.virgin_curve();
  const double along_weft = f.rubs_otherwise() ? f.weft_friction : std::sqrt(f.weft_bending);
  const double width = curve.face_width() * std::max(1.0, 1 / (curve.parts.faces.weft_elastic * along_weft));
  if (scene.law != "linear" && !(width <= kMostFaceWidth))
    refuse("fabric.back-friction", faces.friction,
           "needs bends of +-" + number_text(width, 3) +
               " 1/m from one side's friction to the other's, so that the moment never falls with curvature, "
               "and "
               "must need at most " +
               number_text(kMostFaceWidth) + " 1/m, from where KES-FB2 reads B");
}

void check_fabric(const Scene& scene) {
  const Fabric& f = scene.fabric;
  const auto refuse = [&](const std::string& key, double value, const std::string& unit,
                          const std::string& what) { throw refused_value(scene, key, value, unit, what); };
  check_kes_shape(scene);
  if (f.kes.on() && !(f.b2 > 0))
    refuse("fabric.stops-median", f.kes.shape.median, "1/m",
           "and " + shown(scene, "fabric.stops-spread", f.kes.shape.spread, "") + " make friction of " +
               shown(scene, "fabric.kes-2hb", f.kes.read.loop_width, "N") + " steeper than " +
               shown(scene, "fabric.kes-b", f.kes.read.rigidity, "N m") +
               " where the tester reads: no elasticity is left beside it");
  check_fabric_numbers(scene);
  if (const auto twice = scene.origin.find(kSaidTwice); twice != scene.origin.end())
    throw Error::invalid_input(twice->second).with_key("fabric.kes-b", "");
  if (!f.kes.on()) check_kes_pair(scene);
  if (f.b1 < f.b2) refuse("fabric.b1", f.b1, "N m", "must be >= " + shown(scene, "fabric.b2", f.b2, "N m"));
  if (f.k0 == 0 && f.b1 > f.b2) refuse("fabric.k0", f.k0, "1/m", "must be > 0 while fabric.b1 > fabric.b2");
  if (4 * f.bias_bending < 1 + f.weft_bending)
    refuse("fabric.bias-bending", f.bias_bending, "",
           "must be >= " + number_text((1 + f.weft_bending) / 4) + ", (1 + fabric.weft-bending)/4");
  if (f.rubs_otherwise() && !f.bending.weft_stops.empty())
    refuse("fabric.weft-friction", f.weft_friction, "",
           "goes with b1, b2 and k0: fabric.bending.stops.weft say the friction along weft themselves");
  if (f.rubs_otherwise() && f.bending.set.on())
    refuse("fabric.weft-friction", f.weft_friction, "",
           "goes without fabric.bending.set, whose rest curvature has one direction with the friction");
  check_faces(scene);
  if (f.coupling * f.coupling >= f.warp * f.weft)
    refuse("fabric.coupling", f.coupling, "N/m",
           "must be within +-" + number_text(std::sqrt(f.warp * f.weft)) +
               " N/m, sqrt(fabric.warp * fabric.weft)");
  check_fabric_lists(scene);
}

void check_mesh(const Scene& scene) {
  const ClothShape& cloth = scene.cloth;
  const bool given = cloth.shape == ClothOutline::file && names_an_obj(scene.mesh);
  if (cloth.is_of_file() && cloth.file.empty() && !given) {
    throw Error::invalid_input(shown(scene, "cloth.shape", enum_name(cloth.shape), "") +
                               " needs cloth.file, an OBJ");
  }
  const std::vector<std::string> families = every_name<MeshFamily>();
  if (names_an_obj(scene.mesh) || std::count(families.begin(), families.end(), scene.mesh)) return;
  throw Error::invalid_input(shown(scene, "mesh", scene.mesh, "") + " must be " + join(families, " | ") +
                             " | FILE.obj" + suggestion(scene.mesh, families));
}

// Refuses a mesh beside a file with its own triangles, and a file that no shape asks for, which would
// silently be left unread.
void check_one_mesh(const Scene& scene) {
  const ClothShape& cloth = scene.cloth;
  const bool of_file = cloth.is_of_file();
  if (!of_file && !cloth.file.empty() && !is_given(scene, "cloth.shape"))
    throw Error::invalid_input(shown(scene, "cloth.file", cloth.file, "") +
                               " is not read by a cloth of shape " + enum_name(cloth.shape) +
                               ": give cloth.shape = file, or pattern")
        .with_key("cloth.file", cloth.file);
  if (!of_file || cloth.file.empty() || !is_given(scene, "mesh")) return;
  throw Error::invalid_input(shown(scene, "mesh", scene.mesh, "") + " and " +
                             shown(scene, "cloth.file", cloth.file, "") +
                             " both define the triangles: leave one out");
}

// Refuses a unit of length without a file: keys are in metres.
void check_unit(const Scene& scene) {
  const ClothShape& cloth = scene.cloth;
  if (cloth.unit == LengthUnit::metre || !rest_file(scene).empty() || names_an_obj(cloth.start)) return;
  throw Error::invalid_input(shown(scene, "cloth.unit", enum_name(cloth.unit), "") +
                             " is that of an OBJ, and this cloth is built: lengths of keys are metres")
      .with_key("cloth.unit", enum_name(cloth.unit));
}

void check_method(const Scene& scene) {
  if (scene.force == ForceConvention::chapter && scene.element != BendingElement::hinge)
    throw key_refusal(
        scene, "element",
        shown(scene, "force", "chapter", "") + " needs element = hinge, not " + enum_name(scene.element));
}

void check_motion(const Scene& scene, const std::string& path, const Motion& motion) {
  for (std::size_t i = 0; i < motion.keys.size(); ++i) {
    const std::string key = path_in(path + ".keys", i);
    if (i > 0 && motion.keys[i].time <= motion.keys[i - 1].time)
      throw key_refusal(scene, key,
                        key + ".time = " + number_text(motion.keys[i].time) + " s must be > " +
                            number_text(motion.keys[i - 1].time) + " s, the key before");
    if (motion.keys[i].angle != 0 && motion.axis.isZero(0))
      throw key_refusal(
          scene, key,
          key + ".angle = " + number_text(motion.keys[i].angle) + " degree needs an axis that is not zero");
  }
}

void check_times(const Scene& scene, double from, double until, const std::string& path) {
  if (from >= until)
    throw key_refusal(scene, path,
                      path + ".from = " + number_text(from) + " s must be < " + path +
                          ".until = " + number_text(until) + " s");
}

void check_pin(const Scene& scene, const Pin& pin, const std::string& path) {
  check_times(scene, pin.from, pin.until, path);
  if (pin.select == PinSelection::box && (pin.low.array() > pin.high.array()).any())
    throw key_refusal(scene, path, path + ".low must be <= " + path + ".high in x, y and z [m]");
  if (pin.strength > 0 && !scene.is_implicit())
    throw Error::invalid_input(
        path + ".strength = " + number_text(pin.strength) + " N (" + key_origin(scene, path) +
        ") needs integrator = implicit, bdf2, tr-bdf2 or quasi-static, not " + enum_name(scene.integrator));
  check_motion(scene, path, pin.motion);
  for (std::size_t i = 0; i < pin.motion.keys.size(); ++i)
    if (pin.motion.keys[i].scale != 1)
      throw key_refusal(scene, path, path_in(path + ".keys", i) + ".scale is for obstacles");
}

// Returns how far the obstacle's middle moves in any one step [m].
double longest_stride(const Scene& scene, const Obstacle& solid) {
  constexpr int kParts = 64;  // parts of the time between two keys, whose motion is a cubic in time
  double longest = 0;
  const auto& keys = solid.motion.keys;
  for (std::size_t i = 0; i + 1 < keys.size(); ++i) {
    for (int part = 0; part < kParts; ++part) {
      const double time = keys[i].time + (keys[i + 1].time - keys[i].time) * part / kParts;
      const auto middle = [&](double t) { return placement(solid.motion, t)(solid.center); };
      longest = std::max(longest, (middle(time + scene.step) - middle(time)).norm());
    }
  }
  return longest;
}

// Refuses an obstacle that moves farther in one step than its half thickness: it would push the cloth out on
// the wrong side, or miss it.
void check_stride(const Scene& scene, const Obstacle& solid, const std::string& path) {
  const double stride = longest_stride(scene, solid), most = obstacle_form(solid).half_thickness;
  if (stride <= most) return;
  throw Error::invalid_input(path + " moves " + number_text(stride) + " m in a step of " +
                             number_text(scene.step) + " s (" + key_origin(scene, path) +
                             "), further than half its thickness, " + number_text(most) +
                             " m: it may pass through the cloth; take a step below " +
                             number_text(scene.step * most / stride) + " s");
}

// Refuses a body of triangles that appears late: it keeps the cloth on the side where it is, so it has to be
// there from the start.
void check_body(const Scene& scene, const Obstacle& body, const std::string& path) {
  if (!is_body(body)) return;
  const auto refuse = [&](const std::string& key, const std::string& value, const std::string& what) {
    throw Error::invalid_input(shown(scene, path + "." + key, value, "") + " " + what)
        .with_key(path + "." + key, value);
  };
  if (body.file.empty())
    throw key_refusal(scene, path, path + ".kind = mesh needs " + path + ".file, an OBJ or PLY");
  if (body.from > 0)
    refuse("from", number_text(body.from) + " s",
           "goes without kind = mesh: cloth that would be inside has no way out; bring it by keyframes");
  if (body.until < 1e30)
    refuse("until", number_text(body.until) + " s", "goes without kind = mesh: take it away by keyframes");
  if (body.fps > 0 && body.sequence.empty())
    refuse("fps", number_text(body.fps) + " 1/s", "needs " + path + ".sequence");
}

void check_obstacle(const Scene& scene, const Obstacle& solid, const std::string& path) {
  check_body(scene, solid, path);
  check_times(scene, solid.from, solid.until, path);
  const ObstacleForm form = obstacle_form(solid);
  if (form.has_axis && solid.axis.isZero(0))
    throw key_refusal(scene, path, path + ".axis = [0, 0, 0] must not be zero");
  if (solid.kind == ObstacleKind::torus && solid.radius <= solid.height / 2)
    throw key_refusal(scene, path,
                      path + ".radius = " + number_text(solid.radius) + " m must be > " +
                          number_text(solid.height / 2) + " m, half of " + path +
                          ".height: a torus needs a hole");
  const double room = form.has_rim ? form.half_thickness : kInfinity;
  if (solid.rim > room)
    throw key_refusal(scene, path,
                      path + ".rim = " + number_text(solid.rim) + " m must be in [0, " + number_text(room) +
                          "], half of the thinnest part");
  check_motion(scene, path, solid.motion);
  check_stride(scene, solid, path);
}

// Checks the law's parameters one at a time, so that the message can say where each stands, and then
// together.
void check_parameters(const Scene& scene) {
  const VirginCurve curve = scene.fabric.virgin_curve();
  for (const auto& [name, text] : scene.param) {
    try {
      choose_law(scene.law, curve, {{name, text}});
    } catch (const Error& error) {
      throw error.with_origin(key_origin(scene, "param." + name));
    }
  }
  try {
    choose_law(scene.law, curve, scene.param);
  } catch (const Error& error) {
    throw error.with_origin(
        key_origin(scene, scene.param.contains(error.key()) ? "param." + error.key() : "law"));
  }
}

// Refuses phases of the same name, which a time could not tell apart.
void check_phases(const Scene& scene) {
  const auto table = [&](std::size_t i) {
    const std::string path = path_in("phase", i);
    return path + " (" + key_origin(scene, path) + ")";
  };
  for (std::size_t i = 0; i < scene.phase.size(); ++i) {
    const std::string& name = scene.phase[i].name;
    for (std::size_t j = 0; j < i && !name.empty(); ++j)
      if (scene.phase[j].name == name)
        throw Error::invalid_input(table(i) + " is called \"" + name + "\" like " + table(j) +
                                   ": phases need names of their own");
  }
}

// Returns where a key of a table stands, or the table if the key was left out.
std::string origin_in(const Scene& scene, const std::string& path, const std::string& key) {
  return key_origin(scene, path + "." + key, key_origin(scene, path));
}

// Refuses a command that is due when the scene is over, and would never be carried out.
void check_due(const Scene& scene, const SceneEvent& command, const std::string& path) {
  if (command.time < scene.seconds) return;
  throw Error::invalid_input(path + ".time = " + number_text(command.time) + " s (" +
                             origin_in(scene, path, "time") + ") must be < " +
                             shown(scene, "seconds", scene.seconds, "s") + ", the end of the scene");
}

void check_command(const Scene& scene, const SceneEvent& command, const std::string& path) {
  if ((command.low.array() > command.high.array()).any())
    throw Error::invalid_input(path + ".low must be <= " + path + ".high in x, y and z [m]")
        .with_origin(origin_in(scene, path, "low"));
  if (command.kind == CommandKind::edit && scene.law != "grinspun-edit")
    throw Error::invalid_input(path + ".kind = edit needs law = grinspun-edit, not " + scene.law)
        .with_origin(origin_in(scene, path, "kind"));
}

// Refuses bodies of triangles without implicit steps: their contact is a barrier, a term of the potential
// that such steps minimise.
void check_body_steps(const Scene& scene) {
  if (scene.finds_equilibrium()) return;
  for (std::size_t i = 0; i < scene.obstacle.size(); ++i)
    if (is_body(scene.obstacle[i]))
      throw key_refusal(
          scene, "integrator",
          path_in("obstacle", i) + ".kind = mesh (" +
              key_origin(scene, path_in("obstacle", i) + ".kind", key_origin(scene, path_in("obstacle", i))) +
              ") needs integrator = implicit | bdf2 | tr-bdf2 | quasi-static, or semi-implicit "
              "with self-contact, not " +
              enum_name(scene.integrator) +
              ": a barrier keeps cloth from its triangles, and steps that move the cloth as a "
              "whole to where forces balance are the ones that see it");
}

}  // namespace

void check_steps(const Scene& scene) {
  check_body_steps(scene);
  if (scene.self_contact && scene.integrator == Integrator::explicit_euler)
    throw key_refusal(
        scene, "integrator",
        "self-contact (" + key_origin(scene, "self-contact") +
            ") needs integrator = implicit | bdf2 | tr-bdf2 | quasi-static | semi-implicit, not explicit");
  if (scene.self_contact && scene.integrator == Integrator::semi_implicit &&
      scene.implicit_every == ImplicitEvery::step)
    throw key_refusal(
        scene, "implicit-every",
        "self-contact (" + key_origin(scene, "self-contact") + ") needs implicit-every = substep, not step");
  if (!(scene.tolerance > 0)) return;
  const std::string tolerance = shown(scene, "tolerance", scene.tolerance, "m");
  if (scene.integrator == Integrator::explicit_euler || scene.integrator == Integrator::quasi_static)
    throw key_refusal(scene, "integrator",
                      tolerance + " needs integrator = bdf2 | tr-bdf2 | implicit | semi-implicit, not " +
                          enum_name(scene.integrator));
  if (scene.integrator == Integrator::semi_implicit && scene.self_contact)
    throw key_refusal(
        scene, "integrator",
        tolerance + " with self-contact needs integrator = bdf2 | tr-bdf2 | implicit, not semi-implicit");
  if (scene.integrator == Integrator::semi_implicit && scene.implicit_every == ImplicitEvery::step)
    throw key_refusal(scene, "implicit-every", tolerance + " needs implicit-every = substep");
}

void check_duration(const Scene& scene) {
  if (scene.seconds > 0 && scene.step > scene.seconds)
    throw Error::invalid_input(shown(scene, "step", scene.step, "s") +
                               " must be <= " + shown(scene, "seconds", scene.seconds, "s"));
  check_each(scene, scene.command, "command", check_due);
}

void check_scene(const Scene& scene) {
  check_fabric(scene);
  check_mesh(scene);
  check_one_mesh(scene);
  check_unit(scene);
  check_start_shape(scene);
  check_phases(scene);
  check_cycles(scene);
  check_method(scene);
  check_steps(scene);
  check_parameters(scene);
  check_each(scene, scene.pin, "pin", check_pin);
  check_each(scene, scene.command, "command", check_command);
  check_each(scene, scene.obstacle, "obstacle", check_obstacle);
}

}  // namespace hysteron
