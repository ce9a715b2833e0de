#include "experiments/workbench/session/record.h"

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "sim/base/error.h"

namespace hysteron::experiments {
namespace {

std::string number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", x);
  return text;
}

Error failure(const std::string& attempt, const std::filesystem::path& file, int code) {
  return Error::machine("cannot " + attempt + " " + file.string() + ": " + std::strerror(code ? code : EIO));
}

template <class Items, class ToText>
std::string line_of(const Items& items, ToText to_text) {
  std::string line;
  for (const auto& item : items) line += (line.empty() ? "" : ",") + to_text(item);
  return line;
}

}  // namespace

Record::Record(std::filesystem::path file, const std::vector<std::string>& columns)
    : file_(std::move(file)), growing_(file_.string() + ".part"), columns_(columns.size()) {
  errno = 0;
  stream_.open(growing_, std::ios::trunc);
  if (!stream_) throw failure("create", growing_, errno);
  write_line(line_of(columns, [](const std::string& name) { return name; }));
}

Record::~Record() {
  if (finished_ || !whole_) return;
  stream_.close();
  std::error_code ignored;
  std::filesystem::rename(growing_, file_, ignored);
}

void Record::row(const std::vector<double>& values) {
  if (values.size() != columns_) {
    throw Error::run(file_.string() + ": a row of " + std::to_string(values.size()) + " numbers for " +
                     std::to_string(columns_) + " columns");
  }
  write_line(line_of(values, number));
}

void Record::finish() {
  stream_.close();
  if (std::rename(growing_.c_str(), file_.c_str()) != 0) throw failure("rename to", file_, errno);
  finished_ = true;
}

void Record::write_line(const std::string& line) {
  errno = 0;
  stream_ << line << '\n' << std::flush;
  if (stream_) return;
  whole_ = false;
  throw failure("write", growing_, errno);
}

}  // namespace hysteron::experiments
