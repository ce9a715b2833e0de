#include <png.h>
#include <zlib.h>

#include <algorithm>
#include <csetjmp>
#include <new>
#include <string>

#include "render/image.h"
#include "render/palette.h"
#include "sim/base/atomic_file.h"
#include "sim/base/error.h"
#include "sim/base/whole_file.h"

namespace hysteron::render {
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
  png_set_compression_level(png, fast ? 1 : 6);
  if (fast) png_set_compression_strategy(png, Z_RLE);  // as quick, and dithered colours repeat nowhere else
}

// What the header of a PNG file says of its pixels, and where they are.
struct Pixels {
  int width, height, color_type;
  std::span<const Rgb8> palette;  // of PNG_COLOR_TYPE_PALETTE
  const std::uint8_t* first;
  size_t row_bytes;
};

// libpng leaves through longjmp; this function holds no object with a destructor.
bool encode(png_structp png, png_infop header, const Pixels& pixels, PngEffort effort,
            std::vector<std::uint8_t>& out) {
  static_assert(sizeof(png_color) == sizeof(Rgb8));
  if (setjmp(png_jmpbuf(png))) return false;
  png_set_write_fn(png, &out, append_bytes, no_flush);
  png_set_IHDR(png, header, pixels.width, pixels.height, 8, pixels.color_type, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB(png, header, PNG_sRGB_INTENT_PERCEPTUAL);
  choose_effort(png, effort);
  if (!pixels.palette.empty()) {
    png_set_PLTE(png, header, reinterpret_cast<const png_color*>(pixels.palette.data()),
                 static_cast<int>(pixels.palette.size()));
    png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_NONE);  // differences of colour numbers say nothing
    png_set_compression_level(png, 6);  // on long runs of one number, 9 takes 4 times as long for 5 % less
  }
  png_write_info(png, header);
  for (int y = 0; y < pixels.height; ++y) png_write_row(png, pixels.first + y * pixels.row_bytes);
  png_write_end(png, nullptr);
  return true;
}

// What a header announces, against what the rest of the file can hold: "" if it may be so.
std::string excess_of(std::int64_t width, std::int64_t height, std::size_t bytes) {
  constexpr std::int64_t kMostPixels = std::int64_t{1} << 28;  // 1 GiB of RGBA
  constexpr std::int64_t kMostDeflated = 1032;  // zlib's technical details: bytes that one byte can stand for
  const std::string announced =
      "its header announces " + std::to_string(width) + "x" + std::to_string(height) + " pixels, ";
  if (width * height > kMostPixels)
    return announced + "more than the " + std::to_string(kMostPixels) + " that are read";
  if (height * ((width + 7) / 8) > kMostDeflated * static_cast<std::int64_t>(bytes))  // of one bit a pixel
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
  // Throws Error::request unless the header can be true and the file has its end.
  Opened(std::span<const std::uint8_t> bytes, const std::string& name) : reading("reading " + name + ": ") {
    if (!png_image_begin_read_from_memory(&header, bytes.data(), bytes.size()))
      throw Error::request(reading + "not a PNG picture (" + header.message + ")");
    const std::string excess = excess_of(header.width, header.height, bytes.size());
    if (excess.empty() && has_end(bytes)) return;
    png_image_free(&header);
    throw Error::request(reading +
                         (excess.empty() ? "a broken PNG picture: the file ends too early" : excess));
  }
  Opened(const Opened&) = delete;
  ~Opened() { png_image_free(&header); }

  std::string reading;
  png_image header{.version = PNG_IMAGE_VERSION};
};

std::span<const std::uint8_t> bytes_in(const std::string& file) {
  return {reinterpret_cast<const std::uint8_t*>(file.data()), file.size()};
}

std::vector<std::uint8_t> encoded(const Pixels& pixels, PngEffort effort) {
  std::vector<std::uint8_t> out;
  out.reserve(pixels.row_bytes * pixels.height / 4 + 1024);
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop header = png ? png_create_info_struct(png) : nullptr;
  const bool done = header && encode(png, header, pixels, effort, out);
  png_destroy_write_struct(&png, &header);
  if (!done) throw Error::machine("encoding a PNG: libpng failed, probably out of memory");
  return out;
}

}  // namespace

std::vector<std::uint8_t> encode_png(const Image& image, PngEffort effort) {
  if (image.empty()) throw Error::request("encoding a PNG: the picture is empty");
  const int color_type = image.channels() == 4 ? PNG_COLOR_TYPE_RGBA : PNG_COLOR_TYPE_RGB;
  return encoded({image.width(), image.height(), color_type, {}, image.at(0, 0), image.row_bytes()}, effort);
}

std::vector<std::uint8_t> encode_png(const PaletteImage& image) {
  if (image.index.empty()) throw Error::request("encoding a PNG: the picture is empty");
  return encoded({image.width, image.height, PNG_COLOR_TYPE_PALETTE, image.colors, image.index.data(),
                  static_cast<size_t>(image.width)},
                 PngEffort::best);
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
    throw Error::request(opened.reading + "a broken PNG picture: " + header.message);
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
