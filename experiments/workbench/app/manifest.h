// The manifest describes a run and its results, as types; its JSON is handled in manifest_file.h alone.
#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "experiments/workbench/app/mesh_record.h"

namespace hysteron::experiments {

using Json = nlohmann::ordered_json;

// A result: a number, text, boolean or list of texts; empty if unknown, also for a number that is not finite.
class MetricValue {
 public:
  MetricValue() = default;
  MetricValue(std::nullptr_t) {}
  MetricValue(double number) : value_(number) {}
  template <std::integral Integer>
  MetricValue(Integer number) {
    if constexpr (std::same_as<Integer, bool>)
      value_ = number;
    else
      value_ = static_cast<std::int64_t>(number);
  }
  MetricValue(std::string text) : value_(std::move(text)) {}
  MetricValue(const char* text) : value_(std::string(text)) {}
  MetricValue(std::vector<std::string> texts) : value_(std::move(texts)) {}
  template <class T>
  MetricValue(const std::optional<T>& known) : MetricValue(known ? MetricValue(*known) : MetricValue()) {}

  bool is_known() const { return is_number() || (!is_numeric() && value_.index() > 0); }
  bool is_integer() const { return std::holds_alternative<std::int64_t>(value_); }
  // `is_number` is true for a known, and therefore finite, number.
  bool is_numeric() const { return is_integer() || std::holds_alternative<double>(value_); }
  bool is_number() const { return is_numeric() && std::isfinite(number()); }
  bool is_text() const { return std::holds_alternative<std::string>(value_); }
  bool is(bool truth) const { return value_ == Variant(truth); }
  // The value must be a number, or a text.
  double number() const {
    return is_integer() ? static_cast<double>(std::get<std::int64_t>(value_)) : std::get<double>(value_);
  }
  const std::string& text() const { return std::get<std::string>(value_); }

  using Variant =
      std::variant<std::monostate, bool, std::int64_t, double, std::string, std::vector<std::string>>;
  const Variant& variant() const { return value_; }
  bool operator==(const MetricValue&) const = default;

 private:
  Variant value_;
};

// Results by name, in the order in which they were found.
class Metrics {
 public:
  using Entry = std::pair<std::string, MetricValue>;

  Metrics() = default;
  Metrics(std::initializer_list<Entry> entries) {
    for (const auto& [name, value] : entries) set(name, value);
  }

  void set(const std::string& name, MetricValue value);
  bool contains(const std::string& name) const;
  // Returns an empty value for an unknown name.
  const MetricValue& operator[](const std::string& name) const;
  // Returns NaN unless it is a number.
  double number(const std::string& name) const;
  bool empty() const { return entries_.empty(); }
  auto begin() const { return entries_.begin(); }
  auto end() const { return entries_.end(); }
  bool operator==(const Metrics&) const = default;

 private:
  std::vector<Entry> entries_;
};

// A number of a fabric, as its manifest has it.
struct SourcedNumber {
  std::string name;
  MetricValue value;
  std::string unit;  // "" for SI units
  std::string confidence, source;
};

// The pictures of a run.
struct Frames {
  struct Bar {
    std::string label, unit;
    double low = 0, high = 0;
  };
  struct Look {
    std::string name;
    std::optional<Bar> bar{};  // range of its colours
  };
  struct Instant {
    double time = 0;  // [s]
    std::string phase;
    std::optional<double> difference_rms{};  // root mean square of look `difference` [1/m]
    // The box of the drawn cloth, in shares of the picture from its upper left corner: left, top, right,
    // bottom; all 0 if unknown.
    std::array<double, 4> cloth{};
    double moved = 0;  // root mean square motion of the vertices since the previous picture [m]
  };
  std::vector<Look> looks;
  double metres_per_pixel = 0;
  std::vector<Instant> instants;
};

// A curve that a comparison draws for every column: two columns of a file in its folder.
struct Curve {
  std::string plot, file, x, y;
  bool logarithmic = false;  // scale of y
  std::string caption;
  bool logarithmic_x = false;
  std::string
      knee{};  // the metric that is the share of the first y at which the curve has its knee; "": none
};

// The statements of a fit about the data under a law.
struct Statements {
  std::string law;
  std::vector<std::string> sentences;
};

// A run's request beside its experiment, in a form that can be repeated.
struct RunSpec {
  std::vector<std::string> positionals;                      // arguments: files, folders
  std::vector<std::pair<std::string, std::string>> flags{};  // pairs of path and text, in order
};

// A file that a run has read, or a table that it has written.
struct InputRecord {
  std::string file;  // name as given, or assets/...
  std::string hash;  // hash of its bytes
};

struct Manifest {
  std::string version, commit;
  std::string build;     // build of the executable, as a commit can have two; "": unknown
  std::string isa;       // instruction set of the build, "x86-64-v3"; "": unknown
  std::string compiler;  // compiler with its major version, "g++ 12"; "": unknown
  bool dirty = false;
  std::string experiment, command, started;
  std::optional<RunSpec> spec;          // empty for older programs, which recorded only the command
  std::shared_ptr<const Json> keys;     // the complete request, resolved
  std::shared_ptr<const Json> options;  // resolved keys of a simulated run and its experiment; null: unknown
  // Merge patch from `keys` to the scene before its experiment changed it; null: unknown.
  std::shared_ptr<const Json> requested;
  std::vector<MeshRecord> meshes;   // files of its cloth and bodies
  std::vector<InputRecord> inputs;  // every file that it has read except its own
  std::optional<std::string> device, renderer, positions, precision, element, law;
  std::optional<std::int64_t> triangles, hinges, steps;
  std::optional<double> seconds_simulated;
  std::vector<std::pair<std::string, double>> wall_seconds;  // "total", then by stage
  std::optional<int> batch;  // runs that shared a GPU with this one, including it; times are theirs together
  std::optional<std::int64_t> bytes_device;
  std::vector<std::pair<std::string, double>> energy;  // closing balance [J]; empty if none is kept
  std::optional<std::string> state_hash;
  std::optional<int> substeps;
  std::optional<std::string> linear_solver;                              // solver of Newton's method
  std::vector<std::pair<std::string, std::shared_ptr<const Json>>> own;  // entries of its experiment alone
  std::vector<Statements> statements;
  std::optional<std::vector<std::string>> series;  // its own columns of metrics.csv
  std::optional<Frames> frames;
  std::vector<Curve> curves;
  std::string film_missing;           // why there is no film; "" if there is one
  std::vector<std::string> warnings;  // in the order of their occurrence, each once
  std::vector<std::string> plots_missing, errors_missing;
  Metrics metrics;
  std::vector<std::string> requested_metrics;  // metrics that its scene file requests
  std::vector<std::string> files;
  std::vector<InputRecord> tables;  // CSVs and fabric files, as a complete run has left them
  bool complete = false;

  // Return the text or number at a path of `keys`, "fabric.b2"; other values as JSON.  "" or 0 if there is
  // none.
  std::string text(const std::string& path) const;
  double number(const std::string& path) const;
  // Returns names from "prandtl,linear", from a list of names, or from a list of objects with names, as
  // experiments over several laws or fabrics have it; under the key, or else under that with an s.
  std::vector<std::string> names(const std::string& key) const;
  std::vector<std::string> law_parameters() const;       // texts like "stops=16"
  std::vector<SourcedNumber> fabric_numbers() const;     // numbers with a source
  std::vector<SourcedNumber> published_numbers() const;  // published numbers of the fabric

  double total_seconds() const;               // wall clock [s]; 0 if unknown
  std::optional<double> own_seconds() const;  // the same, unless shared by a batch
};

}  // namespace hysteron::experiments
