// Tables in Markdown that mirror recorded files: one comment says what stands in them.
//
//   <!-- table ../results/drapes/means.csv law=prandtl | fabric = cotton-broad as cotton broad; wool-tropical
//   | coefficient [%] = fabric={} drape_coefficient_percent_mean .1f +-.1f
//   | folds = fabric={} node_count_mean .1f -->
//   ...
//   <!-- /table -->
//
// Between bars stand the columns.  The first has the rows: `HEAD = VALUE; VALUE as LABEL`, or `HEAD = each
// COLUMN` for every value of a column of the file.  The others are `HEAD = SOURCE`, a title of
// number_source.h, in which {} is the row's value, in the name of the file, too.  What stands behind the file
// goes before every source, but for those that begin with a file of their own.  The first head links to the
// file, or each row's label to its own; ` / ` in the first head and in labels begins another column
// of words.
#pragma once

#include "experiments/report/documentation.h"

namespace hysteron::experiments {

// Writes what stands between the comments.  Faults are blocks that are not what their files say, that are
// wrong, or whose numbers are not there.
void write_tables(Page& page);

}  // namespace hysteron::experiments
