// The format is specified in Khronos Group 2021, glTF 2.0 Specification, 3.7.2 (meshes, morph targets), 3.10
// (cameras), 3.11 (animations), 4.4 (binary files).
#include "experiments/workbench/animation/write_glb.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>

#include "experiments/workbench/animation/glb_arrays.h"
#include "sim/base/atomic_file.h"
#include "sim/base/error.h"
#include "sim/base/number_in.h"

namespace hysteron::experiments {
namespace {

using GlbJson = nlohmann::ordered_json;

constexpr std::uint32_t kMagic = 0x46546C67, kVersion = 2;  // magic number "glTF", and version
constexpr std::uint32_t kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;
// Size of the headers of the file and its two chunks.
constexpr std::size_t kHeads = 7 * sizeof(std::uint32_t);
constexpr std::size_t kAligned = 4;
constexpr std::size_t kDescription = 500;  // upper bound of the JSON for an array [bytes]
constexpr double kMatte = 0.9;             // roughness of cloth and bodies

// The vertices of a part in the file, where each vertex has a single texture coordinate, so that seams
// duplicate them.
struct FileVertices {
  std::vector<std::uint32_t> vertex;  // index in the part
  std::vector<Eigen::Vector2f> texture;
  std::vector<std::uint32_t> triangles;

  std::size_t count() const { return vertex.size(); }
  std::vector<Eigen::Vector3f> of(const std::vector<Eigen::Vector3f>& all) const {
    std::vector<Eigen::Vector3f> chosen;
    chosen.reserve(count());
    for (const std::uint32_t v : vertex) chosen.push_back(all[v]);
    return chosen;
  }
};

FileVertices parted_at_seams(const AnimatedPart& part) {
  FileVertices result;
  std::map<std::tuple<std::uint32_t, float, float>, std::uint32_t> known;
  for (std::size_t corner = 0; corner < part.shape.triangles.size(); ++corner) {
    const std::uint32_t v = part.shape.triangles[corner];
    const Eigen::Vector2f& uv = part.texture.at[corner];
    const auto [place, is_new] =
        known.try_emplace({v, uv.x(), uv.y()}, static_cast<std::uint32_t>(result.vertex.size()));
    result.triangles.push_back(place->second);
    if (!is_new) continue;
    result.vertex.push_back(v);
    result.texture.push_back(uv);
  }
  return result;
}

FileVertices file_vertices(const AnimatedPart& part) {
  if (part.texture.of_corners && !part.texture.at.empty()) return parted_at_seams(part);
  FileVertices result{{}, part.texture.at, part.shape.triangles};
  const auto& corners = part.shape.triangles;
  result.vertex.resize(1 + static_cast<std::size_t>(*std::max_element(corners.begin(), corners.end())));
  for (std::size_t v = 0; v < result.vertex.size(); ++v) result.vertex[v] = static_cast<std::uint32_t>(v);
  return result;
}

std::vector<Eigen::Vector3f> change(std::vector<Eigen::Vector3f> now,
                                    const std::vector<Eigen::Vector3f>& base) {
  for (std::size_t i = 0; i < now.size(); ++i) now[i] -= base[i];
  return now;
}

// Flips the texture's second coordinate, which the format counts from the top.
std::vector<Eigen::Vector2f> from_the_top(std::vector<Eigen::Vector2f> texture) {
  for (Eigen::Vector2f& at : texture) at.y() = 1 - at.y();
  return texture;
}

GlbArrays::Array vertex_array(std::size_t count, int components, bool bounded,
                              std::function<void(const GlbArrays::Sink&)> make) {
  GlbArrays::Array array{count, components, std::move(make)};
  array.of_vertices = true;
  array.bounded = bounded;
  return array;
}

GlbJson numbers_in(const Eigen::Vector3f& v) { return {v.x(), v.y(), v.z()}; }
GlbJson numbers_in(const Eigen::Quaternionf& q) { return {q.x(), q.y(), q.z(), q.w()}; }

class GlbFile {
 public:
  explicit GlbFile(const AnimatedScene& scene);
  std::size_t most_bytes() const {
    return kHeads + kAligned + json_.dump().size() + kDescription * (1 + arrays_.size()) + arrays_.bytes();
  }
  void write(const std::string& file);

 private:
  std::size_t add_mesh(const AnimatedPart& part);
  void add_morph_targets(GlbJson& mesh, const AnimatedPart& part,
                         const std::shared_ptr<const FileVertices>& of);
  GlbArrays::Array weights() const;
  std::size_t add_node(GlbJson node) {
    json_["nodes"].push_back(std::move(node));
    return json_["nodes"].size() - 1;
  }
  void add_part(const AnimatedPart& part);
  void add_place(std::size_t node, const AnimatedPart& part);
  std::size_t add_seen_node(std::size_t node, const AnimatedPart& part);
  void add_camera();
  // Animates a node's property by an array with an entry, or a row, for each instant.
  void animate(std::size_t node, const char* path, const char* interpolation, std::size_t array);
  // Does the same with kept numbers, unless all instants have equal ones.
  void animate(std::size_t node, const char* path, const char* interpolation, int components,
               std::vector<float> numbers);

  const AnimatedScene& scene_;
  std::size_t targets_;  // number of morph targets
  GlbArrays arrays_;
  std::size_t times_ = 0;  // index of its accessor
  GlbJson json_;
};

GlbFile::GlbFile(const AnimatedScene& scene) : scene_(scene), targets_(scene.instants.size() - 1) {
  json_ = {{"asset", {{"version", "2.0"}, {"generator", "hysteron"}}},
           {"scene", 0},
           {"scenes", GlbJson::array({{{"nodes", {0}}}})}};
  if (targets_ > 0) {
    std::vector<float> times;
    for (const Instant& at : scene.instants) times.push_back(static_cast<float>(at.time));
    GlbArrays::Array array{times.size(), 1, archived_numbers(times)};
    array.bounded = true;
    times_ = arrays_.add(std::move(array));
  }
  const float half = std::sqrt(0.5f);
  add_node({{"name", "run"},
            {"rotation", numbers_in(Eigen::Quaternionf(half, -half, 0, 0))},
            {"children", GlbJson::array()}});
  for (const AnimatedPart& part : scene.parts) add_part(part);
  add_camera();
}

void GlbFile::animate(std::size_t node, const char* path, const char* interpolation, std::size_t array) {
  if (!json_.contains("animations"))
    json_["animations"].push_back(
        {{"name", "run"}, {"samplers", GlbJson::array()}, {"channels", GlbJson::array()}});
  GlbJson& animation = json_["animations"][0];
  animation["channels"].push_back(
      {{"sampler", animation["samplers"].size()}, {"target", {{"node", node}, {"path", path}}}});
  animation["samplers"].push_back({{"input", times_}, {"output", array}, {"interpolation", interpolation}});
}

void GlbFile::animate(std::size_t node, const char* path, const char* interpolation, int components,
                      std::vector<float> numbers) {
  bool changes = false;
  const std::size_t step = static_cast<std::size_t>(components);
  for (std::size_t i = step; i < numbers.size(); ++i) changes = changes || numbers[i] != numbers[i % step];
  if (!changes) return;
  animate(node, path, interpolation,
          arrays_.add({scene_.instants.size(), components, archived_numbers(std::move(numbers))}));
}

// Returns the weights: at each instant but the first its own target has weight 1, the others 0.
GlbArrays::Array GlbFile::weights() const {
  return {(targets_ + 1) * targets_, 1, [targets = targets_](const GlbArrays::Sink& sink) {
            std::vector<float> row(targets, 0);
            for (std::size_t k = 0; k <= targets; ++k) {
              std::fill(row.begin(), row.end(), 0.0f);
              if (k > 0) row[k - 1] = 1;
              sink(bytes_of(row));
            }
          }};
}

void GlbFile::add_morph_targets(GlbJson& mesh, const AnimatedPart& part,
                                const std::shared_ptr<const FileVertices>& of) {
  const auto base = std::make_shared<const SurfaceState>(surface_at(part, scene_.instants.front()));
  GlbJson names = GlbJson::array();
  for (std::size_t k = 1; k <= targets_; ++k) {
    const Instant at = scene_.instants[k];
    const auto moved = [&part, of, base, at](const GlbArrays::Sink& sink) {
      sink(bytes_of(of->of(change(points_at(part, at), base->points))));
    };
    const auto turned = [&part, of, base, at](const GlbArrays::Sink& sink) {
      sink(bytes_of(of->of(change(surface_at(part, at).normals, base->normals))));
    };
    const std::size_t position = arrays_.add(vertex_array(of->count(), 3, true, moved));
    const std::size_t normal = arrays_.add(vertex_array(of->count(), 3, false, turned));
    mesh["primitives"][0]["targets"].push_back({{"POSITION", position}, {"NORMAL", normal}});
    names.push_back(number_text(at.time) + " s");
  }
  mesh["extras"] = {{"targetNames", names}};
}

std::size_t GlbFile::add_mesh(const AnimatedPart& part) {
  const auto of = std::make_shared<const FileVertices>(file_vertices(part));
  const SurfaceState base = surface_at(part, scene_.instants.front());
  GlbJson attributes = {
      {"POSITION", arrays_.add(vertex_array(of->count(), 3, true, archived_numbers(of->of(base.points))))},
      {"NORMAL", arrays_.add(vertex_array(of->count(), 3, false, archived_numbers(of->of(base.normals))))}};
  if (!of->texture.empty())
    attributes["TEXCOORD_0"] =
        arrays_.add(vertex_array(of->count(), 2, false, archived_numbers(from_the_top(of->texture))));
  GlbArrays::Array corners{of->triangles.size(), 1, archived_numbers(of->triangles)};
  corners.is_index = true;
  GlbJson color = numbers_in(part.color);
  color.push_back(1);
  json_["materials"].push_back(
      {{"name", part.name},
       {"doubleSided", true},
       {"pbrMetallicRoughness",
        {{"baseColorFactor", color}, {"metallicFactor", 0}, {"roughnessFactor", kMatte}}}});
  const GlbJson primitive = {{"attributes", attributes},
                             {"indices", arrays_.add(std::move(corners))},
                             {"material", json_["materials"].size() - 1}};
  GlbJson mesh = {{"name", part.name}, {"primitives", GlbJson::array({primitive})}};
  if (!part.is_rigid() && targets_ > 0) add_morph_targets(mesh, part, of);
  json_["meshes"].push_back(std::move(mesh));
  return json_["meshes"].size() - 1;
}

void GlbFile::add_place(std::size_t node, const AnimatedPart& part) {
  std::vector<float> translations, rotations, scales;
  for (const Pose& pose : poses_at(part, scene_.instants)) {
    translations.insert(translations.end(), pose.translation.begin(), pose.translation.end());
    rotations.insert(rotations.end(), pose.rotation.coeffs().begin(), pose.rotation.coeffs().end());
    scales.insert(scales.end(), 3, pose.scale);
  }
  GlbJson& json = json_["nodes"][node];
  json["translation"] = std::vector<float>(translations.begin(), translations.begin() + 3);
  json["rotation"] = std::vector<float>(rotations.begin(), rotations.begin() + 4);
  json["scale"] = std::vector<float>(scales.begin(), scales.begin() + 3);
  animate(node, "translation", "LINEAR", 3, std::move(translations));
  animate(node, "rotation", "LINEAR", 4, std::move(rotations));
  animate(node, "scale", "LINEAR", 3, std::move(scales));
}

// Adds a parent node that is scaled to zero while the part is not seen, as the format recommends (3.5.2).
std::size_t GlbFile::add_seen_node(std::size_t node, const AnimatedPart& part) {
  std::vector<float> scales;
  for (const Instant& at : scene_.instants) scales.insert(scales.end(), 3, part.is_seen(at) ? 1.0f : 0.0f);
  if (std::count(scales.begin(), scales.end(), 1.0f) == static_cast<std::ptrdiff_t>(scales.size()))
    return node;
  const std::size_t above = add_node({{"name", part.name + "_seen"},
                                      {"scale", std::vector<float>(3, scales.front())},
                                      {"children", {node}}});
  animate(above, "scale", "STEP", 3, std::move(scales));
  return above;
}

void GlbFile::add_part(const AnimatedPart& part) {
  GlbJson json = {{"name", part.name}, {"mesh", add_mesh(part)}};
  if (part.inset > 0) json["extras"] = {{"inset", part.inset}};
  const std::size_t node = add_node(std::move(json));
  if (part.is_rigid())
    add_place(node, part);
  else if (targets_ > 0)
    animate(node, "weights", "LINEAR", arrays_.add(weights()));
  const std::size_t above = add_seen_node(node, part);
  json_["nodes"][0]["children"].push_back(above);
}

void GlbFile::add_camera() {
  const render::Camera& camera = scene_.view.camera;
  const Eigen::Matrix4d projection = camera.projection(scene_.view.aspect()).cast<double>();
  const Eigen::Matrix3f axes = camera.view().topLeftCorner<3, 3>().transpose();
  json_["cameras"].push_back({{"type", "perspective"},
                              {"perspective",
                               {{"aspectRatio", scene_.view.aspect()},
                                {"yfov", 2 * std::atan(1 / projection(1, 1))},
                                {"znear", projection(2, 3) / (projection(2, 2) - 1)},
                                {"zfar", projection(2, 3) / (projection(2, 2) + 1)}}}});
  const std::size_t node = add_node({{"name", "camera"},
                                     {"camera", 0},
                                     {"translation", numbers_in(camera.eye())},
                                     {"rotation", numbers_in(Eigen::Quaternionf(axes).normalized())}});
  json_["nodes"][0]["children"].push_back(node);
}

void GlbFile::write(const std::string& file) {
  GlbJson json = json_;
  arrays_.describe(json);
  std::string text = json.dump();
  text.resize((text.size() + kAligned - 1) / kAligned * kAligned, ' ');
  const std::size_t all = kHeads + text.size() + arrays_.bytes();
  if (all > kMostGlbBytes)
    throw Error::invalid_input("cannot write " + file + ": " + std::to_string(all) +
                               " bytes are more than the 4 GiB of a binary glTF file; a smaller --fps has "
                               "fewer instants");
  const auto word = [](std::size_t n) { return static_cast<std::uint32_t>(n); };
  AtomicFile target(file);
  std::ostream& out = target.stream();
  out << bytes_of<std::uint32_t>({kMagic, kVersion, word(all), word(text.size()), kJsonChunk}) << text
      << bytes_of<std::uint32_t>({word(arrays_.bytes()), kBinaryChunk});
  arrays_.write(out);
  target.commit();
}

}  // namespace

void write_glb(const std::string& file, const AnimatedScene& scene) { GlbFile(scene).write(file); }

std::size_t glb_bytes(const AnimatedScene& scene) { return GlbFile(scene).most_bytes(); }

}  // namespace hysteron::experiments
