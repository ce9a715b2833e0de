#include "experiments/workbench/session/record.h"

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "sim/base/archive.h"
#include "sim/base/csv.h"
#include "sim/base/error.h"

namespace hysteron::experiments {
namespace {

Error failure(const std::string& attempt, const std::filesystem::path& file, int code) {
  return Error::system("cannot " + attempt + " " + file.string() + ": " + std::strerror(code ? code : EIO));
}

}  // namespace

TimeSeriesWriter::TimeSeriesWriter(std::filesystem::path file, const std::vector<std::string>& columns)
    : file_(std::move(file)), growing_(file_.string() + ".part"), columns_(columns.size()) {
  errno = 0;
  stream_.open(growing_, std::ios::trunc);
  if (!stream_) throw failure("create", growing_, errno);
  write(csv_row(columns));
}

TimeSeriesWriter::~TimeSeriesWriter() {
  if (finished_ || !whole_) return;
  stream_.close();
  std::error_code ignored;
  std::filesystem::rename(growing_, file_, ignored);
}

void TimeSeriesWriter::row(const std::vector<double>& values) {
  if (values.size() != columns_) {
    throw Error::simulation(file_.string() + ": a row of " + std::to_string(values.size()) + " numbers for " +
                            std::to_string(columns_) + " columns");
  }
  write(exact_csv_row(values));
}

void TimeSeriesWriter::finish() {
  stream_.close();
  if (std::rename(growing_.c_str(), file_.c_str()) != 0) throw failure("rename to", file_, errno);
  finished_ = true;
}

void TimeSeriesWriter::serialise(Archive& archive) {
  const std::string head = text_;
  archive(text_);
  if (!archive.loads()) return;
  if (!text_.starts_with(head)) throw Error::invalid_input(file_.string() + " had other columns");
  const std::string rows = text_.substr(head.size());
  text_ = head;
  write(rows);
}

void TimeSeriesWriter::write(const std::string& row) {
  errno = 0;
  text_ += row;
  stream_ << row << std::flush;
  if (stream_) return;
  whole_ = false;
  throw failure("write", growing_, errno);
}

}  // namespace hysteron::experiments
