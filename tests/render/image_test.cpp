#include "render/image.h"

#include <zlib.h>

#include <fstream>

#include "render/srgb.h"
#include "tests/render/test_scene.h"
#include "tests/sim/base/small_disk.h"

namespace hysteron::render {
namespace {

Image gradient(int width, int height, int channels) {
  Image image(width, height, channels);
  for (size_t i = 0; i < image.pixels().size(); ++i)
    image.pixels()[i] = static_cast<std::uint8_t>(i * 7 + i / 256);
  return image;
}

TEST(Png, KeepsEveryByteInBothFormatsAndEfforts) {
  const Folder folder;
  for (const int channels : {3, 4})
    for (const PngEffort effort : {PngEffort::fast, PngEffort::best}) {
      const Image image = gradient(61, 37, channels);
      write_png(folder.file("a.png"), image, effort);
      EXPECT_EQ(read_png(folder.file("a.png")), image);
    }
  EXPECT_EQ(folder.names(), std::vector<std::string>{"a.png"});
}

TEST(Png, AMissingFolderIsTheMachinesFailure) {
  const Folder folder;
  const Error error = thrown_error([&] { write_png(folder.file("none/a.png"), Image(2, 2)); });
  EXPECT_EQ(error.exit_code(), 1);
  EXPECT_TRUE(says(error.what(), "none/a.png"));
  EXPECT_TRUE(folder.names().empty());
}

TEST(Png, AFullDiskLeavesTheOldPictureAndNoHalfOne) {
  const Folder folder;
  const Image old = gradient(8, 8, 3);
  write_png(folder.file("a.png"), old);
  const Image large = gradient(400, 300, 3);
  ASSERT_GT(encode_png(large).size(), 4096u);
  {
    const hysteron::test::SmallDisk disk(4096);
    EXPECT_EQ(thrown_error([&] { write_png(folder.file("a.png"), large); }).exit_code(), 1);
    EXPECT_EQ(thrown_error([&] { write_png(folder.file("b.png"), large); }).exit_code(), 1);
  }
  EXPECT_EQ(folder.names(), std::vector<std::string>{"a.png"});
  EXPECT_EQ(read_png(folder.file("a.png")), old);
}

TEST(Png, WhatIsNoPictureIsRefused) {
  const Folder folder;
  std::ofstream(folder.file("text.png")) << "no picture";
  std::ofstream(folder.file("empty.png"));
  for (const char* name : {"text.png", "empty.png", "missing.png"}) {
    const Error error = thrown_error([&] { read_png(folder.file(name)); });
    EXPECT_EQ(error.exit_code(), 2);
    EXPECT_TRUE(says(error.what(), name));
  }
}

// Returns a PNG of one row of grey 16-bit pixels, without any chunk that says what their values mean.
std::vector<std::uint8_t> grey16(const std::vector<std::uint8_t>& values) {
  std::vector<std::uint8_t> bytes = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  const auto number = [](std::vector<std::uint8_t>& to, std::uint32_t n) {
    for (int i = 3; i >= 0; --i) to.push_back(static_cast<std::uint8_t>(n >> 8 * i));
  };
  const auto chunk = [&](const char* name, const std::vector<std::uint8_t>& data) {
    number(bytes, static_cast<std::uint32_t>(data.size()));
    const std::size_t begin = bytes.size();
    bytes.insert(bytes.end(), name, name + 4);
    bytes.insert(bytes.end(), data.begin(), data.end());
    number(bytes,
           static_cast<std::uint32_t>(crc32(0, &bytes[begin], static_cast<uInt>(bytes.size() - begin))));
  };
  std::vector<std::uint8_t> header, row = {0};  // no filter
  number(header, static_cast<std::uint32_t>(values.size()));
  number(header, 1);
  for (const int b : {16, 0, 0, 0, 0}) header.push_back(static_cast<std::uint8_t>(b));
  for (const std::uint8_t v : values) row.insert(row.end(), {v, v});  // 257 v of 65535 is v of 255
  std::vector<std::uint8_t> packed(compressBound(row.size()));
  uLongf size = packed.size();
  compress(packed.data(), &size, row.data(), row.size());
  packed.resize(size);
  chunk("IHDR", header);
  chunk("IDAT", packed);
  chunk("IEND", {});
  return bytes;
}

TEST(Png, SixteenBitsAreTheSameColoursAsEight) {
  const std::vector<std::uint8_t> values = {0, 1, 40, 128, 188, 254, 255};
  const Image image = decode_png(grey16(values), "deep.png");
  for (std::size_t x = 0; x < values.size(); ++x)
    for (int c = 0; c < 3; ++c) EXPECT_EQ(image.at(static_cast<int>(x), 0)[c], values[x]);
}

TEST(Png, ATruncatedPictureIsRefused) {
  auto half = encode_png(gradient(60, 60, 3));
  half.resize(half.size() / 2);
  EXPECT_EQ(thrown_error([&] { decode_png(half, "half.png"); }).exit_code(), 2);
}

// Four bytes that would break the line of the message.
TEST(Png, ADamagedNameOfAChunkIsNotRepeated) {
  auto bytes = encode_png(gradient(6, 6, 3));
  bytes[bytes.size() - 6] = '\n';  // IEND
  const Error error = thrown_error([&] { decode_png(bytes, "a.png"); });
  EXPECT_EQ(std::string(error.what()), "reading a.png: a broken PNG picture: the file ends too early");
}

// The header announces far more than stands behind it.
TEST(Png, AHeaderThatCannotBeTrueIsRefusedBeforeAnythingIsAllocated) {
  const auto refusal = [](std::uint32_t width, std::uint32_t height) {
    auto bytes = encode_png(gradient(60, 60, 3));
    for (int i = 0; i < 4; ++i) {
      bytes[16 + i] = static_cast<std::uint8_t>(width >> (24 - 8 * i));
      bytes[20 + i] = static_cast<std::uint8_t>(height >> (24 - 8 * i));
    }
    const auto sum = static_cast<std::uint32_t>(crc32(0, &bytes[12], 17));  // of the header's chunk
    for (int i = 0; i < 4; ++i) bytes[29 + i] = static_cast<std::uint8_t>(sum >> (24 - 8 * i));
    const Error error = thrown_error([&] { decode_png(bytes, "a.png"); });
    EXPECT_EQ(error.exit_code(), 2);
    return std::string(error.what());
  };
  EXPECT_EQ(refusal(900000, 400),
            "reading a.png: its header announces 900000x400 pixels, more than the 268435456 that are read");
  EXPECT_EQ(refusal(900000, 290),
            "reading a.png: its header announces 900000x290 pixels, more than its bytes can hold");
}

// The wrong bit is in the header's size, or in the compressed rows.
TEST(Png, AWrongBitIsFound) {
  const auto whole = encode_png(gradient(60, 60, 3));
  for (const size_t at : {size_t{19}, whole.size() / 2}) {
    auto wrong = whole;
    wrong[at] ^= 1;
    const Error error = thrown_error([&] { decode_png(wrong, "wrong.png"); });
    EXPECT_EQ(error.exit_code(), 2) << at;
    EXPECT_TRUE(says(error.what(), "PNG picture"));
  }
}

TEST(Image, SizesBelowOneAreRefused) {
  EXPECT_EQ(thrown_error([] { Image(0, 10); }).exit_code(), 2);
  EXPECT_EQ(thrown_error([] { Image(10, -1); }).exit_code(), 2);
  EXPECT_EQ(thrown_error([] { Image(10, 10, 2); }).exit_code(), 2);
}

// Half black, half white is half the light, not half the encoded value: 188, not 128.
TEST(Shrink, AveragesInLinearLight) {
  Image image(2, 1, Rgb8{0, 0, 0});
  for (int c = 0; c < 3; ++c) image.at(1, 0)[c] = 255;
  const Image small = shrink(image, 1, 1);
  EXPECT_EQ(small.at(0, 0)[0], srgb8_of_linear(0.5f));
  EXPECT_EQ(small.at(0, 0)[0], 188);
}

// Pixel 0 of 2 covers pixels 0 and half of 1 of three: light (1 + 0.5 * 0) / 1.5.
TEST(Shrink, WeighsPartlyCoveredPixels) {
  Image image(3, 1, Rgb8{0, 0, 0});
  for (int c = 0; c < 3; ++c) image.at(0, 0)[c] = 255;
  const Image small = shrink(image, 2, 1);
  EXPECT_EQ(small.at(0, 0)[0], srgb8_of_linear(1 / 1.5f));
  EXPECT_EQ(small.at(1, 0)[0], 0);
}

TEST(Shrink, KeepsAnEvenPictureAndRefusesToGrow) {
  const Image even(97, 61, Rgb8{120, 7, 250});
  EXPECT_EQ(shrink(even, 13, 10), Image(13, 10, Rgb8{120, 7, 250}));
  EXPECT_EQ(thrown_error([&] { shrink(even, 98, 10); }).exit_code(), 2);
}

// A red pixel beside nothing is half a red pixel, not a dark one.
TEST(Shrink, TransparentPixelsLendNoColour) {
  Image image(2, 1, 4);
  image.at(0, 0)[0] = 200;
  image.at(0, 0)[3] = 255;
  const Image small = shrink(image, 1, 1);
  EXPECT_EQ(small.at(0, 0)[0], 200);
  EXPECT_EQ(small.at(0, 0)[3], 128);
}

TEST(Paste, BlendsATransparentSource) {
  Image target(3, 1, Rgb8{255, 255, 255}), source(3, 1, 4);
  source.at(1, 0)[3] = 128;
  source.at(2, 0)[3] = 255;
  paste(target, source, 0, 0);
  EXPECT_EQ(target.at(0, 0)[0], 255);
  EXPECT_EQ(target.at(1, 0)[0], 127);
  EXPECT_EQ(target.at(2, 0)[0], 0);
}

TEST(Paste, CutsOffWhatLiesOutside) {
  Image target(4, 4, Rgb8{0, 0, 0});
  paste(target, Image(3, 3, Rgb8{9, 9, 9}), -2, 2);
  int painted = 0;
  for (const std::uint8_t value : target.pixels()) painted += value == 9;
  EXPECT_EQ(painted, 1 * 2 * 3);
  EXPECT_EQ(target.at(0, 3)[0], 9);
}

}  // namespace
}  // namespace hysteron::render
