#include "sim/bending/laws/law_run.h"

#include <cmath>

#include "sim/base/archive.h"
#include "sim/bending/laws/law_commands.h"
#include "sim/bending/laws/law_visit.h"

namespace hysteron {

struct LawWalk::State {
  virtual ~State() = default;
  virtual std::unique_ptr<State> copy() const = 0;
  virtual LawPoint to(const LawRow& row) = 0;
  virtual double residual() const = 0;
  virtual double friction_moment() const = 0;
  virtual double permanent_set() const = 0;
  virtual void serialise(Archive& archive) = 0;
};

namespace {

// A law with its memory on the way through the rows.
template <class L>
struct Drive final : LawWalk::State {
  L law;
  History<double, L::kHistory> history{};
  double dissipated = 0, relaxed = 0;

  explicit Drive(const L& chosen) : law(chosen) {}
  std::unique_ptr<State> copy() const override { return std::make_unique<Drive>(*this); }

  void serialise(Archive& archive) override {
    archive.bytes(&history, sizeof history);
    archive(dissipated);
    archive(relaxed);
  }

  double tangent(const LawRow& row) {
    set_step_time(law, row.seconds);
    return law.tangent(Vec<double, 1>(row.curvature), history)(0, 0);
  }

  LawPoint to(const LawRow& row) override {
    const Vec<double, 1> curvature(row.curvature);
    set_step_time(law, row.seconds);
    auto step = law.step(curvature, history);
    history = step.history;
    dissipated += step.dissipated;
    relaxed += step.relaxed;
    if constexpr (EditableLaw<L>) {
      if (row.edit) {
        const double stored = step.stored;
        history = law.edited(curvature, history);
        step = law.step(curvature, history);
        dissipated += stored - step.stored;
      }
    }
    return {step.moment[0], step.stored, dissipated, relaxed};
  }

  double residual() const override {
    L let_go = law;
    set_step_time(let_go, 0.0);
    return let_go.residual(history)[0];
  }

  double friction_moment() const override {
    if constexpr (WeakeningLaw<L>)
      return law.m0 * law.strength(history);
    else
      return NAN;
  }

  double permanent_set() const override {
    if constexpr (SettingLaw<L>)
      return L::set_curvature(history)[0];
    else
      return 0;
  }
};

// Does set_step_time() reach the law, or one inside it?
template <class Law>
constexpr bool has_step_time() {
  if constexpr (TimedLaw<Law>)
    return true;
  else if constexpr (requires(Law law) { law.law; })
    return has_step_time<decltype(Law::law)>();
  else
    return false;
}

template <class Visit>
void with_law(const LawRequest& request, const Visit& visit) {
  const LawParams choice = choose_law(request.name, request.curve, request.parameters, LawUse::alone);
  visit_groups<double, 1, LawMemorySizes>(LawGroups{}, choice, visit);
}

}  // namespace

LawRun run_law(const LawRequest& request, const std::vector<LawRow>& rows) {
  LawRun run;
  with_law(request, [&]<class Law>(const Law& law) {
    Drive<Law> drive(law);
    for (const LawRow& row : rows) {
      run.tangent.push_back(drive.tangent(row));
      const LawPoint point = drive.to(row);
      run.moment.push_back(point.moment);
      run.stored.push_back(point.stored);
      run.dissipated.push_back(point.dissipated);
      if constexpr (RelaxingLaw<Law>) run.relaxed.push_back(point.relaxed);
    }
  });
  return run;
}

bool takes_time(const LawRequest& request) {
  bool timed = false;
  with_law(request, [&]<class Law>(const Law&) { timed = has_step_time<Law>(); });
  return timed;
}

double rigidity_on_the_tensor(const LawParams& choice) {
  double share = 1;
  visit_groups<double, 3, ClothMemory>(LawGroups{}, choice, [&]<class Law>(const Law&) {
    if constexpr (requires { Law::kElasticity; }) share = Law::kElasticity;
  });
  return share;
}

LawWalk::LawWalk(const LawRequest& request) {
  with_law(request, [&]<class Law>(const Law& law) { state_ = std::make_unique<Drive<Law>>(law); });
}
LawWalk::~LawWalk() = default;
LawWalk::LawWalk(const LawWalk& other) : state_(other.state_->copy()) {}
LawWalk::LawWalk(LawWalk&&) noexcept = default;
LawPoint LawWalk::to(const LawRow& row) { return state_->to(row); }
double LawWalk::residual() const { return state_->residual(); }
double LawWalk::friction_moment() const { return state_->friction_moment(); }
double LawWalk::permanent_set() const { return state_->permanent_set(); }
void LawWalk::serialise(Archive& archive) { state_->serialise(archive); }

}  // namespace hysteron
