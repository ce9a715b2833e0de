#include "render/png_writer.h"

#include "tests/render/test_scene.h"

namespace hysteron::render {
namespace {

std::string frame(int i) { return "frame" + std::to_string(i) + ".png"; }

TEST(PngWriter, WritesEveryPictureThatItWasGiven) {
  const Folder folder;
  PngWriter writer(2, 3);
  for (int i = 0; i < 20; ++i)
    writer.write(folder.file(frame(i)), Image(40, 30, Rgb8{static_cast<std::uint8_t>(i), 0, 0}));
  writer.finish();
  EXPECT_GT(writer.encode_seconds(), 0);
  for (int i = 0; i < 20; ++i) EXPECT_EQ(read_png(folder.file(frame(i))).at(5, 5)[0], i);
}

TEST(PngWriter, FinishReportsTheFirstErrorAndKeepsTheOtherPictures) {
  const Folder folder;
  PngWriter writer(1, 8);
  writer.write(folder.file("good.png"), Image(4, 4));
  writer.write(folder.file("none/bad.png"), Image(4, 4));
  const Error error = thrown_error([&] { writer.finish(); });
  EXPECT_EQ(error.exit_code(), 1);
  EXPECT_TRUE(says(error.what(), "none/bad.png"));
  EXPECT_EQ(folder.names(), std::vector<std::string>{"good.png"});
}

TEST(PngWriter, WriteStopsARunAfterAnError) {
  const Folder folder;
  PngWriter writer(1, 2);
  const Error error = thrown_error([&] {
    for (int i = 0; i < 1000; ++i) writer.write(folder.file("none/bad.png"), Image(4, 4));
  });
  EXPECT_EQ(error.exit_code(), 1);
}

}  // namespace
}  // namespace hysteron::render
