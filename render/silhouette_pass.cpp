#include "render/silhouette_pass.h"

#include "render/srgb.h"

namespace hysteron::render {

SilhouettePass::SilhouettePass(const GlFunctions& gl) : gl_(&gl), alone_samples_(gl), seen_samples_(gl) {}

void SilhouettePass::set_look(const Look& look, bool figure) {
  if (programs_ && look.show == show_) return;
  programs_.emplace(*gl_, look.show, figure, "silhouette.frag");
  show_ = look.show;
}

void SilhouettePass::draw(const ViewScene& scene, const PartView& view) const {
  programs_->draw(scene.cloth->surface(), view, scene.look.thickness);
}

// Drawn once more, the cloth passes the test of depth where nothing stands before it.
void SilhouettePass::count(const ViewScene& scene, const PartView& view, const GlQuery& samples) const {
  gl_->ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  gl_->BeginQuery(GL_SAMPLES_PASSED, samples.name());
  draw(scene, view);
  gl_->EndQuery(GL_SAMPLES_PASSED);
  gl_->ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

std::uint64_t SilhouettePass::counted(const GlQuery& samples) const {
  GLuint count = 0;
  gl_->GetQueryObjectuiv(samples.name(), GL_QUERY_RESULT, &count);
  return count;
}

void SilhouettePass::add_counts() {
  alone_ += counted(alone_samples_);
  seen_ += counted(seen_samples_);
}

double SilhouettePass::hidden_fraction() const {
  if (alone_ == 0) return 0;
  return 1 - static_cast<double>(seen_) / static_cast<double>(alone_);
}

double covered_area(const Image& silhouette, double metres_per_pixel) {
  const auto& linear_light = linear_of_srgb8();
  double covered = 0;
  for (int y = 0; y < silhouette.height(); ++y)
    for (int x = 0; x < silhouette.width(); ++x) covered += 1 - linear_light[silhouette.at(x, y)[1]];
  return covered * metres_per_pixel * metres_per_pixel;
}

}  // namespace hysteron::render
