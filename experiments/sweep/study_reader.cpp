#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "experiments/sweep/study.h"
#include "experiments/workbench/app/command_line.h"
#include "experiments/workbench/app/fixed_keys.h"
#include "experiments/workbench/app/manifest_file.h"
#include "experiments/workbench/app/scene_source.h"
#include "sim/base/error.h"
#include "sim/base/number_in.h"
#include "sim/scene/assets.h"
#include "sim/scene/choice.h"
#include "sim/scene/toml_file.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;

constexpr double kMaxValues = 100000, kMaxRuns = 1e6;
constexpr int kDigits = 6;  // digits of values from a range or a sample, which appear in names and tables

// True for a flag of `sweep` itself, which a study must not set.
bool is_of_sweep(const std::string& flag) {
  const InColumns in = simulation_traits(flag).in_columns;
  return in == InColumns::leave || in == InColumns::share;
}

// True if the experiment writes a folder with a manifest and flags alone define it; if its argument is a
// scene, it also takes this as --scene.
bool can_be_repeated(const Experiment& experiment) {
  const bool by_flags = !*experiment.positionals || (experiment.simulates && experiment.defaults);
  if ((!experiment.run && !experiment.case_of) || !by_flags) return false;
  const std::vector<KeyDescription> keys = experiment_options(experiment, Defaults::left_out);
  return has_key(keys, "out") && has_key(keys, "quiet");
}

// Splits "fabric.k0=12" or "param=stack=8" into key and value.
ValueTree shared_node(std::string flag) {
  if (flag.starts_with("param=")) flag[5] = '.';
  const std::size_t end = flag.find('=');
  return {ValueTree::Kind::value, flag.substr(0, end), 0, flag.substr(end + 1), {}};
}

// Returns a study from the manifest of its sweep, which outlives the study file.  The tree is that of a study
// file, with "scale" and "sampled" for axes whose values are listed, which a file cannot express. Throws
// Error::invalid_input, naming `file`, if the manifest is not of a sweep.
ValueTree recorded_study(const Manifest& manifest, const std::string& file) {
  for (const char* key : {"experiment", "shared", "axes"})
    if (manifest.experiment != "sweep" || !manifest.keys || !manifest.keys->contains(key))
      throw Error::invalid_input(file + " is not the manifest of a sweep").with_key("study", file);
  ValueTree root = json_tree(*manifest.keys, file, Lists::allowed);
  std::erase_if(root.children, [](const ValueTree& node) { return node.key == "study"; });
  for (ValueTree& node : root.children) {
    if (node.key == "axes") node.key = "axis";
    if (node.key != "shared") continue;
    node.key = "scene";
    node.kind = ValueTree::Kind::table;
    for (ValueTree& flag : node.children)
      if (const auto* text = std::get_if<std::string>(&flag.value)) flag = shared_node(*text);
  }
  return root;
}

// Formats a number as flags take it: integers without an exponent.
std::string flag_text(double x) {
  constexpr double kExact = 1e15;
  return x == std::floor(x) && std::abs(x) < kExact ? number_text(x, {.decimals = 0}) : number_text(x);
}

std::string flag_text(const Value& value) {
  if (const auto* x = std::get_if<bool>(&value)) return *x ? "true" : "false";
  if (const auto* x = std::get_if<std::int64_t>(&value)) return std::to_string(*x);
  if (const auto* x = std::get_if<double>(&value)) return flag_text(*x);
  if (const auto* x = std::get_if<std::string>(&value)) return *x;
  std::vector<std::string> words;
  for (double x : std::get<std::vector<double>>(value)) words.push_back(number_text(x));
  return join(words, " ");
}

class StudyFile {
 public:
  // `recorded` is true if `root` is from a manifest.
  StudyFile(const std::string& file, const std::string& name, bool recorded)
      : file_(file), recorded_(recorded) {
    study_.file = file;
    study_.name = name;
  }

  Study read(const ValueTree& root) {
    throw_if_unknown(root, {"experiment", "scene", "axis", "sample", "seeds", "metrics", "resources"}, "");
    choose_experiment(root);
    if (const ValueTree* scene = root.find("scene")) read_scene("", table(*scene));
    if (const ValueTree* axes = root.find("axis")) read_axes(*axes);
    if (!recorded_) read_sample(root.find("sample"));
    if (const ValueTree* seeds = root.find("seeds")) add_seeds(*seeds);
    if (const ValueTree* metrics = root.find("metrics")) {
      study_.metrics = texts(*metrics);
      study_.metrics_place = at(*metrics);
    }
    if (const ValueTree* resources = root.find("resources")) read_resources(table(*resources));
    if (study_.axes.empty())
      throw Error::invalid_input("a study needs an [[axis]] or seeds (" + file_ + ")").with_key("axis", "");
    check_number_of_runs();
    study_.runs = runs_on_axes(study_.axes);
    return std::move(study_);
  }

 private:
  std::string at(const ValueTree& node) const { return place(file_, node); }

  Error refusal(const ValueTree& node, const std::string& what) const {
    return Error::invalid_input(what).with_origin(at(node));
  }

  void throw_if_unknown(const ValueTree& of, const std::vector<std::string>& known,
                        const std::string& prefix) const {
    for (const ValueTree& child : of.children) {
      if (std::count(known.begin(), known.end(), child.key)) continue;
      const std::string nearest = nearest_name(child.key, known);
      throw refusal(child, "unknown key " + prefix + child.key + "; " +
                               (nearest.empty() ? "there are: " + join(known, ", ")
                                                : "did you mean " + prefix + nearest + "?"))
          .with_key(prefix + child.key, "");
    }
  }

  const ValueTree& table(const ValueTree& node) const {
    if (node.kind != ValueTree::Kind::table)
      throw refusal(node, node.key + " must be a table, [" + node.key + "]");
    return node;
  }

  std::string text(const ValueTree& of, const char* key, const std::string& name) const {
    const ValueTree* node = of.find(key);
    const auto* text = node ? std::get_if<std::string>(&node->value) : nullptr;
    if (!text || text->empty()) throw refusal(node ? *node : of, name + " must be a text");
    return *text;
  }

  // Returns one value as flags take it; it finds files that lie beside the study, and names shipped ones
  // assets/...
  std::string one_value(const ValueTree& node, const std::string& name) const {
    if (node.kind != ValueTree::Kind::value) throw refusal(node, name + " must be one value");
    const std::string text = flag_text(node.value);
    const fs::path beside = fs::path(file_).parent_path() / text;
    std::error_code ignored;
    const bool names_a_file = fs::path(text).has_extension() && !fs::exists(text, ignored);
    return names_a_file && fs::is_regular_file(beside, ignored) ? asset_name(beside) : text;
  }

  std::vector<std::string> texts(const ValueTree& node) const {
    std::vector<std::string> values;
    if (const auto* numbers = std::get_if<std::vector<double>>(&node.value);
        node.kind == ValueTree::Kind::value && numbers) {
      for (double x : *numbers) values.push_back(flag_text(x));
    } else if (node.kind == ValueTree::Kind::array) {
      for (const ValueTree& child : node.children) values.push_back(one_value(child, node.key));
    }
    if (values.empty()) throw refusal(node, node.key + " must be a list of numbers or texts");
    return values;
  }

  int integer(const ValueTree& node, const std::string& name, double low, double high) const {
    const KeyDescription key{name, "integer", "", between(low, high), {}, "", ""};
    int number = 0;
    assign({key, &number}, node.kind == ValueTree::Kind::value ? node.value : Value(std::string("a table")),
           at(node));
    return number;
  }

  void choose_experiment(const ValueTree& root) {
    study_.experiment = text(root, "experiment", "experiment");
    std::vector<std::string> known;
    for (const Experiment& e : experiments())
      if (can_be_repeated(e)) known.push_back(e.name);
    if (!std::count(known.begin(), known.end(), study_.experiment))
      throw not_a_choice("experiment", study_.experiment, known, at(*root.find("experiment")));
    for (const KeyDescription& key :
         experiment_options(experiment_named(study_.experiment), Defaults::left_out))
      keys_.push_back({key, Field{}});
  }

  // Returns a key of the experiment by its name in the study; "param.stack" belongs to key "param".
  const KeyDescription& known_key(const std::string& key, const ValueTree& node) const {
    if (is_of_sweep(key))
      throw refusal(node, key + " is given to sweep (--" + key + "), not to its runs").with_key(key, "");
    for (const FixedKey& fixed_keys : experiment_named(study_.experiment).fixed_keys())
      if (fixed_keys.path == key)
        throw refusal(node, key + " cannot be set: " + fixed_key_message(study_.experiment, fixed_keys))
            .with_key(key, "");
    return find_key(keys_, key_of_flag(flag_of(study_.experiment, key, "").path), at(node)).description;
  }

  void check_value(const std::string& key, const KeyDescription& description, const std::string& value,
                   const ValueTree& node) const {
    Scratch scratch;
    const Flag flag = flag_of(study_.experiment, key, value);
    assign({description, scratch.field(description.type)}, flag.value, at(node));
    if (description.path == "fabric.name") find_asset("fabrics", value, key + ", " + at(node));
    if (key == "scene") find_asset("scenes", value, key + ", " + at(node));
    const std::vector<std::string> laws = law_names();
    if (key == "law" && !std::count(laws.begin(), laws.end(), value))
      throw not_a_choice(key, value, laws, at(node));
  }

  void read_scene(const std::string& prefix, const ValueTree& of) {
    for (const ValueTree& child : of.children) {
      const std::string key = flag_of_key(prefix + child.key);
      if (child.kind == ValueTree::Kind::table) {
        read_scene(key + ".", child);
        continue;
      }
      const KeyDescription& description = known_key(key, child);
      const std::string value = one_value(child, key);
      check_value(key, description, value, child);
      study_.shared.push_back(flag_of(study_.experiment, key, value));
      set_.insert(key);
    }
  }

  void read_axes(const ValueTree& axes) {
    for (const ValueTree& node : tables(axes, file_)) {
      table(node);
      if (!recorded_) throw_if_unknown(node, {"key", "values", "linear", "log"}, "axis.");
      read_axis(flag_of_key(text(node, "key", "axis.key")), node);
      if (!recorded_) continue;
      study_.axes.back().logarithmic = node.find("scale");
      study_.axes.back().sampled = node.find("sampled");
    }
  }

  void read_axis(const std::string& key, const ValueTree& node) {
    const KeyDescription& description = known_key(key, *node.find("key"));
    if (!set_.insert(key).second)
      throw refusal(node, key + " is set twice: an axis varies what nothing else sets").with_key(key, "");
    const ValueTree* recorded = recorded_ ? node.find("values") : nullptr;
    if (recorded_ ? !recorded : node.children.size() != 2)
      throw refusal(node, "the axis " + key + " must have one of values, linear, log").with_key(key, "");
    const ValueTree& given = recorded ? *recorded : node.children[node.children[0].key == "key" ? 1 : 0];
    StudyAxis axis{key, description.unit, {}, false, given.key == "log", false};
    if (given.key == "values")
      axis.values = texts(given);
    else
      read_range(axis, given);
    for (const std::string& value : axis.values) check_value(key, description, value, given);
    for (std::size_t i = 1; i < axis.values.size(); ++i)
      if (std::count(axis.values.begin(), axis.values.begin() + static_cast<std::ptrdiff_t>(i),
                     axis.values[i]))
        throw refusal(given, key + " = " + axis.values[i] + " stands twice among the values")
            .with_key(key, "");
    axis.numeric = std::all_of(axis.values.begin(), axis.values.end(),
                               [](const std::string& value) { return number_in(value).has_value(); });
    if (!axis.numeric) axis.unit.clear();
    study_.axes.push_back(std::move(axis));
  }

  // Reads [from, to, n], or [from, to] for a sampled axis, whose ends are then checked as its values.
  void read_range(StudyAxis& axis, const ValueTree& given) {
    const std::string name = axis.key + ": " + given.key;
    const auto* range = std::get_if<std::vector<double>>(&given.value);
    if (given.kind != ValueTree::Kind::value || !range || range->size() < 2 || range->size() > 3)
      throw refusal(given, name + " must be [from, to, n], or [from, to] of an axis that [sample] draws");
    const double from = (*range)[0], to = (*range)[1];
    if (!std::isfinite(from) || !std::isfinite(to) || from == to)
      throw refusal(given, name + " must lead from one finite number to another");
    if (axis.logarithmic && (from <= 0 || to <= 0))
      throw refusal(given, fmt::format("{} = [{:g}, {:g}] must have ends > 0", name, from, to));
    axis.sampled = range->size() == 2;
    if (axis.sampled) {
      axis.values = {flag_text(from), flag_text(to)};
      return;
    }
    const double n = (*range)[2];
    if (!(n >= 2 && n <= kMaxValues) || n != std::floor(n))
      throw refusal(given,
                    fmt::format("{}: n = {:g} must be an integer in [2, {:.0f}]", name, n, kMaxValues));
    for (int i = 0; i < n; ++i) axis.values.push_back(between_ends(axis, from, to, i / (n - 1)));
  }

  // Returns the number at the fraction `part` of the range, rounded as it is shown; the ends are exact.
  std::string between_ends(const StudyAxis& axis, double from, double to, double part) const {
    if (part == 0) return flag_text(from);
    if (part == 1) return flag_text(to);
    const double x = axis.logarithmic ? from * std::pow(to / from, part) : from + (to - from) * part;
    return flag_text(*number_in(number_text(x, kDigits)));
  }

  // Returns an integer; each one has an equal part of the range, the last one too.
  std::string integer_between(const StudyAxis& axis, double low, double high, double part) const {
    return flag_text(std::min(high, std::floor(*number_in(between_ends(axis, low, high + 1, part)))));
  }

  void read_sample(const ValueTree* node) {
    const auto is_sampled = [](const StudyAxis& axis) { return axis.sampled; };
    const auto sampled = std::count_if(study_.axes.begin(), study_.axes.end(), is_sampled);
    if (!node && sampled == 0) return;
    if (!node)
      throw Error::invalid_input(std::find_if(study_.axes.begin(), study_.axes.end(), is_sampled)->key +
                                 " has a range without n, which needs [sample] with method and n (" + file_ +
                                 ")");
    table(*node);
    throw_if_unknown(*node, {"method", "n", "seed"}, "sample.");
    if (const std::string method = text(*node, "method", "sample.method"); method != "latin")
      throw refusal(*node->find("method"), "sample.method = " + method + " must be latin")
          .with_key("method", method);
    if (!node->find("n")) throw refusal(*node, "sample.n must be given: how often is drawn");
    if (sampled == 0)
      throw refusal(*node, "[sample] needs an axis with a range without n: linear = [from, to]");
    const int n = integer(*node->find("n"), "sample.n", 1, kMaxValues);
    const ValueTree* seed = node->find("seed");
    draw(static_cast<std::size_t>(sampled), static_cast<std::size_t>(n),
         seed ? integer(*seed, "sample.seed", 0, std::numeric_limits<int>::max()) : 1);
  }

  void draw(std::size_t sampled, std::size_t n, int seed) {
    const auto drawn = latin_hypercube(sampled, n, static_cast<std::uint64_t>(seed));
    std::size_t next = 0;
    for (StudyAxis& axis : study_.axes) {
      if (!axis.sampled) continue;
      const auto [low, high] = std::minmax({*number_in(axis.values[0]), *number_in(axis.values[1])});
      const bool whole = known_key(axis.key, {}).type == "integer";
      axis.values.clear();
      for (const double part : drawn[next])
        axis.values.push_back(whole ? integer_between(axis, low, high, part)
                                    : between_ends(axis, low, high, part));
      ++next;
    }
  }

  void add_seeds(const ValueTree& node) {
    const int n = integer(node, "seeds", 1, kMaxValues);
    known_key(kSeedKey, node);
    if (set_.contains(kSeedKey))
      throw refusal(node, "seeds repeats runs with seed = 1, 2, ...: seed is set already");
    StudyAxis axis{kSeedKey, "", {}, true, false, false};
    for (int i = 1; i <= n; ++i) axis.values.push_back(std::to_string(i));
    study_.axes.push_back(std::move(axis));
  }

  void read_resources(const ValueTree& node) {
    throw_if_unknown(node, {"runs", "cores", "memory", "gpus", "minutes"}, "resources.");
    JobResources& r = study_.resources;
    const auto read = [&](const char* key, int& number, double low, double high) {
      if (const ValueTree* given = node.find(key))
        number = integer(*given, std::string("resources.") + key, low, high);
    };
    read("runs", study_.runs_a_job, 1, kMaxValues);
    read("cores", r.cores, 1, 1024);
    read("memory", r.memory, 1, 1e8);
    read("gpus", r.gpus, 0, 64);
    read("minutes", r.minutes, 1, 1e6);
  }

  void check_number_of_runs() const {
    double runs = 1;
    bool sample = false;
    for (const StudyAxis& axis : study_.axes) {
      if (!axis.sampled || !sample) runs *= static_cast<double>(axis.values.size());
      sample = sample || axis.sampled;
    }
    if (runs > kMaxRuns)
      throw Error::invalid_input(fmt::format("{:g} runs must be <= {:.0f} ({})", runs, kMaxRuns, file_));
  }

  std::string file_;
  bool recorded_;
  Study study_;
  Keys keys_;                  // without their fields
  std::set<std::string> set_;  // keys set by [scene] or an axis
};

}  // namespace

Study read_study(const std::string& name_or_file) {
  if (name_or_file.ends_with(".json")) {
    const Manifest manifest = read_manifest(name_or_file);
    const ValueTree recorded = recorded_study(manifest, name_or_file);
    return StudyFile(name_or_file, manifest.keys->value("study", ""), true).read(recorded);
  }
  const std::string file = find_asset("studies", name_or_file, "sweep").string();
  return StudyFile(file, asset_name(file), false).read(read_toml(file, Lists::allowed));
}

}  // namespace hysteron::experiments
