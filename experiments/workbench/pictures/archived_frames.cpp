#include "experiments/workbench/pictures/archived_frames.h"

#include <fstream>
#include <set>

#include "experiments/workbench/pictures/drawing.h"
#include "experiments/workbench/pictures/drawn_body.h"
#include "experiments/workbench/pictures/scene_renderer.h"
#include "sim/base/atomic_file.h"
#include "sim/base/error.h"
#include "sim/scene/keys.h"
#include "sim/scene/scene_reader.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;

constexpr double kStepsAcross = 1024;  // quanta over the range of a look's colours

bool draws(const std::string& option) {
  static const std::set<std::string> kOptions = {"size",  "quality", "look",      "curvature-range",
                                                 "plain", "light",   "background"};
  return kOptions.contains(option) || option.starts_with("camera.");
}

// Returns the scene and options that determine how a state is drawn, which sources of numbers do not.
Json setup_json(const Setup& setup) {
  Json scene = to_json(setup.scene);
  scene.erase("origin");
  for (const char* key : {"provenance", "published"}) scene["fabric"].erase(key);
  Options options = setup.options;
  Keys keys = bind_options(options);
  std::erase_if(keys, [](const BoundKey& key) { return !draws(key.description.path); });
  return {{"scene", scene}, {"options", to_json(keys)}};
}

std::map<std::string, double> storage_quanta(const Setup& setup) {
  std::map<std::string, double> quanta;
  for (const std::string& name : setup.options.looks()) {
    const render::Look look = scene_look(setup.scene, setup.options, name);
    quanta[name] = (look.value_high - look.value_low) / kStepsAcross;
  }
  return quanta;
}

void append(const fs::path& file, std::ios::openmode mode, const std::string& text) {
  std::ofstream stream(file, mode | std::ios::binary);
  stream.write(text.data(), static_cast<std::streamsize>(text.size()));
  if (!stream.flush()) throw Error::system("cannot write " + file.string());
}

std::vector<ArchivedBody> archived_bodies(const std::vector<Obstacle>& obstacles, double cloth_quantum) {
  std::vector<ArchivedBody> bodies;
  for (std::size_t i = 0; i < obstacles.size(); ++i) {
    const Obstacle& o = obstacles[i];
    if (!is_body(o) || !o.visible || !o.mesh) continue;
    ArchivedBody body{i, {}, o.mesh->closed, {}};
    body.mesh.vertices = static_cast<std::size_t>(o.mesh->vertices());
    body.mesh.triangles = flat_triangles(o.mesh->face);
    body.mesh.quantum = body_quantum(o, cloth_quantum);
    if (!o.mesh->moves()) body.xyz = drawn_body(o, 0, body.mesh.quantum);
    bodies.push_back(std::move(body));
  }
  return bodies;
}

// Returns the body with its kept positions: at the instants, or once for all.
std::shared_ptr<const BodyMesh> body_mesh(const ArchivedBody& body,
                                          const std::vector<ArchivedState>& instants) {
  auto mesh = std::make_shared<BodyMesh>();
  mesh->closed = body.closed;
  for (std::size_t t = 0; t + 2 < body.mesh.triangles.size(); t += 3)
    mesh->face.emplace_back(body.mesh.triangles[t], body.mesh.triangles[t + 1], body.mesh.triangles[t + 2]);
  const auto add = [&](const std::vector<float>& xyz) {
    std::vector<Eigen::Vector3d>& frame = mesh->frames.emplace_back();
    for (std::size_t i = 0; i + 2 < xyz.size(); i += 3) frame.emplace_back(xyz[i], xyz[i + 1], xyz[i + 2]);
  };
  if (!body.xyz.empty()) {
    add(body.xyz);
    return mesh;
  }
  for (const ArchivedState& instant : instants) {
    const auto found = instant.bodies.find(body.obstacle);
    if (found == instant.bodies.end() || (!mesh->time.empty() && !(instant.time > mesh->time.back())))
      continue;
    add(found->second);
    mesh->time.push_back(instant.time);
  }
  return mesh->frames.empty() ? nullptr : mesh;
}

}  // namespace

ArchivedFrames::ArchivedFrames(const Setup& setup, const DrawnMesh& mesh, const render::Box& bounds,
                               std::optional<float> floor)
    : mesh_(mesh),
      packer_(mesh.vertices, mesh.triangles),
      cloth_{
          "", 0, setup_json(setup), bounds, floor, {}, archived_bodies(setup.scene.obstacle, mesh.quantum)},
      obstacles_(setup.scene.obstacle),
      quanta_(storage_quanta(setup)) {
  for (const ArchivedBody& body : cloth_.bodies)
    body_packers_.emplace_back(body.mesh.vertices, body.mesh.triangles);
}

void ArchivedFrames::add(const fs::path& file, ArchivedState instant) {
  if (!has_begun_) {
    std::string head = record_text(mesh_record(mesh_)) + record_text(cloth_record(cloth_));
    for (const ArchivedBody& body : cloth_.bodies) head += record_text(body_record(body));
    append(file, std::ios::trunc, head);
  }
  has_begun_ = true;
  ArchivedRecord record = instant_record(mesh_, packer_, instant, quanta_);
  for (std::size_t b = 0; b < cloth_.bodies.size(); ++b) {
    const ArchivedBody& body = cloth_.bodies[b];
    if (body.xyz.empty())
      add_body(record, body, body_packers_[b],
               drawn_body(obstacles_[body.obstacle], instant.time, body.mesh.quantum));
  }
  append(file, std::ios::app, record_text(record));
}

void ArchivedFrames::end(const fs::path& file, const ArchivedRecord& sheet) {
  append(file, std::ios::app, record_text(sheet));
}

void ArchivedFrames::continue_file(const fs::path& file, std::size_t instants) {
  std::vector<int> all(instants);
  for (std::size_t i = 0; i < instants; ++i) all[i] = static_cast<int>(i);
  write_records(file, chosen_records(file, all));
  has_begun_ = true;
}

std::vector<ArchivedRecord> chosen_records(const fs::path& frames, const std::vector<int>& instants) {
  const std::vector<ArchivedRecord> all = read_records(frames);
  std::vector<ArchivedRecord> head, found;
  for (const ArchivedRecord& record : all) {
    if (record.kind() == "instant")
      found.push_back(record);
    else if (record.kind() != "sheet")
      head.push_back(record);
  }
  for (const int i : instants) {
    if (i < 0 || i >= static_cast<int>(found.size()))
      throw Error::invalid_input(frames.string() + " keeps no instant " + std::to_string(i));
    head.push_back(found[static_cast<std::size_t>(i)]);
  }
  return head;
}

void write_records(const fs::path& file, const std::vector<ArchivedRecord>& records) {
  std::string text;
  for (const ArchivedRecord& record : records) text += record_text(record);
  write_text(file, text);
}

Setup archived_setup(const ArchivedCloth& cloth, const std::string& file) {
  Setup setup{default_scene(), {}};
  Json keys = cloth.setup.at("scene");
  keys.merge_patch(cloth.setup.at("options"));
  apply_recorded_scene(setup.scene, std::move(keys), file, bind_options(setup.options));
  for (const ArchivedBody& body : cloth.bodies)
    if (body.obstacle < setup.scene.obstacle.size())
      setup.scene.obstacle[body.obstacle].mesh = body_mesh(body, cloth.instants);
  return setup;
}

}  // namespace hysteron::experiments
