#include "experiments/validate/named_table.h"

#include <algorithm>
#include <cmath>

#include "sim/base/number_in.h"

namespace hysteron::experiments {

NamedTable::NamedTable(const std::filesystem::path& csv) : file_(csv), table_(read_words(csv)) {}

const std::string& NamedTable::word(std::size_t row, const std::string& column) const {
  const auto found = std::find(table_.head.begin(), table_.head.end(), column);
  if (found == table_.head.end())
    throw Error::invalid_input("validate: " + file_.string() + " has no column \"" + column + "\"");
  return table_.rows[row][found - table_.head.begin()];
}

double NamedTable::number(std::size_t row, const std::string& column) const {
  return number_in(word(row, column)).value_or(NAN);
}

}  // namespace hysteron::experiments
