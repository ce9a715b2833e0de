// Finds sequences of mesh files, from this program or another.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "sim/mesh/length_unit.h"
#include "sim/mesh/surface.h"

namespace hysteron {

struct MeshSequence {
  std::string name;
  std::vector<std::filesystem::path> files;  // one per frame, all of one format
  // The numbers that tell the files apart, ascending: 1, 5, 6 for f1.obj, f5.obj, f6.obj.  Empty where the
  // names differ in more than one number, or the files are not in its order.
  std::vector<std::int64_t> number;
  std::string unnumbered;  // why several files have no numbers: "rest.obj is not named like f1.obj"
};

// Finds the sequences of a command line's words: each folder is a sequence, its *.obj or *.ply in the order
// of their names (numbers in them by value); the files together are one more, in the order given, in the
// first one's place.  A folder without meshes that has a folder mesh/ of them, as a run leaves it with
// --export, stands for that folder.  Sequences are named after their folder (mesh/ after the one above), a
// single file after itself; equal names get numbers.  Throws Error::invalid_input for words that are no mesh
// file or folder, folders without meshes or with a file that is named unlike most others of it, and sequences
// of both formats.
std::vector<MeshSequence> mesh_sequences(const std::vector<std::string>& words);

// Returns the files whose names match a pattern with *, ? and [...] in any of its folders (glob(7)), in the
// order of their names, numbers in them by value; a file of that very name matches.  None if there is no such
// file.
std::vector<std::filesystem::path> files_like(const std::string& pattern);

// Does the folder exist, with .obj or .ply files? Throws Error::system where it cannot be read.
bool holds_meshes(const std::filesystem::path& folder);

// The relation of a file's coordinates to metres with z up.
struct FileAxes {
  LengthUnit unit = LengthUnit::metre;
  bool y_up = false;  // (x, y, z) in the file is (x, -z, y) here
};
// Reads a frame in metres, z up, with curvature in 1/m.  Throws as read_surface() does.
Surface read_frame(const std::filesystem::path& file, const FileAxes& axes);

// Returns warp and weft coordinates [m] of each vertex, n x 2, for the look's threads: texture coordinates
// where the surface has them, scaled to its area unless they are lengths already; otherwise the two axes
// along which the surface extends most, in alphabetical order: x and y of a cloth that lies flat.
std::vector<float> thread_coordinates(const Surface& surface);

}  // namespace hysteron
