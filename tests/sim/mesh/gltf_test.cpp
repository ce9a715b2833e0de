#include "sim/mesh/gltf.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "sim/base/error.h"
#include "tests/sim/base/folder.h"

namespace hysteron {
namespace {

using Json = nlohmann::json;

std::uint32_t word(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

// A file as the specification says that it is read.
struct Glb {
  std::string bytes;
  Json json;
  std::size_t binary;  // where the buffer begins

  explicit Glb(const std::string& file) : bytes(test::content_of(file)), binary(28 + word(bytes, 12)) {
    json = Json::parse(bytes.substr(20, word(bytes, 12)));
  }
  std::vector<float> floats(std::size_t accessor) const {
    const Json& view = json["bufferViews"][json["accessors"][accessor]["bufferView"].get<std::size_t>()];
    std::vector<float> values(view["byteLength"].get<std::size_t>() / sizeof(float));
    std::memcpy(values.data(), bytes.data() + binary + view["byteOffset"].get<std::size_t>(),
                values.size() * sizeof(float));
    return values;
  }
  const Json& primitive() const { return json["meshes"][0]["primitives"][0]; }
  const Json& sampler() const { return json["animations"][0]["samplers"][0]; }
  std::vector<float> at_time(const char* attribute, const char* target, std::size_t frame) const {
    std::vector<float> values = floats(primitive()["attributes"][attribute]);
    const std::size_t targets = primitive()["targets"].size();
    const std::vector<float> weight = floats(sampler()["output"]);
    for (std::size_t k = 0; k < targets; ++k) {
      const std::vector<float> change = floats(primitive()["targets"][k][target]);
      for (std::size_t i = 0; i < values.size(); ++i) values[i] += weight[frame * targets + k] * change[i];
    }
    return values;
  }
};

// A square that is rolled up about the y axis, to a cylinder of this curvature [1/m].
ClothFrame rolled(const ClothMesh& mesh, double time, double curvature) {
  ClothFrame frame{time, {}};
  for (const Eigen::Vector3d& x : mesh.rest) {
    const double angle = curvature * x.x();
    const Eigen::Vector3d at = curvature == 0 ? x
                                              : Eigen::Vector3d(std::sin(angle) / curvature, x.y(),
                                                                (1 - std::cos(angle)) / curvature);
    for (const double c : at) frame.xyz.push_back(static_cast<float>(c));
  }
  return frame;
}

class Gltf : public ::testing::Test {
 protected:
  const test::Folder folder;
  const ClothMesh mesh = make_rectangle(0.1, 0.1, 200, MeshFamily::random, 1);
  const std::vector<ClothFrame> frames = {rolled(mesh, 0.5, 0), rolled(mesh, 0.6, 5), rolled(mesh, 0.8, 10)};
  Glb written() const {
    const std::string file = folder.file("cloth.glb");
    write_glb(file, mesh, frames);
    return Glb(file);
  }
};

TEST_F(Gltf, IsWhereItsWeightsAreOneTheClothOfThatTimeWithYUp) {
  const double kRounding = 2e-8;  // [m], of a sum in single precision of numbers up to 0.1 m
  const Glb glb = written();
  EXPECT_EQ(glb.floats(glb.sampler()["input"]), (std::vector<float>{0.5F, 0.6F, 0.8F}));
  EXPECT_EQ(glb.sampler()["interpolation"], "LINEAR");
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const std::vector<float> x = glb.at_time("POSITION", "POSITION", k);
    ASSERT_EQ(x.size(), 3 * mesh.rest.size());
    for (std::size_t v = 0; v < mesh.rest.size(); ++v) {
      const float* const expected = &frames[k].xyz[3 * v];
      EXPECT_NEAR(x[3 * v], expected[0], kRounding);
      EXPECT_NEAR(x[3 * v + 1], expected[2], kRounding);
      EXPECT_NEAR(x[3 * v + 2], -expected[1], kRounding);
    }
  }
}

// Where the faces around a vertex lie opposite to each other, their mean normal is the cylinder's to second
// order in the angle between neighbouring vertices.
TEST_F(Gltf, TurnsTheNormalsWithTheCloth) {
  const double kCurvature = 10, kEdge = 0.01, kFacets = std::pow(kCurvature * kEdge, 2);
  const ClothMesh grid = make_grid(0.1, 0.1, 10, 10, MeshFamily::aligned, 1);
  const std::string file = folder.file("grid.glb");
  write_glb(file, grid, {rolled(grid, 0, 0), rolled(grid, 1, kCurvature)});
  const Glb glb(file);
  const std::vector<float> flat = glb.at_time("NORMAL", "NORMAL", 0),
                           bent = glb.at_time("NORMAL", "NORMAL", 1);
  int inside = 0;
  for (std::size_t v = 0; v < grid.rest.size(); ++v) {
    EXPECT_EQ(flat[3 * v + 1], 1);
    const Eigen::Vector3d& x = grid.rest[v];
    if (std::min(x.x(), x.y()) < kEdge / 2 || std::max(x.x(), x.y()) > 0.1 - kEdge / 2) continue;
    ++inside;
    EXPECT_NEAR(bent[3 * v], -std::sin(kCurvature * x.x()), kFacets);
    EXPECT_NEAR(bent[3 * v + 1], std::cos(kCurvature * x.x()), kFacets);
  }
  EXPECT_EQ(inside, 9 * 9);
}

TEST_F(Gltf, HasBoundsAndPlacesThatItsNumbersKeep) {
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
  for (std::size_t a = 1; a < glb.json["accessors"].size(); ++a) {
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
  for (const Json& target : glb.primitive()["targets"])
    EXPECT_TRUE(glb.json["accessors"][target["POSITION"].get<std::size_t>()].contains("max"));
}

TEST_F(Gltf, GrowsBy24BytesAVertexAndInstant) {
  const std::string one = folder.file("one.glb"), two = folder.file("two.glb");
  const std::size_t weights = sizeof(float) * (3 * 2 - 2 * 1), times = sizeof(float);
  write_glb(one, mesh, {frames[0], frames[1]});
  write_glb(two, mesh, frames);
  const Glb first(one), second(two);
  EXPECT_EQ(second.bytes.size() - second.binary - (first.bytes.size() - first.binary),
            kMorphBytes * mesh.rest.size() + weights + times);
}

TEST_F(Gltf, OfOneInstantStandsStill) {
  const std::string file = folder.file("still.glb");
  write_glb(file, mesh, {frames[0]});
  const Glb glb(file);
  EXPECT_FALSE(glb.json.contains("animations"));
  EXPECT_FALSE(glb.primitive().contains("targets"));
}

TEST_F(Gltf, RefusesTimesThatDoNotAscend) {
  const Error why = test::error_of([&] { write_glb(folder.file("x.glb"), mesh, {frames[0], frames[0]}); });
  EXPECT_NE(std::string(why.what()).find("0.5 s does not come after 0.5 s"), std::string::npos) << why.what();
  EXPECT_TRUE(folder.names().empty());
}

TEST_F(Gltf, RefusesAKeyframeOfAnotherSize) {
  const Error why = test::error_of([&] {
    write_glb(folder.file("x.glb"), mesh, {frames[0], {1, {0, 0, 0}}});
  });
  EXPECT_NE(std::string(why.what()).find("1 positions for"), std::string::npos) << why.what();
}

}  // namespace
}  // namespace hysteron
