#include <png.h>
#include <zlib.h>

#include <algorithm>
#include <csetjmp>
#include <fstream>
#include <iterator>
#include <memory>
#include <new>
#include <string>

#include "render/image.h"
#include "sim/atomic_file.h"
#include "sim/error.h"

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#define STBI_NO_STDIO
#define STBI_NO_HDR
#define STBI_NO_LINEAR
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

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
  png_set_compression_level(png, fast ? 1 : 9);
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

std::uint32_t big_endian(const std::uint8_t* bytes) {
  return static_cast<std::uint32_t>(bytes[0]) << 24 | bytes[1] << 16 | bytes[2] << 8 | bytes[3];
}

// What the chunks' check sums say, which stb_image does not read: "" if all is well.
std::string damage_of(std::span<const std::uint8_t> bytes) {
  constexpr size_t kSignature = 8, kAround = 12;  // [bytes]; of a chunk: length, type, check sum
  size_t at = kSignature;
  while (at + kAround <= bytes.size()) {
    const size_t length = big_endian(&bytes[at]);
    const std::string type(reinterpret_cast<const char*>(&bytes[at + 4]), 4);
    if (length > bytes.size() - at - kAround) break;
    const uLong sum = crc32(0, &bytes[at + 4], static_cast<uInt>(length + 4));
    if (sum != big_endian(&bytes[at + 8 + length])) return "chunk " + type + " is damaged";
    if (type == "IEND") return "";
    at += length + kAround;
  }
  return "the file ends too early";
}

}  // namespace

std::vector<std::uint8_t> encode_png(const Image& image, PngEffort effort) {
  if (image.empty()) throw Error::request("encoding a PNG: the picture is empty");
  std::vector<std::uint8_t> out;
  out.reserve(image.pixels().size() / 4 + 1024);
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop header = png ? png_create_info_struct(png) : nullptr;
  const bool encoded = header && encode(png, header, image, effort, out);
  png_destroy_write_struct(&png, &header);
  if (!encoded) throw Error::machine("encoding a PNG: libpng failed, probably out of memory");
  return out;
}

void write_png(const std::filesystem::path& path, const Image& image, PngEffort effort) {
  const auto bytes = encode_png(image, effort);
  AtomicFile file(path.string());
  file.stream().write(reinterpret_cast<const char*>(bytes.data()),
                      static_cast<std::streamsize>(bytes.size()));
  file.commit();
}

Image read_png(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw Error::request("reading " + path.string() + ": the file cannot be opened");
  const std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(file), {}};
  const stbi_uc* begin = bytes.data();
  const int size = static_cast<int>(bytes.size());
  int width = 0, height = 0, channels = 0;
  const bool known = stbi_info_from_memory(begin, size, &width, &height, &channels) != 0;
  const std::string damage = known ? damage_of(bytes) : "";
  if (!damage.empty()) throw Error::request("reading " + path.string() + ": a broken PNG picture: " + damage);
  const int kept = channels == 2 || channels == 4 ? 4 : 3;
  stbi_uc* pixels = known ? stbi_load_from_memory(begin, size, &width, &height, &channels, kept) : nullptr;
  if (!pixels)
    throw Error::request("reading " + path.string() + ": not a PNG picture (" + stbi_failure_reason() + ")");
  const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> owner(pixels, &stbi_image_free);
  Image image(width, height, kept);
  std::copy_n(pixels, image.pixels().size(), image.pixels().data());
  return image;
}

}  // namespace hysteron::render
