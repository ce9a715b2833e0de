#include "experiments/bench/table.h"

#include "sim/base/csv.h"

namespace hysteron::experiments {

void write_table(Run& run, const std::vector<Metrics>& rows) {
  std::vector<CsvField> head;
  for (const auto& [key, value] : rows.front()) head.push_back(key);
  CsvFile file(run.path("table.csv"), head);
  for (const Metrics& row : rows) {
    std::vector<CsvField> fields;
    for (const auto& [key, value] : row)
      fields.push_back(value.is_text() ? CsvField(value.text()) : CsvField(value.number()));
    file.row(fields);
  }
  file.commit();
}

}  // namespace hysteron::experiments
