#include "experiments/fab/sheet_pictures.h"

#include <fmt/core.h>

#include <algorithm>

#include "experiments/specimens/jaw.h"
#include "experiments/workbench/pictures/drawing.h"

namespace hysteron::experiments {
namespace {

constexpr double kJawLength = 8e-3;  // [m]
constexpr JawSize kJaw{.overhang = 2e-3, .thickness = 3e-3};
constexpr float kRoom = 1.5e-3f;  // around the jaws, and below the cloth [m]
constexpr int kFrames = 4;        // of a branch; every second is on the contact sheet
constexpr int kCells = kFrames;   // of a cycle there

}  // namespace

SheetPictures::SheetPictures(Run& run, const Options& options, const FabSheet& sheet, const FabLoops& loops,
                             double height)
    : run_(run), sheet_(sheet), loops_(loops), setup_{sheet.scene, options} {
  setup_.options.camera_direction = {0.25, -1.0, 0.35};
  const double width = sheet.scene.cloth.width, length = sheet.scene.cloth.length;
  setup_.scene.obstacle = {jaw(-kJawLength, sheet.spacing, width, kJaw),
                           jaw(length - sheet.spacing, length + kJawLength, width, kJaw)};
  // Where the jaw is when the cloth starts, a little nearer than on the flat cloth.
  const Eigen::Vector3d moved = sheet.cloth.start[sheet.cloth.pin_vertices[1][0]] -
                                sheet.cloth.mesh.rest[sheet.cloth.pin_vertices[1][0]];
  setup_.scene.obstacle[1].center += moved;
  setup_.scene.obstacle[1].motion = sheet.scene.pin[1].motion;
  const float top = static_cast<float>(sheet.side > 0 ? height : kJaw.thickness / 2);
  floor_ = -static_cast<float>(sheet.side > 0 ? kJaw.thickness / 2 : height) - kRoom;
  framed_ = {{static_cast<float>(-kJawLength), static_cast<float>(-kJaw.overhang), floor_},
             {static_cast<float>(length + kJawLength), static_cast<float>(width + kJaw.overhang), top}};
}

// Which frame of its branch a row is, 1 to kFrames; 0: none.
int SheetPictures::part_of(const SheetRow& row) const {
  const std::size_t last = loops_.branches[row.branch].distance.size() - 1;
  for (int part = 1; part <= kFrames; ++part)
    if (row.row == last * static_cast<std::size_t>(part) / kFrames) return part;
  return 0;
}

void SheetPictures::begin(Simulation& simulation) {
  pictures_ = std::make_unique<Pictures>(setup_, sheet_.cloth, simulation, framed_, floor_);
  run_.manifest().renderer = pictures_->renderer();
}

void SheetPictures::watch(const SheetRow& row, Simulation& simulation) {
  const int part = part_of(row);
  if (part == 0) return;
  if (!pictures_) begin(simulation);
  const auto stage = run_.stage("render");
  const std::string when = fmt::format("cycle {}, {}: {:.1f} mm, {:+.2f} N/m", row.branch / 2 + 1,
                                       row.branch % 2 == 0 ? "out" : "back", 1e3 * row.distance, row.force);
  render::Image image = pictures_->picture("cloth", pictures_->camera(),
                                           sheet_.scene.fabric.name + ", " + loops_.name() + "\n" + when);
  if (part % 2 == 0) cells_.push_back({thumbnail(image), when});
  writer_.write(run_.path(fmt::format("frames/{:04}.png", frames_++)), std::move(image));
  if (part == kFrames && row.branch + 1 == loops_.branches.size())
    pictures_.reset();  // which the simulation must outlive
}

void SheetPictures::finish(const std::string& title) {
  writer_.finish();
  render::write_png(run_.path("sheet.png"),
                    render::contact_sheet(cells_, {.title = title, .columns = kCells}),
                    render::PngEffort::best);
}

}  // namespace hysteron::experiments
