#include "sim/bending/law_run.h"

#include "sim/bending/law_commands.h"
#include "sim/bending/law_visit.h"
#include "sim/bending/recovery.h"

namespace hysteron {
namespace {

// A law with its memory, on the way through the rows.
template <class Law>
struct Drive {
  Law law;
  History<double, Law::kHistory> history{};
  LawRun run{};
  double dissipated = 0;

  void through(const std::vector<LawRow>& rows) {
    for (const LawRow& row : rows) to(row);
  }

  void to(const LawRow& row) {
    const Vec<double, 1> curvature(row.curvature);
    set_step_time(law, row.seconds);
    run.tangent.push_back(law.tangent(curvature, history)(0, 0));
    auto step = law.step(curvature, history);
    history = step.history;
    dissipated += step.dissipated;
    if constexpr (kIsEditable<Law>) {
      if (row.edit) {
        const double stored = step.stored;
        history = law.edited(curvature, history);
        step = law.step(curvature, history);
        dissipated += stored - step.stored;
      }
    }
    run.moment.push_back(step.moment[0]);
    run.stored.push_back(step.stored);
    run.dissipated.push_back(dissipated);
  }
};

template <class Visit>
void with_law(const LawRequest& request, const Visit& visit) {
  const LawChoice choice = choose_law(request.name, request.curve, request.parameters, LawUse::alone);
  visit_memoryless<double, 1>(choice, visit) || visit_plastic<double, 1>(choice, visit) ||
      visit_friction<double, 1, AloneMemory>(choice, visit) ||
      visit_fatigue<double, 1, AloneMemory>(choice, visit);
}

}  // namespace

LawRun run_law(const LawRequest& request, const std::vector<LawRow>& rows) {
  LawRun run;
  with_law(request, [&]<class Law>(const Law& law) {
    Drive<Law> drive{law};
    drive.through(rows);
    run = std::move(drive.run);
  });
  return run;
}

double residual_after(const LawRequest& request, const std::vector<LawRow>& rows) {
  double residual = 0;
  with_law(request, [&]<class Law>(const Law& law) {
    Drive<Law> drive{law};
    drive.through(rows);
    set_step_time(drive.law, 0.0);
    residual = drive.law.residual(drive.history)[0];
  });
  return residual;
}

}  // namespace hysteron
