// Finds out what the machine offers: processors, renderers, programs, memory and disk.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/workbench/app/manifest.h"

namespace hysteron::experiments {

// A processor or a renderer that was opened to see whether it works.
struct TriedDevice {
  std::string kind;     // one of cpu, cuda, renderer
  std::string id;       // "cuda:0", "EGL device 0"
  std::string name;     // name with driver and version, as in manifests; "EGL device 0 fails", "none"
  std::string failure;  // why it could not be opened; empty if it was
};

// Tries the CPU, all GPUs, and all renderers in the order in which they are tried for pictures.  GPUs and
// renderers are opened in child processes, so that a crashing driver is a failure of that device alone.
std::vector<TriedDevice> tried_devices();

// Returns an array with one object a device: `device` or `renderer` (the id), `name` (null if it fails),
// `reason`.
Json devices_json(const std::vector<TriedDevice>& devices);

// The result of trying a thing that runs need or use.
struct Finding {
  std::string part;      // name of the thing: "gnuplot"
  bool found = false;    // true if it works
  std::string text{};    // its version, or why it does not work: "5.4 patchlevel 4, draws PNG, SVG and PDF"
  std::string cost{};    // cost of its lack: "plots are not drawn, tables are written"
  std::string remedy{};  // "apt install gnuplot-nox"; empty if there is none or nothing is lost
  bool needed = false;   // `drape --quick` with pictures needs it
};

// Returns all findings, in the order in which they are printed; `out` is where runs would write.  A probe
// that crashes is a finding like any other.
std::vector<Finding> findings(const std::vector<TriedDevice>& devices, const std::filesystem::path& out);

// Returns one finding for each device.
std::vector<Finding> device_findings(const std::vector<TriedDevice>& devices);
Finding disk_finding(const std::filesystem::path& out);

// Formats "gnuplot    lacking: gnuplot cannot be started; plots are not drawn, tables are written (apt
// install gnuplot-nox)".
std::string finding_line(const Finding& finding);

// Returns the parts without which `drape --quick` draws no pictures here, each once; renderers are one part,
// of which one is enough.
std::vector<std::string> lacking_parts(const std::vector<Finding>& findings);

// Tries everything and prints a line on each to stdout, for `doctor` and its older name `list devices`.
// Returns the findings.
std::vector<Finding> print_findings(const std::filesystem::path& out);

// Returns the first instruction set that the program was compiled for and this CPU lacks, such as "AVX-512F";
// null if it lacks none.  It runs before anything else, so it calls nothing that is compiled for these sets.
const char* missing_instructions();

}  // namespace hysteron::experiments
