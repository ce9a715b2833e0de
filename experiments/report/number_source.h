// Where a number in Markdown comes from, as its marker spells it, and how it is written there.
#pragma once

#include <filesystem>
#include <string>

namespace hysteron::experiments {

// What stands between `<!-- n: ` and ` -->`: words apart by spaces, in double quotes where they hold some.
//
//   results/crease-cotton-broad recovery_angle_deg .1f° +-.1g    a metric of the folder's manifest.json
//   results/fold-cotton-broad /steps ,                           a JSON pointer into it
//   results/speed/bench-cpu-4608.json /0/ms_per_step .2f         or into another JSON file
//   results/fold-cotton-broad/material.csv 10 "M0 [N]" .2g       a cell: the row's first field, the column
//   results/a/table.csv law=wong&element=hinge error .1f         a cell of the row with these fields
//
// `minus SOURCE` and `over SOURCE` subtract another number or divide by it; `times NUMBER` converts units.
// Then the format: digits behind the point (.1f) or significant ones (.2g), with `+` before them a sign; `,`
// is a count with thousands apart; the unit stands behind.  A cell that is `text` stands as it is.  `+-.1g`
// appends those of the metric's _step_error, _mesh_error and _draw_error that are known.
//
// Returns what stands there now.  `root`: folder from which paths start.  Throws Error::request, without file
// and line, if the marker is wrong or there is no such number.
std::string number_from(const std::string& source, const std::filesystem::path& root);

// The first word of the marker: the folder or file that it reads, still without root.
std::filesystem::path path_in(const std::string& source);

}  // namespace hysteron::experiments
