// What a manifest says of a run, in words for captions.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/workbench/app/manifest.h"

namespace hysteron::experiments {

// "strip of 90 by 30 mm, mesh unionjack, 1,000 triangles"
std::string cloth_words(const Manifest& manifest);
// "cotton-broad (b1 3.589e-05 N m, b2 1.157e-05 N m, k0 50 1/m, 123.8 g/m2)"
std::string fabric_words(const Manifest& manifest);
// "1e-05 s": viscosity of bending over b1.
std::string damping_words(const Manifest& manifest);
// "prandtl (memory=stops, stops=16)"
std::string law_words(const Manifest& manifest);
// "bdf2, step 4.167 ms, element shape, double precision"
std::string solver_words(const Manifest& manifest);
std::string device_words(const Manifest& manifest);
// "1000" is "1,000".
std::string grouped(long count);

// "Cloth: ... Fabric: ... Law: ... Solver: ... Device: ..." of runs with these names: each fact once, and
// where some differ, theirs with their names.
std::string run_facts(const std::vector<std::string>& names, const std::vector<const Manifest*>& manifests);

// A figure with its caption, for readers and for the gallery, which shows captions below its pictures.
struct FigureCaption {
  std::string file;   // in the same folder, "sheet.png"
  std::string title;  // of one line
  std::string text;   // what it shows, in sentences; one paragraph without line ends
};

// A heading, an introduction, and each figure above its caption.  Throws Error::system if the file cannot be
// written.
void write_captions(const std::filesystem::path& path, const std::string& heading,
                    const std::string& introduction, const std::vector<FigureCaption>& figures);

// README.md of a finished run's folder: those of the figures that are there with their captions and, below
// the first, the run's facts and its command.  Throws Error::system if it cannot be written.
void write_run_captions(const std::filesystem::path& folder, const Manifest& manifest,
                        std::vector<FigureCaption> figures);

// "Written by `COMMAND`, hysteron 0.1.0, commit 0123456789ab."; the manifest is of any run of that program;
// without one only the command.
std::string origin_words(const std::string& command, const Manifest* manifest);

}  // namespace hysteron::experiments
