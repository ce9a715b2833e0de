// The strip in its clamps, seen at some curvatures of the test.
#pragma once

#include <memory>

#include "experiments/kes/strip_output.h"
#include "experiments/workbench/pictures/pictures.h"

namespace hysteron::experiments {

class StripPictures {
 public:
  // `strip` must outlive the pictures.
  StripPictures(const Options& options, const ClampedStrip& strip);

  // A StripWatch: keeps a picture of the rows that are worth one.
  void watch(std::size_t row, Simulation& simulation);
  // With the moments of those rows.
  std::vector<StripPicture> taken(const StripTest& test);
  std::string renderer() const { return renderer_; }

 private:
  Setup setup_;
  const ClampedStrip& strip_;
  std::unique_ptr<Pictures> pictures_;
  std::vector<std::size_t> rows_;
  std::vector<StripPicture> taken_;
  std::string renderer_;
};

}  // namespace hysteron::experiments
