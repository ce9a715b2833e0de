#include "experiments/sweep/study.h"

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>
#include <numeric>
#include <random>
#include <set>
#include <utility>

#include "experiments/workbench/compare/variants.h"

namespace hysteron::experiments {
namespace {

constexpr std::size_t kLongestName =
    200;  // file systems allow 255 bytes; names of files beside the folder are longer

std::string last_part(const std::string& key) { return key.substr(key.rfind('.') + 1); }

// Returns "k0" for "fabric.k0", unless another axis ends in the same.
std::string short_name(const std::vector<StudyAxis>& axes, const StudyAxis& axis) {
  const std::string last = last_part(axis.key);
  const auto shared = std::count_if(axes.begin(), axes.end(),
                                    [&](const StudyAxis& other) { return last_part(other.key) == last; });
  return shared > 1 ? axis.key : last;
}

// Returns a value as part of a file's name, without characters that are special in shells.
std::string plain(const std::string& value) {
  std::string name = column_name(value);
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) &&
        std::string_view("._+-").find(c) == std::string_view::npos)
      c = '-';
  return name;
}

// Returns `number` with as many digits as `most` has.
std::string padded(std::size_t number, std::size_t most) {
  const std::string digits = std::to_string(number);
  return std::string(std::to_string(most).size() - digits.size(), '0') + digits;
}

// A factor of the combinations: one axis, or all sampled axes together.
struct Part {
  std::vector<std::size_t> axes;
  std::size_t size;
};

std::vector<Part> axis_parts(const std::vector<StudyAxis>& axes) {
  std::vector<Part> parts;
  std::size_t sample = axes.size();  // index of the sampled part
  for (std::size_t a = 0; a < axes.size(); ++a) {
    if (axes[a].sampled && sample < axes.size()) {
      parts[sample].axes.push_back(a);
      continue;
    }
    if (axes[a].sampled) sample = parts.size();
    parts.push_back({{a}, axes[a].values.size()});
  }
  return parts;
}

void name_runs(const std::vector<StudyAxis>& axes, const std::vector<Part>& parts,
               std::vector<StudyRun>& runs) {
  std::set<std::string> taken;
  bool too_long = false;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    std::string& name = runs[r].name;
    std::size_t stride = runs.size();
    for (const Part& part : parts) {
      stride /= part.size;
      const StudyAxis& axis = axes[part.axes.front()];
      const std::string value = axis.sampled
                                    ? "sample=" + padded(r / stride % part.size + 1, part.size)
                                    : short_name(axes, axis) + "=" + plain(runs[r].values[part.axes[0]]);
      name += (name.empty() ? "" : ",") + value;
    }
    const std::string stem = name;
    for (int number = 2; !taken.insert(name).second; ++number) name = stem + "-" + std::to_string(number);
    too_long = too_long || name.size() > kLongestName;
  }
  if (!too_long) return;
  for (std::size_t r = 0; r < runs.size(); ++r) runs[r].name = "run=" + padded(r + 1, runs.size());
}

// Returns a uniform number in [0, 1); the standard fixes the engine's numbers, not those of its
// distributions.
double uniform(std::mt19937_64& engine) { return static_cast<double>(engine() >> 11) * 0x1p-53; }

}  // namespace

bool is_seed(const StudyAxis& axis) { return axis.key == kSeedKey; }

std::vector<StudyRun> runs_on_axes(const std::vector<StudyAxis>& axes) {
  const std::vector<Part> parts = axis_parts(axes);
  std::size_t count = 1;
  for (const Part& part : parts) count *= part.size;
  std::vector<StudyRun> runs(count, {"", std::vector<std::string>(axes.size())});
  for (std::size_t r = 0; r < count; ++r) {
    std::size_t stride = count;
    for (const Part& part : parts) {
      stride /= part.size;
      for (const std::size_t a : part.axes) runs[r].values[a] = axes[a].values[r / stride % part.size];
    }
  }
  name_runs(axes, parts, runs);
  return runs;
}

std::vector<std::vector<double>> latin_hypercube(std::size_t axes, std::size_t n, std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  std::vector<std::vector<double>> drawn(axes, std::vector<double>(n));
  std::vector<std::size_t> part(n);
  for (std::vector<double>& axis : drawn) {
    std::iota(part.begin(), part.end(), std::size_t{0});
    for (std::size_t i = n; i > 1; --i) {  // Durstenfeld 1964
      const auto other = static_cast<std::size_t>(uniform(engine) * static_cast<double>(i));
      std::swap(part[i - 1], part[other]);
    }
    for (std::size_t i = 0; i < n; ++i)
      axis[i] = (static_cast<double>(part[i]) + uniform(engine)) / static_cast<double>(n);
  }
  return drawn;
}

Flag flag_of(const std::string& experiment, const std::string& key, const std::string& value) {
  if (!key.starts_with("param.")) return parsed_flag(experiment, key, value);
  return {"param", key.substr(6) + "=" + value};
}

CommandLine run_command_line(const Study& study, const StudyRun& run) {
  CommandLine line{study.experiment, "hysteron " + study.experiment, study.shared, {}};
  for (std::size_t a = 0; a < study.axes.size(); ++a)
    line.flags.push_back(flag_of(study.experiment, study.axes[a].key, run.values[a]));
  // Drops the seed of a structured mesh, which is the same in every repetition.
  if (last_text(line.flags, "mesh", "random") != "random")
    std::erase_if(line.flags, [](const Flag& flag) { return flag.path == kSeedKey; });
  return line;
}

Json study_record(const Study& study) {
  Json shared = Json::array(), axes = Json::array();
  for (const Flag& flag : study.shared) shared.push_back(flag.path + "=" + flag.text());
  for (const StudyAxis& axis : study.axes) {
    axes.push_back({{"key", axis.key}, {"values", axis.values}});
    if (axis.logarithmic) axes.back()["scale"] = "log";
    if (axis.sampled) axes.back()["sampled"] = "latin";
  }
  Json keys = {{"study", study.name}, {"experiment", study.experiment}, {"shared", shared}, {"axes", axes}};
  if (!study.metrics.empty()) keys["metrics"] = study.metrics;
  return keys;
}

}  // namespace hysteron::experiments
