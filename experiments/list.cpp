// `hysteron list`: what there is, on stdout.
#include <algorithm>
#include <iomanip>
#include <iostream>
#include <sstream>

#include "experiments/experiments.h"
#include "render/offscreen.h"
#include "sim/bending/law_run.h"
#include "sim/error.h"
#include "sim/scene/assets.h"
#include "sim/scene/fabric_reader.h"
#include "sim/solve/back_end.h"

namespace hysteron::experiments {
namespace {

std::string short_number(double x, int digits = 4) {
  std::ostringstream text;
  text << std::setprecision(digits) << x;
  return text.str();
}

void print_row(const std::vector<std::string>& cells, const std::vector<int>& widths) {
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const bool last = i + 1 == cells.size();
    std::cout << std::left << std::setw(last ? 0 : widths[i]) << cells[i] << (last ? "\n" : " ");
  }
}

void list_fabrics_table() {
  const std::vector<int> widths = {20, 11, 11, 11, 9, 16};
  print_row({"fabric", "B [N m]", "2HB [N]", "HB/B [1/m]", "K0 [1/m]", "density [kg/m^2]", "source of B"},
            widths);
  for (const FabricFile& file : list_fabrics()) {
    const Fabric& f = file.fabric;
    const double hb = f.virgin_curve().friction_moment();
    print_row({f.name, short_number(f.b2), short_number(2 * hb), short_number(hb / f.b2, 3),
               short_number(f.k0), short_number(f.density),
               f.published.count("B") ? f.published.at("B").provenance.source : f.provenance.at("b2").source},
              widths);
  }
}

void list_laws() {
  for (const LawEntry& law : law_catalogue()) {
    print_row({law.name, law.description + (law.built ? "" : " (not built yet)")}, {15});
  }
}

void list_scenes() {
  for (const std::string& name : list_assets("scenes")) print_row({name}, {});
}

void list_devices() {
  print_row({"cpu", cpu_description()}, {10});
  std::string reason;
  const int gpus = gpu_count(reason);
  for (int i = 0; i < gpus; ++i) print_row({"cuda", gpu_description(i)}, {10});
  if (gpus == 0) print_row({"cuda", "none: " + reason}, {10});
  for (const render::Candidate& candidate : render::Offscreen::candidates(render::Renderer::automatic)) {
    print_row({"renderer", candidate.name()}, {10});
  }
}

}  // namespace

int list(const CommandLine& line) {
  const std::vector<std::pair<std::string, void (*)()>> parts = {{"fabrics", list_fabrics_table},
                                                                 {"laws", list_laws},
                                                                 {"scenes", list_scenes},
                                                                 {"devices", list_devices}};
  for (const std::string& name : line.names) {
    const auto is_named = [&](const auto& part) { return part.first == name; };
    if (std::none_of(parts.begin(), parts.end(), is_named)) {
      throw Error::request("\"" + name + "\" must be fabrics | laws | scenes | devices");
    }
  }
  for (const auto& [name, print] : parts) {
    if (line.names.empty()) std::cout << (print == list_fabrics_table ? "" : "\n") << name << ":\n";
    if (line.names.empty() || std::count(line.names.begin(), line.names.end(), name)) print();
  }
  return 0;
}

}  // namespace hysteron::experiments
