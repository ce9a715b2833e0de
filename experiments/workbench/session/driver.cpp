#include "experiments/workbench/session/driver.h"

#include "experiments/workbench/app/case.h"
#include "experiments/workbench/session/session.h"

namespace hysteron::experiments {

int run_experiment(const CommandLine& line) {
  const Experiment& experiment = experiment_named(line.experiment);
  if (!experiment.case_of) return experiment.run(line);
  const std::unique_ptr<Case> own = experiment.case_of(line);
  if (!own) return experiment.run(line);
  if (!own->setup.options.explain) own->prepare();
  Session session(line, own->setup, std::move(own->cloth));
  if (session.is_over()) return 0;
  const RunPlan plan = own->plan(session);
  session.simulate(plan);
  own->conclude(session);
  session.finish(plan.title);
  return 0;
}

}  // namespace hysteron::experiments
