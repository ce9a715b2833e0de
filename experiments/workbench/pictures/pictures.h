// Draws the pictures of a run: a sequence of frames, single pictures, a contact sheet.
//
//   simulation at rest:  positions (CUDA -> OpenGL, or by the host), values   -> studio's thread
//   simulation goes on:  draw, annotate                                       -> PNG writer's threads
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiments/workbench/app/run.h"
#include "experiments/workbench/pictures/archived_frames.h"
#include "experiments/workbench/pictures/archived_instants.h"
#include "experiments/workbench/pictures/frame_source.h"
#include "experiments/workbench/pictures/scene_renderer.h"
#include "experiments/workbench/pictures/sheet_view.h"
#include "render/contact_sheet.h"
#include "render/loop_inset.h"
#include "render/png_writer.h"
#include "sim/base/own_thread.h"

namespace hysteron::experiments {

// Returns the files that finish() and frame() write under these options, for Run::reserve().
std::vector<std::string> picture_files(const Options& options);

class Pictures {
 public:
  // Draws `simulation`, which must outlive the pictures.  Every picture of the sequence frames `bounds`;
  // `floor` is the height of the visible ground [m].
  Pictures(const Setup& setup, const Cloth& cloth, Simulation& simulation, const render::Box& bounds,
           std::optional<float> floor);
  // Draws any source of frames, which the pictures then own.
  Pictures(const Setup& setup, std::unique_ptr<FrameSource> source, const render::Box& bounds,
           std::optional<float> floor);

  const std::string& renderer() const { return renderer_; }
  // Returns how positions reach the renderer: "CUDA-GL" without passing the host, or "host (why)".
  std::string positions_route() const { return why_host_.empty() ? "CUDA-GL" : "host (" + why_host_ + ")"; }

  // Draws the present state as the next of frames/, captioned with what is simulated and the time; in
  // further looks as the next of frames-LOOK/.  Returns when positions and values are copied; throws errors
  // of earlier pictures, and Error::simulation if it shows no cloth.  `xyz` has 3 numbers a vertex [m], of
  // which the first beyond the picture's border is a warning; `loop` is a probe's so far, shown in a corner
  // unless it is empty.  The picture's data are added to frames.hyg.
  void frame(Run& run, const std::vector<float>& xyz, const render::Path& loop = {});
  // Draws the present state in a look of its own, with caption and colour bar.  Throws Error::simulation if
  // it shows no cloth.
  render::Image picture(const std::string& look, const render::Camera& camera, const std::string& caption);
  // Draws the same with the sequence's camera into a file; it returns, and throws, as frame() does.
  void picture_file(const std::filesystem::path& file, const std::string& look, const std::string& caption);
  // Writes a picture on another thread.
  void write(const std::filesystem::path& file, render::Image image) {
    writer_.write(file, std::move(image), render::PngEffort::best);
  }
  // Adds the last instant seen from there as a further cell of the contact sheet; `words` name the direction.
  void also_from(const Eigen::Vector3f& direction, const std::string& words) {
    further_.push_back({direction, words});
  }
  // Begins the contact sheet with one picture of all that moves up to `until` [s].
  void begin_with_onion_skin(double until) { onion_until_ = until; }
  // Makes the contact sheet show what that of a kept run shows, by its record.
  void show_as(const Json& sheet);
  // Sets "studio" or "raking" light for the next pictures; single pictures are raked in the plane that the
  // cloth lies in most nearly.
  void set_light(Lighting light);
  // Returns the sequence's camera.
  render::Camera camera() const;
  // Draws the cloth's shadow from straight above; `metres_per_pixel` receives the picture's scale.
  render::Image silhouette(double half_width, int pixels, double& metres_per_pixel);
  // Waits for the files so far.  Throws Error::system.
  void serialise(Archive& archive, Run& run);
  // Waits for the files and writes sheet.png with instants spread by displacement, framed by their contents,
  // and sheet.hyg with the data of its pictures.
  void finish(Run& run, const std::string& title);

 private:
  // A picture to be drawn while the simulation goes on.
  struct FrameJob {
    std::string look;
    std::filesystem::path file;
    SceneRenderer::Shown shown;
    render::LoopInset loop;
  };

  struct FurtherView {
    Eigen::Vector3f direction;
    std::string words;
  };

  void take_positions(const std::vector<float>& xyz);
  // `difference` is the root mean square of what look "difference" shows, if it is drawn.
  void note_frame(Run& run, const std::vector<FrameJob>& orders, const std::vector<float>& xyz,
                  std::optional<double> difference);
  void watch_border(Run& run, const std::filesystem::path& file, const std::vector<float>& xyz);
  void fill(SceneRenderer& studio, const FrameJob& order);
  render::Image single(SceneRenderer& studio, const std::string& look, const render::Camera& camera,
                       const std::string& caption, const SceneRenderer::Shown& shown);
  render::Look sheet_look() const;
  render::Image sheet_picture(SceneRenderer& studio, const ArchivedInstant& instant,
                              const render::Camera& camera) const;
  render::SheetEntry sheet_cell(SceneRenderer& studio, const ArchivedInstant& instant,
                                const SheetView& view) const;
  std::vector<render::SheetEntry> sheet_cells(const std::vector<ArchivedInstant>& instants,
                                              const std::vector<ArchivedInstant>& motion,
                                              const SheetView& view);
  std::vector<render::SheetEntry> bent_cells(SceneRenderer& studio,
                                             const std::vector<ArchivedInstant>& instants,
                                             const SheetView& view) const;
  render::SheetEntry further_cell(SceneRenderer& studio, const FurtherView& from,
                                  const SheetView& view) const;
  void write_sheet(Run& run, const std::string& title);
  std::vector<ArchivedInstant> chosen(const std::vector<double>& times, int count, double until) const;
  void keep_sheet(Run& run, const std::vector<ArchivedInstant>& cells,
                  const std::vector<ArchivedInstant>& skins, const std::string& title) const;
  std::string when(double time) const;  // returns "t = 0.50 s, lift"
  std::string caption(double time) const;
  std::string captioned(const std::string& text) const;

  Scene scene_;
  Options options_;
  std::unique_ptr<FrameSource> source_;
  render::Box bounds_;
  ArchivedFrames archived_frames_;
  std::string why_host_;  // why positions pass the host; empty if they do not
  render::PngWriter writer_;
  int frames_ = 0;
  ArchivedInstants kept_;  // instants for the contact sheet
  std::vector<FurtherView> further_;
  double onion_until_ = 0;                       // [s]; 0: none
  std::vector<double> cell_times_, skin_times_;  // times of a kept sheet [s]; empty: found
  bool is_cut_off_ = false;                      // the border of some picture cuts off cloth
  double encode_seconds_ = 0;                    // time before an interruption [s]
  double waited_seconds_ = 0;                    // time that the simulation waited for its pictures [s]
  // The studio's thread writes these while it draws a picture.
  double render_seconds_ = 0;
  std::string renderer_;
  OwnThread<SceneRenderer> scene_renderer_;
};

}  // namespace hysteron::experiments
