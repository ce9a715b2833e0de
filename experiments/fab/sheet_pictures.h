// The sheet between its clamps, seen along its way: frames/0000.png ... and sheet.png.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "experiments/fab/sheet.h"
#include "experiments/workbench/pictures/pictures.h"
#include "render/contact_sheet.h"

namespace hysteron::experiments {

class SheetPictures {
 public:
  // `height`: to which the strip buckles at most [m].  All must outlive the pictures.
  SheetPictures(Run& run, const Options& options, const FabSheet& sheet, const FabLoops& loops,
                double height);

  // A SheetWatch: draws the rows that are worth a frame.
  void watch(const SheetRow& row, Simulation& simulation);
  // Writes the contact sheet: a line per cycle, half-way and at the turns of the clamps.
  void finish(const std::string& title);

 private:
  int part_of(const SheetRow& row) const;
  void begin(Simulation& simulation);

  Run& run_;
  const FabSheet& sheet_;
  const FabLoops& loops_;
  Setup setup_;
  render::Box framed_;
  float floor_;
  std::unique_ptr<Pictures> pictures_;
  render::PngWriter writer_;
  int frames_ = 0;
  std::vector<render::SheetEntry> cells_;
};

}  // namespace hysteron::experiments
