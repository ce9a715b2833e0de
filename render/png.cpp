#include <fmt/core.h>
#include <png.h>
#include <zlib.h>

#include <csetjmp>
#include <new>
#include <string>

#include "render/image.h"
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

// libpng leaves through longjmp; this function holds no object with a destructor.
bool encode(png_structp png, png_infop header, const Image& image, PngEffort effort,
            std::vector<std::uint8_t>& out) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_set_write_fn(png, &out, append_bytes, no_flush);
  png_set_IHDR(png, header, image.width(), image.height(), 8,
               image.channels() == 4 ? PNG_COLOR_TYPE_RGBA : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB(png, header, PNG_sRGB_INTENT_PERCEPTUAL);
  choose_effort(png, effort);
  png_write_info(png, header);
  for (int y = 0; y < image.height(); ++y) png_write_row(png, image.at(0, y));
  png_write_end(png, nullptr);
  return true;
}

// The header of a file that is read; it frees what libpng holds of it.
class Reading {
 public:
  // Throws Error::request where it is no PNG picture or announces more than its bytes can hold.
  Reading(std::span<const std::uint8_t> bytes, const std::string& name) : name_(name) {
    constexpr std::uint64_t kMostDeflated = 1032;  // zlib's technical details: bytes that one byte stands for
    png_.version = PNG_IMAGE_VERSION;
    if (!png_image_begin_read_from_memory(&png_, bytes.data(), bytes.size()))
      throw failure("not a PNG picture");
    png_.flags |= PNG_IMAGE_FLAG_16BIT_sRGB;  // where the file does not say
    const std::uint64_t least = std::uint64_t{png_.height} * ((png_.width + 7) / 8);  // of one bit a pixel
    const bool too_large = std::uint64_t{png_.width} * png_.height > kMostPixels;
    if (too_large || least > kMostDeflated * bytes.size()) {
      png_image_free(&png_);
      throw Error::request(fmt::format(
          "reading {}: its header announces {}x{} pixels, more than {}", name, size().width, size().height,
          too_large ? fmt::format("the {} that are read", kMostPixels) : "its bytes can hold"));
    }
  }
  Reading(const Reading&) = delete;
  Reading& operator=(const Reading&) = delete;
  ~Reading() { png_image_free(&png_); }

  ImageSize size() const { return {static_cast<int>(png_.width), static_cast<int>(png_.height)}; }

  Image image() {
    const bool transparent = png_.format & PNG_FORMAT_FLAG_ALPHA;
    png_.format = transparent ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB;
    Image image(size().width, size().height, transparent ? 4 : 3);
    if (!png_image_finish_read(&png_, nullptr, image.pixels().data(), 0, nullptr))
      throw failure("a broken PNG picture");
    return image;
  }

 private:
  static constexpr std::uint64_t kMostPixels = std::uint64_t{1} << 28;  // 1 GiB of RGBA

  Error failure(const char* what) const {
    return Error::request(fmt::format("reading {}: {} ({})", name_, what, png_.message));
  }

  png_image png_ = {};
  const std::string& name_;
};

std::span<const std::uint8_t> bytes_in(const std::string& file) {
  return {reinterpret_cast<const std::uint8_t*>(file.data()), file.size()};
}

}  // namespace

std::vector<std::uint8_t> encode_png(const Image& image, PngEffort effort) {
  if (image.empty()) throw Error::request("encoding a PNG: the picture is empty");
  std::vector<std::uint8_t> out;
  out.reserve(image.pixels().size() / 4 + 1024);
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop header = png ? png_create_info_struct(png) : nullptr;
  const bool done = header && encode(png, header, image, effort, out);
  png_destroy_write_struct(&png, &header);
  if (!done) throw Error::machine("encoding a PNG: libpng failed, probably out of memory");
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
  return Reading(bytes, name).image();
}

Image read_png(const std::filesystem::path& path) {
  const std::string bytes = file_named(path, "reading " + path.string());
  return decode_png(bytes_in(bytes), path.string());
}

ImageSize png_size(const std::filesystem::path& path) {
  const std::string bytes = file_named(path, "reading " + path.string()), name = path.string();
  return Reading(bytes_in(bytes), name).size();
}

}  // namespace hysteron::render
