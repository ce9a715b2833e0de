#include "sim/contact/body_vertices.h"

#include "sim/device/archive_buffer.h"
#include "sim/scene/body.h"

namespace hysteron {

namespace {

std::vector<Obstacle> mesh_bodies(const Scene& scene) {
  std::vector<Obstacle> bodies;
  for (const Obstacle& o : scene.obstacle)
    if (is_body(o)) bodies.push_back(o);
  return bodies;
}

int vertices_of(const std::vector<Obstacle>& bodies) {
  int count = 0;
  for (const Obstacle& o : bodies) count += o.mesh->vertices();
  return count;
}

template <class Real>
std::vector<Vec3<Real>> positions_at(const std::vector<Obstacle>& bodies, double time) {
  std::vector<Vec3<Real>> all;
  for (const Obstacle& o : bodies)
    for (const Eigen::Vector3d& x : body_positions(o, time)) all.push_back(x.cast<Real>());
  return all;
}

}  // namespace

template <class Real, class Device>
BodyVertices<Real, Device>::BodyVertices(Device& device, const Scene& scene, int cloth)
    : device_(device),
      body_(mesh_bodies(scene)),
      cloth_(cloth),
      count_(vertices_of(body_)),
      start_(device, count_),
      way_(device, count_),
      friction_(device, count_),
      position_(device, any() ? all() : 0),
      before_(device, any() ? all() : 0),
      direction_(device, any() ? all() : 0),
      held_(device, any() ? all() : 0) {
  if (!any()) return;
  std::vector<Real> friction;
  for (const Obstacle& o : body_) {
    const double mu = o.friction < 0 ? scene.fabric.friction : o.friction;
    friction.insert(friction.end(), o.mesh->vertices(), static_cast<Real>(mu));
    rubs_ |= mu > 0;
  }
  friction_.upload(friction);
  move(0, 0);
  try_step(1);
  accept();
}

template <class Real, class Device>
void BodyVertices<Real, Device>::move(double start, double end) {
  moved_from_ = start;
  moved_to_ = end;
  if (!any()) return;
  const std::vector<Vec3<Real>> from = positions_at<Real>(body_, start);
  std::vector<Vec3<Real>> way = positions_at<Real>(body_, end);
  for (std::size_t i = 0; i < way.size(); ++i) way[i] -= from[i];
  start_.upload(from);
  way_.upload(way);
  begin_guess();
  aim(1);
}

template <class Real, class Device>
const Vec3<Real>* BodyVertices<Real, Device>::joined(const Vec3<Real>* cloth,
                                                     Buffer<Vec3<Real>, Device>& into, double of_start,
                                                     double of_way) {
  if (!any()) return cloth;
  const Real start_share = static_cast<Real>(of_start), way_share = static_cast<Real>(of_way);
  const int first = cloth_;
  const Vec3<Real>*start = start_.data(), *way = way_.data();
  Vec3<Real>* to = into.data();
  for_each(
      device_, "self-contact: bodies", all(), HYST_KERNEL(int i) {
        to[i] =
            i < first ? cloth[i] : Vec3<Real>(start_share * start[i - first] + way_share * way[i - first]);
      });
  return to;
}

template <class Real, class Device>
const char* BodyVertices<Real, Device>::held(const char* cloth) {
  if (!any()) return cloth;
  const int first = cloth_;
  char* to = held_.data();
  for_each(
      device_, "self-contact: held", all(), HYST_KERNEL(int i) { to[i] = i < first ? cloth[i] : char(1); });
  return to;
}

template <class Real, class Device>
void BodyVertices<Real, Device>::serialise(Archive& archive) {
  archive(moved_from_);
  archive(moved_to_);
  if (!archive.loads()) return;
  move(moved_from_, moved_to_);
  try_step(1);  // between steps they have arrived
  accept();
}

template class BodyVertices<double, ThisDevice>;
template class BodyVertices<float, ThisDevice>;

}  // namespace hysteron
