// Tables of words and numbers as they stand in a file, to be shown; csv.h reads columns of numbers.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/workbench/app/run.h"

namespace hysteron::experiments {

struct TextTable {
  std::vector<std::string> head;
  std::vector<std::vector<std::string>> rows;  // each as long as the head
};

// A CSV file, quoted where a field needs it (RFC 4180).  Throws Error::machine if it cannot be read,
// Error::request (with file:line) if a row has another number of fields or a quote is not closed.
TextTable read_words(const std::filesystem::path& file);

// A row for each object, a column for each key that is no list or object; one that only later objects have
// stands behind the key that it follows there.
TextTable table_of(const Json& objects);

// Takes columns out that say the same in every row, "device: cpu, precision: double"; empty ones are left
// out.  A table of one row stays whole.
std::string take_common(TextTable& table);

// HTML: names with their units apart, long numbers with six digits, numbers to the right.
std::string html_of(const TextTable& table);

}  // namespace hysteron::experiments
