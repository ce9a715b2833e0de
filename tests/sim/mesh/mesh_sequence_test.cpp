// Which files are a sequence, in which order and under which name; thread coordinates of a frame.
#include "sim/mesh/mesh_sequence.h"

#include <gtest/gtest.h>

#include "tests/sim/base/folder.h"
#include "tests/sim/base/refusal.h"

namespace hysteron {
namespace {
namespace fs = std::filesystem;

// Writes an empty file, in a folder of its own if its name says so.
std::string touch(const test::Folder& folder, const std::string& name) {
  fs::create_directories(fs::path(folder.file(name)).parent_path());
  return folder.write(name, "");
}

TEST(MeshSequences, FoldersAreInNaturalOrderAndNamedApart) {
  const test::Folder folder;
  for (const char* name :
       {"a/mesh/f10.obj", "a/mesh/f9.obj", "a/mesh/f0100.obj", "a/mesh/readme.txt", "b/a/x.PLY"})
    touch(folder, name);
  const auto sequences = mesh_sequences({folder.file("a/"), folder.file("a/mesh"), folder.file("b/a")});
  ASSERT_EQ(sequences.size(), 3u);
  EXPECT_EQ(sequences[0].name, "a");
  EXPECT_EQ(sequences[1].name, "a-2");
  EXPECT_EQ(sequences[2].name, "a-3");
  std::vector<std::string> names;
  for (const auto& file : sequences[0].files) names.push_back(file.filename());
  EXPECT_EQ(names, (std::vector<std::string>{"f9.obj", "f10.obj", "f0100.obj"}));
}

TEST(MeshSequences, NumbersAreThoseThatTellTheFilesApart) {
  const auto numbers = [](const std::vector<const char*>& names) {
    const test::Folder folder;
    for (const char* name : names) touch(folder, std::string("s/") + name);
    return mesh_sequences({folder.file("s")})[0].number;
  };
  using Numbers = std::vector<std::int64_t>;
  EXPECT_EQ(numbers({"v2_f0001_a.obj", "v2_f0005_a.obj", "v2_f12_a.obj"}), (Numbers{1, 5, 12}));
  EXPECT_EQ(numbers({"a1.obj", "b2.obj"}), Numbers{});
  EXPECT_EQ(numbers({"t0.9.obj", "t1.0.obj"}), Numbers{});
  EXPECT_EQ(numbers({"f1.obj", "f01.obj"}), Numbers{});
  EXPECT_EQ(numbers({"f12345678901234567890.obj", "f2.obj"}), Numbers{});
}

// The files 0, 1, 5 would be frames 0, 1, 2 if their numbers were ignored.
TEST(MeshSequences, AnOddNameInAFolderIsRefusedAndAmongFilesSaid) {
  const test::Folder folder;
  std::vector<std::string> files;
  for (const char* name : {"s/f0.obj", "s/f1.obj", "s/f5.obj", "s/rest.obj"})
    files.push_back(touch(folder, name));
  EXPECT_EQ(
      test::refusal([&] { mesh_sequences({folder.file("s")}); }),
      "sequence " + folder.file("s") +
          ": rest.obj is not named like f0.obj, whose number is its frame: take it out of the folder, or "
          "name the files one by one in their order");
  EXPECT_EQ(mesh_sequences(files)[0].unnumbered, "rest.obj is not named like f0.obj");
  EXPECT_EQ(mesh_sequences({files[1], files[0]})[0].unnumbered, "f0.obj stands behind f1.obj");
}

TEST(MeshSequences, FilesAreOneSequenceInTheOrderGiven) {
  const test::Folder folder;
  const std::string a = touch(folder, "set/a.obj"), b = touch(folder, "set/b.obj");
  const auto sequences = mesh_sequences({b, a});
  ASSERT_EQ(sequences.size(), 1u);
  EXPECT_EQ(sequences[0].name, "set");
  EXPECT_EQ(sequences[0].files, (std::vector<fs::path>{b, a}));
  EXPECT_EQ(mesh_sequences({a})[0].name, "a");
}

TEST(Threads, FollowTheTextureOrTheAxesAlongWhichTheSurfaceExtends) {
  Surface upright;
  upright.vertex = {{0, 0, 0}, {0.2, 0.01, 0}, {0, 0, 0.3}};
  upright.face = {{0, 1, 2}};
  EXPECT_EQ(thread_coordinates(upright), (std::vector<float>{0, 0, 0.2f, 0, 0, 0.3f}));
  // A texture in lengths is taken as it is, one that runs from 0 to 1 is scaled to the surface's area.
  Surface flat;
  flat.vertex = {{0, 0, 0}, {0.5, 0, 0}, {0, 0.5, 0}};
  flat.face = {{0, 1, 2}};
  flat.pattern = {{0, 0}, {0.51, 0}, {0, 0.51}};
  EXPECT_EQ(thread_coordinates(flat)[2], 0.51f);
  flat.pattern = {{0, 0}, {1, 0}, {0, 1}};
  EXPECT_EQ(thread_coordinates(flat), (std::vector<float>{0, 0, 0.5f, 0, 0, 0.5f}));
}

}  // namespace
}  // namespace hysteron
