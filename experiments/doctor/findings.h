// What this program finds on the machine that it runs on.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/workbench/app/manifest.h"

namespace hysteron::experiments {

// A processor or a renderer, opened to see that it can be.
struct TriedDevice {
  std::string kind;     // cpu, cuda, renderer
  std::string id;       // "cuda:0", "EGL device 0"
  std::string name;     // with driver and version, as manifests have it; "EGL device 0 fails", "none"
  std::string failure;  // why it could not be; empty: it was
};

// The CPU, all GPUs, all renderers in the order in which they are tried for pictures.  GPUs and renderers are
// opened in child processes, so that a driver that crashes is a failure of that one.
std::vector<TriedDevice> tried_devices();

// An array with one object a device: `device` or `renderer` (the id), `name` (null where it fails), `reason`.
Json devices_json(const std::vector<TriedDevice>& devices);

// A thing that runs need or use, tried.
struct Finding {
  std::string part;      // "gnuplot"
  bool found = false;    // it works
  std::string text{};    // what it is, or why it does not work: "5.4 patchlevel 4, draws PNG, SVG and PDF"
  std::string cost{};    // what its lack costs: "plots are not drawn, tables are written"
  std::string remedy{};  // "apt install gnuplot-nox"; empty where there is none, or nothing is lost
  bool needed = false;   // `drape --quick` with pictures needs it
};

// Everything, in the order in which it is printed; `out` is where runs would write.  A probe that crashes is
// a finding as any other.
std::vector<Finding> findings(const std::vector<TriedDevice>& devices, const std::filesystem::path& out);

// One for each device.
std::vector<Finding> device_findings(const std::vector<TriedDevice>& devices);
Finding disk_finding(const std::filesystem::path& out);

// "gnuplot    lacking: gnuplot cannot be started; plots are not drawn, tables are written (apt install
// gnuplot-nox)".
std::string finding_line(const Finding& finding);

// The parts without which `drape --quick` draws no pictures here, each once; renderers are one part, of which
// one is enough.
std::vector<std::string> lacking_parts(const std::vector<Finding>& findings);

// Tries everything and prints a line on each to stdout, for `doctor` and its older name `list devices`.
// Returns what it found.
std::vector<Finding> print_findings(const std::filesystem::path& out);

// The first kind of instructions that the program was compiled for and this CPU lacks, "AVX-512F"; null where
// it has all that are asked for here.  Calls nothing that is compiled for them: it is asked before anything
// else runs.
const char* missing_instructions();

}  // namespace hysteron::experiments
