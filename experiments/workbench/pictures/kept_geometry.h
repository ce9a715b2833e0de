// What pictures were drawn from, in one file: cloth at each instant, with the scene and options that draw it.
//
//   {"record": "mesh", ...}      triangles and pattern, once for all cloth that has them
//   {"record": "cloth", ...}     scene, options, what is framed; the instants that follow are its
//   {"record": "body", ...}      triangles of an obstacle that a file holds, and, where it keeps its shape,
//   their
//                                vertices
//   {"record": "instant", ...}   positions and values at the vertices
//   {"record": "sheet", ...}     how the contact sheet, or a comparison's page, is headed
//
// Each record is a line of JSON and, behind it, as many packed blocks (packing.h) as its "bytes" has lengths.
// Records are appended while a run goes on: a file that ends within one has all before it, and the last comes
// with the sheet.  Numbers are whole
// multiples of a "quantum": pictures are drawn from positions that are rounded so, unless they go from CUDA
// to OpenGL on one GPU.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "experiments/workbench/app/manifest.h"
#include "experiments/workbench/pictures/packing.h"
#include "render/camera.h"

namespace hysteron::experiments {

inline constexpr const char* kKeptFrames = "frames.hyg";  // of all pictures of a run
inline constexpr const char* kKeptSheet = "sheet.hyg";    // of those on its sheet

// The nearest multiple.
int quantum_count(double value, double quantum);
std::vector<float> rounded(std::span<const float> values, double quantum);
// The same, but what is within three quarters of a quantum of where it was before stays there: cloth that
// creeps by less does not jump to and fro between two multiples.  `before`: multiples; empty: none.
std::vector<float> rounded(std::span<const float> values, double quantum, std::span<const float> before);

struct DrawnMesh {
  std::size_t vertices = 0;
  std::vector<int> triangles;  // 3 each, counter-clockwise seen from the front
  std::vector<float> pattern;  // warp and weft coordinates, 2 a vertex [m]; may be empty
  double quantum = 0;          // of positions [m]
};

struct KeptState {
  double time = 0;                                   // [s]
  std::vector<float> xyz;                            // 3 a vertex [m]
  std::map<std::string, std::vector<float>> values;  // by look, one a vertex
  std::size_t loop = 0;  // points of the probe's path up to here, which stands with the sheet
  std::map<std::size_t, std::vector<float>> bodies;  // by obstacle: of those that change their shape
};

// An obstacle of kind mesh.
struct KeptBody {
  std::size_t obstacle = 0;  // in the scene
  DrawnMesh mesh;            // without a pattern
  bool closed = false;
  std::vector<float> xyz;  // 3 a vertex in its own frame [m]; empty: as the instants have it
};

struct KeptCloth {
  std::string name;  // of a comparison's column
  std::size_t mesh = 0;
  Json setup;  // "scene", "options"; of a column also "manifest" and "stopped"
  render::Box bounds;
  std::optional<float> floor;  // [m]
  std::vector<KeptState> instants;
  std::vector<KeptBody> bodies;
};

struct Kept {
  std::vector<DrawnMesh> meshes;
  std::vector<KeptCloth> cloths;
  Json sheet;  // null: the file has none
};

// A record as it stands in the file.
struct KeptRecord {
  Json head;
  std::vector<std::string> blocks;
  std::string kind() const { return head.value("record", ""); }
};

KeptRecord mesh_record(const DrawnMesh& mesh);
// Without the number of its mesh.
KeptRecord cloth_record(const KeptCloth& cloth);
KeptRecord body_record(const KeptBody& body);
// `quanta`: of each look's values.  Bodies are added to it.
KeptRecord instant_record(const DrawnMesh& mesh, const MeshPacker& packer, const KeptState& instant,
                          const std::map<std::string, double>& quanta);
// The vertices of a body at that instant; `packer` is of its mesh.
void add_body(KeptRecord& instant, const KeptBody& body, const MeshPacker& packer,
              const std::vector<float>& xyz);

std::string record_text(const KeptRecord& record);
// Whole records; what stands behind the last one is left out.  Throws Error::invalid_input, naming the file,
// for what is no file of these, Error::system if it cannot be read.
std::vector<KeptRecord> read_records(const std::filesystem::path& file);
// Throws Error::invalid_input, naming the file, for damaged records.
Kept read_kept(const std::filesystem::path& file);
// The first mesh of it alone; throws alike.
DrawnMesh read_kept_mesh(const std::filesystem::path& file);

// Of a run's or a recorded folder: all frames, else those of the sheet; "" if it keeps none.
std::filesystem::path kept_file_in(const std::filesystem::path& folder);

}  // namespace hysteron::experiments
