// A fabric as Python has it: the keys fabric.* of a scene, as attributes.
#pragma once

#include <string>

#include "python/values.h"
#include "sim/scene/scene.h"

namespace hysteron::python {

class FabricValue {
 public:
  // By name of assets/fabrics or file; then single keys.  RequestError as scene files.
  FabricValue(const std::string& name_or_file, const py::dict& keys);
  explicit FabricValue(const Fabric& fabric) { scene_.fabric = fabric; }

  const Fabric& fabric() const { return scene_.fabric; }
  // What no single key can tell, too: b1 >= b2.
  const Fabric& checked() const;
  // "b1", "weft_bending", "bending_stops_thresholds".  AttributeError for what no fabric has.
  py::object get(const std::string& name) const;
  void set(const std::string& name, py::handle value);

 private:
  Scene scene_;  // of which only the fabric is used: keys are a scene's
};

// What Python may name as a fabric: a FabricValue, a name or a file.
Fabric fabric_from_python(py::handle fabric);

}  // namespace hysteron::python
