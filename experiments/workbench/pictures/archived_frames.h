// Writes the file in which a run keeps the data of its pictures, and the selection beside its sheet.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "experiments/workbench/app/experiment.h"
#include "experiments/workbench/pictures/archived_geometry.h"

namespace hysteron::experiments {

class ArchivedFrames {
 public:
  // `mesh` must outlive this object.
  ArchivedFrames(const Setup& setup, const DrawnMesh& mesh, const render::Box& bounds,
                 std::optional<float> floor);

  // Appends an instant with the bodies of triangles that the scene then has; the first begins the file anew.
  // Throws Error::system if it cannot be written.
  void add(const std::filesystem::path& file, ArchivedState instant);
  // Appends the record of the sheet of these instants, for the file beside the sheet.
  static void end(const std::filesystem::path& file, const ArchivedRecord& sheet);
  // Continues the file of a run that had kept at least as many instants; later ones are removed.
  void continue_file(const std::filesystem::path& file, std::size_t instants);
  // Returns the multiple to which a look's values are rounded, in their unit.
  double quantum(const std::string& look) const { return quanta_.at(look); }

 private:
  const DrawnMesh& mesh_;
  MeshPacker packer_;
  ArchivedCloth cloth_;
  std::vector<Obstacle> obstacles_;
  std::vector<MeshPacker> body_packers_;  // for the bodies of cloth_
  std::map<std::string, double> quanta_;
  bool has_begun_ = false;
};

// Returns the records of a sheet: mesh and cloth of a file of one run, and the instants with these numbers.
std::vector<ArchivedRecord> chosen_records(const std::filesystem::path& frames,
                                           const std::vector<int>& instants);
// Writes the records.  Throws Error::system.
void write_records(const std::filesystem::path& file, const std::vector<ArchivedRecord>& records);

// Returns the scene, with its bodies of triangles, and the options that draw the cloth; `file` names it in
// messages.  Throws Error::invalid_input for keys unknown to this program.
Setup archived_setup(const ArchivedCloth& cloth, const std::string& file);

}  // namespace hysteron::experiments
