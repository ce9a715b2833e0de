#include "sim/time/step_errors.h"

#include "sim/base/enum_names.h"
#include "sim/base/error.h"
#include "sim/base/number_in.h"
#include "sim/contact/obstacle_set.h"
#include "sim/contact/start_checks.h"

namespace hysteron {

namespace {

std::string at_time(double time) { return "at t = " + number_text(time, 6) + " s "; }

// Joins names: "obstacle[1] (box) and the cloth itself".
std::string together(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " and ") + word;
  return text;
}

// Names a pair: "edge 3-4 and edge 8-9", "vertex 12 and triangle 3-4-5".
template <class Real>
std::string pair_text(const SelfPair<Real>& pair) {
  const auto dash = [](int a, int b) { return std::to_string(a) + "-" + std::to_string(b); };
  if (pair.is_edges())
    return "edge " + dash(pair.v[0], pair.v[1]) + " and edge " + dash(pair.v[2], pair.v[3]);
  return "vertex " + std::to_string(pair.v[0]) + " and triangle " + dash(pair.v[1], pair.v[2]) + "-" +
         std::to_string(pair.v[3]);
}

// Names the objects that touch a vertex at x.
template <class Real, class Device>
std::vector<std::string> touching(Body<Real, Device>& body, int vertex, const Eigen::Vector3d& x,
                                  double time) {
  const Scene& scene = body.scene;
  std::vector<std::string> by;
  const auto set = obstacles_during<double>(scene.obstacle, scene.fabric.friction, time, time);
  for (int o = 0; o < set.count; ++o)
    if (distance_to<double>(set.item[o], x).value < scene.fabric.thickness)
      by.push_back("obstacle[" + std::to_string(set.item[o].index) + "] (" +
                   enum_name(scene.obstacle[set.item[o].index].kind) + ")");
  if (body.self_contact && body.self_contact->pairs() > 0 && body.self_contact->forces()[vertex].norm() > 0)
    by.emplace_back("the cloth itself");
  return by;
}

std::string others(const Immersion& found) {
  return ", of " + std::to_string(found.count) + " such vertices the deepest";
}

}  // namespace

template <class Real, class Device>
void throw_if_arrival(Body<Real, Device>& body, double met, double time) {
  const Scene& scene = body.scene;
  std::vector<Obstacle> fresh = scene.obstacle;
  for (Obstacle& o : fresh)
    if (o.from <= met) o.until = o.from;  // it was never there
  const std::vector<Eigen::Vector3d> x = cast_to<double>(body.x.download());
  const std::vector<char> held = body.cloth.held(scene, time);
  const auto set = obstacles_during<double>(fresh, scene.fabric.friction, time, time);
  const Immersion found = deepest(set, x, held);
  if (found.count > 0)
    throw Error::simulation(at_time(time) + "an obstacle appears where the cloth is: " +
                            immersion_text(found, scene.obstacle, x[found.vertex] + body.origin) +
                            others(found));
  std::vector<char> exempted = body.contact->exempted(), deep = immersed(set, x);
  for (int i = 0; i < body.vertices; ++i) exempted[i] = exempted[i] || (deep[i] && held[i]);
  body.contact->exempt(exempted);
}

template <class Real, class Device>
void throw_if_release(Body<Real, Device>& body, const std::vector<char>& held, double time) {
  const Scene& scene = body.scene;
  const std::vector<char> before = body.held.download();
  std::vector<char> unconcerned(body.vertices);
  for (int i = 0; i < body.vertices; ++i) unconcerned[i] = held[i] || !before[i];
  const std::vector<Eigen::Vector3d> x = cast_to<double>(body.x.download());
  const auto set = obstacles_during<double>(scene.obstacle, scene.fabric.friction, time, time);
  const Immersion found = deepest(set, x, unconcerned);
  if (found.count == 0) return;
  throw Error::simulation(at_time(time) + "a pin releases the cloth inside an obstacle: " +
                          immersion_text(found, scene.obstacle, x[found.vertex] + body.origin) +
                          others(found));
}

template <class Real, class Device>
void throw_no_equilibrium(Body<Real, Device>& body, ImplicitStep<Real, Device>& step, double start, double h,
                          const NewtonOutcome& outcome) {
  std::string message = "no equilibrium of the step " + at_time(start) + "was found, even in parts of " +
                        number_text(h, 6) + " s: ";
  if (outcome.end == NewtonEnd::blocked) {
    message += "every motion leads the cloth through itself";
    if (body.self_contact->pairs() > 0) message += ", " + pair_text(body.self_contact->blocking_pair());
    throw Error::simulation(message);
  }
  if (!(outcome.load > 0)) {
    const std::string part = step.not_finite();
    throw Error::simulation(message + (part.empty()
                                           ? "nothing holds the cloth back, or an obstacle bars its way"
                                           : part + " is not finite"));
  }
  message += "an unbalanced force of " + number_text(outcome.residual, 6) +
             " N remains (weight, pins and inertia: " + number_text(outcome.load, 6) + " N)";
  const Unbalanced worst = step.most_unbalanced();
  if (worst.vertex < 0) throw Error::simulation(message);
  const std::vector<std::string> by = touching(body, worst.vertex, worst.position, start + h);
  throw Error::simulation(message + ", most of it, " + number_text(worst.force, 6) + " N, at " +
                          vertex_text(worst.vertex, worst.position + body.origin) +
                          (by.empty() ? "" : ", pressed by " + together(by)));
}

template void throw_if_arrival(Body<double, ThisDevice>&, double, double);
template void throw_if_arrival(Body<float, ThisDevice>&, double, double);
template void throw_if_release(Body<double, ThisDevice>&, const std::vector<char>&, double);
template void throw_if_release(Body<float, ThisDevice>&, const std::vector<char>&, double);
template void throw_no_equilibrium(Body<double, ThisDevice>&, ImplicitStep<double, ThisDevice>&, double,
                                   double, const NewtonOutcome&);
template void throw_no_equilibrium(Body<float, ThisDevice>&, ImplicitStep<float, ThisDevice>&, double, double,
                                   const NewtonOutcome&);

}  // namespace hysteron
