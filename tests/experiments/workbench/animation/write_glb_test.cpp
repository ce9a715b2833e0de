// A glTF file as the specification says that it is read; tests/animation.py has other programs read one.
#include "experiments/workbench/animation/write_glb.h"

#include <algorithm>
#include <cstring>

#include "tests/experiments/folder.h"
#include "tests/experiments/workbench/animation/moving_scene.h"
#include "tests/sim/mesh/panel_tube.h"

namespace hysteron::experiments {
namespace {

std::uint32_t word(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

struct Glb {
  std::string bytes;
  Json json;
  std::size_t binary;  // where the buffer begins

  explicit Glb(const std::string& file) : bytes(file_content(file)), binary(28 + word(bytes, 12)) {
    json = Json::parse(bytes.substr(20, word(bytes, 12)));
  }
  template <class T>
  std::vector<T> array(const Json& accessor) const {
    const Json& of = json["accessors"][accessor.get<std::size_t>()];
    const Json& view = json["bufferViews"][of["bufferView"].get<std::size_t>()];
    std::vector<T> values(view["byteLength"].get<std::size_t>() / sizeof(T));
    std::memcpy(values.data(), bytes.data() + binary + view["byteOffset"].get<std::size_t>(),
                values.size() * sizeof(T));
    return values;
  }
  std::vector<float> floats(const Json& accessor) const { return array<float>(accessor); }
  const Json& node(const std::string& name) const {
    for (const Json& node : json["nodes"])
      if (node["name"] == name) return node;
    throw std::out_of_range(name);
  }
  const Json& primitive(const std::string& name) const {
    return json["meshes"][node(name)["mesh"].get<std::size_t>()]["primitives"][0];
  }
  // The sampler of a node's property; null where that does not move.
  Json sampler(const std::string& name, const std::string& path) const {
    if (!json.contains("animations")) return {};
    for (const Json& channel : json["animations"][0]["channels"]) {
      const Json& target = channel["target"];
      if (target["path"] == path && json["nodes"][target["node"].get<std::size_t>()]["name"] == name)
        return json["animations"][0]["samplers"][channel["sampler"].get<std::size_t>()];
    }
    return {};
  }
  // Returns an attribute with all targets by the weights of that keyframe.
  std::vector<float> at(const std::string& name, const char* attribute, std::size_t frame) const {
    const Json& primitive = this->primitive(name);
    std::vector<float> values = floats(primitive["attributes"][attribute]);
    const std::size_t targets = primitive["targets"].size();
    const std::vector<float> weight = floats(sampler(name, "weights")["output"]);
    for (std::size_t k = 0; k < targets; ++k) {
      const std::vector<float> change = floats(primitive["targets"][k][attribute]);
      for (std::size_t i = 0; i < values.size(); ++i) values[i] += weight[frame * targets + k] * change[i];
    }
    return values;
  }
};

class GlbFile : public testing::Test {
 protected:
  Glb written() const {
    const Folder folder;
    const std::string file = folder.file("cloth.glb");
    write_glb(file, moving.scene);
    return Glb(file);
  }
  MovingScene moving;
};

TEST_F(GlbFile, IsAtEachKeyframeTheClothOfThatTime) {
  const double kRounding = 4e-8;  // [m], of a sum in single precision of numbers up to 0.25 m
  const Glb glb = written();
  const Json sampler = glb.sampler("cloth", "weights");
  EXPECT_EQ(sampler["interpolation"], "LINEAR");
  EXPECT_EQ(glb.floats(sampler["input"]), (std::vector<float>{0, 0.125f, 0.25f, 0.75f}));
  for (std::size_t k = 0; k < 4; ++k) {
    const std::vector<float> x = glb.at("cloth", "POSITION", k), n = glb.at("cloth", "NORMAL", k);
    const SurfaceState expected = surface_at(moving.scene.parts[0], moving.scene.instants[k]);
    ASSERT_EQ(x.size(), 3 * expected.points.size());
    for (std::size_t i = 0; i < x.size(); ++i) {
      EXPECT_NEAR(x[i], expected.points[i / 3][static_cast<int>(i % 3)], kRounding);
      EXPECT_NEAR(n[i], expected.normals[i / 3][static_cast<int>(i % 3)], 2e-7);
    }
  }
}

// Halfway between two keyframes both weights are a half, and all others nothing.
TEST_F(GlbFile, LeadsLinearlyFromOneInstantToTheNext) {
  const std::vector<float> weight = written().floats(written().sampler("cloth", "weights")["output"]);
  ASSERT_EQ(weight.size(), 4u * 3);
  for (std::size_t frame = 0; frame < 4; ++frame)
    for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(weight[3 * frame + k], frame == k + 1 ? 1 : 0);
}

TEST_F(GlbFile, HasBoundsAndPlacesThatItsNumbersKeep) {
  const Glb glb = written();
  EXPECT_EQ(glb.bytes.substr(0, 4), "glTF");
  EXPECT_EQ(word(glb.bytes, 4), 2u);
  EXPECT_EQ(word(glb.bytes, 8), glb.bytes.size());
  EXPECT_EQ(glb.binary % 4, 0u);
  std::size_t end = 0;
  for (const Json& view : glb.json["bufferViews"]) {
    EXPECT_EQ(view["byteOffset"], end);
    EXPECT_EQ(view["byteOffset"].get<std::size_t>() % 4, 0u);
    end += view["byteLength"].get<std::size_t>();
  }
  EXPECT_EQ(glb.json["buffers"][0]["byteLength"], end);
  EXPECT_EQ(glb.bytes.size(), glb.binary + end);
  for (std::size_t a = 0; a < glb.json["accessors"].size(); ++a) {
    const Json& accessor = glb.json["accessors"][a];
    if (!accessor.contains("min")) continue;
    const std::vector<float> values = glb.floats(a);
    const std::size_t components = accessor["min"].size();
    for (std::size_t c = 0; c < components; ++c) {
      float low = values[c], high = low;
      for (std::size_t i = c; i < values.size(); i += components) {
        low = std::min(low, values[i]);
        high = std::max(high, values[i]);
      }
      EXPECT_EQ(accessor["min"][c], low);
      EXPECT_EQ(accessor["max"][c], high);
    }
  }
  for (const Json& target : glb.primitive("cloth")["targets"])
    EXPECT_TRUE(glb.json["accessors"][target["POSITION"].get<std::size_t>()].contains("max"));
  EXPECT_LE(glb.bytes.size(), glb_bytes(moving.scene));
  EXPECT_GT(glb.bytes.size() * 2, glb_bytes(moving.scene));
}

TEST_F(GlbFile, TurnsZUpIntoYUpAsAWhole) {
  const Glb glb = written();
  const auto q = glb.json["nodes"][glb.json["scenes"][0]["nodes"][0].get<std::size_t>()]["rotation"]
                     .get<std::vector<float>>();
  ASSERT_EQ(q.size(), 4u);
  const Eigen::Quaternionf turn(q[3], q[0], q[1], q[2]);
  EXPECT_LT((turn * Eigen::Vector3f(1, 2, 3) - Eigen::Vector3f(1, 3, -2)).norm(), 1e-6);
  const std::size_t nodes = glb.json["nodes"].size();
  EXPECT_EQ(glb.json["nodes"][0]["children"].size(), nodes - 2) << "all but itself and the seen ball";
}

TEST_F(GlbFile, MovesAndShowsABodyAsTheSceneSays) {
  const Glb glb = written();
  const auto places = glb.floats(glb.sampler("sphere_1", "translation")["output"]),
             turns = glb.floats(glb.sampler("sphere_1", "rotation")["output"]),
             scales = glb.floats(glb.sampler("sphere_1", "scale")["output"]),
             seen = glb.floats(glb.sampler("sphere_1_seen", "scale")["output"]);
  EXPECT_NEAR(places[0], 0.1, 1e-6);
  EXPECT_NEAR(places[6], 0.15, 1e-6);
  EXPECT_NEAR(turns[4 * 2 + 1], std::sqrt(0.5), 1e-6);
  EXPECT_NEAR(turns[4 * 2 + 3], std::sqrt(0.5), 1e-6) << "the real part comes last";
  EXPECT_EQ(scales[6], MovingScene::kGrows);
  EXPECT_EQ(seen, (std::vector<float>{0, 0, 0, 1, 1, 1, 1, 1, 1, 0, 0, 0}));
  EXPECT_EQ(glb.sampler("sphere_1_seen", "scale")["interpolation"], "STEP");
  const Json above = glb.node("sphere_1_seen");
  EXPECT_EQ(glb.json["nodes"][above["children"][0].get<std::size_t>()]["name"], "sphere_1");
  EXPECT_EQ(above["scale"], Json({0, 0, 0})) << "at the start";
  EXPECT_TRUE(glb.sampler("ground_2", "translation").is_null());
}

TEST_F(GlbFile, HasACameraAndAMatteMaterialOfBothSides) {
  const Glb glb = written();
  const Json camera = glb.json["cameras"][0]["perspective"];
  EXPECT_NEAR(camera["yfov"].get<double>() * 180 / std::numbers::pi, moving.setup.options.camera_fov, 1e-4);
  EXPECT_NEAR(camera["aspectRatio"].get<double>(), 4.0 / 3, 1e-6);
  const auto eye = glb.node("camera")["translation"].get<std::vector<float>>();
  const auto q = glb.node("camera")["rotation"].get<std::vector<float>>();
  const render::Camera& expected = moving.scene.view.camera;
  EXPECT_EQ(Eigen::Vector3f(eye[0], eye[1], eye[2]), expected.eye());
  const Eigen::Vector3f looks = Eigen::Quaternionf(q[3], q[0], q[1], q[2]) * -Eigen::Vector3f::UnitZ();
  EXPECT_LT((looks - expected.forward()).norm(), 1e-5);
  const Json& material = glb.json["materials"][glb.primitive("cloth")["material"].get<std::size_t>()];
  EXPECT_EQ(material["doubleSided"], true);
  EXPECT_EQ(material["pbrMetallicRoughness"]["metallicFactor"], 0);
}

TEST_F(GlbFile, TextureRunsFromTheTop) {
  const Glb glb = written();
  const auto uv = glb.floats(glb.primitive("cloth")["attributes"]["TEXCOORD_0"]);
  ASSERT_EQ(uv.size(), 2 * moving.mesh.rest.size());
  for (std::size_t v = 0; v < moving.mesh.rest.size(); ++v) {
    EXPECT_FLOAT_EQ(uv[2 * v], static_cast<float>(moving.mesh.rest[v].x()));
    EXPECT_FLOAT_EQ(uv[2 * v + 1], 1 - static_cast<float>(moving.mesh.rest[v].y()));
  }
}

// Each of two seams of a tube of two panels doubles its vertices.
TEST_F(GlbFile, AVertexOfASeamIsThereOnceForEachPlaceInTheTexture) {
  using Tube = test::PanelTube;
  Tube tube;
  tube.second = Tube::moved;
  const ClothMesh mesh = tube.mesh();
  AnimatedPart& cloth = moving.scene.parts[0];
  cloth = animated_cloth(mesh, ClothShape(), moving.scene.view);
  cloth.points_at = [&](const Instant& at) {
    std::vector<Eigen::Vector3f> points;
    for (const Eigen::Vector3d& x : mesh.rest)
      points.push_back(x.cast<float>() + static_cast<float>(at.time) * Eigen::Vector3f::UnitZ());
    return points;
  };
  const Glb glb = written();
  const auto x = glb.at("cloth", "POSITION", 3),
             uv = glb.floats(glb.primitive("cloth")["attributes"]["TEXCOORD_0"]);
  const auto corner = glb.array<std::uint32_t>(glb.primitive("cloth")["indices"]);
  EXPECT_EQ(x.size() / 3, mesh.rest.size() + 2 * (Tube::kAlong + 1));
  ASSERT_EQ(corner.size(), 3 * mesh.face.size());
  for (std::size_t i = 0; i < corner.size(); ++i) {
    const Eigen::Vector3d& rest = mesh.rest[static_cast<std::size_t>(mesh.face[i / 3][i % 3])];
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(x[3 * corner[i] + c], rest[static_cast<int>(c)] + (c == 2 ? 0.75 : 0), 1e-7);
    EXPECT_EQ(uv[2 * corner[i]], mesh.panel[i / 3][i % 3].x());
  }
}

TEST_F(GlbFile, OfOneInstantStandsStill) {
  moving.scene.instants.resize(1);
  const Glb glb = written();
  EXPECT_FALSE(glb.json.contains("animations"));
  EXPECT_FALSE(glb.primitive("cloth").contains("targets"));
  EXPECT_EQ(glb.node("sphere_1_seen")["scale"], Json({0, 0, 0}));
}

// As a body of triangles with a motion of its own would be.
TEST_F(GlbFile, AnotherPartMayChangeItsShape) {
  AnimatedPart other = moving.scene.parts[0];
  other.name = "other";
  moving.scene.parts.push_back(other);
  const Glb glb = written();
  EXPECT_EQ(glb.primitive("other")["targets"].size(), 3u);
  EXPECT_EQ(glb.at("other", "POSITION", 2), glb.at("cloth", "POSITION", 2));
}

TEST_F(GlbFile, GrowsBy24BytesAVertexAndInstant) {
  const std::size_t whole = glb_bytes(moving.scene);
  moving.scene.instants.pop_back();
  const std::size_t grown = whole - glb_bytes(moving.scene);
  EXPECT_GT(grown, 24 * moving.mesh.rest.size());
  EXPECT_LT(grown, 24 * moving.mesh.rest.size() + 1500) << "and its description";
}

TEST_F(GlbFile, IsKnownToBeTooLargeBeforeItIsWritten) {
  moving.scene.parts.resize(1);
  moving.scene.instants.clear();
  for (std::size_t k = 0; k < 40000; ++k) moving.scene.instants.push_back({static_cast<double>(k), 0});
  EXPECT_GT(glb_bytes(moving.scene), kMostGlbBytes) << "weights alone are 6.4 GB";
  halve(moving.scene.instants);
  EXPECT_LT(glb_bytes(moving.scene), kMostGlbBytes);
}

}  // namespace
}  // namespace hysteron::experiments
