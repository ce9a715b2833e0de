// Numbers that links bring into Markdown: in the text `opens to [127.8° ± 0.1][crease-angle]`, at the page's
// foot `[crease-angle]: results/crease-cotton-broad/errors.csv "recovery_angle_deg .1f° +-.1g"`, whose target
// and title say where the number is and how it is written (number_source.h).
#pragma once

#include "experiments/report/documentation.h"

namespace hysteron::experiments {

// Writes what stands in the brackets of links whose definition has a title.  Faults are numbers that are not
// what their files say, definitions that are wrong, twice there or never used, links to labels that are not
// defined, and links to files that are not there.
void write_numbers(Page& page);

}  // namespace hysteron::experiments
