// Pictures in memory and PNG files.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace hysteron::render {

// An sRGB-encoded colour: red, green, blue.
using Rgb8 = std::array<std::uint8_t, 3>;

// A picture of 8 bits a channel, 3 (RGB) or 4 (RGBA) channels, rows from the top, no padding.
class Image {
 public:
  Image() = default;
  // Error::invalid_input if a side is not positive or channels is not 3 or 4.
  Image(int width, int height, int channels = 3);
  Image(int width, int height, const Rgb8& fill);

  int width() const { return width_; }
  int height() const { return height_; }
  int channels() const { return channels_; }
  bool empty() const { return pixels_.empty(); }
  size_t row_bytes() const { return static_cast<size_t>(width_) * channels_; }

  std::uint8_t* at(int x, int y) { return &pixels_[y * row_bytes() + static_cast<size_t>(x) * channels_]; }
  const std::uint8_t* at(int x, int y) const {
    return &pixels_[y * row_bytes() + static_cast<size_t>(x) * channels_];
  }
  std::span<std::uint8_t> pixels() { return pixels_; }
  std::span<const std::uint8_t> pixels() const { return pixels_; }

  bool operator==(const Image&) const = default;

 private:
  int width_ = 0, height_ = 0, channels_ = 3;
  std::vector<std::uint8_t> pixels_;
};

// Pastes `source` with its top left corner at (x, y); pixels outside are cut off.  A transparent source is
// blended over the target's colours as viewers do it, in encoded values.
void paste(Image& target, const Image& source, int x, int y);

// Averages over exact pixel footprints in linear light, for supersampling and contact sheets.
// Error::invalid_input if a side would grow.
Image shrink(const Image& source, int width, int height);
// Returns how many pixels shrink() has read on this thread so far, the cost of a page of pictures on any
// machine.
std::size_t pixels_shrunk();

enum class PngEffort {
  fast,  // UP filter, zlib level 1: sequences (about five times faster than zlib's default)
  best,  // every filter tried, zlib level 5 (6 takes twice as long for 4 % less): pictures to keep
};

// Encodes a PNG file in memory.
std::vector<std::uint8_t> encode_png(const Image& image, PngEffort effort = PngEffort::fast);

// A chunk of text that every PNG of this program holds.
inline const std::string kPngMark{"tEXtSoftware\0hysteron", 21};

// Writes a temporary file beside `path` and renames it, so that `path` is either whole or not there.
// Error::system if the folder cannot be written or the disk is full.
void write_png(const std::filesystem::path& path, const Image& image, PngEffort effort = PngEffort::fast);

// Decodes a PNG file in memory; `name` stands for it in errors, which are those of read_png().
Image decode_png(std::span<const std::uint8_t> bytes, const std::string& name);

struct ImageSize {
  int width = 0, height = 0;
  bool operator==(const ImageSize&) const = default;
};
// Reads a PNG file's size from its header and checks its end.  Errors as in read_png().
ImageSize png_size(const std::filesystem::path& path);

// Reads a PNG file as RGB or RGBA, as the file has it (grey becomes RGB).  Error::invalid_input if the file
// is missing or not a picture.
Image read_png(const std::filesystem::path& path);

}  // namespace hysteron::render
