// Compares forms of friction that were fitted to the same rows, by a misfit, a criterion for forms of which
// none is a special case of the other, and the noise that repeated records show.
#pragma once

#include <string>
#include <vector>

#include "sim/identification/fab_bending.h"

namespace hysteron {

inline constexpr double kSameGauge = 0.01;  // gauges that differ by a smaller share are the same

// The differences between records of the same cycle, bent to the other side or run once more.
struct Repeats {
  std::vector<std::string> of = {};  // "L D1 cycle 2 and U1 cycle 2"; empty: the file has none
  double noise = 0;                  // standard deviation of the force of the whole strip in one record [N]
  double correlation = 0;            // of neighbouring rows

  bool known() const { return !of.empty(); }
};

// Compares the fitted cycles with those of all other tests and cycles with the same direction, gauge (within
// 1 %) and ends of the clamps' way (within 3 %).  Forces are compared at the fitted rows, without those on
// which records are unreliable (FabBendingQuestion::settling) and less the mean of their differences, since
// zeros differ; half of the remaining variance is that of one record.
Repeats find_repeats(const std::vector<FabLoops>& all, const std::vector<FabLoops>& fitted,
                     const FabBendingQuestion& question);

// The comparison of one form with the form asked for.  S is a form's sum of squared residuals, v the larger
// one of the variance of repeats and the mean square residual of the form asked for, and l = (1 + r)/(1 - r)
// the number of rows that count as one, with r the correlation of neighbouring rows of repeats or, without
// them, of residuals.
struct FormComparison {
  // misfit is (S - S of the form asked for)/(v l): the fall of twice the logarithm of the likelihood, with
  // more noise where no form meets the data within that of repeats (quasi-likelihood, Wedderburn 1974).  A
  // special case with one number less, k0 on a grid, is excluded with 95 % above kLikelihoodFall (Wilks
  // 1938).
  double misfit = 0;
  // preference is the misfit plus twice the difference in numbers (Akaike 1974), over its standard deviation:
  // by the scatter of the rows' own differences (Vuong 1989, Eq. 5.6; rows correlated as above) and by the
  // gain from meaningless numbers (chi square of as many).  Of forms of which none is a special case of the
  // other, one below -1.96 is nearer to the data than the one asked for, and one above 1.96 is farther,
  // whichever of them is true.
  double preference = 0;
  bool is_excluded = false;  // with 95 %: a special case by the misfit, another form by the preference
  bool is_nearer = false;
};
FormComparison compare_forms(const FabForm& form, const FabBending& asked, const Repeats& repeats);

// Widens the errors of b2 and HB by the values of other forms, each weighted by its likelihood beside this
// one: the form asked for is an assumption, and the data may not tell (Hoeting et al. 1999, Eq. 3).
void widen_errors(FabBending& asked, const std::vector<FabForm>& others, const Repeats& repeats = {});

}  // namespace hysteron
