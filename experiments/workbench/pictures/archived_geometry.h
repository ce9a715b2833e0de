// One file keeps the data of pictures: cloth at each instant, with the scene and options that draw it.
//
//   {"record": "mesh", ...}      triangles and pattern, once for all cloth that has them
//   {"record": "cloth", ...}     scene, options and framed box, for the instants that follow
//   {"record": "body", ...}      triangles of an obstacle from a file, and, if it keeps its shape, their
//                                vertices
//   {"record": "instant", ...}   positions and values at the vertices
//   {"record": "sheet", ...}     heads of the contact sheet, or of a comparison's page
//
// Each record is a line of JSON and, behind it, as many packed blocks (packing.h) as its "bytes" has lengths.
// Records are appended while a run goes on: a file that ends within one has all before it, and the last comes
// with the sheet.  Numbers are whole multiples of a "quantum": pictures are drawn from positions rounded in
// this way, unless they go from CUDA to OpenGL on one GPU.
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

inline constexpr const char* kArchivedFrames = "frames.hyg";  // data of all pictures of a run
inline constexpr const char* kArchivedSheet = "sheet.hyg";    // data of those on its sheet

// Returns the nearest multiple of `quantum`, as a count, or for each value.
int quantum_count(double value, double quantum);
std::vector<float> rounded(std::span<const float> values, double quantum);
// Does the same, but a value within three quarters of a quantum of its previous multiple stays there, so that
// slow creep does not alternate between two multiples.  `before` has the previous multiples, one a value;
// empty: none.
std::vector<float> rounded(std::span<const float> values, double quantum, std::span<const float> before);

struct DrawnMesh {
  std::size_t vertices = 0;
  std::vector<int> triangles;  // 3 per triangle, counter-clockwise seen from the front
  std::vector<float> pattern;  // warp and weft coordinates, 2 per vertex [m]; may be empty
  double quantum = 0;          // quantum of positions [m]
};

struct ArchivedState {
  double time = 0;                                   // [s]
  std::vector<float> xyz;                            // 3 per vertex [m]
  std::map<std::string, std::vector<float>> values;  // by look, one per vertex
  std::size_t loop = 0;  // number of points of the probe's path so far, which is in the sheet's record
  std::map<std::size_t, std::vector<float>> bodies{};  // by obstacle, for those that change their shape
};

// An obstacle of kind mesh.
struct ArchivedBody {
  std::size_t obstacle = 0;  // index in the scene
  DrawnMesh mesh;            // has no pattern
  bool closed = false;
  std::vector<float> xyz;  // 3 per vertex in its own frame [m]; empty if the instants have them
};

struct ArchivedCloth {
  std::string name;  // name of a comparison's column
  std::size_t mesh = 0;
  Json setup;  // "scene", "options"; for a column also "manifest" and "stopped"
  render::Box bounds;
  std::optional<float> floor;  // [m]
  std::vector<ArchivedState> instants;
  std::vector<ArchivedBody> bodies{};
};

struct Archived {
  std::vector<DrawnMesh> meshes;
  std::vector<ArchivedCloth> cloths;
  Json sheet;  // null if the file has none
};

// A record as stored in the file.
struct ArchivedRecord {
  Json head;
  std::vector<std::string> blocks;
  std::string kind() const { return head.value("record", ""); }
};

ArchivedRecord mesh_record(const DrawnMesh& mesh);
// These records lack the index of their mesh, which is added when they are written.
ArchivedRecord cloth_record(const ArchivedCloth& cloth);
ArchivedRecord body_record(const ArchivedBody& body);
// `quanta` are those of each look's values.  Bodies are added by add_body().
ArchivedRecord instant_record(const DrawnMesh& mesh, const MeshPacker& packer, const ArchivedState& instant,
                              const std::map<std::string, double>& quanta);
// Adds the vertices of a body at that instant, 3 numbers each [m]; `packer` is that of its mesh.
void add_body(ArchivedRecord& instant, const ArchivedBody& body, const MeshPacker& packer,
              const std::vector<float>& xyz);

std::string record_text(const ArchivedRecord& record);
// Returns the complete records and drops what follows the last.  Throws Error::invalid_input, naming the
// file, if it has another format, Error::system if it cannot be read.
std::vector<ArchivedRecord> read_records(const std::filesystem::path& file);
// Reads the file.  Throws Error::invalid_input, naming the file, for damaged records.
Archived read_archived(const std::filesystem::path& file);
// Reads its first mesh alone; throws as read_archived() does.
DrawnMesh read_archived_mesh(const std::filesystem::path& file);

// Returns the file of a run's or a recorded folder: that of all frames, else that of the sheet; "" if there
// is none.
std::filesystem::path archived_file_in(const std::filesystem::path& folder);

}  // namespace hysteron::experiments
