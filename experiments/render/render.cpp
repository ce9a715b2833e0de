// `hysteron render` draws sequences of OBJ or PLY files, of this program or another, in the look, light and
// camera of its own runs, and several of them side by side.  A folder of its own runs is drawn again as it
// was.
#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "experiments/render/archived_pictures.h"
#include "experiments/render/instants.h"
#include "experiments/workbench/app/experiment.h"
#include "experiments/workbench/app/manifest_file.h"
#include "experiments/workbench/app/run.h"
#include "experiments/workbench/compare/column_view.h"
#include "experiments/workbench/pages/report.h"
#include "experiments/workbench/pictures/drawing.h"
#include "experiments/workbench/pictures/mesh_pictures.h"
#include "render/contact_sheet.h"
#include "render/png_writer.h"
#include "sim/base/comma_list.h"
#include "sim/base/error.h"
#include "sim/base/number_in.h"
#include "sim/base/whole_file.h"
#include "sim/mesh/cloth_mesh.h"
#include "sim/mesh/mesh_sequence.h"
#include "sim/mesh/topology.h"
#include "sim/scene/choice.h"

namespace hysteron::experiments {
namespace {

enum class CurvatureSource { geometry, file };
constexpr std::array<const char*, 2> names(CurvatureSource) { return {"geometry", "file"}; }

struct RenderFlags {
  std::string fps, unit = "metre", up = "z";  // one for all sequences, or one for each, separated by commas
  std::string title, ground = "none", body, fabric, part;
  CurvatureSource curvature = CurvatureSource::geometry;
  double range = 100;  // [1/m]; 2 k0 of the shipped fabrics, as in the pictures of their runs
  Eigen::Vector3d low{0, 0, 0}, high{0, 0, 0}, also{0, 0, 0};
  std::string video = "none";
  double video_size = 4;
  Options options;
};

using F = RenderFlags;
// clang-format off
const KeyRow<F> kRows[] = {
    {"fps", at<&F::fps>, "", any(), "frames per second of the files, one number for all sequences or one for each, separated by commas; files are frames by the numbers in their names; without it pictures carry the frame's number"},
    {"render.unit", at<&F::unit>, "", any(), "unit of length in the files: metre | centimetre | millimetre | inch, for all or for each"},
    {"render.up", at<&F::up>, "", any(), "the files' upward axis: z | y, for all or for each"},
    {"render.range", at<&F::range>, "1/m", positive(), "curvature at the ends of the colour bar; 100, as in runs of the shipped fabrics; of kept geometry without it that of its run"},
    {"render.curvature", at<&F::curvature>, "", any(), "computed from positions, or the property of that name in a PLY"},
    {"render.title", at<&F::title>, "", any(), "of the sheet, and of a single sequence's pictures; else the sequences' names, or what was recorded"},
    {"render.ground", at<&F::ground>, "", any(), "height of a visible ground [m], or none"},
    {"render.body", at<&F::body>, "", any(), "a mesh that does not move, drawn matte as obstacles are; in the unit and axes of the first sequence"},
    {"render.fabric", at<&F::fabric>, "", any(), "a fabric of assets/fabrics or a file, whose colours and weave the cloth has"},
    {"render.also", at<&F::also>, "", any(), "a further row of the sheet has each sequence's last frame from this direction, which points to the eye; 0,0,0: none"},
    {"render.part", at<&F::part>, "", any(), "of a run's folder: how much relief is seen of the part that this [[metric]] of its scene is measured on, before and after: the median of the deviation of L* within 21 pixels, in this --light"},
    {"render.low", at<&F::low>, "m", any(), "with render.high: corners of what is framed; else the box of all frames"},
    {"render.high", at<&F::high>, "m", any(), "see render.low"},
    {"render.video", at<&F::video>, "", any(), "of a comparison whose columns' folders stand in its own: a film, as compare.video"},
    {"render.video-size", at<&F::video_size>, "MB", positive(), "as compare.video-size"},
};
// clang-format on

constexpr int kCells = 12, kInstants = 5;  // pictures on the sheet of one sequence, or of each of several

Keys option_keys(F& flags) {
  Keys keys = bind(kRows, flags);
  for (BoundKey& key : bind_options_of(Takers::files, flags.options)) keys.push_back(std::move(key));
  return keys;
}

Error refusal(const std::string& key, const std::string& value, const std::string& must) {
  return Error::invalid_input(key + " = " + value + " must be " + must + " (--" + key + ")")
      .with_key(key, value);
}

std::optional<float> ground_height(const F& flags) {
  if (flags.ground == "none") return {};
  float height = 0;
  const char* const end = flags.ground.data() + flags.ground.size();
  const auto [rest, code] = std::from_chars(flags.ground.data(), end, height);
  if (code != std::errc() || rest != end || !std::isfinite(height))
    throw refusal("render.ground", flags.ground, "a height [m] or none");
  return height;
}

// A sequence with the axes of its files, and the frames that the sheet shows.
struct Column : TimedSequence {
  FileAxes axes;

  // Returns "t = 0.50 s", or "frame 12" if the rate is unknown; "" for a single picture.
  std::string instant(std::size_t file) const {
    if (fps > 0) return fmt::format("t = {:.2f} s", static_cast<double>(frame[file]) / fps);
    return files.size() > 1 ? fmt::format("frame {}", frame[file]) : "";
  }
};

std::string after(const std::string& separator, const std::string& text) {
  return text.empty() ? "" : separator + text;
}

// Returns the i-th of `count` values in a list of one for all or one for each; "" for an empty list.
std::string listed_value(const std::string& key, const std::string& list, std::size_t i, std::size_t count) {
  const std::vector<std::string> values = split(list);
  if (values.empty()) return "";
  if (values.size() == 1) return values[0];
  if (values.size() == count) return values[i];
  throw refusal(key, list, "one value, or as many as sequences: " + std::to_string(count));
}

LengthUnit parsed_unit(const std::string& unit) {
  if (const auto known = value_if_named<LengthUnit>(unit)) return *known;
  throw refusal("render.unit", unit, join(every_name<LengthUnit>(), " | "));
}

bool is_y_up(const std::string& up) {
  if (up != "y" && up != "z") throw refusal("render.up", up, "z | y");
  return up == "y";
}

double frame_rate(const std::string& fps) {
  if (fps.empty()) return 0;
  const double rate = number_in(fps).value_or(0);
  if (!(rate > 0 && rate <= 10000)) throw refusal("fps", fps, "a number in (0, 10000] [1/s]");
  return rate;
}

// Returns the rate at which a run exported these meshes [1/s]; 0 if they are of no run, or it does not state
// it.
double recorded_rate(const MeshSequence& sequence) {
  const std::filesystem::path folder = sequence.files.front().parent_path();
  if (folder.filename() != "mesh") return 0;
  const std::optional<Manifest> run = manifest_or_none(folder.parent_path() / kManifestFile);
  if (!run || !run->options || !run->options->contains("fps")) return 0;
  const auto& fps = run->options->at("fps");
  return fps.is_number() ? fps.get<double>() : 0;
}

// Returns the requested rate, or that of the run whose meshes they are.
double frame_rate(const std::string& asked, const MeshSequence& sequence) {
  const double rate = frame_rate(asked), recorded = recorded_rate(sequence);
  if (rate > 0 && recorded > 0 && rate != recorded)
    throw refusal("fps", asked,
                  "left out, or that of the run in " +
                      sequence.files.front().parent_path().parent_path().string() + ", " +
                      number_text(recorded) + " [1/s]");
  return rate > 0 ? rate : recorded;
}

std::vector<Column> rendered_columns(const F& flags, const std::vector<std::string>& words) {
  std::vector<Column> columns;
  if (words.empty()) throw Error::invalid_input("needs mesh files or folders: hysteron render FILES...");
  const std::vector<MeshSequence> sequences = mesh_sequences(words);
  for (std::size_t i = 0; i < sequences.size(); ++i) {
    const auto value = [&](const char* key, const std::string& list) {
      return listed_value(key, list, i, sequences.size());
    };
    columns.push_back(
        {{{sequences[i]}, frame_rate(value("fps", flags.fps), sequences[i]), {}, {}},
         {parsed_unit(value("render.unit", flags.unit)), is_y_up(value("render.up", flags.up))}});
  }
  std::vector<TimedSequence*> timed;
  for (Column& column : columns) timed.push_back(&column);
  number_frames(timed);
  choose_instants(timed, columns.size() > 1 ? kInstants : kCells);
  return columns;
}

Surface moving_obstacle(const F& flags, const FileAxes& axes) {
  try {
    check_there(flags.body);
  } catch (const Error& error) {
    throw error.with_key("render.body", flags.body);
  }
  return read_frame(flags.body, axes);
}

// Returns the frame as a cloth, whose edges must have at most two triangles.
ClothMesh frame_mesh(const Surface& frame, const std::string& what) {
  ClothMesh mesh;
  mesh.rest = frame.vertex;
  mesh.face = frame.face;
  build_topology(mesh, what);
  return mesh;
}

void check_curvature(const F& flags, const Surface& frame, const std::string& what) {
  if (flags.options.look != "curvature") return;
  if (flags.curvature == CurvatureSource::file) {
    if (!frame.curvature.empty()) return;
    throw Error::invalid_input(what + ": no property curvature of its vertices (--render.curvature file)")
        .with_key("render.curvature", enum_name(flags.curvature));
  }
  frame_mesh(frame, what);
}

// Warns of what is doubtful about each sequence's first mesh: curvature needs an edge between two triangles.
void warn_of_loose_parts(const F& flags, const std::vector<Column>& columns, Run& run) {
  if (flags.options.look != "curvature" || flags.curvature == CurvatureSource::file) return;
  for (const Column& column : columns) {
    const std::string what = "mesh " + column.files.front().string();
    const ClothMesh mesh = frame_mesh(read_frame(column.files.front(), column.axes), what);
    for (const std::string& warning : mesh_warnings(mesh, {what, {}, {}})) run.warn(warning);
  }
}

// Reads every file once before anything is written, so that faults are found at the start; returns the box of
// all.
render::Box checked_box(const F& flags, const std::vector<Column>& columns) {
  std::optional<render::Box> box;
  const auto add = [&](const Surface& surface) {
    const render::Box here = render::bounding_box(flat_points(surface.vertex));
    box = box ? box->merged(here) : here;
  };
  for (const Column& column : columns)
    for (const auto& file : column.files) {
      const Surface frame = read_frame(file, column.axes);
      check_curvature(flags, frame, "mesh " + file.string());
      add(frame);
    }
  if (!flags.body.empty()) add(moving_obstacle(flags, columns.front().axes));
  return *box;
}

render::Box framed(const F& flags, const render::Box& whole) {
  if (flags.low == flags.high) return whole;
  if ((flags.low.array() < flags.high.array()).all())
    return {flags.low.cast<float>(), flags.high.cast<float>()};
  throw Error::invalid_input(
      "render.low must be less than render.high in x, y and z (--render.low, --render.high)")
      .with_key("render.low", "");
}

std::string joined_names(const std::vector<Column>& columns) {
  std::vector<std::string> names;
  names.reserve(columns.size());
  for (const Column& column : columns) names.push_back(column.name);
  return join(names, " | ");
}

void note_sequences(const std::vector<Column>& columns, Run& run) {
  std::vector<const TimedSequence*> timed;
  for (const Column& column : columns) timed.push_back(&column);
  for (const std::string& warning : frame_warnings(timed)) run.warn(warning);
  Json notes = Json::array();
  for (const Column& column : columns) {
    Json files = Json::array();
    for (const auto& file : column.files) files.push_back(file.string());
    notes.push_back({{"name", column.name}, {"files", files}, {"frames", column.frame}});
  }
  run.note("sequences", notes);
}

std::string direction_text(const Eigen::Vector3d& direction) {
  constexpr double kSteep = 0.9;  // limit of the sine of the elevation
  return direction.normalized().z() > kSteep ? "from above" : "from elsewhere";
}

class FramesAndSheet {
 public:
  FramesAndSheet(const F& flags, const std::vector<Column>& columns, const render::Box& bounds, Run& run)
      : flags_(flags),
        columns_(columns),
        run_(run),
        pictures_(flags.options, {bounds, ground_height(flags), flags.range,
                                  flags.curvature == CurvatureSource::file, flags.fabric}) {}

  void draw() {
    if (!flags_.body.empty()) pictures_.add_body(moving_obstacle(flags_, columns_.front().axes));
    for (const Column& column : columns_) draw_sequence(column);
    writer_.finish();
    write_sheet();
    run_.manifest().renderer = pictures_.renderer();
    run_.manifest().positions = "host (files)";
    run_.add_seconds("encode", writer_.encode_seconds());
  }

 private:
  bool alone() const { return columns_.size() == 1; }
  std::string label(const Column& column) const {
    return alone() && !flags_.title.empty() ? flags_.title : column.name;
  }

  void draw_sequence(const Column& column) {
    pictures_.begin_sequence();
    Surface frame;
    for (std::size_t k = 0; k < column.files.size(); ++k) {
      frame = read(column, k);
      draw_frame(column, frame, k);
    }
    run_.metric(column.name + ".frames_count", column.files.size());
    run_.metric(column.name + ".triangles_count", frame.face.size());
    if (const auto rms = pictures_.curvature_rms()) run_.metric(column.name + ".curvature_rms_per_m", *rms);
    if (flags_.also.isZero()) return;
    pictures_.look_from(flags_.also);
    add_cell(picture(frame, column.name), frame, direction_text(flags_.also));
    pictures_.look_from(flags_.options.camera_direction);
  }

  Surface read(const Column& column, std::size_t k) {
    const auto stage = run_.stage("io");
    return read_frame(column.files[k], column.axes);
  }

  void draw_frame(const Column& column, const Surface& frame, std::size_t k) {
    const std::string when = column.instant(k), file = column.files[k].string();
    run_.progress(file + ": " + std::to_string(frame.face.size()) + " triangles" + after(", ", when));
    render::Image image = picture(frame, "mesh " + file);
    for (auto n = std::count(column.shown.begin(), column.shown.end(), static_cast<int>(k)); n > 0; --n)
      add_cell(image, frame, when);
    pictures_.letter_picture(image, label(column) + after("\n", when));
    const std::string folder = alone() ? "frames" : column.name;
    writer_.write(run_.path(fmt::format("{}/{:04}.png", folder, k)), std::move(image));
  }

  void add_cell(const render::Image& image, const Surface& frame, const std::string& when) {
    const float aspect = static_cast<float>(image.width()) / static_cast<float>(image.height());
    const render::Window at = pictures_.camera().image_window(flat_points(frame.vertex), aspect);
    cells_.push_back({image, when, {}, pictures_.metres_per_pixel()});
    cells_.back().shown.cloth = {at.left, 1 - at.top, at.right, 1 - at.bottom};
  }

  render::Image picture(const Surface& frame, const std::string& what) {
    const auto stage = run_.stage("render");
    return pictures_.picture(frame, what);
  }

  // Leaves out instants that look like an earlier one in every sequence; cells are ordered by sequence.
  void drop_repeated_instants() {
    const std::size_t count = cells_.size() / columns_.size();
    const auto are_alike = [&](std::size_t a, std::size_t b) {
      Crop both;
      for (std::size_t first = 0; first < cells_.size(); first += count)
        for (const std::size_t i : {first + a, first + b}) both.include(cells_[i].shown);
      for (std::size_t first = 0; first < cells_.size(); first += count)
        if (!render::look_alike(both.of(cells_[first + a].image), both.of(cells_[first + b].image)))
          return false;
      return true;
    };
    std::vector<Cell> kept;
    const std::vector<std::size_t> instants = render::distinct(count, are_alike);
    for (std::size_t first = 0; first < cells_.size(); first += count)
      for (const std::size_t i : instants) kept.push_back(std::move(cells_[first + i]));
    cells_ = std::move(kept);
  }

  // Composes the sheet from cells that are ordered by sequence.  Each of several sequences has a column; of a
  // single one each instant has.
  void write_sheet() {
    drop_repeated_instants();
    render::ComparisonSheet sheet;
    sheet.title = flags_.title.empty() ? joined_names(columns_) : flags_.title;
    sheet.scale_note = "in the middle";
    sheet.in_sequence = alone();
    const std::size_t rows = alone() ? 1 : cells_.size() / columns_.size();
    const std::size_t wide = alone() ? cells_.size() : columns_.size();
    std::vector<Crop> crops(rows);
    for (std::size_t c = 0; c < wide; ++c)
      for (std::size_t r = 0; r < rows; ++r) crops[r].include(cells_[c * rows + r].shown);
    for (std::size_t r = 0; r < rows; ++r)
      sheet.rows.push_back({alone() ? "" : cells_[r].when, "", cells_[r].metres_per_pixel});
    for (std::size_t c = 0; c < wide; ++c) {
      sheet.columns.push_back({.name = alone() ? cells_[c].when : columns_[c].name, .numbers = {}});
      for (std::size_t r = 0; r < rows; ++r)
        sheet.columns.back().cells.push_back({crops[r].of(cells_[c * rows + r].image)});
    }
    if (const auto bar = pictures_.color_bar()) sheet.bars.push_back(*bar);
    sheet.beside = alone() ? 0 : static_cast<int>(std::min<std::size_t>(wide, render::kMaxBeside));
    render::write_png(run_.path("sheet.png"), render::draw_comparison(sheet), render::PngEffort::best);
  }

  struct Cell {
    render::Image image;
    std::string when;
    Frames::Instant shown;  // region of the cloth in the picture
    double metres_per_pixel;
  };

  const F& flags_;
  const std::vector<Column>& columns_;
  Run& run_;
  MeshPictures pictures_;
  std::vector<Cell> cells_;
  render::PngWriter writer_;
};

// Throws for looks that show friction or residual curvature, which mesh files do not hold.
void check_look(const std::string& look) {
  static const std::vector<std::string> kLooks = {"cloth",     "grid",      "clay",
                                                  "curvature", "wireframe", "silhouette"};
  check_choice("look", look, kLooks);
}

// Draws a folder again from the meshes within, if it keeps what its sheet was drawn from in a folder per
// column.
CommandLine from_within(CommandLine line) {
  namespace fs = std::filesystem;
  if (line.positionals.size() != 1) return line;
  const fs::path folder = line.positionals[0];
  const std::optional<Manifest> recorded = manifest_or_none(folder / "manifest.json");
  if (!recorded || recorded->experiment != "render" || !recorded->spec) return line;
  std::vector<std::string> columns;
  for (const std::string& name : recorded->spec->positionals)
    if (const fs::path column = folder / fs::path(name).filename(); fs::is_directory(column / "mesh"))
      columns.push_back(column.string());
  if (columns.empty() || columns.size() != recorded->spec->positionals.size()) return line;
  line.positionals = columns;
  for (const auto& [path, text] : recorded->spec->flags)
    if (!simulation_traits(path).is_of_page() && last_text(line.flags, path, "").empty())
      line.flags.push_back(parsed_flag(line.experiment, path, text));
  return line;
}

int run_render(const CommandLine& asked) {
  if (const auto kept = archived_geometry_file(asked); !kept.empty()) {
    draw_archived(asked, kept);
    return 0;
  }
  const CommandLine line = from_within(asked);
  F flags;
  flags.options.out = "out/render";
  const Keys keys = option_keys(flags);
  set_keys(line, keys);
  if (flags.video != "none")
    throw refusal("render.video", flags.video, "left out: it is of a comparison's folder, not of mesh files");
  check_options(flags.options);
  check_look(flags.options.look);
  ground_height(flags);
  if (!flags.part.empty())
    throw refusal("render.part", flags.part, "left out: it is of a run's folder, not of files");
  const std::vector<Column> columns = rendered_columns(flags, line.positionals);
  const render::Box bounds = framed(flags, checked_box(flags, columns));
  Run run(line, flags.options, to_json(keys));
  note_sequences(columns, run);
  warn_of_loose_parts(flags, columns, run);
  FramesAndSheet(flags, columns, bounds, run).draw();
  finish_with_report(run);
  return 0;
}

}  // namespace

Experiment render_files() {
  return {.name = "render",
          .question =
              "pictures of OBJ/PLY sequences of any simulator, side by side in one look and camera; "
              "those of a run's folder again, from the geometry that it keeps",
          .run = run_render,
          .own_keys = own_key_descriptions<option_keys>,
          .positionals = "FILES|DIR",
          .conditions = {{"render.range | render.curvature", "look = curvature"},
                         {"render.low", "render.high"},
                         {"render.high", "render.low"},
                         {"render.video-size", "render.video != none"}},
          .headlines = {
              .all = {{"frames_count", "frames", "", "{:.0f}", 1, kNoErrors},
                      {"lightness_deviation_before", "deviation of L* before", "", "{:.2f}", 1, kNoErrors},
                      {"lightness_deviation", "deviation of L*", "", "{:.2f}", 1, kNoErrors},
                      {"lightness_deviation_added", "deviation of L* that was added", "", "{:.2f}", 1,
                       kNoErrors}}}};
}

}  // namespace hysteron::experiments
