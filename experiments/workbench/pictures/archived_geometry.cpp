#include "experiments/workbench/pictures/archived_geometry.h"

#include <algorithm>
#include <cmath>

#include "experiments/workbench/app/json_file.h"
#include "sim/base/error.h"
#include "sim/base/whole_file.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;

constexpr int kFormat = 1;
constexpr std::size_t kMaxHead = 1 << 20;  // largest line of a record [bytes]

std::vector<int> all_steps(std::span<const float> values, double quantum) {
  std::vector<int> steps(values.size());
  std::ranges::transform(values, steps.begin(), [&](float value) { return quantum_count(value, quantum); });
  return steps;
}

std::vector<float> all_values(const std::vector<int>& steps, double quantum) {
  std::vector<float> values(steps.size());
  std::ranges::transform(steps, values.begin(), [&](int step) { return static_cast<float>(quantum * step); });
  return values;
}

// Removes the next record from the text and returns it; nothing if it is not complete.
std::optional<ArchivedRecord> next_record(std::string_view& text) {
  const std::size_t end = text.substr(0, kMaxHead).find('\n');
  if (end == text.npos) return {};
  ArchivedRecord record{parsed_json(text.substr(0, end)), {}};
  if (!record.head.is_object()) throw Error::invalid_input("a record is no JSON");
  std::size_t at = end + 1;
  for (const Json& size : record.head.value("bytes", Json::array())) {
    const auto bytes = size.get<std::size_t>();
    if (bytes > text.size() - at) return {};
    record.blocks.emplace_back(text.substr(at, bytes));
    at += bytes;
  }
  text.remove_prefix(at);
  return record;
}

const std::string& block(const ArchivedRecord& record, std::size_t i) {
  if (i >= record.blocks.size()) throw Error::invalid_input("a record lacks a block");
  return record.blocks[i];
}

DrawnMesh record_mesh(const ArchivedRecord& record) {
  DrawnMesh mesh;
  mesh.vertices = record.head.at("vertices");
  mesh.quantum = record.head.at("quantum");
  mesh.triangles = unpacked_triangles(block(record, 0), record.head.at("triangles"), mesh.vertices);
  if (!block(record, 1).empty())
    mesh.pattern =
        all_values(MeshPacker(mesh.vertices, mesh.triangles).unpacked(block(record, 1), 2), mesh.quantum);
  return mesh;
}

ArchivedCloth archived_cloth(const ArchivedRecord& record, std::size_t meshes) {
  ArchivedCloth cloth;
  cloth.name = record.head.at("name");
  cloth.mesh = record.head.at("mesh");
  if (cloth.mesh >= meshes) throw Error::invalid_input("a record names a mesh that is not there");
  cloth.setup = parsed_json(inflated(block(record, 0), record.head.at("setup_bytes")));
  if (!cloth.setup.is_object()) throw Error::invalid_input("a record's setup is no JSON");
  const auto corners = record.head.at("bounds").get<std::vector<float>>();
  if (corners.size() != 6) throw Error::invalid_input("bounds have other than six numbers");
  cloth.bounds = render::bounding_box(corners);
  if (!record.head.at("floor").is_null()) cloth.floor = record.head.at("floor").get<float>();
  return cloth;
}

ArchivedBody archived_body(const ArchivedRecord& record) {
  ArchivedBody body;
  body.obstacle = record.head.at("obstacle");
  body.closed = record.head.at("closed");
  body.mesh.vertices = record.head.at("vertices");
  body.mesh.quantum = record.head.at("quantum");
  body.mesh.triangles = unpacked_triangles(block(record, 0), record.head.at("triangles"), body.mesh.vertices);
  if (!block(record, 1).empty())
    body.xyz = all_values(MeshPacker(body.mesh.vertices, body.mesh.triangles).unpacked(block(record, 1), 3),
                          body.mesh.quantum);
  return body;
}

// The decoders for the instants of a cloth.
struct Packers {
  const MeshPacker* cloth;
  std::vector<MeshPacker> bodies;
};

// Reads the bodies that change their shape, behind the values, from block `next` on.
void read_bodies(const ArchivedRecord& record, std::size_t next, const ArchivedCloth& cloth,
                 const Packers& packers, ArchivedState& instant) {
  for (const Json& number : record.head.value("bodies", Json::array())) {
    const auto obstacle = number.get<std::size_t>();
    const auto body = std::ranges::find(cloth.bodies, obstacle, &ArchivedBody::obstacle);
    if (body == cloth.bodies.end()) throw Error::invalid_input("an instant names a body that is not there");
    const MeshPacker& packer = packers.bodies[static_cast<std::size_t>(body - cloth.bodies.begin())];
    instant.bodies[obstacle] = all_values(packer.unpacked(block(record, next++), 3), body->mesh.quantum);
  }
}

ArchivedState instant_state(const ArchivedRecord& record, const DrawnMesh& mesh, const ArchivedCloth& cloth,
                            const Packers& packers) {
  ArchivedState instant;
  instant.time = record.head.at("time");
  instant.loop = record.head.at("loop");
  instant.xyz = all_values(packers.cloth->unpacked(block(record, 0), 3), mesh.quantum);
  std::size_t next = 1;
  for (const auto& [look, quantum] : record.head.at("values").items())
    instant.values[look] = all_values(packers.cloth->unpacked(block(record, next++), 1), quantum);
  read_bodies(record, next, cloth, packers, instant);
  return instant;
}

Archived archived_contents(const std::vector<ArchivedRecord>& records) {
  Archived kept;
  std::vector<MeshPacker> packers;
  Packers of_cloth;
  for (const ArchivedRecord& record : records) {
    const std::string kind = record.kind();
    if (kind == "mesh") {
      kept.meshes.push_back(record_mesh(record));
      packers.emplace_back(kept.meshes.back().vertices, kept.meshes.back().triangles);
    } else if (kind == "cloth") {
      kept.cloths.push_back(archived_cloth(record, kept.meshes.size()));
      of_cloth = {nullptr, {}};
    } else if (kind == "body") {
      if (kept.cloths.empty()) throw Error::invalid_input("a body stands before its cloth");
      kept.cloths.back().bodies.push_back(archived_body(record));
      const DrawnMesh& mesh = kept.cloths.back().bodies.back().mesh;
      of_cloth.bodies.emplace_back(mesh.vertices, mesh.triangles);
    } else if (kind == "instant") {
      if (kept.cloths.empty()) throw Error::invalid_input("an instant stands before its cloth");
      ArchivedCloth& cloth = kept.cloths.back();
      of_cloth.cloth = &packers[cloth.mesh];
      cloth.instants.push_back(instant_state(record, kept.meshes[cloth.mesh], cloth, of_cloth));
    } else if (kind == "sheet") {
      kept.sheet = record.head;
    }
  }
  return kept;
}

}  // namespace

int quantum_count(double value, double quantum) { return static_cast<int>(std::lround(value / quantum)); }

std::vector<float> rounded(std::span<const float> values, double quantum) {
  return all_values(all_steps(values, quantum), quantum);
}

std::vector<float> rounded(std::span<const float> values, double quantum, std::span<const float> before) {
  constexpr double kStays = 0.75;
  std::vector<float> result = rounded(values, quantum);
  for (std::size_t i = 0; i < before.size(); ++i)
    if (std::abs(values[i] - before[i]) < kStays * quantum) result[i] = before[i];
  return result;
}

ArchivedRecord mesh_record(const DrawnMesh& mesh) {
  const MeshPacker packer(mesh.vertices, mesh.triangles);
  return {{{"record", "mesh"},
           {"format", kFormat},
           {"vertices", mesh.vertices},
           {"triangles", mesh.triangles.size() / 3},
           {"quantum", mesh.quantum}},
          {packed_triangles(mesh.triangles),
           mesh.pattern.empty() ? "" : packer.packed(all_steps(mesh.pattern, mesh.quantum), 2)}};
}

ArchivedRecord cloth_record(const ArchivedCloth& cloth) {
  const std::string setup = cloth.setup.dump();
  const Eigen::Vector3f &low = cloth.bounds.low, &high = cloth.bounds.high;
  return {{{"record", "cloth"},
           {"name", cloth.name},
           {"mesh", cloth.mesh},
           {"bounds", {low.x(), low.y(), low.z(), high.x(), high.y(), high.z()}},
           {"floor", cloth.floor ? Json(*cloth.floor) : Json()},
           {"setup_bytes", setup.size()}},
          {deflated(setup)}};
}

ArchivedRecord body_record(const ArchivedBody& body) {
  const DrawnMesh& mesh = body.mesh;
  return {{{"record", "body"},
           {"obstacle", body.obstacle},
           {"closed", body.closed},
           {"vertices", mesh.vertices},
           {"triangles", mesh.triangles.size() / 3},
           {"quantum", mesh.quantum}},
          {packed_triangles(mesh.triangles),
           body.xyz.empty()
               ? ""
               : MeshPacker(mesh.vertices, mesh.triangles).packed(all_steps(body.xyz, mesh.quantum), 3)}};
}

void add_body(ArchivedRecord& instant, const ArchivedBody& body, const MeshPacker& packer,
              const std::vector<float>& xyz) {
  instant.head["bodies"].push_back(body.obstacle);
  instant.blocks.push_back(packer.packed(all_steps(xyz, body.mesh.quantum), 3));
}

ArchivedRecord instant_record(const DrawnMesh& mesh, const MeshPacker& packer, const ArchivedState& instant,
                              const std::map<std::string, double>& quanta) {
  ArchivedRecord record{
      {{"record", "instant"}, {"time", instant.time}, {"loop", instant.loop}, {"values", Json::object()}},
      {packer.packed(all_steps(instant.xyz, mesh.quantum), 3)}};
  for (const auto& [look, values] : instant.values) {
    record.head["values"][look] = quanta.at(look);
    record.blocks.push_back(packer.packed(all_steps(values, quanta.at(look)), 1));
  }
  return record;
}

std::string record_text(const ArchivedRecord& record) {
  Json head = record.head;
  head["bytes"] = Json::array();
  for (const std::string& block : record.blocks) head["bytes"].push_back(block.size());
  std::string text = head.dump() + "\n";
  for (const std::string& block : record.blocks) text += block;
  return text;
}

std::vector<ArchivedRecord> read_records(const fs::path& file) {
  const std::string bytes = whole_file(file);
  std::string_view text = bytes;
  std::vector<ArchivedRecord> records;
  try {
    while (auto record = next_record(text)) records.push_back(std::move(*record));
  } catch (const std::exception& e) {
    throw Error::invalid_input(file.string() + ": " + e.what());
  }
  if (records.empty() || records[0].head.value("format", 0) != kFormat)
    throw Error::invalid_input(file.string() + " holds no kept geometry of this program's format");
  return records;
}

Archived read_archived(const fs::path& file) {
  const std::vector<ArchivedRecord> records = read_records(file);
  try {
    return archived_contents(records);
  } catch (const std::exception& e) {
    throw Error::invalid_input(file.string() + ": " + e.what());
  }
}

DrawnMesh read_archived_mesh(const fs::path& file) {
  const std::vector<ArchivedRecord> records = read_records(file);
  try {
    const auto mesh =
        std::ranges::find_if(records, [](const ArchivedRecord& record) { return record.kind() == "mesh"; });
    if (mesh == records.end()) throw Error::invalid_input("no record is a mesh");
    return record_mesh(*mesh);
  } catch (const std::exception& e) {
    throw Error::invalid_input(file.string() + ": " + e.what());
  }
}

fs::path archived_file_in(const fs::path& folder) {
  std::error_code ignored;
  for (const char* name : {kArchivedFrames, kArchivedSheet})
    if (fs::exists(folder / name, ignored)) return folder / name;
  return {};
}

}  // namespace hysteron::experiments
