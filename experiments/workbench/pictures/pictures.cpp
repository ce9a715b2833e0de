#include "experiments/workbench/pictures/pictures.h"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>

#include "experiments/workbench/pictures/drawing.h"
#include "sim/base/archive.h"
#include "sim/base/error.h"
#include "sim/base/root_mean_square.h"

namespace hysteron::experiments {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kSheetCells = 12;  // pictures on the contact sheet

// "frames/0012.png"; of further looks "frames-LOOK/0012.png".
std::string frame_file(const std::string& look, bool first, int number) {
  return fmt::format("{}/{:04}.png", first ? "frames" : "frames-" + look, number);
}

Error no_cloth_in(const std::string& picture, double time) {
  return Error::run(
      fmt::format("{} shows no cloth at t = {:.3f} s: frame where it is (--camera.box)", picture, time));
}

// Adds the time from now until its end.
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
  std::vector<std::string> names = {"sheet.png"};
  for (const std::string& look : options.looks()) names.push_back(frame_file(look, names.size() == 1, 0));
  names.insert(names.end(), {kKeptFrames, kKeptSheet});
  return names;
}

Pictures::Pictures(const Setup& setup, const Cloth& cloth, Simulation& simulation, const render::Box& bounds,
                   std::optional<float> floor)
    : Pictures(setup, simulated(setup.scene, cloth, simulation, setup.options.reference), bounds, floor) {}

Pictures::Pictures(const Setup& setup, std::unique_ptr<Subject> subject, const render::Box& bounds,
                   std::optional<float> floor)
    : scene_(setup.scene),
      options_(setup.options),
      subject_(std::move(subject)),
      bounds_(bounds),
      kept_(setup, subject_->mesh(), bounds, floor),
      scene_renderer_([this, floor] {
        return std::make_unique<SceneRenderer>(scene_, options_, subject_->mesh(), bounds_, floor,
                                               subject_->cuda_device());
      }) {
  scene_renderer_.run([this](SceneRenderer& studio) {
    renderer_ = studio.offscreen().description();
    studio.view().share_positions(subject_->share_positions(studio.view().position_buffer(),
                                                            studio.offscreen().cuda_device(), why_host_));
  });
}

render::Camera Pictures::camera() const { return camera_of(options_, bounds_); }

// The studio's thread reads the options while it draws.
void Pictures::set_light(const std::string& light) {
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

// A figure, whose background is transparent, has a caption of its own.
std::string Pictures::captioned(const std::string& text) const {
  return options_.background == "transparent" ? "" : text;
}

render::Image Pictures::picture(const std::string& look, const render::Camera& camera,
                                const std::string& text) {
  take_positions(rounded(subject_->positions(), subject_->mesh().quantum));
  const SceneRenderer::Shown shown{subject_->time(), subject_->values(look)};
  return scene_renderer_.run([&](SceneRenderer& studio) {
    const Stopwatch watch(render_seconds_);
    render::Image image = studio.draw(look_of(scene_, options_, look), camera, shown);
    if (!studio.view().shows_cloth()) throw no_cloth_in("the picture of look " + look, shown.time);
    letter(image, camera, bounds_.center(), captioned(text), color_bar_of(scene_, options_, look));
    return image;
  });
}

// What a page that compares runs has to know of their pictures.
void Pictures::note_frame(Run& run, const std::vector<Order>& orders) {
  std::optional<Frames>& frames = run.manifest().frames;
  if (!frames) frames.emplace();
  frames->looks.clear();
  Frames::Instant instant{subject_->time(), scene_.phase_at(subject_->time())};
  for (const Order& order : orders) {
    frames->looks.push_back({order.look});
    if (const auto bar = color_bar_of(scene_, options_, order.look))
      frames->looks.back().bar = {bar->label, bar->unit, bar->low, bar->high};
    if (order.look == "difference") instant.difference_rms = root_mean_square(order.shown.values);
  }
  frames->metres_per_pixel = camera().metres_per_pixel(bounds_.center(), options_.height());
  frames->instants.push_back(std::move(instant));
}

void Pictures::watch_border(Run& run, const std::filesystem::path& file,
                            const std::vector<Eigen::Vector3d>& x) {
  const float aspect = static_cast<float>(options_.width()) / static_cast<float>(options_.height());
  if (is_cut_off_ || camera().frames(flat_points(x), aspect)) return;
  is_cut_off_ = true;
  run.warn(
      fmt::format("from t = {:.3f} s on ({}) the cloth is cut off at the border of pictures: --camera.box "
                  "frames more",
                  subject_->time(), file.lexically_relative(run.folder()).string()));
}

void Pictures::frame(Run& run, const std::vector<Eigen::Vector3d>& x) {
  const Stopwatch waited(waited_seconds_);
  KeptState instant{subject_->time(), rounded(flat_points(x), subject_->mesh().quantum), {}};
  take_positions(instant.xyz);
  std::vector<Order> orders;
  for (const std::string& look : options_.looks()) {
    orders.push_back(
        {look, run.path(frame_file(look, orders.empty(), frames_)), {instant.time, subject_->values(look)}});
  }
  watch_border(run, orders.front().file, x);
  ++frames_;
  note_frame(run, orders);
  for (Order& order : orders) {
    if (order.shown.values.empty()) continue;
    order.shown.values = rounded(order.shown.values, kept_.quantum(order.look));
    instant.values[order.look] = order.shown.values;
  }
  scene_renderer_.post([this, orders = std::move(orders), instant = std::move(instant),
                        file = run.path(kKeptFrames)](SceneRenderer& studio) {
    const Stopwatch watch(render_seconds_);
    kept_.add(file, instant);
    for (const Order& order : orders) fill(studio, order, &order == orders.data());
  });
}

// On the studio's thread.
void Pictures::fill(SceneRenderer& studio, const Order& order, bool on_sheet) {
  render::Image image = studio.draw(look_of(scene_, options_, order.look), camera(), order.shown);
  if (!studio.view().shows_cloth()) {
    writer_.write(order.file, std::move(image));
    throw no_cloth_in(order.file.string(), order.shown.time);
  }
  if (!options_.plain)
    letter(image, camera(), bounds_.center(), captioned(caption(order.shown.time)),
           color_bar_of(scene_, options_, order.look));
  if (on_sheet) thumbnails_.push_back({thumbnail(image), when(order.shown.time)});
  writer_.write(order.file, std::move(image));
}

render::Image Pictures::silhouette(double half_width, int pixels, double& metres_per_pixel) {
  const float r = static_cast<float>(half_width);
  const render::Box box{{-r, -r, bounds_.low.z()}, {r, r, bounds_.high.z()}};
  const render::Camera camera = render::Camera::top(box, 1);
  metres_per_pixel = camera.metres_per_pixel(box.center(), pixels);
  const std::vector<float> xyz = subject_->positions();
  return scene_renderer_.run(
      [&](SceneRenderer& studio) { return studio.silhouette(subject_->mesh(), xyz, camera, pixels); });
}

void Pictures::visit(Archive& archive, Run& run) {
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
  }
  if (!archive.loads()) return;
  encode_seconds_ = encode;
  if (frames_ > 0) kept_.go_on(run.path(kKeptFrames), static_cast<std::size_t>(frames_));
  for (int i = 0; i < frames_; ++i)
    thumbnails_.push_back({thumbnail(render::read_png(run.folder() / fmt::format("frames/{:04}.png", i))),
                           when(instants[i].time)});
}

void Pictures::keep_sheet(Run& run, const std::vector<int>& instants, const std::string& title) {
  const std::filesystem::path frames = run.folder() / kKeptFrames;
  const KeptRecord sheet{{{"record", "sheet"}, {"title", title}}, {}};
  std::vector<KeptRecord> records = chosen_records(frames, instants);
  records.push_back(sheet);
  write_records(run.path(kKeptSheet), records);
  KeptFrames::end(frames, sheet);
}

void Pictures::finish(Run& run, const std::string& title) {
  scene_renderer_.wait();
  writer_.finish();
  std::vector<render::SheetEntry> cells;
  const std::vector<int> shown = render::spread(static_cast<int>(thumbnails_.size()), kSheetCells);
  for (const int i : shown) cells.push_back(std::move(thumbnails_[i]));
  if (!cells.empty()) keep_sheet(run, shown, title);
  if (cells.empty())
    run.warn("there is no contact sheet: no instant was pictured");
  else
    render::write_png(run.path("sheet.png"), render::contact_sheet(cells, {.title = title}),
                      render::PngEffort::best);
  run.manifest().renderer = renderer();
  run.manifest().positions = positions_way();
  run.add_seconds("render", render_seconds_);
  run.add_seconds("encode", encode_seconds_ + writer_.encode_seconds());
  run.add_seconds("waited", waited_seconds_);
}

}  // namespace hysteron::experiments
