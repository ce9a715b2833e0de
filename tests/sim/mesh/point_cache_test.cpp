#include "sim/mesh/mesh_export.h"

#include <gtest/gtest.h>

#include <cstring>

#include "sim/base/error.h"
#include "tests/sim/base/folder.h"
#include "tests/sim/base/refusal.h"

namespace hysteron {
namespace {

using Positions = std::vector<Eigen::Vector3d>;

template <class T>
T at(const std::string& bytes, std::size_t offset) {
  T value;
  std::memcpy(&value, bytes.data() + offset, sizeof(T));
  return value;
}

// The file is as Blender's `Mesh Cache` reads it: signature, version, points, first frame, step, samples,
// positions.
TEST(PointCache, HoldsEachInstantAndMayGoOnFromAnEarlierOne) {
  const test::Folder folder;
  const std::string file = folder.file("cloth.pc2");
  const auto positions = [](double at) { return Positions{{at, 0, 1}, {0, at, 2}}; };
  for (int k = 0; k < 3; ++k) write_to_point_cache(file, k, positions(k));
  write_to_point_cache(file, 1, positions(5));
  EXPECT_EQ(at<std::int32_t>(test::file_content(file), 28), 2) << "what lay behind no longer counts";
  write_to_point_cache(file, 2, positions(7));
  const std::string bytes = test::file_content(file);
  ASSERT_EQ(bytes.size(), 32 + 3 * 2 * 12u);
  EXPECT_STREQ(bytes.c_str(), "POINTCACHE2");
  EXPECT_EQ(at<std::int32_t>(bytes, 12), 1);
  EXPECT_EQ(at<std::int32_t>(bytes, 16), 2);
  EXPECT_EQ(at<float>(bytes, 20), 0);
  EXPECT_EQ(at<float>(bytes, 24), 1);
  EXPECT_EQ(at<std::int32_t>(bytes, 28), 3);
  const float x[] = {0, 5, 7};
  for (int k = 0; k < 3; ++k) {
    const std::size_t begin = 32 + k * 24;
    EXPECT_EQ(at<float>(bytes, begin), x[k]);
    EXPECT_EQ(at<float>(bytes, begin + 16), x[k]);
    EXPECT_EQ(at<float>(bytes, begin + 20), 2);
  }
}

TEST(PointCache, GivesBackEachInstant) {
  const test::Folder folder;
  const std::string file = folder.file("cloth.pc2");
  for (int k = 0; k < 3; ++k) write_to_point_cache(file, k, {{0.1 * k, 0, 1}, {0, 2, 0.1 * k}});
  for (std::size_t k = 0; k < 3; ++k) {
    const std::vector<Eigen::Vector3f> x = read_from_point_cache(file, k);
    ASSERT_EQ(x.size(), 2u);
    EXPECT_EQ(x[0], Eigen::Vector3d(0.1 * static_cast<double>(k), 0, 1).cast<float>());
    EXPECT_EQ(x[1].y(), 2);
  }
  EXPECT_TRUE(
      test::says(test::refusal([&] { read_from_point_cache(file, 3); }, 1), "3 instants and not number 3"));
  std::filesystem::resize_file(file, std::filesystem::file_size(file) - 1);
  EXPECT_TRUE(test::says(test::refusal([&] { read_from_point_cache(file, 2); }, 1), "cut off"));
  EXPECT_THROW(read_from_point_cache(folder.file("none.pc2"), 0), Error);
}

TEST(PointCache, DoesNotGoOnInAFileThatIsGone) {
  const test::Folder folder;
  EXPECT_THROW(write_to_point_cache(folder.file("cloth.pc2"), 1, {{0, 0, 0}}), Error);
}

}  // namespace
}  // namespace hysteron
