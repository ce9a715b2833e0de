// When a run cannot go on: where, when, and what presses there.
#include <algorithm>
#include <cstdio>

#include "sim/base/enum_names.h"
#include "sim/base/error.h"
#include "sim/time/stepper.h"

namespace hysteron {

namespace {

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

std::string at_time(double time) { return "at t = " + number(time) + " s "; }

// "obstacle[1] (box) and the cloth itself"
std::string together(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " and ") + word;
  return text;
}

// "edge 3-4 and edge 8-9", "vertex 12 and triangle 3-4-5"
template <class Real>
std::string names(const SelfPair<Real>& pair) {
  const auto dash = [](int a, int b) { return std::to_string(a) + "-" + std::to_string(b); };
  if (pair.is_edges())
    return "edge " + dash(pair.v[0], pair.v[1]) + " and edge " + dash(pair.v[2], pair.v[3]);
  return "vertex " + std::to_string(pair.v[0]) + " and triangle " + dash(pair.v[1], pair.v[2]) + "-" +
         std::to_string(pair.v[3]);
}

}  // namespace

// Obstacles that have come since the last time.  What hands hold may be inside them; nothing else.
template <class Real, class Device>
void Stepper<Real, Device>::meet_obstacles(double time) {
  std::vector<Obstacle> fresh = scene_.obstacle;
  next_obstacle_ = 1e30;
  for (Obstacle& o : fresh) {
    if (o.from > time) next_obstacle_ = std::min(next_obstacle_, o.from);
    if (o.from <= met_) o.until = o.from;  // never there
  }
  met_ = time;
  const std::vector<Eigen::Vector3d> x = positions();
  const std::vector<char> held = cloth_.held(scene_, time);
  const auto set = obstacles_during<double>(fresh, scene_.fabric.friction, time, time);
  const Immersion found = deepest(set, x, held, scene_.fabric.thickness);
  if (found.count > 0)
    throw Error::run(at_time(time) +
                     "an obstacle appears where the cloth is: " + immersion_text(found, scene_.obstacle, x) +
                     ", of " + std::to_string(found.count) + " such vertices the deepest");
  std::vector<char> spared = contact_->spared(), deep = immersed(set, x, scene_.fabric.thickness);
  for (int i = 0; i < vertices_; ++i) spared[i] = spared[i] || (deep[i] && held[i]);
  contact_->spare(spared);
}

// What hands let go must not be inside an obstacle.
template <class Real, class Device>
void Stepper<Real, Device>::refuse_release(const std::vector<char>& before, const std::vector<char>& held,
                                           double time) {
  std::vector<char> others(vertices_);
  for (int i = 0; i < vertices_; ++i) others[i] = held[i] || !before[i];
  const std::vector<Eigen::Vector3d> x = positions();
  const auto set = obstacles_during<double>(scene_.obstacle, scene_.fabric.friction, time, time);
  const Immersion found = deepest(set, x, others, scene_.fabric.thickness);
  if (found.count == 0) return;
  throw Error::run(at_time(time) + "a pin lets go of the cloth inside an obstacle: " +
                   immersion_text(found, scene_.obstacle, x) + ", of " + std::to_string(found.count) +
                   " such vertices the deepest");
}

template <class Real, class Device>
void Stepper<Real, Device>::commit_contact(double time) {
  clock_.begin(Stage::contact);
  const int deep = contact_->commit(x_.data(), before_.data(), held_.data());
  clock_.end(Stage::contact);
  if (deep == 0) return;
  ++deep_steps_;
  if (scene_.newton_iterations == 0) refuse_crushed(time);  // else forces need not have come to balance
}

// A blow may drive the cloth deep into an obstacle for a moment.  It is crushed where that lasts because
// something presses from the other side: a pin, an obstacle, or other layers.
template <class Real, class Device>
void Stepper<Real, Device>::refuse_crushed(double time) {
  const std::vector<Eigen::Vector3d> x = positions();
  const std::vector<char> held = cloth_.held(scene_, time), spared = contact_->spared();
  const auto set = obstacles_during<double>(scene_.obstacle, scene_.fabric.friction, time, time);
  const std::vector<Vec3<Real>> layers =
      self_contact_ ? self_contact_->forces() : std::vector<Vec3<Real>>(vertices_, Vec3<Real>::Zero());
  std::vector<char> well(vertices_);
  for (int i = 0; i < vertices_; ++i) {
    const double stiffness = contact_->stiffness() * cloth_.mesh.vertex_area[i];
    const Eigen::Vector3d force = layers[i].template cast<double>() / stiffness;
    well[i] = held[i] ? spared[i] : !is_squeezed(set, scene_.fabric.thickness, x[i], force);
  }
  const Immersion found = deepest(set, x, well, scene_.fabric.thickness);
  if (found.count == 0) return;
  const std::vector<std::string> by = pressing(found.vertex, x[found.vertex], time);
  throw Error::run(at_time(time) + "the cloth is crushed: " + immersion_text(found, scene_.obstacle, x) +
                   ", more than fabric.thickness = " + number(1e3 * scene_.fabric.thickness) + " mm" +
                   (held[found.vertex] ? ", held by a pin" : ", pressed by " + together(by)) +
                   ": leave it more room, or raise contact-stiffness = " + number(contact_->stiffness()) +
                   " N/m^3");
}

// What a vertex at x touches.
template <class Real, class Device>
std::vector<std::string> Stepper<Real, Device>::pressing(int vertex, const Eigen::Vector3d& x, double time) {
  std::vector<std::string> by;
  const auto set = obstacles_during<double>(scene_.obstacle, scene_.fabric.friction, time, time);
  for (int o = 0; o < set.count; ++o)
    if (distance_to<double>(set.item[o], x).value < scene_.fabric.thickness)
      by.push_back("obstacle[" + std::to_string(set.item[o].index) + "] (" +
                   name_of(scene_.obstacle[set.item[o].index].kind) + ")");
  if (self_contact_ && self_contact_->pairs() > 0 && self_contact_->forces()[vertex].norm() > 0)
    by.push_back("the cloth itself");
  return by;
}

template <class Real, class Device>
void Stepper<Real, Device>::refuse_unbalanced(double start, double h, const NewtonOutcome& outcome) {
  std::string message =
      "no equilibrium of the step " + at_time(start) + "was found, even in parts of " + number(h) + " s: ";
  if (outcome.blocked) {
    message += "pins move the cloth through itself";
    if (self_contact_->pairs() > 0) message += ", " + names(self_contact_->blocking_pair());
    throw Error::run(message);
  }
  if (!(outcome.load > 0))
    throw Error::run(message + "the forces are not finite, or nothing holds the cloth back");
  message += "an unbalanced force of " + number(outcome.residual) +
             " N remains (weight, handles and inertia: " + number(outcome.load) + " N)";
  const Unbalanced worst = implicit_->most_unbalanced(held_.data());
  if (worst.vertex < 0) throw Error::run(message);
  const std::vector<std::string> by = pressing(worst.vertex, worst.position, start + h);
  throw Error::run(message + ", most of it, " + number(worst.force) + " N, at " +
                   vertex_text(worst.vertex, worst.position) +
                   (by.empty() ? "" : ", pressed by " + together(by)));
}

template class Stepper<double, ThisDevice>;
template class Stepper<float, ThisDevice>;

}  // namespace hysteron
