// Source of the format: Khronos Group 2021, glTF 2.0 Specification, 3.6 (buffers), 3.7.2 (meshes, morph
// targets), 3.11 (animations), 4.4 (binary files).
#include <bit>
#include <cstdint>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>

#include "sim/base/atomic_file.h"
#include "sim/base/error.h"
#include "sim/base/number_in.h"
#include "sim/mesh/gltf.h"

namespace hysteron {
namespace {

using Json = nlohmann::ordered_json;

static_assert(std::endian::native == std::endian::little, "numbers are stored as they lie in memory");

constexpr std::uint32_t kMagic = 0x46546C67, kVersion = 2;  // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4E4F534A, kBinChunk = 0x004E4942;
constexpr int kUnsigned = 5125, kFloat = 5126;                     // types of numbers
constexpr int kVertices = 34962, kIndices = 34963, kNoTarget = 0;  // what a view of the buffer is for
constexpr std::size_t kAligned = 4;                                // chunks; all arrays are of 4-byte numbers

// One array of the buffer, with the accessor through which it is read.
struct Array {
  std::string bytes;
  Json accessor;
  int target;
};

template <class T>
std::string bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

// `bounded`: with the least and largest of each component, as positions and times must have them.
Array floats(const std::vector<float>& values, int components, bool bounded, int target) {
  Json accessor = {{"componentType", kFloat},
                   {"count", values.size() / components},
                   {"type", components == 3 ? "VEC3" : "SCALAR"}};
  if (bounded) {
    std::vector<float> low(values.begin(), values.begin() + components), high = low;
    for (std::size_t i = 0; i < values.size(); ++i) {
      low[i % components] = std::min(low[i % components], values[i]);
      high[i % components] = std::max(high[i % components], values[i]);
    }
    accessor["min"] = low;
    accessor["max"] = high;
  }
  return {bytes_of(values), accessor, target};
}

std::vector<float> y_up(const std::vector<float>& xyz) {
  std::vector<float> turned(xyz.size());
  for (std::size_t i = 0; i < xyz.size(); i += 3) {
    turned[i] = xyz[i];
    turned[i + 1] = xyz[i + 2];
    turned[i + 2] = 0 - xyz[i + 1];
  }
  return turned;
}

// Of vertices, y up: the mean of the faces around them by area.
std::vector<float> normals(const ClothMesh& mesh, const std::vector<float>& xyz) {
  const auto at = [&](int v) { return Eigen::Map<const Eigen::Vector3f>(&xyz[3 * v]).cast<double>(); };
  std::vector<Eigen::Vector3d> sum(mesh.rest.size(), Eigen::Vector3d::Zero());
  for (const auto& f : mesh.face) {
    const Eigen::Vector3d normal = (at(f[1]) - at(f[0])).cross(at(f[2]) - at(f[0]));
    for (const int v : f) sum[v] += normal;
  }
  std::vector<float> result;
  for (const Eigen::Vector3d& n : sum) {
    const Eigen::Vector3d unit = n.norm() > 0 ? n.normalized() : Eigen::Vector3d::UnitZ();
    for (const double x : unit) result.push_back(static_cast<float>(x));
  }
  return y_up(result);
}

std::vector<float> difference(std::vector<float> a, const std::vector<float>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] -= b[i];
  return a;
}

// All arrays in the order of their accessors, each made when it is asked for: a long run has many.
void for_each_array(const ClothMesh& mesh, const std::vector<ClothFrame>& frames,
                    const std::function<void(const Array&)>& visit) {
  std::vector<std::uint32_t> corners;
  for (const auto& face : mesh.face) corners.insert(corners.end(), face.begin(), face.end());
  visit({bytes_of(corners),
         {{"componentType", kUnsigned}, {"count", corners.size()}, {"type", "SCALAR"}},
         kIndices});
  const std::vector<float> position = y_up(frames[0].xyz), normal = normals(mesh, frames[0].xyz);
  visit(floats(position, 3, true, kVertices));
  visit(floats(normal, 3, false, kVertices));
  const std::size_t targets = frames.size() - 1;
  if (targets == 0) return;
  std::vector<float> times = {static_cast<float>(frames[0].time)}, weights(targets, 0);
  for (std::size_t k = 1; k <= targets; ++k) {
    visit(floats(difference(y_up(frames[k].xyz), position), 3, true, kVertices));
    visit(floats(difference(normals(mesh, frames[k].xyz), normal), 3, false, kVertices));
    times.push_back(static_cast<float>(frames[k].time));
    weights.resize(weights.size() + targets, 0);
    weights[k * targets + k - 1] = 1;
  }
  visit(floats(times, 1, true, kNoTarget));
  visit(floats(weights, 1, false, kNoTarget));
}

// The scene without its buffer: accessors are numbered as for_each_array() has the arrays.
Json scene_of(const std::vector<ClothFrame>& frames) {
  const std::size_t targets = frames.size() - 1, times = 3 + 2 * targets;
  Json primitive = {{"attributes", {{"POSITION", 1}, {"NORMAL", 2}}}, {"indices", 0}, {"material", 0}};
  Json names = Json::array();
  for (std::size_t k = 0; k < targets; ++k) {
    primitive["targets"].push_back({{"POSITION", 3 + 2 * k}, {"NORMAL", 4 + 2 * k}});
    names.push_back(number_text(frames[k + 1].time) + " s");
  }
  Json json = {{"asset", {{"version", "2.0"}, {"generator", "hysteron"}}},
               {"scene", 0},
               {"scenes", Json::array({{{"nodes", {0}}}})},
               {"nodes", Json::array({{{"name", "cloth"}, {"mesh", 0}}})},
               {"materials",
                Json::array({{{"name", "cloth"},
                              {"doubleSided", true},
                              {"pbrMetallicRoughness", {{"metallicFactor", 0}, {"roughnessFactor", 0.9}}}}})},
               {"meshes", Json::array({{{"name", "cloth"}, {"primitives", Json::array({primitive})}}})}};
  if (targets == 0) return json;
  json["meshes"][0]["extras"] = {{"targetNames", names}};
  json["animations"] = Json::array(
      {{{"name", "run"},
        {"samplers", Json::array({{{"input", times}, {"output", times + 1}, {"interpolation", "LINEAR"}}})},
        {"channels", Json::array({{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}})}}});
  return json;
}

void check(const std::string& file, const ClothMesh& mesh, const std::vector<ClothFrame>& frames) {
  if (frames.empty()) throw Error::request("cannot write " + file + ": no frames");
  for (std::size_t k = 0; k < frames.size(); ++k) {
    if (frames[k].xyz.size() != 3 * mesh.rest.size())
      throw Error::request("cannot write " + file + ": " + std::to_string(frames[k].xyz.size() / 3) +
                           " positions for " + std::to_string(mesh.rest.size()) + " vertices");
    if (k > 0 && !(static_cast<float>(frames[k].time) > static_cast<float>(frames[k - 1].time)))
      throw Error::request("cannot write " + file + ": " + number_text(frames[k].time) +
                           " s does not come after " + number_text(frames[k - 1].time) + " s");
  }
}

}  // namespace

void write_glb(const std::string& file, const ClothMesh& mesh, const std::vector<ClothFrame>& frames) {
  check(file, mesh, frames);
  Json json = scene_of(frames);
  std::size_t length = 0;
  for_each_array(mesh, frames, [&](const Array& array) {
    Json view = {{"buffer", 0}, {"byteOffset", length}, {"byteLength", array.bytes.size()}};
    if (array.target != kNoTarget) view["target"] = array.target;
    json["accessors"].push_back(array.accessor);
    json["accessors"].back()["bufferView"] = json["bufferViews"].size();
    json["bufferViews"].push_back(view);
    length += array.bytes.size();
  });
  json["buffers"] = Json::array({{{"byteLength", length}}});
  std::string text = json.dump();
  text.resize((text.size() + kAligned - 1) / kAligned * kAligned, ' ');
  const std::size_t all = 3 * sizeof(std::uint32_t) + 4 * sizeof(std::uint32_t) + text.size() + length;
  if (all > std::numeric_limits<std::uint32_t>::max())
    throw Error::request("cannot write " + file + ": " + std::to_string(all) +
                         " bytes are more than the 4 GiB of a binary glTF file");

  AtomicFile out(file);
  const auto write = [&](const std::string& bytes) {
    out.stream().write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  };
  const auto number = [](std::size_t n) { return static_cast<std::uint32_t>(n); };
  write(bytes_of<std::uint32_t>({kMagic, kVersion, number(all), number(text.size()), kJsonChunk}) + text);
  write(bytes_of<std::uint32_t>({number(length), kBinChunk}));
  for_each_array(mesh, frames, [&](const Array& array) { write(array.bytes); });
  out.commit();
}

}  // namespace hysteron
