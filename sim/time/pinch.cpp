#include "sim/time/pinch.h"

#include <algorithm>

#include "sim/contact/obstacle_set.h"

namespace hysteron {

namespace {

// Marks free vertices in a solid that layers or other solids press from the other side, and held vertices
// that a solid has come over.
template <class Real, class Device>
std::vector<char> pinched_vertices(Body<Real, Device>& body, const ObstacleSet<double>& set,
                                   const std::vector<Eigen::Vector3d>& x, const std::vector<char>& held) {
  const std::vector<char> exempted = body.contact->exempted();
  const std::vector<Vec3<Real>> layers = body.self_contact
                                             ? body.self_contact->forces()
                                             : std::vector<Vec3<Real>>(body.vertices, Vec3<Real>::Zero());
  const ObstacleResponse<double> response = obstacle_response(body.scene);
  std::vector<char> pinched(body.vertices);
  for (int i = 0; i < body.vertices; ++i) {
    const Eigen::Vector3d pressure = layers[i].template cast<double>() / body.cloth.mesh.vertex_area[i];
    pinched[i] = held[i] ? !exempted[i] : is_squeezed(set, response, x[i], pressure);
  }
  return pinched;
}

// Counts the present part of a step if something was `seen` in it for the first time; `last` is the part
// counted last, as the number of steps and parts before it.
void count_part(const Diagnostics& counts, bool seen, long& last, long& parts) {
  const long present = counts.steps + counts.parts;
  if (!seen || last == present) return;
  last = present;
  ++parts;
}

}  // namespace

template <class Real, class Device>
void count_overlap(Body<Real, Device>& body, double time) {
  const Scene& scene = body.scene;
  const std::vector<Eigen::Vector3d> x = cast_to<double>(body.x.download());
  const std::vector<char> held = body.cloth.held(scene, time);
  const auto set = obstacles_during<double>(scene.obstacle, scene.fabric.friction, time, time);
  const std::vector<char> pinched = pinched_vertices(body, set, x, held);
  std::vector<char> spared(body.vertices), others(body.vertices);
  for (int i = 0; i < body.vertices; ++i) {
    spared[i] = !pinched[i];
    others[i] = pinched[i] || held[i];
  }
  const Immersion deepest_pinched = deepest(set, x, spared);
  count_part(body.counts, deepest_pinched.count > 0, body.last_pinched, body.counts.pinched);
  body.counts.pinch_depth = std::max(body.counts.pinch_depth, deepest_pinched.depth);
  count_part(body.counts, deepest(set, x, others).count > 0, body.last_deep, body.counts.deep);
}

template <class Real, class Device>
void count_dents(Body<Real, Device>& body) {
  const double deepest = body.self_contact->deepest_dent();
  count_part(body.counts, deepest > 0, body.last_pinched, body.counts.pinched);
  body.counts.pinch_depth = std::max(body.counts.pinch_depth, deepest);
}

template void count_overlap(Body<double, ThisDevice>&, double);
template void count_overlap(Body<float, ThisDevice>&, double);
template void count_dents(Body<double, ThisDevice>&);
template void count_dents(Body<float, ThisDevice>&);

}  // namespace hysteron
