// The pictures of a run: a sequence of frames, single pictures, a contact sheet.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "experiments/run.h"
#include "render/caption.h"
#include "render/cloth_view.h"
#include "render/contact_sheet.h"
#include "render/png_writer.h"
#include "sim/scene/cloth.h"
#include "sim/solve/simulation.h"

namespace hysteron::experiments {

class Pictures {
 public:
  // `simulation`: what is drawn; it must outlive the pictures.  `bounds`: what every picture of the sequence
  // frames; `floor`: height of the visible ground [m].
  Pictures(const Setup& setup, const Cloth& cloth, Simulation& simulation, const render::Box& bounds,
           std::optional<float> floor);

  const std::string& renderer() const { return offscreen_->description(); }
  // How positions reach the renderer: "CUDA-GL" without passing the host, or "host (why)".
  std::string positions_way() const { return why_host_.empty() ? "CUDA-GL" : "host (" + why_host_ + ")"; }

  // Draws the present state as the next of frames/, captioned with what is simulated and the time; in further
  // looks as the next of frames-LOOK/.
  void frame(Run& run);
  // Draws the present state in a look of its own, with caption and colour bar.
  render::Image picture(const std::string& look, const render::Camera& camera, const std::string& caption);
  // "studio" or "raking", for the pictures to come.
  void set_light(const std::string& light) { options_.light = light; }
  // The sequence's camera.
  render::Camera camera() const;
  // The cloth's shadow from straight above; `metres_per_pixel` of the picture.
  render::Image silhouette(double half_width, int pixels, double& metres_per_pixel);
  // Waits for the files and writes sheet.png.
  void finish(Run& run, const std::string& title);

 private:
  void show(render::ClothView& view, const std::string& look_name);
  render::Image drawn(const std::string& look, const render::Camera& camera);  // without letters
  void note_frame(Run& run);
  render::Look look_of(const std::string& name) const;
  std::optional<render::ColorBar> color_bar(const std::string& look) const;
  std::string when(double time) const;  // "t = 0.50 s, lift"
  std::string caption(double time) const;
  std::string captioned(const std::string& text) const;

  Scene scene_;
  Options options_;
  const Cloth& cloth_;
  Simulation& simulation_;
  render::Box bounds_;
  std::unique_ptr<render::Offscreen> offscreen_;
  std::unique_ptr<render::ClothView> view_;
  std::string why_host_;       // positions pass the host; empty: they do not
  std::vector<int> obstacle_;  // the view's number of each obstacle of the scene, -1 = not a body
  render::PngWriter writer_;
  std::vector<render::SheetEntry> thumbnails_;
  int frames_ = 0;
  Json moments_ = Json::array();  // of frames
  double render_seconds_ = 0;
};

}  // namespace hysteron::experiments
