// Writes positions into a renderer's buffer on the same GPU.
#pragma once

#include <string>

namespace hysteron {

// An OpenGL buffer of n x 3 floats, opened by a simulation to write its positions into.
//
// It is opened, written and closed (destroyed) with the buffer's context current on the calling thread, and
// closed while the buffer and the simulation exist.
class GlPositions {
 public:
  GlPositions() = default;
  GlPositions(const GlPositions&) = delete;
  GlPositions& operator=(const GlPositions&) = delete;
  virtual ~GlPositions() = default;

  // Writes x, y, z of every vertex at present [m]; GL calls that follow on this thread see them.  Returns
  // false, and sets `reason`, if the driver refuses; the buffer's content is undefined then.
  virtual bool write(std::string& reason) = 0;
};

}  // namespace hysteron
