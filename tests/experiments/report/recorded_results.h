// A checkout with a few recorded results, beside which pages of documentation are written.
#pragma once

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <fstream>

#include "experiments/report/number_source.h"
#include "tests/experiments/folder.h"
#include "tests/experiments/program.h"

namespace hysteron::experiments {

inline void write_text(const std::filesystem::path& file, const std::string& text) {
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file) << text;
}

class RecordedResults : public testing::Test {
 protected:
  RecordedResults() {
    Options options;
    options.out = root_.path() / "results/crease";
    options.quiet = true;
    ExperimentRun run({"crease", "hysteron crease", {}, {}}, options, Json::object());
    run.manifest().steps = 12345;
    run.metric("recovery_angle_deg", 127.768);
    run.metric("recovery_angle_deg_step_error", 0.114);
    run.metric("recovery_angle_deg_mesh_error", MetricValue());
    run.metric("recovery_angle_deg_draw_error", 2.3e-7);
    run.metric("recovery_angle_deg_mean", 126.2);
    run.metric("recovery_angle_deg_mean_stderr", 0.25);
    run.metric("set_m", 0);
    run.finish();
    write_text(root_.path() / "results/crease/errors.csv", "repeat,differs\nmesh,triangles=4\n");
    write_text(root_.path() / "results/cycles.csv",
               "cycle,law,M0 [N],note\n1,wong,5.9e-4,\"bent, flat\"\n10,wong,4.9e-4,\n10,dahl,-4e-4,\n");
    write_text(root_.path() / "results/means.csv",
               "fabric,law,area_mean,area_stderr\ncotton,wong,80.14,0.62\ncotton,dahl,70,0.4\n"
               "\"the chapter's, wool\",wong,51.8,0.07\n");
    write_text(root_.path() / "results/bench.json",
               R"([{"law": "wong", "cloths": 4.0, "ms": 2.5}, {"law": "dahl", "cloths": 4.0, "ms": 5}])");
  }
  std::string docs() const { return root_.path() / "docs"; }
  std::string page() const { return docs() + "/angles.md"; }
  void write_page(const std::string& text) const { write_text(page(), text); }
  // What `report --check` says of the page, without the program's and the page's name.
  std::string faults() const {
    const Outcome outcome = program("report --check " + docs());
    EXPECT_EQ(outcome.exit_code, outcome.err.empty() ? 0 : 4);
    std::string said = outcome.err;
    const std::string name = "hysteron report: " + page() + ":",
                      remedy = "; write it again: hysteron report " + docs();
    for (const std::string& known : {name, remedy})
      for (std::size_t at; (at = said.find(known)) != said.npos;) said.erase(at, known.size());
    return said;
  }

  Folder root_;
};

}  // namespace hysteron::experiments
