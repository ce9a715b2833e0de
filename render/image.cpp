#include "render/image.h"

#include <png.h>
#include <zlib.h>
#include <algorithm>
#include <cmath>
#include <csetjmp>
#include <new>
#include <string>

#include "render/srgb.h"
#include "sim/base/atomic_file.h"
#include "sim/base/error.h"
#include "sim/base/whole_file.h"

namespace hysteron::render {

namespace {

thread_local std::size_t pixels_read = 0;

// The source pixels that one target pixel covers along a side, and how much of each.
struct Footprint {
  int first;
  std::vector<float> weights;
};

std::vector<Footprint> footprints(int source, int target) {
  const double scale = static_cast<double>(source) / target;
  std::vector<Footprint> result(static_cast<size_t>(target));
  for (int i = 0; i < target; ++i) {
    const double begin = i * scale, end = std::min((i + 1) * scale, static_cast<double>(source));
    Footprint& footprint = result[i];
    footprint.first = static_cast<int>(begin);
    for (int k = footprint.first; k < end && k < source; ++k)
      footprint.weights.push_back(
          static_cast<float>((std::min(end, k + 1.0) - std::max(begin, k * 1.0)) / scale));
  }
  return result;
}

// Returns the columns of linear light, times alpha where there is one, summed over the rows' footprint.
std::vector<float> summed_columns(const Image& source, const Footprint& rows) {
  std::vector<float> sums(source.row_bytes(), 0.0f);
  pixels_read += rows.weights.size() * static_cast<std::size_t>(source.width());
  const auto& linear = linear_of_srgb8();
  for (size_t k = 0; k < rows.weights.size(); ++k) {
    const std::uint8_t* row = source.at(0, rows.first + static_cast<int>(k));
    if (source.channels() == 3) {
      for (size_t i = 0; i < sums.size(); ++i) sums[i] += rows.weights[k] * linear[row[i]];
      continue;
    }
    for (size_t i = 0; i < sums.size(); i += 4) {
      const float alpha = rows.weights[k] * static_cast<float>(row[i + 3]) / 255;
      for (size_t c = 0; c < 3; ++c) sums[i + c] += alpha * linear[row[i + c]];
      sums[i + 3] += alpha;
    }
  }
  return sums;
}

// Stores light that was multiplied by alpha, if there are four channels.
void store(std::uint8_t* pixel, const std::array<float, 4>& light, int channels) {
  const float fraction = channels == 4 ? std::max(light[3], 1e-6f) : 1;
  for (int c = 0; c < 3; ++c) pixel[c] = srgb8_of_linear(light[c] / fraction);
  if (channels == 4) pixel[3] = static_cast<std::uint8_t>(255 * std::min(light[3], 1.0f) + 0.5f);
}

}  // namespace

Image::Image(int width, int height, int channels) : width_(width), height_(height), channels_(channels) {
  if (width <= 0 || height <= 0)
    throw Error::invalid_input("picture of " + std::to_string(width) + " x " + std::to_string(height) +
                               " pixels: both sides must be >= 1");
  if (channels != 3 && channels != 4)
    throw Error::invalid_input("picture of " + std::to_string(channels) +
                               " channels: 3 (RGB) or 4 (RGBA) are allowed");
  pixels_.assign(row_bytes() * height, 0);
}

Image::Image(int width, int height, const Rgb8& fill) : Image(width, height, 3) {
  for (size_t i = 0; i < pixels_.size(); ++i) pixels_[i] = fill[i % 3];
}

void paste(Image& target, const Image& source, int x, int y) {
  const int left = std::max(0, -x), right = std::min(source.width(), target.width() - x);
  for (int row = std::max(0, -y); row < std::min(source.height(), target.height() - y); ++row)
    for (int column = left; column < right; ++column) {
      const std::uint8_t* from = source.at(column, row);
      std::uint8_t* to = target.at(x + column, y + row);
      const int alpha = source.channels() == 4 ? from[3] : 255;
      for (int c = 0; c < 3; ++c)
        to[c] = static_cast<std::uint8_t>((alpha * from[c] + (255 - alpha) * to[c] + 127) / 255);
    }
}

std::size_t pixels_shrunk() { return pixels_read; }

Image shrink(const Image& source, int width, int height) {
  if (width > source.width() || height > source.height())
    throw Error::invalid_input("shrinking a picture of " + std::to_string(source.width()) + " x " +
                               std::to_string(source.height()) + " to " + std::to_string(width) + " x " +
                               std::to_string(height) + " pixels: no side may grow");
  Image result(width, height, source.channels());
  const auto columns = footprints(source.width(), width);
  const auto rows = footprints(source.height(), height);
  const int channels = source.channels();
  for (int y = 0; y < height; ++y) {
    const auto sums = summed_columns(source, rows[y]);
    for (int x = 0; x < width; ++x) {
      std::array<float, 4> light{};
      for (size_t k = 0; k < columns[x].weights.size(); ++k)
        for (int c = 0; c < channels; ++c)
          light[c] += columns[x].weights[k] * sums[(columns[x].first + k) * channels + c];
      store(result.at(x, y), light, channels);
    }
  }
  return result;
}

namespace {

void append_bytes(png_structp png, png_bytep bytes, size_t count) {
  auto& out = *static_cast<std::vector<std::uint8_t>*>(png_get_io_ptr(png));
  try {
    out.insert(out.end(), bytes, bytes + count);
  } catch (const std::bad_alloc&) {
    png_error(png, "out of memory");  // an exception must not pass through libpng's C frames
  }
}

void no_flush(png_structp) {}

void choose_effort(png_structp png, PngEffort effort) {
  const bool fast = effort == PngEffort::fast;
  png_set_filter(png, PNG_FILTER_TYPE_BASE, fast ? PNG_FILTER_UP : PNG_ALL_FILTERS);
  png_set_compression_level(png, fast ? 1 : 5);
  // RLE is as quick, and dithered colours repeat nowhere else.
  if (fast) png_set_compression_strategy(png, Z_RLE);
}

// libpng leaves through longjmp; this function holds no object with a destructor.
bool encode(png_structp png, png_infop header, const Image& image, PngEffort effort,
            std::vector<std::uint8_t>& out) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_set_write_fn(png, &out, append_bytes, no_flush);
  png_set_IHDR(png, header, image.width(), image.height(), 8,
               image.channels() == 4 ? PNG_COLOR_TYPE_RGBA : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB(png, header, PNG_sRGB_INTENT_PERCEPTUAL);
  png_text software{};
  software.compression = PNG_TEXT_COMPRESSION_NONE;
  software.key = const_cast<char*>("Software");  // libpng copies both
  software.text = const_cast<char*>("hysteron");
  png_set_text(png, header, &software, 1);
  choose_effort(png, effort);
  png_write_info(png, header);
  for (int y = 0; y < image.height(); ++y) png_write_row(png, image.at(0, y));
  png_write_end(png, nullptr);
  return true;
}

// Compares what a header announces with what the rest of the file can hold: "" if it may be so.
std::string announced_excess(std::int64_t width, std::int64_t height, std::size_t bytes) {
  constexpr std::int64_t kMaxPixels = std::int64_t{1} << 28;  // 1 GiB of RGBA
  constexpr std::int64_t kMaxDeflated = 1032;  // most bytes from one (zlib's technical details)
  const std::string announced =
      "its header announces " + std::to_string(width) + "x" + std::to_string(height) + " pixels, ";
  if (width * height > kMaxPixels)
    return announced + "more than the " + std::to_string(kMaxPixels) + " that are read";
  if (height * ((width + 7) / 8) > kMaxDeflated * static_cast<std::int64_t>(bytes))  // at one bit per pixel
    return announced + "more than its bytes can hold";
  return "";
}

bool has_end(std::span<const std::uint8_t> bytes) {
  constexpr std::uint8_t kEnd[] = {0, 0, 0, 0, 'I', 'E', 'N', 'D', 0xae, 0x42, 0x60, 0x82};
  return bytes.size() >= sizeof kEnd &&
         std::equal(std::begin(kEnd), std::end(kEnd), bytes.end() - sizeof kEnd);
}

// A picture whose header libpng has read.
struct Opened {
  // Throws Error::invalid_input unless the header can be true and the file has its end.
  Opened(std::span<const std::uint8_t> bytes, const std::string& name) : reading("reading " + name + ": ") {
    header.version = PNG_IMAGE_VERSION;
    if (!png_image_begin_read_from_memory(&header, bytes.data(), bytes.size()))
      throw Error::invalid_input(reading + "not a PNG picture (" + header.message + ")");
    // A 16-bit file without a gAMA or sRGB chunk is sRGB, as an 8-bit one is.
    header.flags |= PNG_IMAGE_FLAG_16BIT_sRGB;
    const std::string excess = announced_excess(header.width, header.height, bytes.size());
    if (excess.empty() && has_end(bytes)) return;
    png_image_free(&header);
    throw Error::invalid_input(reading +
                               (excess.empty() ? "a broken PNG picture: the file ends too early" : excess));
  }
  Opened(const Opened&) = delete;
  ~Opened() { png_image_free(&header); }

  std::string reading;
  png_image header{};
};

std::span<const std::uint8_t> bytes_in(const std::string& file) {
  return {reinterpret_cast<const std::uint8_t*>(file.data()), file.size()};
}

}  // namespace

std::vector<std::uint8_t> encode_png(const Image& image, PngEffort effort) {
  if (image.empty()) throw Error::invalid_input("encoding a PNG: the picture is empty");
  std::vector<std::uint8_t> out;
  out.reserve(image.pixels().size() / 4 + 1024);
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop header = png ? png_create_info_struct(png) : nullptr;
  const bool done = header && encode(png, header, image, effort, out);
  png_destroy_write_struct(&png, &header);
  if (!done) throw Error::system("encoding a PNG: libpng failed, probably out of memory");
  return out;
}

void write_png(const std::filesystem::path& path, const Image& image, PngEffort effort) {
  const auto bytes = encode_png(image, effort);
  AtomicFile file(path.string());
  file.stream().write(reinterpret_cast<const char*>(bytes.data()),
                      static_cast<std::streamsize>(bytes.size()));
  file.commit();
}

Image decode_png(std::span<const std::uint8_t> bytes, const std::string& name) {
  Opened opened(bytes, name);
  png_image& header = opened.header;
  const bool alpha = header.format & PNG_FORMAT_FLAG_ALPHA;
  header.format = alpha ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB;
  Image image(static_cast<int>(header.width), static_cast<int>(header.height), alpha ? 4 : 3);
  if (!png_image_finish_read(&header, nullptr, image.pixels().data(), 0, nullptr))
    throw Error::invalid_input(opened.reading + "a broken PNG picture: " + header.message);
  return image;
}

Image read_png(const std::filesystem::path& path) {
  const std::string bytes = file_named(path, "reading " + path.string());
  return decode_png(bytes_in(bytes), path.string());
}

ImageSize png_size(const std::filesystem::path& path) {
  const std::string bytes = file_named(path, "reading " + path.string());
  const Opened opened(bytes_in(bytes), path.string());
  return {static_cast<int>(opened.header.width), static_cast<int>(opened.header.height)};
}

}  // namespace hysteron::render
