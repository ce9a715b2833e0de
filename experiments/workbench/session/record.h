// Writes a time series to disk, row by row.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace hysteron {
class Archive;
}

namespace hysteron::experiments {

// The file is a CSV with named columns and units in the header, "time [s]".  Every row is flushed, so that a
// run can be watched in FILE.part; the file gets its name in finish() or, after an exception elsewhere, on
// destruction.  A file that could not be written (full disk) never gets it.
class TimeSeriesWriter {
 public:
  // Throws Error::system if the file cannot be created or written, as the others below do.
  TimeSeriesWriter(std::filesystem::path file, const std::vector<std::string>& columns);
  ~TimeSeriesWriter();
  TimeSeriesWriter(const TimeSeriesWriter&) = delete;
  TimeSeriesWriter& operator=(const TimeSeriesWriter&) = delete;

  // Writes one number per column, with 17 significant digits.
  void row(const std::vector<double>& values);
  void finish();
  // Serialises the rows so far, with which a continued run begins.  Throws Error::invalid_input if columns
  // differ.
  void serialise(Archive& archive);

 private:
  void write(const std::string& row);

  std::filesystem::path file_, growing_;
  std::ofstream stream_;
  std::size_t columns_;
  std::string text_;   // text written so far
  bool whole_ = true;  // true if every row so far is on disk
  bool finished_ = false;
};

}  // namespace hysteron::experiments
