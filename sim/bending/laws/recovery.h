// Computes what is left of a bend after release: the residual curvature by closed form, and the chapter's
// three cases.
//
// The moment at the reversal decides the case (Wong 4.3.3, after Anandjiwala & Leaf 1991): |M| <= Ma, Ma <
// |M| <= 2 Ma, |M| > 2 Ma, with Ma = M0 + b2 K0.
#pragma once

#include "sim/bending/laws/law_run.h"

namespace hysteron {

enum class RecoveryCase { elastic = 1, partial = 2, full_slip = 3 };

// Classifies the moment at the reversal [N], which is negative for bends to the back, whose Ma may differ.
// Without friction (b1 = b2 or k0 = 0) every recovery is elastic.
RecoveryCase recovery_case(const VirginCurve& curve, double moment);

// Does residual_by_formula() know the law? It knows bilinear, wong, and prandtl without fatigue, a fabric's
// own stops or a set; for elastic laws the residual is 0.
bool has_residual_formula(const LawParams& law);

// Returns the curvature [1/m] at which the moment is zero on the branch that begins at a reversal at
// (curvature [1/m], moment [N]), both of one sign, which lies on the virgin curve or on the straight line
// that follows it:
//   bilinear (Anandjiwala & Leaf 1991, Eqs. of the three cases): 0;  Km - M K0/Ma;  M0/b2
//   wong, prandtl: the root of b2 K + F on the quadratic branch, M0/b2 where the branch has run out
//   wong with recovery = reversible: 0 in case 1 on the virgin quadratic
// The branch of a bilinear law runs out at 2 K0 beyond the reversal as well.
double residual_by_formula(const LawParams& law, double curvature, double moment);

// Counts of a driven law's reversals that unload, by case.
struct RecoveryCounts {
  int of[3] = {0, 0, 0};  // elastic, partial, full slip
};
RecoveryCounts count_recoveries(const VirginCurve& curve, const std::vector<LawRow>& rows, const LawRun& run);

// Returns the curvature [1/m] at which the law's moment is zero after `rows`, found on the law itself.
double residual_after(const LawRequest& request, const std::vector<LawRow>& rows);

}  // namespace hysteron
