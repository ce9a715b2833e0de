#include "experiments/workbench/session/driver.h"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <iostream>

#include "experiments/workbench/app/case.h"
#include "experiments/workbench/app/fixed_keys.h"
#include "experiments/workbench/app/scene_source.h"
#include "experiments/workbench/compare/sweep_columns.h"
#include "experiments/workbench/session/probes.h"
#include "experiments/workbench/session/requested_metrics.h"
#include "experiments/workbench/session/resuming.h"
#include "experiments/workbench/session/session.h"
#include "experiments/workbench/session/variant_page.h"
#include "sim/base/error.h"
#include "sim/scene/body.h"

namespace hysteron::experiments {
namespace {

// True if the experiment leaves [[metric]] tables of its scenes to the driver.
bool takes_metrics(const Setup& setup) { return std::ranges::count(setup.own_tables, "metric") > 0; }

// A case whose request is accepted, with the metrics that its scene requests; null for a line without cloth.
struct AcceptedCase {
  std::unique_ptr<Case> own;
  std::vector<MetricRequest> metrics{};
};

// Throws what is refused before a cloth is built.
AcceptedCase accepted_case(const Experiment& experiment, const CommandLine& line) {
  AcceptedCase accepted{experiment.case_of(line)};
  if (!accepted.own) return accepted;
  Setup& setup = accepted.own->setup;
  if (takes_metrics(setup)) accepted.metrics = take_requests(setup);
  if (setup.options.errors && experiment.headlines.requested && accepted.metrics.empty())
    throw Error::invalid_input("--errors: " + setup.options.scene +
                               " has no [[metric]] whose errors could be measured")
        .with_key("errors", "true");
  check_duration(setup.scene);
  refuse_late_tables(setup);
  return accepted;
}

// Prints what the scene includes and leaves out, with bytes and loops (--explain).
void explain(const Scene& scene, const Cloth& cloth, const Simulation& simulation) {
  std::cout << cloth.mesh.faces() << " triangles, " << cloth.mesh.interior_edges << " hinges, "
            << cloth.mesh.vertices() << " vertices on " << simulation.device() << "\n";
  for (const std::string& body : body_lines(scene)) std::cout << body << "\n";
  for (const std::string& warning : cloth.warnings) std::cout << "warning: " << warning << "\n";
  for (const std::string& warning : body_warnings(scene)) std::cout << "warning: " << warning << "\n";
  const MethodChoice& method = simulation.method;
  if (!method.reason.empty()) std::cout << method.reason << "\n";
  if (method.linear_solver != Preconditioning::automatic)
    std::cout << "linear solver " << enum_name(method.linear_solver) << (method.in_float ? " in float" : "")
              << "\n";
  const StepLimits limits = simulation.limits();
  std::cout << "substeps " << limits.substeps << " of " << limits.substep << " s";
  if (limits.bending_step > 0)
    std::cout << "; largest stable explicit bending step " << limits.bending_step << " s";
  std::cout << "\n";
  std::size_t total = 0;
  for (const ScenePart& part : simulation.parts()) {
    std::cout << fmt::format("{:<16} {:<3} {:12} bytes  {}\n", part.name, part.included ? "in" : "out",
                             part.bytes, part.included ? part.kernels : part.reason);
    total += part.bytes;
  }
  std::cout << "in all " << total << " bytes, " << static_cast<double>(total) / cloth.mesh.faces()
            << " per triangle" << std::endl;
}

// Simulates, measures and concludes.
void simulate(Session& session, AcceptedCase& accepted) {
  std::optional<RequestedMetrics> requested;
  if (takes_metrics(session.setup())) requested.emplace(accepted.metrics, session);
  RunPlan plan = accepted.own->plan(session);
  if (requested) requested->join(plan);
  session.simulate(plan);
  if (requested) requested->finish();
  accepted.own->conclude(session);
  session.finish(plan.title);
}

int run_case(const CommandLine& given) {
  const Experiment& experiment = experiment_named(given.experiment);
  AcceptedCase accepted = accepted_case(experiment, given);
  if (!accepted.own) return experiment.run(given);
  Case& own = *accepted.own;
  const CommandLine& line = own.line ? *own.line : given;
  const Setup& setup = own.setup;
  const Options& options = setup.options;
  if (!options.explain) own.prepare();
  const auto begun = std::chrono::steady_clock::now();
  const Cloth cloth = own.cloth ? std::move(*own.cloth) : make_cloth(setup.scene);
  const std::unique_ptr<Simulation> simulation = make_simulation(setup.scene, cloth);
  auto probes = std::make_unique<Probes>(options.probe, cloth.mesh, simulation->dimension());
  if (options.explain) {
    explain(setup.scene, cloth, *simulation);
    std::cout << probes->text() << std::flush;
    return 0;
  }
  if (!options.dump_scene.empty()) {
    dump_scene(setup);
    return 0;
  }
  check_reference(options.reference, cloth.mesh, setup.scene.cloth);
  auto checkpoints = std::make_unique<Checkpoints>(line, setup, cloth, *simulation);
  if (checkpoints->is_complete()) return 0;
  Session session(line, setup, cloth, *simulation, checkpoints->archived_files());
  session.run().begun_at(begun);
  session.observe(std::move(probes), std::move(checkpoints));
  simulate(session, accepted);
  return 0;
}

}  // namespace

int run_experiment(const CommandLine& line) {
  const Experiment& experiment = experiment_named(line.experiment);
  if (!experiment.case_of) return experiment.run(line);
  return experiment.page ? run_variants(line, run_case, experiment.page) : run_case(line);
}

void check_columns(const std::vector<ChildRun>& columns) {
  for (const ChildRun& column : columns) try {
      accepted_case(experiment_named(column.line.experiment), column.line);
    } catch (const Error& error) {
      const std::string message = column.name + ": " + error.what();
      throw error.exit_code() == 2 ? Error::invalid_input(message) : Error::system(message);
    }
}

void explain_columns(const std::vector<ChildRun>& columns) {
  for (const ChildRun& column : columns) {
    std::cout << column.name << ":" << std::endl;
    run_experiment(column.line);
  }
}

}  // namespace hysteron::experiments
