#include "experiments/bench/table.h"

#include <fmt/core.h>

#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>

#include "experiments/workbench/app/manifest_file.h"
#include "sim/base/csv.h"

namespace hysteron::experiments {
namespace {

std::string cell(const MetricValue& value, const Column& column) {
  if (value.is_text()) return fmt::format("{:<{}}", value.text(), column.width);
  if (value.is_number()) return fmt::format("{:{}.{}f}", value.number(), column.width, column.digits);
  return std::string(column.width, ' ');
}

void print_line(std::string line) {
  line.erase(line.find_last_not_of(' ') + 1);
  fmt::print("{}\n", line);
  std::fflush(stdout);
}

}  // namespace

RowPrinter::RowPrinter(std::vector<Column> columns, bool silent)
    : columns_(std::move(columns)), silent_(silent) {
  if (silent_) return;
  std::string heads;
  for (const Column& column : columns_) heads += fmt::format("{:>{}} ", column.head, column.width);
  print_line(heads);
}

void RowPrinter::operator()(const Metrics& row) const {
  if (silent_) return;
  std::string line;
  for (const Column& column : columns_) line += cell(row[column.key], column) + " ";
  print_line(line);
}

void print_json(const std::vector<Metrics>& rows) {
  Json list = Json::array();
  for (const Metrics& row : rows) list.push_back(to_json(row));
  std::cout << list.dump(2) << std::endl;
}

void write_table(Run& run, const std::vector<Metrics>& rows) {
  std::vector<std::string> head;
  for (const auto& [key, value] : rows.front()) head.push_back(key);
  Table table(head);
  for (const Metrics& row : rows) {
    std::vector<Cell> fields;
    for (const auto& [key, value] : row)
      fields.push_back(value.is_text() ? Cell(value.text()) : Cell(value.number()));
    table.row(fields);
  }
  table.write(run.path("table.csv"));
}

}  // namespace hysteron::experiments
