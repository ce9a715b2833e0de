// Rows of numbers: on stdout as they are measured, as JSON, as table.csv.
#pragma once

#include <vector>

#include "experiments/workbench/app/run.h"

namespace hysteron::experiments {

// A number or a text of every row, on stdout.
struct Column {
  const char* key;
  const char* head;
  int width;
  int digits = 0;  // of numbers, behind the point
};

// Rows on stdout under the heads of their columns; what is not known is left blank.
class RowPrinter {
 public:
  // `silent`: prints nothing, since JSON follows.
  RowPrinter(std::vector<Column> columns, bool silent);
  void operator()(const Metrics& row) const;

 private:
  std::vector<Column> columns_;
  bool silent_;
};

void print_json(const std::vector<Metrics>& rows);

// table.csv; all rows have the keys of the first.
void write_table(Run& run, const std::vector<Metrics>& rows);

}  // namespace hysteron::experiments
