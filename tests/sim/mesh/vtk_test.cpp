#include "sim/mesh/mesh_export.h"

#include <gtest/gtest.h>

#include <cstring>

#include "sim/mesh/builders.h"
#include "tests/sim/base/folder.h"
#include "tests/sim/base/refusal.h"

namespace hysteron {
namespace {

// The numbers that stand behind the header where the array of that name says.
std::vector<double> numbers(const std::string& file, const std::string& name) {
  const std::size_t element = file.find("Name=\"" + name + "\"");
  const std::string key = "offset=\"";
  const std::size_t offset = std::stoul(file.substr(file.find(key, element) + key.size()));
  const std::string begin = "<AppendedData encoding=\"raw\">\n_";
  const char* at = file.data() + file.find(begin) + begin.size() + offset;
  std::uint64_t bytes = 0;
  std::memcpy(&bytes, at, sizeof bytes);
  std::vector<double> result(bytes / sizeof(double));
  std::memcpy(result.data(), at + sizeof bytes, bytes);
  return result;
}

TEST(Vtp, HoldsPositionsAndFieldsWhereItsHeaderSays) {
  const test::Folder folder;
  const ClothMesh mesh = make_rectangle(0.1, 0.2, 20, MeshFamily::random, 1);
  std::vector<double> numbered(mesh.face.size());
  for (std::size_t f = 0; f < numbered.size(); ++f) numbered[f] = static_cast<double>(f);
  const std::string file = folder.file("cloth.vtp");
  write_vtp(file, mesh, mesh.rest, {}, {{"number", 1, numbered}});
  const std::string text = test::file_content(file);
  const std::vector<double> position = numbers(text, "position");
  ASSERT_EQ(position.size(), 3 * mesh.rest.size());
  for (std::size_t v = 0; v < mesh.rest.size(); ++v)
    for (int k = 0; k < 3; ++k) EXPECT_EQ(position[3 * v + k], mesh.rest[v][k]);
  EXPECT_EQ(numbers(text, "number"), numbered);
  EXPECT_TRUE(test::says(text, "NumberOfPolys=\"" + std::to_string(mesh.faces()) + "\""));
}

TEST(Vtp, RefusesAFieldOfAnotherSize) {
  const test::Folder folder;
  const ClothMesh mesh = make_rectangle(0.1, 0.1, 8, MeshFamily::aligned, 1);
  const auto write = [&] { write_vtp(folder.file("x.vtp"), mesh, mesh.rest, {{"speed", 1, {1, 2}}}, {}); };
  EXPECT_TRUE(test::says(test::refusal(write), "2 values of speed"));
  EXPECT_TRUE(folder.names().empty());
}

TEST(Pvd, GivesEachInstantItsTime) {
  const test::Folder folder;
  write_pvd(folder.file("cloth.pvd"), {{0, "0000.vtp"}, {0.1, "0001.vtp"}});
  EXPECT_TRUE(test::says(test::file_content(folder.file("cloth.pvd")),
                         "timestep=\"0.1\" part=\"0\" file=\"0001.vtp\""));
}

}  // namespace
}  // namespace hysteron
