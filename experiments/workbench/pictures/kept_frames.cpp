#include "experiments/workbench/pictures/kept_frames.h"

#include <fstream>
#include <set>

#include "experiments/workbench/pictures/scene_renderer.h"
#include "sim/base/atomic_file.h"
#include "sim/base/error.h"
#include "sim/scene/keys.h"
#include "sim/scene/scene_reader.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;

constexpr double kStepsAcross = 1024;  // quanta from end to end of a look's colours

bool draws(const std::string& option) {
  static const std::set<std::string> kOptions = {"size",  "quality", "look",      "curvature-range",
                                                 "plain", "light",   "background"};
  return kOptions.contains(option) || option.starts_with("camera.");
}

// What decides how a state is drawn: sources of numbers do not.
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

}  // namespace

KeptFrames::KeptFrames(const Setup& setup, const DrawnMesh& mesh, const render::Box& bounds,
                       std::optional<float> floor)
    : mesh_(mesh),
      packer_(mesh.vertices, mesh.triangles),
      cloth_{"", 0, setup_json(setup), bounds, floor, {}},
      quanta_(storage_quanta(setup)) {}

void KeptFrames::add(const fs::path& file, KeptState instant) {
  if (!has_begun_)
    append(file, std::ios::trunc, record_text(mesh_record(mesh_)) + record_text(cloth_record(cloth_)));
  has_begun_ = true;
  append(file, std::ios::app, record_text(instant_record(mesh_, packer_, instant, quanta_)));
}

void KeptFrames::end(const fs::path& file, const KeptRecord& sheet) {
  append(file, std::ios::app, record_text(sheet));
}

void KeptFrames::continue_file(const fs::path& file, std::size_t instants) {
  std::vector<int> all(instants);
  for (std::size_t i = 0; i < instants; ++i) all[i] = static_cast<int>(i);
  write_records(file, chosen_records(file, all));
  has_begun_ = true;
}

std::vector<KeptRecord> chosen_records(const fs::path& frames, const std::vector<int>& instants) {
  const std::vector<KeptRecord> all = read_records(frames);
  std::vector<KeptRecord> head, found;
  for (const KeptRecord& record : all) {
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

void write_records(const fs::path& file, const std::vector<KeptRecord>& records) {
  std::string text;
  for (const KeptRecord& record : records) text += record_text(record);
  write_text(file, text);
}

Setup kept_setup(const KeptCloth& cloth, const std::string& file) {
  Setup setup{default_scene(), {}};
  Json keys = cloth.setup.at("scene");
  keys.merge_patch(cloth.setup.at("options"));
  apply_recorded_scene(setup.scene, std::move(keys), file, bind_options(setup.options));
  return setup;
}

}  // namespace hysteron::experiments
