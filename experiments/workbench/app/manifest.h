// What a run is and has found: the manifest in its folder, typed.  JSON is only in manifest_file.h.
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

// A result: number, text, truth or list of texts; nothing where it is not known, as where a number is not
// finite.
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
  // A number, if it is known; and if so, finite.
  bool is_numeric() const { return is_integer() || std::holds_alternative<double>(value_); }
  bool is_number() const { return is_numeric() && std::isfinite(number()); }
  bool is_text() const { return std::holds_alternative<std::string>(value_); }
  bool is(bool truth) const { return value_ == Variant(truth); }
  // Of a number, of a text.
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
  // What is not there is not known.
  const MetricValue& operator[](const std::string& name) const;
  // NaN where it is no number.
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
  std::string unit;  // "" for SI
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
    std::optional<Bar> bar{};  // of its colours
  };
  struct Instant {
    double time = 0;  // [s]
    std::string phase;
    std::optional<double> difference_rms{};  // of look `difference` [1/m]
    // Box of what is drawn of the cloth, in shares of the picture from its upper left corner: left, top,
    // right, bottom; all 0 where it is not noted.
    std::array<double, 4> cloth{};
    double moved = 0;  // since the picture before, root mean square over the vertices [m]
  };
  std::vector<Look> looks;
  double metres_per_pixel = 0;
  std::vector<Instant> instants;
};

// A curve that a comparison draws of every column: two columns of a file in its folder.
struct Curve {
  std::string plot, file, x, y;
  bool logarithmic = false;  // along y
  std::string caption;
  bool logarithmic_x = false;
  std::string
      knee{};  // the metric that is the share of the first y at which the curve has its knee; "": none
};

// What a fit says of the data under a law.
struct Statements {
  std::string law;
  std::vector<std::string> sentences;
};

// What a run was asked for beside its experiment, as it can be asked for again.
struct RunSpec {
  std::vector<std::string> positionals;                      // files, folders
  std::vector<std::pair<std::string, std::string>> flags{};  // path and text, in their order
};

// A file that a run has read, or a table that it has written.
struct InputRecord {
  std::string file;  // as it was named, or assets/...
  std::string hash;  // of its bytes
};

struct Manifest {
  std::string version, commit;
  std::string build;     // of the executable, which tells two of one commit apart; "": not noted
  std::string isa;       // that the program was built for, "x86-64-v3"; "": not noted
  std::string compiler;  // with its major version, "g++ 12"; "": not noted
  bool dirty = false;
  std::string experiment, command, started;
  std::optional<RunSpec> spec;       // of older programs only the command is known
  std::shared_ptr<const Json> keys;  // all that the run was asked for, resolved
  std::shared_ptr<const Json>
      options;  // resolved keys of a simulated run and its experiment; null: not noted
  std::shared_ptr<const Json> requested;  // merge patch that turns `keys` into the scene before its
                                          // experiment changed it; null: not noted
  std::vector<MeshRecord> meshes;         // files that its cloth and bodies were read from
  std::vector<InputRecord> inputs;        // every file that it has read but its own
  std::optional<std::string> device, renderer, positions, precision, element, law;
  std::optional<std::int64_t> triangles, hinges, steps;
  std::optional<double> seconds_simulated;
  std::vector<std::pair<std::string, double>> wall_seconds;  // "total", then by stage
  std::optional<int>
      batch;  // runs that shared a GPU with this one, itself included: times are of all of them
  std::optional<std::int64_t> bytes_device;
  std::vector<std::pair<std::string, double>> energy;  // closing balance [J]; empty: none is kept
  std::optional<std::string> state_hash;
  std::optional<int> substeps;
  std::optional<std::string> linear_solver;                              // of Newton's method
  std::vector<std::pair<std::string, std::shared_ptr<const Json>>> own;  // what only its experiment notes
  std::vector<Statements> statements;
  std::optional<std::vector<std::string>> series;  // own columns of metrics.csv
  std::optional<Frames> frames;
  std::vector<Curve> curves;
  std::string film_missing;           // why; "" if it is not
  std::vector<std::string> warnings;  // in the order in which they were given, each once
  std::vector<std::string> plots_missing, errors_missing;
  Metrics metrics;
  std::vector<std::string> requested_metrics;  // those that its scene file asks for
  std::vector<std::string> files;
  std::vector<InputRecord> tables;  // of those files CSVs and fabric files, as a complete run has left them
  bool complete = false;

  // Of `keys` the text or number at a path, "fabric.b2"; what is neither is its JSON.  "", 0: there is none.
  std::string text(const std::string& path) const;
  double number(const std::string& path) const;
  // "prandtl,linear", or a list of names or of what has one, as experiments over several laws or fabrics have
  // it; under the key, or else under that with an s.
  std::vector<std::string> names(const std::string& key) const;
  std::vector<std::string> law_parameters() const;       // "stops=16"
  std::vector<SourcedNumber> fabric_numbers() const;     // those with a source
  std::vector<SourcedNumber> published_numbers() const;  // of the fabric, as they stand in print

  double total_seconds() const;               // of wall clock; 0 where it is not known
  std::optional<double> own_seconds() const;  // the same, where they are not those of a batch
};

}  // namespace hysteron::experiments
