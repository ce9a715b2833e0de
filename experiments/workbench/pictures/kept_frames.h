// The file in which a run keeps what its pictures are drawn from, and the choice of it beside its sheet.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "experiments/workbench/app/experiment.h"
#include "experiments/workbench/pictures/kept_geometry.h"

namespace hysteron::experiments {

class KeptFrames {
 public:
  // `mesh` must outlive it.
  KeptFrames(const Setup& setup, const DrawnMesh& mesh, const render::Box& bounds,
             std::optional<float> floor);

  // Appends an instant with the bodies of triangles that the scene has then; the first begins the file anew.
  // Throws Error::system if it cannot be written.
  void add(const std::filesystem::path& file, KeptState instant);
  // Appends how the sheet of these instants is headed, as the file beside the sheet has it.
  static void end(const std::filesystem::path& file, const KeptRecord& sheet);
  // A run goes on that had kept at least as many instants: those behind them go.
  void continue_file(const std::filesystem::path& file, std::size_t instants);
  // Multiple to which a look's values are rounded, in their unit.
  double quantum(const std::string& look) const { return quanta_.at(look); }

 private:
  const DrawnMesh& mesh_;
  MeshPacker packer_;
  KeptCloth cloth_;
  std::vector<Obstacle> obstacles_;
  std::vector<MeshPacker> body_packers_;  // of the bodies of cloth_
  std::map<std::string, double> quanta_;
  bool has_begun_ = false;
};

// What a sheet shows: mesh and cloth of a file of one run, and the instants of these numbers, as it has them.
std::vector<KeptRecord> chosen_records(const std::filesystem::path& frames, const std::vector<int>& instants);
// Throws Error::system.
void write_records(const std::filesystem::path& file, const std::vector<KeptRecord>& records);

// Scene, with its bodies of triangles, and options that draw the cloth; `file` names it in messages.  Throws
// Error::invalid_input for what this program does not know.
Setup kept_setup(const KeptCloth& cloth, const std::string& file);

}  // namespace hysteron::experiments
