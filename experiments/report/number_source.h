// Where a number in Markdown comes from and how it is written there: target and title of its link.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace hysteron::experiments {

// The target is a file, as seen from the page; the title is words apart by spaces, in single quotes where
// they hold some:
//
//   a/manifest.json "recovery_angle_deg .1f° +-.1g"        a metric of the run; a/errors.csv means the same
//   a/manifest.json "/steps ,"                             a JSON pointer, into any JSON file
//   a/material.csv "10 'M0 [N]' .2g"                       a cell: the row's first field, the column
//   a/table.csv "law=wong&element=hinge error .1f"         a cell of the row with these fields
//   a/bench.json "law=wong element=hinge ms_per_step .1f"  the same in a list of objects
//
// `minus SOURCE` and `over SOURCE` subtract another number or divide by it, of the same file unless one is
// named; `times NUMBER` converts units.  Then the format: digits behind the point (.1f) or significant ones
// (.2g), with `+` before them a sign; `,` is a count with thousands apart; the unit stands behind.  A cell
// that is `text` stands as it is, an empty one as a dash.  `+-.1g` appends the errors that stand beside the
// number: of x its x_step_error, x_mesh_error and x_draw_error, of x_mean the first two and its x_mean_stderr
// or x_stderr.
struct NumberSource {
  std::string target, title;
};

// What stands there now.  `folder`: that of the page.  Throws Error::invalid_input, without file and line of
// the page, if the title is wrong or there is no such number.
std::string number_from(const NumberSource& source, const std::filesystem::path& folder);

// The values of a column of a CSV file or of a list of objects, each once, in their order.  Throws as
// number_from does.
std::vector<std::string> values_of_column(const std::string& target, const std::string& column,
                                          const std::filesystem::path& folder);

// Whether a word of a source names a file of numbers.
bool names_a_file(const std::string& word);

}  // namespace hysteron::experiments
