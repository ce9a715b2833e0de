// Tables of words and numbers, by the names of their columns.
#pragma once

#include <filesystem>
#include <string>

#include "sim/base/csv.h"

namespace hysteron::experiments {

class NamedTable {
 public:
  // Throws as read_words() does.
  explicit NamedTable(const std::filesystem::path& csv);

  std::size_t size() const { return table_.rows.size(); }
  // Both throw Error::invalid_input, naming the file, where there is no such column.
  const std::string& word(std::size_t row, const std::string& column) const;
  double number(std::size_t row, const std::string& column) const;  // NaN of a cell that is none

 private:
  std::filesystem::path file_;
  TextTable table_;
};

}  // namespace hysteron::experiments
