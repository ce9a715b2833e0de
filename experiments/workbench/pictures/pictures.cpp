#include "experiments/workbench/pictures/pictures.h"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "experiments/workbench/app/camera_file.h"
#include "experiments/workbench/app/law_family.h"
#include "experiments/workbench/pictures/bent_part.h"
#include "experiments/workbench/pictures/drawing.h"
#include "sim/base/archive.h"
#include "sim/base/atomic_file.h"
#include "sim/base/error.h"
#include "sim/base/root_mean_square.h"

namespace hysteron::experiments {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kSheetCells = 8;           // most pictures on the contact sheet
constexpr int kSkins = 14;               // instants of a motion in one picture
constexpr float kInsetFraction = 0.18f;  // share of a picture, which is wide

// Returns "frames/0012.png"; for further looks "frames-LOOK/0012.png".
std::string frame_file(const std::string& look, bool first, int number) {
  return fmt::format("{}/{:04}.png", first ? "frames" : "frames-" + look, number);
}

Error no_cloth_in(const std::string& picture, double time) {
  return Error::simulation(
      fmt::format("{} shows no cloth at t = {:.3f} s: frame where it is (--camera.box)", picture, time));
}

// Returns those that look different, in their order.
std::vector<render::SheetEntry> distinct_cells(const std::vector<render::SheetEntry>& cells) {
  std::vector<render::SeenPicture> seen;
  for (const render::SheetEntry& cell : cells) seen.push_back(render::on_front_page(cell.image));
  std::vector<render::SheetEntry> kept;
  for (std::size_t i : render::distinct(
           cells.size(), [&](std::size_t a, std::size_t b) { return render::look_alike(seen[a], seen[b]); }))
    kept.push_back(cells[i]);
  return kept;
}

std::vector<double> instant_times(const std::vector<ArchivedInstant>& instants) {
  std::vector<double> times;
  for (const ArchivedInstant& instant : instants) times.push_back(instant.time);
  return times;
}

// Adds the time from construction to destruction.
class Stopwatch {
 public:
  explicit Stopwatch(double& seconds) : seconds_(seconds) {}
  ~Stopwatch() { seconds_ += std::chrono::duration<double>(Clock::now() - start_).count(); }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  double& seconds_;
  Clock::time_point start_ = Clock::now();
};

}  // namespace

std::vector<std::string> picture_files(const Options& options) {
  std::vector<std::string> names = {"sheet.png", "camera.json"};
  for (const std::string& look : options.looks()) names.push_back(frame_file(look, names.size() == 2, 0));
  names.insert(names.end(), {kArchivedFrames, kArchivedSheet});
  return names;
}

Pictures::Pictures(const Setup& setup, const Cloth& cloth, Simulation& simulation, const render::Box& bounds,
                   std::optional<float> floor)
    : Pictures(setup, simulated(setup.scene, cloth, simulation, setup.options.reference), bounds, floor) {}

Pictures::Pictures(const Setup& setup, std::unique_ptr<FrameSource> source, const render::Box& bounds,
                   std::optional<float> floor)
    : scene_(setup.scene),
      options_(setup.options),
      source_(std::move(source)),
      bounds_(bounds),
      archived_frames_(setup, source_->mesh(), bounds, floor),
      scene_renderer_([this, floor] {
        return std::make_unique<SceneRenderer>(scene_, options_, source_->mesh(), bounds_, floor,
                                               source_->cuda_device());
      }) {
  scene_renderer_.run([this](SceneRenderer& studio) {
    renderer_ = studio.offscreen().description();
    studio.view().share_positions(source_->share_positions(studio.view().position_buffer(),
                                                           studio.offscreen().cuda_device(), why_host_));
  });
}

render::Camera Pictures::camera() const { return framed_camera(options_, bounds_); }

// Waits because the studio's thread reads the options while it draws.
void Pictures::set_light(Lighting light) {
  scene_renderer_.wait();
  options_.light = light;
}

// The simulation stands still meanwhile, because the studio's thread reads its positions where they are.
void Pictures::take_positions(const std::vector<float>& xyz) {
  if (scene_renderer_.run([this](SceneRenderer& studio) { return studio.view().write_positions(why_host_); }))
    return;
  scene_renderer_.run([&](SceneRenderer& studio) { studio.view().set_positions(xyz); });
}

std::string Pictures::when(double time) const {
  const std::string phase = scene_.phase_at(time);
  return fmt::format("t = {:.2f} s{}{}", time, phase.empty() ? "" : ", ", phase);
}

std::string Pictures::caption(double time) const {
  return scene_.fabric.name + ", law " + scene_.law + "\n" + when(time);
}

// Returns no caption for a figure, whose background is transparent, as it has a caption of its own.
std::string Pictures::captioned(const std::string& text) const {
  return options_.background == render::Background::transparent ? "" : text;
}

render::Image Pictures::picture(const std::string& look, const render::Camera& camera,
                                const std::string& text) {
  take_positions(rounded(source_->positions(), source_->mesh().quantum));
  const SceneRenderer::Shown shown{source_->time(), source_->values(look)};
  return scene_renderer_.run(
      [&](SceneRenderer& studio) { return single(studio, look, camera, text, shown); });
}

void Pictures::picture_file(const std::filesystem::path& file, const std::string& look,
                            const std::string& text) {
  take_positions(rounded(source_->positions(), source_->mesh().quantum));
  scene_renderer_.post(
      [=, this, shown = SceneRenderer::Shown{source_->time(), source_->values(look)}](SceneRenderer& studio) {
        write(file, single(studio, look, camera(), text, shown));
      });
}

// Draws one picture on the studio's thread.
render::Image Pictures::single(SceneRenderer& studio, const std::string& look, const render::Camera& camera,
                               const std::string& text, const SceneRenderer::Shown& shown) {
  const Stopwatch watch(render_seconds_);
  render::Image image = studio.draw(scene_look(scene_, options_, look), camera, shown);
  if (!studio.view().shows_cloth()) throw no_cloth_in("the picture of look " + look, shown.time);
  if (!options_.plain)
    annotate(image, camera, bounds_.center(), captioned(text), value_color_bar(scene_, options_, look));
  return image;
}

// Records what a page that compares runs needs to know of their pictures.
void Pictures::note_frame(Run& run, const std::vector<FrameJob>& orders, const std::vector<float>& xyz,
                          std::optional<double> difference) {
  std::optional<Frames>& frames = run.manifest().frames;
  if (!frames) frames.emplace();
  frames->looks.clear();
  Frames::Instant instant{source_->time(), scene_.phase_at(source_->time())};
  instant.difference_rms = difference;
  for (const FrameJob& order : orders) {
    frames->looks.push_back({order.look});
    if (const auto bar = value_color_bar(scene_, options_, order.look))
      frames->looks.back().bar = {bar->label, bar->unit, bar->low, bar->high};
  }
  const render::Window at = camera().image_window(xyz, picture_aspect(options_));
  instant.cloth = {at.left, 1 - at.top, at.right, 1 - at.bottom};
  instant.moved = kept_.add(
      {instant.time, xyz, orders.front().shown.values, when(instant.time), orders.front().loop.path});
  frames->metres_per_pixel = camera().metres_per_pixel(bounds_.center(), options_.height());
  frames->instants.push_back(std::move(instant));
}

void Pictures::watch_border(Run& run, const std::filesystem::path& file, const std::vector<float>& xyz) {
  if (is_cut_off_ || camera().frames(xyz, picture_aspect(options_))) return;
  is_cut_off_ = true;
  run.warn(
      fmt::format("from t = {:.3f} s on ({}) the cloth is cut off at the border of pictures: --camera.box "
                  "frames more",
                  source_->time(), file.lexically_relative(run.folder()).string()));
}

void Pictures::frame(Run& run, const std::vector<float>& xyz, const render::Path& loop) {
  const Stopwatch waited(waited_seconds_);
  const std::vector<float> before = kept_.empty() ? std::vector<float>{} : kept_.last().xyz;
  ArchivedState instant{
      source_->time(), rounded(xyz, source_->mesh().quantum, before), {}, loop.curvature.size(), {}};
  take_positions(instant.xyz);
  std::vector<FrameJob> orders;
  for (const std::string& look : options_.looks()) {
    orders.push_back({look,
                      run.path(frame_file(look, orders.empty(), frames_)),
                      {instant.time, source_->values(look)},
                      {.path = loop, .color = color_of_law(scene_.law)}});
  }
  watch_border(run, orders.front().file, instant.xyz);
  ++frames_;
  std::optional<double> difference;
  for (FrameJob& order : orders) {
    if (order.shown.values.empty()) continue;
    if (!source_->has_values(order.look))
      run.warn(
          "reference = " + options_.reference +
          " has no instant within half a step of some of this run's pictures: look difference is blank in "
          "these, and their root mean square is left out");
    else if (order.look == "difference")
      difference = root_mean_square(order.shown.values, source_->vertex_areas());
    order.shown.values = rounded(order.shown.values, archived_frames_.quantum(order.look));
    instant.values[order.look] = order.shown.values;
  }
  note_frame(run, orders, instant.xyz, difference);
  scene_renderer_.post([this, orders = std::move(orders), instant = std::move(instant),
                        file = run.path(kArchivedFrames)](SceneRenderer& studio) {
    const Stopwatch watch(render_seconds_);
    archived_frames_.add(file, instant);
    for (const FrameJob& order : orders) fill(studio, order);
  });
}

// Draws a job's picture on the studio's thread.
void Pictures::fill(SceneRenderer& studio, const FrameJob& order) {
  render::Image image =
      studio.draw_with_ghosts(scene_look(scene_, options_, order.look), camera(), order.shown);
  if (!studio.view().shows_cloth()) {
    writer_.write(order.file, std::move(image));
    throw no_cloth_in(order.file.string(), order.shown.time);
  }
  if (!options_.plain) {
    const auto bar = value_color_bar(scene_, options_, order.look);
    annotate(image, camera(), bounds_.center(), captioned(caption(order.shown.time)), bar);
    render::draw_loop(image, order.loop, bar ? render::Corner::top_right : render::Corner::bottom_right,
                      kInsetFraction, render::text_size(image));
  }
  writer_.write(order.file, std::move(image));
}

render::Image Pictures::silhouette(double half_width, int pixels, double& metres_per_pixel) {
  const float r = static_cast<float>(half_width);
  const render::Box box{{-r, -r, bounds_.low.z()}, {r, r, bounds_.high.z()}};
  const render::Camera camera = render::Camera::top(box, 1);
  metres_per_pixel = camera.metres_per_pixel(box.center(), pixels);
  const std::vector<float> xyz = source_->positions();
  return scene_renderer_.run([&](SceneRenderer& studio) { return studio.silhouette(xyz, camera, pixels); });
}

void Pictures::serialise(Archive& archive, Run& run) {
  scene_renderer_.wait();
  if (!archive.loads()) writer_.finish();
  archive(frames_);
  archive(is_cut_off_);
  archive(waited_seconds_);
  archive(render_seconds_);
  double encode = encode_seconds_ + writer_.encode_seconds();
  archive(encode);
  if (!run.manifest().frames) run.manifest().frames.emplace();
  std::vector<Frames::Instant>& instants = run.manifest().frames->instants;
  instants.resize(archive.size(instants.size()));
  for (Frames::Instant& instant : instants) {
    archive(instant.time);
    archive(instant.phase);
    archive(instant.difference_rms);
    archive(instant.cloth);
    archive(instant.moved);
  }
  kept_.serialise(archive);
  auto side = scene_renderer_.run([](SceneRenderer& studio) { return studio.view().first_side(); });
  archive(side);
  if (!archive.loads()) return;
  if (side) scene_renderer_.run([side](SceneRenderer& studio) { studio.view().set_first_side(*side); });
  encode_seconds_ = encode;
  if (frames_ > 0)
    archived_frames_.continue_file(run.path(kArchivedFrames), static_cast<std::size_t>(frames_));
}

// Uses white paper, if the look allows it: cells of a page have no boxes.
render::Look Pictures::sheet_look() const {
  Options options = options_;
  const std::string look = options.looks().front();
  using render::Background;
  if (look == "cloth" && options.background == Background::studio) options.background = Background::white;
  return scene_look(scene_, options, look);
}

render::Image Pictures::sheet_picture(SceneRenderer& studio, const ArchivedInstant& instant,
                                      const render::Camera& camera) const {
  studio.view().set_positions(instant.xyz);
  render::Image image = studio.draw_with_ghosts(sheet_look(), camera, {instant.time, instant.values});
  render::fade_to_page(image);
  return image;
}

// Draws an instant, from nearer by if its cloth is small in the view.
render::SheetEntry Pictures::sheet_cell(SceneRenderer& studio, const ArchivedInstant& instant,
                                        const SheetView& view) const {
  const std::optional<NearerView> nearer = nearer_view(instant.xyz, view, options_);
  return {sheet_picture(studio, instant, nearer ? nearer->camera : view.camera),
          instant.caption,
          {.path = instant.loop, .color = color_of_law(scene_.law)},
          nearer ? nearer->enlargement : 1};
}

// Leaves out instants that look like an earlier one, but keeps the last.
std::vector<render::SheetEntry> Pictures::sheet_cells(const std::vector<ArchivedInstant>& instants,
                                                      const std::vector<ArchivedInstant>& motion,
                                                      const SheetView& view) {
  return scene_renderer_.run([&](SceneRenderer& studio) {
    const Stopwatch watch(render_seconds_);
    studio.take_size({view.width, view.height, picture_size(options_).samples});
    std::vector<render::SheetEntry> cells;
    std::vector<render::Image> skins;
    for (const ArchivedInstant& instant : motion)
      skins.push_back(sheet_picture(studio, instant, view.camera));
    if (!skins.empty())
      cells.push_back({render::onion_skin(skins),
                       fmt::format("0–{:.2f} s, over each other", motion.back().time),
                       {.path = motion.back().loop, .color = color_of_law(scene_.law)}});
    for (const ArchivedInstant& instant : instants) cells.push_back(sheet_cell(studio, instant, view));
    cells = distinct_cells(cells);
    for (render::SheetEntry& cell : bent_cells(studio, instants, view)) cells.push_back(std::move(cell));
    for (const FurtherView& view_from : further_) cells.push_back(further_cell(studio, view_from, view));
    return cells;
  });
}

// Draws the part that is bent most, of the instant in which it is and of the last, from one place; nothing if
// that instant is drawn from nearer by already.
std::vector<render::SheetEntry> Pictures::bent_cells(SceneRenderer& studio,
                                                     const std::vector<ArchivedInstant>& instants,
                                                     const SheetView& view) const {
  const ArchivedInstant* most = nullptr;
  Bending bending;
  for (const ArchivedInstant& instant : instants)
    if (Bending own = bending_of(instant.xyz, source_->mesh().triangles);
        !most || own.total() > bending.total()) {
      bending = std::move(own);
      most = &instant;
    }
  std::vector<render::SheetEntry> cells;
  if (nearer_view(most->xyz, view, options_)) return cells;
  const std::optional<NearerView> part = bent_part(most->xyz, bending, view);
  for (const ArchivedInstant* instant : {most, &instants.back()})
    if (part && (cells.empty() || instant != most))
      cells.push_back({sheet_picture(studio, *instant, part->camera),
                       fmt::format("t = {:.2f} s", instant->time),
                       {},
                       part->enlargement});
  return cells;
}

// Draws the last instant at the scale of the others.
render::SheetEntry Pictures::further_cell(SceneRenderer& studio, const FurtherView& from,
                                          const SheetView& view) const {
  const ArchivedInstant& last = kept_.last();
  const render::Camera camera = further_view(last.xyz, from.direction, view, options_);
  studio.view().set_positions(last.xyz);
  render::Image image = studio.draw(sheet_look(), camera, {last.time, last.values});
  render::fade_to_page(image);
  return {std::move(image), from.words};
}

void Pictures::write_sheet(Run& run, const std::string& title) {
  if (kept_.empty()) return run.warn("there is no contact sheet: no instant was pictured");
  const std::vector<ArchivedInstant> instants = chosen(cell_times_, kSheetCells, INFINITY),
                                     skins = onion_until_ > 0 ? chosen(skin_times_, kSkins, onion_until_)
                                                              : std::vector<ArchivedInstant>{};
  std::vector<ArchivedInstant> shown = skins;  // before the cells, whose last one sets the scale
  shown.insert(shown.end(), instants.begin(), instants.end());
  const SheetView view = sheet_view(shown, options_, bounds_);
  std::vector<render::SheetEntry> cells = sheet_cells(instants, skins, view);
  render::LoopFrame frame;
  for (const render::SheetEntry& cell : cells) frame.include(cell.loop.path);
  for (render::SheetEntry& cell : cells) cell.loop.frame = frame;
  render::ComparisonSheet page{.title = title, .scale_note = "at the cloth's middle"};
  if (const auto bar = value_color_bar(scene_, options_, options_.looks().front())) page.bars.push_back(*bar);
  write(run.path("sheet.png"), render::contact_sheet(cells, page, view.metres_per_pixel));
  keep_sheet(run, instants, skins, title);
}

void Pictures::show_as(const Json& sheet) {
  cell_times_ = sheet.at("cells").get<std::vector<double>>();
  skin_times_ = sheet.at("skins").get<std::vector<double>>();
  onion_until_ = sheet.at("onion");
  for (const Json& from : sheet.at("further")) {
    const auto d = from.at("direction").get<std::vector<float>>();
    also_from({d.at(0), d.at(1), d.at(2)}, from.at("words"));
  }
}

// Returns the instants at these times, or `count` of those up to `until` [s] if none are given.
std::vector<ArchivedInstant> Pictures::chosen(const std::vector<double>& times, int count,
                                              double until) const {
  if (times.empty()) return kept_.chosen(count, until);
  std::vector<ArchivedInstant> found;
  for (const ArchivedInstant& instant : kept_.all())
    if (std::count(times.begin(), times.end(), instant.time)) found.push_back(instant);
  return found;
}

// Keeps the sheet's geometry, found among the frames by their times.
void Pictures::keep_sheet(Run& run, const std::vector<ArchivedInstant>& cells,
                          const std::vector<ArchivedInstant>& skins, const std::string& title) const {
  const std::filesystem::path frames = run.folder() / kArchivedFrames;
  std::vector<int> instants;
  const std::vector<double> cell_times = instant_times(cells), skin_times = instant_times(skins);
  const std::vector<Frames::Instant>& all = run.manifest().frames->instants;
  for (std::size_t f = 0; f < all.size(); ++f)
    if (std::count(cell_times.begin(), cell_times.end(), all[f].time) +
        std::count(skin_times.begin(), skin_times.end(), all[f].time))
      instants.push_back(static_cast<int>(f));
  ArchivedRecord sheet{
      {{"record", "sheet"},
       {"title", title},
       {"cells", cell_times},
       {"skins", skin_times},
       {"onion", onion_until_},
       {"further", Json::array()},
       {"loop", {{"curvature", kept_.last().loop.curvature}, {"moment", kept_.last().loop.moment}}}},
      {}};
  for (const FurtherView& from : further_)
    sheet.head["further"].push_back(
        {{"direction", {from.direction.x(), from.direction.y(), from.direction.z()}}, {"words", from.words}});
  std::vector<ArchivedRecord> records = chosen_records(frames, instants);
  records.push_back(sheet);
  write_records(run.path(kArchivedSheet), records);
  ArchivedFrames::end(frames, sheet);
}

void Pictures::finish(Run& run, const std::string& title) {
  scene_renderer_.wait();
  write_sheet(run, title);
  writer_.finish();
  write_text(run.path("camera.json"), camera_text(camera(), options_.size));
  run.manifest().renderer = renderer();
  run.manifest().positions = positions_route();
  run.add_seconds("render", render_seconds_);
  run.add_seconds("encode", encode_seconds_ + writer_.encode_seconds());
  run.add_seconds("waited", waited_seconds_);
}

}  // namespace hysteron::experiments
