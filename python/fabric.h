// A fabric for Python: the keys fabric.* of a scene, as attributes.
#pragma once

#include <string>

#include "python/values.h"
#include "sim/scene/scene.h"

namespace hysteron::python {

class FabricValue {
 public:
  // Reads a fabric by name from assets/fabrics or from a file; then sets single keys.  Throws RequestError as
  // scene files do.
  FabricValue(const std::string& name_or_file, const py::dict& keys);
  explicit FabricValue(const Fabric& fabric) { scene_.fabric = fabric; }

  const Fabric& fabric() const { return scene_.fabric; }
  // Returns the fabric after checks that involve several keys: b1 >= b2.
  const Fabric& checked() const;
  // The names are "b1", "weft_bending", "bending_stops_thresholds".  Throws AttributeError for a name that no
  // fabric has.
  py::object get(const std::string& name) const;
  void set(const std::string& name, py::handle value);

 private:
  Scene scene_;  // only its fabric is used, because keys belong to a scene
};

// Converts a FabricValue, a name or a file from Python to a fabric.
Fabric fabric_from_python(py::handle fabric);

}  // namespace hysteron::python
