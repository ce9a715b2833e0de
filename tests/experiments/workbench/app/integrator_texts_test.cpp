// These tests check what is said of the integrator's part in dissipation.
#include "experiments/workbench/app/integrator_texts.h"

#include <fmt/core.h>

#include <limits>

#include "tests/experiments/program.h"

namespace hysteron::experiments {
namespace {

// The ledger of cloth whose friction took 1 J, and whose integrator `part` J.
Ledger ledger_with(double part) {
  Ledger ledger;
  ledger.initial = ledger.bending_friction = 1;
  ledger.inertia = part;
  return ledger;
}

TEST(Integrator, ThatTakesMoreThanAQuarterIsSaidWithTheStepThatWouldDoInProportion) {
  EXPECT_EQ(integrator_text(ledger_with(0.33), 1e-3), "");
  // The step over the one taken is as a third over the part taken.
  for (const double part : {1.0, 3.0, 9.0}) {
    const std::string text = integrator_text(ledger_with(part), 1e-3);
    EXPECT_TRUE(says(text, fmt::format("steps of about {:.2g} s would take 25 %", 1e-3 / 3 / part)));
    EXPECT_TRUE(says(text, "if its part shrinks with the step"));
  }
}

TEST(Integrator, ThatTakesNearlyAllGetsNoAdvice) {
  for (const double part : {50.0, 1e7, 1e12}) {
    const std::string text = integrator_text(ledger_with(part), 1.0 / 120);
    EXPECT_TRUE(says(text, fmt::format("took {:.0f} %", 100 * part / (1 + part))));
    EXPECT_FALSE(says(text, "steps of"));
  }
  Ledger nothing_else = ledger_with(1);
  nothing_else.bending_friction = 0;
  EXPECT_EQ(integrator_text(nothing_else, 1e-3), "") << "of cloth that dissipates nothing itself";
}

TEST(Integrator, ThatGivesEnergyIsNotSaidToTakeIt) {
  const std::string text = integrator_text(ledger_with(-0.7), 1e-3);
  EXPECT_TRUE(says(text, "gave 0.7 J, 70 % of what else was dissipated"));
  EXPECT_FALSE(says(text, "took"));
  EXPECT_EQ(integrator_text(ledger_with(-0.33), 1e-3), "");
}

// With half the step nothing else is dissipated.
TEST(Integrator, ThatIsAllThereIsHasAShareOfAHundred) {
  const std::string text = integrator_text(2.0 / 3, std::numeric_limits<double>::infinity(), 5e-3);
  EXPECT_TRUE(says(text, "is 40 %, 100 % with half the step: by these two, 100 % would stay"));
}

// Parts that fall along a line with the step, and the step at which they are a third.
TEST(Integrator, ThatShrinksWithTheStepIsGivenTheStepThatWouldDo) {
  EXPECT_TRUE(says(integrator_text(0.8, 0.4, 4e-3), "of about 0.0017 s would take 25 %"));
  EXPECT_TRUE(says(integrator_text(0.8, 0.45, 4e-3), "of about 0.0013 s would take 25 %"));
  EXPECT_TRUE(says(integrator_text(-0.8, -0.4, 4e-3), "of about 0.0017 s would take 25 %"));
}

TEST(Integrator, ThatKeepsItsShareInHalfTheStepGetsNoStep) {
  const std::string text = integrator_text(2.0 / 3, 9.0 / 16, 5e-3);
  EXPECT_TRUE(says(text, "share of all dissipation is 40 %, 36 % with half the step"));
  EXPECT_TRUE(says(text, "31 % would stay however short it is"));
  EXPECT_FALSE(says(integrator_text(0.7, 1.3, 4e-3), "would take")) << "one that grows";
}

}  // namespace
}  // namespace hysteron::experiments
