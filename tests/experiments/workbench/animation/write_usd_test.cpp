// The text of a USD file; tests/animation.py has OpenUSD read one.
#include "experiments/workbench/animation/write_usd.h"

#include <regex>
#include <sstream>

#include "tests/experiments/folder.h"
#include "tests/experiments/workbench/animation/moving_scene.h"

namespace hysteron::experiments {
namespace {

Numbers numbers_in_text(std::string text) {
  for (char& c : text)
    if (c == '(' || c == ')' || c == '[' || c == ']' || c == ',') c = ' ';
  std::istringstream stream(text);
  Numbers numbers;
  for (double x; stream >> x;) numbers.push_back(x);
  return numbers;
}

class UsdFile : public testing::Test {
 protected:
  std::string written() const {
    const Folder folder;
    const std::string file = folder.file("cloth.usda");
    write_usd(file, moving.scene);
    return file_content(file);
  }
  // Returns the text between the braces of `def TYPE "NAME"`.
  static std::string prim(const std::string& text, const std::string& name) {
    std::size_t at = text.find("{\n", text.find("def " + name)), end = at;
    for (int open = 1; open > 0 && end != text.npos;) {
      end = text.find_first_of("{}", end + 1);
      if (end != text.npos) open += text[end] == '{' ? 1 : -1;
    }
    return text.substr(at, end - at);
  }
  // Returns the values of a sampled attribute by time code, as texts.
  static std::map<double, std::string> samples(const std::string& prim, const std::string& attribute) {
    std::map<double, std::string> values;
    const std::size_t begin = prim.find(" " + attribute + ".timeSamples = {\n");
    if (begin == prim.npos) return values;
    std::istringstream lines(prim.substr(prim.find('\n', begin) + 1));
    for (std::string line; std::getline(lines, line) && line.find('}') == line.npos;) {
      const std::size_t colon = line.find(": ");
      values[std::stod(line.substr(0, colon))] = line.substr(colon + 2);
    }
    return values;
  }
  // Returns the value of an attribute without samples.
  static std::string value(const std::string& prim, const std::string& attribute) {
    const std::size_t at = prim.find(" " + attribute + " = ");
    if (at == prim.npos) return "";
    const std::size_t begin = at + attribute.size() + 4;
    return prim.substr(begin, prim.find('\n', begin) - begin);
  }

  MovingScene moving;
};

TEST_F(UsdFile, StatesUnitsUpAxisAndTimes) {
  const std::string text = written(), head = text.substr(0, text.find("def "));
  EXPECT_TRUE(text.starts_with("#usda 1.0\n"));
  EXPECT_TRUE(says(head, "metersPerUnit = 1\n", "upAxis = \"Z\"", "defaultPrim = \"run\""));
  EXPECT_TRUE(says(head, "timeCodesPerSecond = 8\n", "framesPerSecond = 8\n", "startTimeCode = 0\n",
                   "endTimeCode = 6\n"));
  EXPECT_EQ(occurrences(text, "{"), occurrences(text, "}"));
  EXPECT_TRUE(says(text, "def Xform \"run\"\n"));
}

TEST_F(UsdFile, HasTheClothOfEachInstantAtItsTimeCode) {
  const std::string cloth = prim(written(), "Mesh \"cloth\"");
  const auto points = samples(cloth, "point3f[] points"), normals = samples(cloth, "normal3f[] normals"),
             extents = samples(cloth, "float3[] extent");
  ASSERT_EQ(points.size(), 4u);
  ASSERT_EQ(normals.size(), 4u);
  ASSERT_EQ(extents.size(), 4u);
  for (std::size_t k = 0; k < 4; ++k) {
    const double code = MovingScene::kRate * MovingScene::kTimes[k];
    ASSERT_TRUE(points.contains(code)) << code;
    const Numbers x = numbers_in_text(points.at(code)), n = numbers_in_text(normals.at(code)),
                  box = numbers_in_text(extents.at(code));
    const std::vector<Eigen::Vector3f> expected = moving.points(k);
    ASSERT_EQ(x.size(), 3 * expected.size());
    ASSERT_EQ(n.size(), 3 * expected.size());
    ASSERT_EQ(box.size(), 6u);
    for (std::size_t v = 0; v < expected.size(); ++v) {
      double length = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_EQ(static_cast<float>(x[3 * v + c]), expected[v][static_cast<int>(c)]) << "to the last bit";
        EXPECT_TRUE(box[c] <= x[3 * v + c] && x[3 * v + c] <= box[3 + c]);
        length += n[3 * v + c] * n[3 * v + c];
      }
      EXPECT_NEAR(length, 1, 1e-4);
    }
  }
}

TEST_F(UsdFile, HasTheClothsTrianglesAndTexture) {
  const std::string cloth = prim(written(), "Mesh \"cloth\"");
  EXPECT_EQ(value(cloth, "uniform token subdivisionScheme"), "\"none\"");
  EXPECT_EQ(value(cloth, "uniform bool doubleSided"), "1");
  EXPECT_TRUE(says(cloth, "normal3f[] normals (interpolation = \"vertex\")"));
  const Numbers counts = numbers_in_text(value(cloth, "int[] faceVertexCounts")),
                corners = numbers_in_text(value(cloth, "int[] faceVertexIndices")),
                st = numbers_in_text(value(cloth, "texCoord2f[] primvars:st"));
  EXPECT_EQ(counts, Numbers(moving.mesh.face.size(), 3));
  ASSERT_EQ(corners.size(), 3 * moving.mesh.face.size());
  for (std::size_t i = 0; i < corners.size(); ++i) EXPECT_EQ(corners[i], moving.mesh.face[i / 3][i % 3]);
  ASSERT_EQ(st.size(), 2 * moving.mesh.rest.size());
  EXPECT_EQ(st[2], moving.mesh.rest[1].x());
  EXPECT_TRUE(says(value(cloth, "texCoord2f[] primvars:st"), "(interpolation = \"vertex\")"));
  EXPECT_TRUE(says(cloth, "color3f[] primvars:displayColor = [("));
}

TEST_F(UsdFile, MovesAndShowsABodyAsTheSceneSays) {
  const std::string text = written(), ball = prim(text, "Mesh \"sphere_1\"");
  EXPECT_TRUE(says(value(ball, "uniform token[] xformOpOrder"), "translate", "orient", "scale"));
  const auto places = samples(ball, "double3 xformOp:translate"),
             turns = samples(ball, "quatf xformOp:orient"), scales = samples(ball, "float3 xformOp:scale");
  ASSERT_EQ(places.size(), 4u);
  ASSERT_EQ(turns.size(), 4u);
  ASSERT_EQ(scales.size(), 4u);
  EXPECT_NEAR(numbers_in_text(places.at(0)).at(0), 0.1, 1e-6);
  EXPECT_NEAR(numbers_in_text(places.at(2)).at(0), 0.15, 1e-6);
  const Numbers quarter = numbers_in_text(turns.at(2));
  ASSERT_EQ(quarter.size(), 4u);
  EXPECT_NEAR(quarter[0], std::sqrt(0.5), 1e-6) << "the real part comes first";
  EXPECT_NEAR(quarter[2], std::sqrt(0.5), 1e-6);
  EXPECT_EQ(numbers_in_text(scales.at(2)), Numbers(3, MovingScene::kGrows));
  const auto seen = samples(ball, "token visibility");
  ASSERT_EQ(seen.size(), 3u);
  EXPECT_EQ(seen.at(0), "\"invisible\",");
  EXPECT_EQ(seen.at(1), "\"inherited\",") << "0.125 s";
  EXPECT_EQ(seen.at(6), "\"invisible\",") << "0.75 s";
  EXPECT_FALSE(says(prim(text, "Mesh \"ground_2\""), "timeSamples")) << "what does not change is stated once";
}

TEST_F(UsdFile, LooksFromThePicturesCamera) {
  const std::string camera = prim(written(), "Camera \"camera\"");
  const double focal = std::stod(value(camera, "float focalLength")),
               height = std::stod(value(camera, "float verticalAperture")),
               width = std::stod(value(camera, "float horizontalAperture"));
  EXPECT_NEAR(2 * std::atan(height / 2 / focal) * 180 / std::numbers::pi, moving.setup.options.camera_fov,
              1e-4);
  EXPECT_NEAR(width / height, 4.0 / 3, 1e-6);
  EXPECT_NEAR(height / 10, 0.024, 1e-9) << "film of 24 mm, in tenths of the unit";
  const Numbers rows = numbers_in_text(value(camera, "matrix4d xformOp:transform"));
  ASSERT_EQ(rows.size(), 16u);
  const render::Camera& expected = moving.scene.view.camera;
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(rows[static_cast<std::size_t>(12 + c)], expected.eye()[c], 1e-5)
        << "the last row is the place";
    EXPECT_NEAR(rows[static_cast<std::size_t>(8 + c)], -expected.forward()[c], 1e-5) << "it looks along -z";
  }
}

// The format's own number of time codes a second is 24.
TEST_F(UsdFile, OfNoRateHasTheFormats) {
  moving.scene.rate = 0;
  const std::string text = written();
  EXPECT_TRUE(says(text, "timeCodesPerSecond = 24\n", "endTimeCode = 18\n"));
}

TEST_F(UsdFile, OfFramesThatSumsOfStepsMissByRoundingHasWholeTimeCodes) {
  moving.scene.rate = 30;
  double time = 0;
  for (int step = 0; step < 100; ++step) time += 1e-3;
  EXPECT_NE(time * 30, 3.0);
  EXPECT_EQ(time_code(moving.scene, time), 3.0);
}

// As a body of triangles with a motion of its own would be.
TEST_F(UsdFile, AnotherPartMayChangeItsShape) {
  AnimatedPart other = moving.scene.parts[0];
  other.name = "other";
  moving.scene.parts.push_back(other);
  EXPECT_EQ(samples(prim(written(), "Mesh \"other\""), "point3f[] points").size(), 4u);
}

TEST_F(UsdFile, IsNotThereWhereAnInstantCannotBeRead) {
  const Folder folder;
  moving.scene.parts[0].points_at = [&](const Instant& at) {
    if (at.number == 2) throw Error::system("gone");
    return moving.points(at.number);
  };
  EXPECT_THROW(write_usd(folder.file("cloth.usda"), moving.scene), Error);
  EXPECT_TRUE(folder.names().empty());
}

}  // namespace
}  // namespace hysteron::experiments
