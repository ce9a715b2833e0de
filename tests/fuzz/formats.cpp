#include "tests/fuzz/formats.h"

#include <zlib.h>

#include <cstring>

#include "experiments/sweep/study.h"
#include "experiments/workbench/app/recorded_command.h"
#include "experiments/workbench/app/scene_source.h"
#include "experiments/workbench/session/checkpoint.h"
#include "render/image.h"
#include "render/plot.h"
#include "sim/base/archive.h"
#include "sim/base/csv.h"
#include "sim/base/fnv1a.h"
#include "sim/identification/series.h"
#include "sim/mesh/cloth_mesh.h"
#include "sim/mesh/garment.h"
#include "sim/mesh/point_cache.h"
#include "sim/mesh/surface.h"
#include "sim/reference/fab_loops.h"
#include "sim/scene/fabric_reader.h"
#include "sim/scene/scene_reader.h"

namespace hysteron::fuzz {
namespace {
namespace fs = std::filesystem;
using experiments::Setup;

void read_scene(const fs::path& file) {
  Scene scene = default_scene();
  apply_scene_file(scene, file.string());
  check_scene(scene);
}

Format toml() {
  return {"toml", "toml", ".toml", {read_scene, [](const fs::path& file) {
                                      read_fabric(file.string(), "--fabric");
                                    }}};
}

Format study() {
  return {"study", "study", ".toml", {[](const fs::path& file) { experiments::read_study(file.string()); }}};
}

Format obj() {
  return {"obj",
          "obj",
          ".obj",
          {[](const fs::path& file) { read_obj(file.string(), 0); },
           [](const fs::path& file) { read_obj(file.string(), 1e-3); },
           [](const fs::path& file) { read_pattern(file.string(), 0, 1); },
           [](const fs::path& file) { read_surface(file.string()); }}};
}

Format ply() {
  return {"ply", "ply", ".ply", {[](const fs::path& file) { read_surface(file.string()); }}};
}

// A point cache has the motion of a body.
Format pc2() {
  return {"pc2", "pc2", ".pc2", {[](const fs::path& file) { read_point_cache(file.string()); }}};
}

Format mdd() {
  return {"mdd", "mdd", ".mdd", {[](const fs::path& file) { read_point_cache(file.string()); }}};
}

Format csv() {
  constexpr double kRipple = 0.05;
  return {"csv",
          "csv",
          ".csv",
          {[](const fs::path& file) {
             read_csv(file, {"curvature [1/m]"}, {"moment [N]", "time [s]", "edit"}, "law");
           },
           [](const fs::path& file) { read_table(file); },
           [](const fs::path& file) { read_series(file, kRipple, "fit"); },
           [](const fs::path& file) { read_kes_series(file, kRipple, "fit"); },
           [](const fs::path& file) { read_fab(file, TesterUnits::si, "fit"); },
           [](const fs::path& file) { read_fab(file, TesterUnits::fab, "fab"); },
           [](const fs::path& file) { render::series_from_csv(file, "curvature", "moment", ""); }}};
}

std::uint32_t big_endian(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

// Readers stop at a wrong check sum, so that these are set right.
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

Format png() {
  return {"png", "png", ".png", {[](const fs::path& file) { render::read_png(file); }}, with_check_sums};
}

// This format covers what `rerun`, `verify` and --scene take from a manifest.
Format manifest() {
  return {"manifest",
          "manifest",
          ".json",
          {[](const fs::path& file) {
             Setup setup{default_scene(), {}};
             experiments::apply_scene(setup, "swing", file.string(),
                                      experiments::bind_options(setup.options));
             check_scene(setup.scene);
             experiments::check_options(setup.options);
           },
           [](const fs::path& file) {
             experiments::line_that_repeats(experiments::recorded_run(file.string()));
           }}};
}

// Reads the state as a run begins to read it.
void read_state(const fs::path& file) {
  const std::string state = experiments::read_checkpoint(file, {"cpu", 1}).value_or("");
  Archive archive{state};
  std::vector<std::string> files;
  std::string started;
  double elapsed = 0;
  std::vector<std::pair<std::string, double>> seconds;
  std::vector<double> values;
  archive(files);
  archive(started);
  archive(elapsed);
  archive(seconds);
  archive(values);
}

std::string sealed(std::string bytes) {
  constexpr std::size_t kHead = 22;  // magic and format
  std::uint64_t seal[2] = {};
  if (bytes.size() < kHead + sizeof seal) return bytes;
  const std::size_t body = kHead + sizeof seal;
  seal[0] = bytes.size() - body;
  seal[1] = fnv1a(&bytes[body], bytes.size() - body);
  std::memcpy(&bytes[kHead], seal, sizeof seal);
  return bytes;
}

Format checkpoint() { return {"checkpoint", "checkpoint", "", {read_state}, sealed}; }

}  // namespace

std::vector<Format> formats() {
  return {toml(), study(), obj(), ply(), pc2(), mdd(), csv(), png(), manifest(), checkpoint()};
}

int taken(const Format& format, const fs::path& file) {
  int count = 0;
  for (const auto& reader : format.readers) {
    try {
      reader(file);
      ++count;
    } catch (const Error& error) {
      const std::string message = error.what();
      if (message.empty() || message.find_first_of("\n\r") != message.npos)
        throw std::runtime_error("an error of several lines or none: " + message);
    }
  }
  return count;
}

}  // namespace hysteron::fuzz
