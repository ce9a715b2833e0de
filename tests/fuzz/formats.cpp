#include "tests/fuzz/formats.h"

#include <zlib.h>

#include "experiments/workbench/pages/gallery.h"
#include "experiments/workbench/pages/report.h"
#include "experiments/workbench/pages/text_table.h"
#include "render/image.h"
#include "render/plot.h"
#include "sim/base/csv.h"
#include "sim/identification/series.h"
#include "sim/mesh/builders.h"
#include "sim/mesh/surface.h"
#include "sim/scene/fabric_reader.h"
#include "sim/scene/scene_reader.h"

namespace hysteron::fuzz {
namespace {
namespace fs = std::filesystem;

const std::vector<std::string> kNumbers = {"0",   "-1",          "1e300",       "-1e300",     "nan",
                                           "inf", "99999999999", "-2147483648", "4294967295", "1e-320"};

std::vector<std::string> with_numbers(std::vector<std::string> words) {
  words.insert(words.end(), kNumbers.begin(), kNumbers.end());
  return words;
}

void read_scene(const fs::path& file) {
  Scene scene = default_scene();
  apply_scene_file(scene, file.string());
  check_scene(scene);
}

// A copy of the file under a name of its own, in a folder of results beside it.
fs::path placed(const fs::path& file, const char* name) {
  const fs::path folder = file.parent_path() / "results" / "run";
  fs::create_directories(folder);
  fs::copy_file(file, folder / name, fs::copy_options::overwrite_existing);
  return folder;
}

std::uint32_t big_endian(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

// With the check sums of what its chunks are now: otherwise no reader looks further.
std::string with_check_sums(std::string png) {
  for (std::size_t at = 8; at + 12 <= png.size();) {
    const std::size_t length = big_endian(png, at);
    if (length > png.size() - at - 12) break;
    const auto* type = reinterpret_cast<const Bytef*>(&png[at + 4]);
    const uLong sum = crc32(0, type, static_cast<uInt>(length + 4));
    for (int i = 0; i < 4; ++i) png[at + 8 + length + i] = static_cast<char>(sum >> (24 - 8 * i));
    at += length + 12;
  }
  return png;
}

Format toml() {
  return {"toml",
          with_numbers({"[",
                        "]",
                        "[[",
                        "]]",
                        "{",
                        "}",
                        "=",
                        ",",
                        ".",
                        "\"",
                        "'",
                        "\"\"\"",
                        "'''",
                        "\\u0041",
                        "\xC3\xA9",
                        "#",
                        "\n",
                        "1979-05-27T07:32:00Z",
                        "0x1F",
                        "true",
                        "[[[pin]]",
                        "a=[[}",
                        "a.a.a.a.a.a.a.a",
                        "[[phase]]\n",
                        "[[obstacle]]\n",
                        "\"hang + 0.1\""}),
          {read_scene, [](const fs::path& file) { read_fabric(file.string(), "--fabric"); }}};
}

Format obj() {
  return {"obj",
          with_numbers({"\nf ", "\nv ", "\nvt ", "\nvn ", "/", "//", "1/1/1", "\r\n", "\nl 1 2", "\np 1",
                        "\nt a 9999999/1/1", "\ng x", "\nusemtl y", "\nmtllib z.mtl", "\\\n", "+1", "-3"}),
          {[](const fs::path& file) { read_obj(file.string(), 0); },
           [](const fs::path& file) { read_obj(file.string(), 1e-3); },
           [](const fs::path& file) { read_surface(file.string()); }}};
}

Format ply() {
  return {"ply",
          with_numbers({"\nelement vertex 2147483648", "\nelement face ", "\nproperty list uchar int x",
                        "\nproperty list uint uint vertex_indices", "\nproperty double x", "\nend_header\n",
                        "\nformat ascii 1.0", "binary_big_endian", "binary_little_endian", "float", "char",
                        "uint", "list", "\ncomment", std::string(4, '\xFF'), std::string(4, '\0')}),
          {[](const fs::path& file) { read_surface(file.string()); }}};
}

Format csv() {
  const auto chart = [](const fs::path& file) {
    placed(file, "table.csv");
    experiments::report_page(placed(file, "metrics.csv"));
    experiments::gallery_page(file.parent_path() / "results");
  };
  return {"csv",
          with_numbers({",", "\n", "\"", "\"\"", "curvature [1/m]", "moment [N]", "time [s]", "[", "]",
                        "1/cm", "\xEF\xBB\xBF", ";", "\r"}),
          {[](const fs::path& file) {
             read_csv(file, {"curvature [1/m]"}, {"moment [N]", "time [s]", "edit"}, "law");
           },
           [](const fs::path& file) { read_series(file, 0.05, "fuzz"); },
           [](const fs::path& file) { read_words(file); },
           [](const fs::path& file) { render::series_from_csv(file, "curvature", "moment", ""); }, chart}};
}

Format png() {
  std::vector<std::string> words = {"IHDR", "IDAT", "PLTE", "tRNS", "IEND"};
  for (const char byte : {'\0', '\1', '\x7F', '\xFF'})
    for (const std::size_t count : {1, 4}) words.emplace_back(count, byte);
  return {"png", words, {[](const fs::path& file) { render::read_png(file); }}, with_check_sums};
}

Format json() {
  return {"json",
          with_numbers({"null", "true", "{", "}", "[", "]", "\"", ":", ",", "{}", "[]", "\"\"", "\\u0000",
                        "\\", "\"metrics\"", "\"scene\"", "\"fabric\"", "\"law\"", std::string(200, '[')}),
          {[](const fs::path& file) { experiments::report_page(placed(file, "manifest.json")); },
           [](const fs::path& file) {
             placed(file, "again.json");
             experiments::gallery_page(file.parent_path() / "results");
           }}};
}

}  // namespace

const std::vector<Format>& formats() {
  static const std::vector<Format> all = {toml(), obj(), ply(), csv(), png(), json()};
  return all;
}

}  // namespace hysteron::fuzz
