#include "experiments/workbench/app/manifest_file.h"

#include <nlohmann/json.hpp>

#include "experiments/workbench/app/json_file.h"
#include "sim/base/comma_list.h"
#include "sim/base/error.h"

namespace hysteron::experiments {
namespace {

Json to_json(const MetricValue& value) {
  return std::visit(
      [](const auto& known) -> Json {
        if constexpr (std::is_same_v<std::decay_t<decltype(known)>, std::monostate>)
          return nullptr;
        else
          return known;
      },
      value.variant());
}

template <class T>
Json to_json(const std::optional<T>& known) {
  return known ? Json(*known) : Json();
}

// An object with these entries, null without any.
template <class T>
Json to_json(const std::vector<std::pair<std::string, T>>& entries) {
  Json object;
  for (const auto& [name, value] : entries) object[name] = value;
  return object;
}

// A list of one law's, else lists by law.
Json to_json(const std::vector<Statements>& all) {
  if (all.size() == 1) return all[0].sentences;
  Json object;
  for (const auto& [law, sentences] : all) object[law] = sentences;
  return object;
}

Json to_json(const Frames& frames) {
  Json looks = Json::object(), instants = Json::array();
  for (const auto& [name, bar] : frames.looks) {
    looks[name] = nullptr;
    if (bar)
      looks[name] = {{"label", bar->label}, {"unit", bar->unit}, {"low", bar->low}, {"high", bar->high}};
  }
  for (const Frames::Instant& instant : frames.instants) {
    instants.push_back({{"s", instant.time}, {"phase", instant.phase}});
    if (instant.difference_rms) instants.back()["difference_rms_per_m"] = *instant.difference_rms;
    if (instant.cloth != Frames::Instant{}.cloth) instants.back()["cloth"] = instant.cloth;
    if (instant.moved > 0) instants.back()["moved_m"] = instant.moved;
  }
  return {{"looks", looks}, {"m_per_pixel", frames.metres_per_pixel}, {"moments", instants}};
}

Json to_json(const std::vector<MeshRecord>& meshes) {
  Json object = Json::object();
  for (const MeshRecord& mesh : meshes) object[mesh.key] = {{"file", mesh.file}, {"hash", mesh.hash}};
  return object;
}

Json to_json(const Curve& curve) {
  return {{"plot", curve.plot},
          {"file", curve.file},
          {"x", curve.x},
          {"y", curve.y},
          {"logarithmic", curve.logarithmic},
          {"caption", curve.caption}};
}

// What every manifest has behind its scene, in this order.
template <class M, class Visit>
void visit_results(M& m, const Visit& visit) {
  visit("device", m.device);
  visit("renderer", m.renderer);
  visit("positions", m.positions);
  visit("precision", m.precision);
  visit("element", m.element);
  visit("law", m.law);
  visit("triangles", m.triangles);
  visit("hinges", m.hinges);
  visit("steps", m.steps);
  visit("seconds_simulated", m.seconds_simulated);
  visit("wall_seconds", m.wall_seconds);
  visit("bytes_device", m.bytes_device);
  visit("energy", m.energy);
  visit("state_hash", m.state_hash);
}

// Entries that only some runs have.
void add_what_some_have(const Manifest& m, Json& json) {
  if (m.batch) json["batch"] = *m.batch;
  if (m.substeps) json["substeps"] = *m.substeps;
  if (m.linear_solver) json["linear_solver"] = *m.linear_solver;
  for (const auto& [key, value] : m.own) json[key] = *value;
  if (!m.statements.empty()) json["statements"] = to_json(m.statements);
  if (m.series) json["series"] = *m.series;
  if (m.frames) json["frames"] = to_json(*m.frames);
  for (const Curve& curve : m.curves) json["curves"].push_back(to_json(curve));
  if (!m.film_missing.empty()) json["film_missing"] = m.film_missing;
  if (!m.warnings.empty()) json["warnings"] = m.warnings;
  if (!m.plots_missing.empty()) json["plots_missing"] = m.plots_missing;
  if (!m.errors_missing.empty()) json["errors_missing"] = m.errors_missing;
  if (!m.requested_metrics.empty()) json["asked_metrics"] = m.requested_metrics;
}

// Null if there is nothing.
const Json& at(const Json& json, const char* key) {
  static const Json kNothing;
  if (!json.is_object()) return kNothing;
  const auto found = json.find(key);
  return found == json.end() ? kNothing : *found;
}

std::string text_at(const Json& json, const char* key) {
  const Json& value = at(json, key);
  return value.is_string() ? value.get<std::string>() : "";
}

double number_at(const Json& json, const char* key) {
  const Json& value = at(json, key);
  return value.is_number() ? value.get<double>() : 0;
}

bool is_true_at(const Json& json, const char* key) { return at(json, key) == Json(true); }

template <class T>
std::optional<T> known_at(const Json& json, const char* key) {
  const Json& value = at(json, key);
  const bool fits = std::is_same_v<T, std::string> ? value.is_string()
                    : std::is_integral_v<T>        ? value.is_number_integer()
                                                   : value.is_number();
  return fits ? std::optional<T>(value.get<T>()) : std::nullopt;
}

// As it is shown, a list as JSON.
std::string shown(const Json& value) { return value.is_string() ? value.get<std::string>() : value.dump(); }
std::string shown_at(const Json& json, const char* key) {
  const Json& value = at(json, key);
  return value.is_null() ? "–" : shown(value);
}

// "fabric.b2" in `keys`; null if there is nothing.
const Json& at_path(const std::shared_ptr<const Json>& keys, const std::string& path) {
  static const Json kNothing;
  return keys ? json_at(*keys, path) : kNothing;
}

std::vector<std::string> texts_at(const Json& json, const char* key) {
  std::vector<std::string> texts;
  for (const Json& text : at(json, key))
    if (text.is_string()) texts.push_back(text.get<std::string>());
  return texts;
}

std::vector<std::pair<std::string, double>> numbers_at(const Json& json, const char* key) {
  std::vector<std::pair<std::string, double>> numbers;
  for (const auto& [name, number] : at(json, key).items())
    if (number.is_number()) numbers.emplace_back(name, number.get<double>());
  return numbers;
}

template <class T>
void take(const Json& json, const char* key, std::optional<T>& value) {
  value = known_at<T>(json, key);
}
void take(const Json& json, const char* key, std::vector<std::pair<std::string, double>>& numbers) {
  numbers = numbers_at(json, key);
}

Metrics parsed_metrics(const Json& json) {
  Metrics metrics;
  for (const auto& [name, value] : json.items()) metrics.set(name, metric_value(value));
  return metrics;
}

std::optional<RunSpec> recorded_spec(const Json& json) {
  if (!json.is_object()) return {};
  RunSpec spec{texts_at(json, "names")};
  for (const Json& flag : at(json, "flags"))
    if (flag.is_array() && flag.size() == 2 && flag[0].is_string() && flag[1].is_string())
      spec.flags.emplace_back(flag[0], flag[1]);
  return spec;
}

std::array<double, 4> cloth_box(const Json& instant) {
  const Json& box = at(instant, "cloth");
  std::array<double, 4> cloth{};
  if (box.is_array() && box.size() == cloth.size())
    for (std::size_t k = 0; k < cloth.size(); ++k)
      if (box[k].is_number()) cloth[k] = box[k].get<double>();
  return cloth;
}

std::optional<Frames> recorded_frames(const Json& json) {
  if (!json.is_object()) return {};
  Frames frames;
  for (const auto& [name, bar] : at(json, "looks").items()) {
    frames.looks.push_back({name});
    if (bar.is_object())
      frames.looks.back().bar = {text_at(bar, "label"), text_at(bar, "unit"), number_at(bar, "low"),
                                 number_at(bar, "high")};
  }
  frames.metres_per_pixel = number_at(json, "m_per_pixel");
  for (const Json& instant : at(json, "moments"))
    frames.instants.push_back({number_at(instant, "s"), text_at(instant, "phase"),
                               known_at<double>(instant, "difference_rms_per_m"), cloth_box(instant),
                               known_at<double>(instant, "moved_m").value_or(0)});
  return frames;
}

// Entries that only some runs have.
void take_what_some_have(const Json& json, Manifest& m) {
  m.batch = known_at<int>(json, "batch");
  m.substeps = known_at<int>(json, "substeps");
  m.linear_solver = known_at<std::string>(json, "linear_solver");
  if (at(json, "series").is_array()) m.series = texts_at(json, "series");
  const Json& statements = at(json, "statements");
  if (statements.is_array()) m.statements = {{"", texts_at(json, "statements")}};
  if (statements.is_object())
    for (const auto& [law, sentences] : statements.items())
      m.statements.push_back({law, texts_at(statements, law.c_str())});
  m.frames = recorded_frames(at(json, "frames"));
  for (const Json& curve : at(json, "curves"))
    m.curves.push_back({text_at(curve, "plot"), text_at(curve, "file"), text_at(curve, "x"),
                        text_at(curve, "y"), is_true_at(curve, "logarithmic"), text_at(curve, "caption")});
  m.film_missing = text_at(json, "film_missing");
  m.warnings = texts_at(json, "warnings");
  m.plots_missing = texts_at(json, "plots_missing");
  m.errors_missing = texts_at(json, "errors_missing");
  m.requested_metrics = texts_at(json, "asked_metrics");
}

// The first key without which a JSON is no manifest; "" if it has all.
std::string missing_in(const Json& json) {
  const Json& program = at(json, "hysteron");
  if (!program.is_object()) return "object hysteron";
  for (const char* key : {"version", "commit"})
    if (!program.contains(key)) return std::string("hysteron.") + key;
  return at(json, "scene").is_object() ? "" : "object scene";
}

std::string json_kind(const Json& value) {
  if (value.is_null()) return "null";
  if (value.is_boolean()) return "true or false";
  if (value.is_number()) return "a number";
  if (value.is_string()) return "a text";
  return value.is_array() ? "a list" : "an object";
}

// What stands at a place, if anything does; null is nothing.
struct Rule {
  const char* path;
  const char* kind;
};

const Rule kRules[] = {{"experiment", "a text"},
                       {"command", "a text"},
                       {"started", "a text"},
                       {"complete", "true or false"},
                       {"hysteron.dirty", "true or false"},
                       {"metrics", "an object"},
                       {"wall_seconds", "an object"},
                       {"wall_seconds.total", "a number"},
                       {"seconds_simulated", "a number"},
                       {"frames", "an object"},
                       {"frames.moments", "a list"},
                       {"scene.fabric", "an object"},
                       {"scene.fabric.name", "a text"},
                       {"scene.fabric.provenance", "an object"},
                       {"scene.fabric.published", "an object"}};

// Lists of names may also be one text, "linear,prandtl".
const char* const kNames[] = {"scene.law", "scene.laws", "scene.element", "scene.elements"};

// Entries of which each is an object with these keys.
struct Entries {
  const char* path;
  std::vector<std::string> keys;
};

const Entries kEntries[] = {{"frames.moments", {"s"}},
                            {"scene.fabric.provenance", {"confidence", "source"}},
                            {"scene.fabric.published", {"value", "unit", "confidence", "source"}}};

// Whether its keys are of the types that they have.
void check_manifest(const Json& manifest, const std::filesystem::path& file) {
  const auto refuse = [&](const std::string& path, const std::string& problem) {
    throw Error::invalid_input(file.string() + " is no manifest of hysteron: " + path + " " + problem);
  };
  for (const auto& [path, kind] : kRules)
    if (const Json& value = json_at(manifest, path); !value.is_null() && json_kind(value) != kind)
      refuse(path, "is " + json_kind(value) + ", must be " + kind);
  for (const char* path : kNames)
    if (const Json& names = json_at(manifest, path); names.is_array())
      for (const Json& name : names)
        if (!name.is_string()) refuse(path, "holds " + json_kind(name) + " where a name must be");
  for (const auto& [path, keys] : kEntries)
    for (const Json& entry : json_at(manifest, path))
      for (const std::string& key : keys)
        if (!entry.is_object() || !entry.contains(key)) refuse(path, "has an entry without " + key);
  for (const Json& instant : json_at(manifest, "frames.moments"))
    if (!instant["s"].is_number()) refuse("frames.moments", "has a time s that is no number");
}

}  // namespace

Json to_json(const Metrics& metrics) {
  Json object = Json::object();
  for (const auto& [name, value] : metrics) object[name] = to_json(value);
  return object;
}

Json to_json(const Manifest& m) {
  Json json;
  json["hysteron"] = {{"version", m.version}, {"commit", m.commit}, {"dirty", m.dirty}};
  if (!m.isa.empty()) json["hysteron"]["instructions"] = m.isa;
  if (!m.compiler.empty()) json["hysteron"]["compiler"] = m.compiler;
  json["experiment"] = m.experiment;
  json["command"] = m.command;
  if (m.spec) json["spec"] = {{"names", m.spec->positionals}, {"flags", m.spec->flags}};
  json["started"] = m.started;
  json["scene"] = *m.keys;
  if (m.options) json["options"] = *m.options;
  if (m.requested) json["asked"] = *m.requested;
  if (!m.meshes.empty()) json["meshes"] = to_json(m.meshes);
  visit_results(m, [&](const char* key, const auto& value) { json[key] = to_json(value); });
  add_what_some_have(m, json);
  json["metrics"] = to_json(m.metrics);
  json["files"] = m.files;
  json["complete"] = m.complete;
  return json;
}

Manifest parsed_manifest(const Json& json) {
  Manifest m;
  const Json& program = at(json, "hysteron");
  m.version = shown_at(program, "version");
  m.commit = shown_at(program, "commit");
  m.isa = text_at(program, "instructions");
  m.compiler = text_at(program, "compiler");
  m.dirty = is_true_at(program, "dirty");
  m.experiment = json.contains("experiment") ? text_at(json, "experiment") : "run";
  m.command = text_at(json, "command");
  m.spec = recorded_spec(at(json, "spec"));
  m.started = text_at(json, "started");
  m.keys = std::make_shared<const Json>(at(json, "scene"));
  if (at(json, "options").is_object()) m.options = std::make_shared<const Json>(json["options"]);
  if (at(json, "asked").is_object()) m.requested = std::make_shared<const Json>(json["asked"]);
  if (at(json, "meshes").is_object())
    for (const auto& [key, mesh] : json["meshes"].items())
      m.meshes.push_back({key, text_at(mesh, "file"), text_at(mesh, "hash")});
  visit_results(m, [&](const char* key, auto& value) { take(json, key, value); });
  take_what_some_have(json, m);
  m.metrics = parsed_metrics(at(json, "metrics"));
  m.files = texts_at(json, "files");
  m.complete = is_true_at(json, "complete");
  return m;
}

std::string Manifest::text(const std::string& path) const {
  const Json& value = at_path(keys, path);
  return value.is_null() ? "" : shown(value);
}

double Manifest::number(const std::string& path) const {
  const Json& value = at_path(keys, path);
  return value.is_number() ? value.get<double>() : 0;
}

std::vector<std::string> Manifest::names(const std::string& key) const {
  const Json& one = at_path(keys, key);
  const Json& value = one.is_null() ? at_path(keys, key + "s") : one;
  if (value.is_string()) return split(value.get<std::string>());
  std::vector<std::string> names;
  if (value.is_array())
    for (const Json& entry : value)
      names.push_back(entry.is_string() ? entry.get<std::string>() : text_at(entry, "name"));
  return names;
}

std::vector<std::string> Manifest::law_parameters() const {
  std::vector<std::string> parameters;
  for (const auto& [name, value] : at_path(keys, "param").items())
    parameters.push_back(name + "=" + shown(value));
  return parameters;
}

std::vector<SourcedNumber> Manifest::fabric_numbers() const {
  std::vector<SourcedNumber> numbers;
  const Json& fabric = at_path(keys, "fabric");
  for (const auto& [name, from] : at(fabric, "provenance").items())
    numbers.push_back({name, metric_value(at(fabric, name.c_str())), "", shown_at(from, "confidence"),
                       shown_at(from, "source")});
  return numbers;
}

std::vector<SourcedNumber> Manifest::published_numbers() const {
  std::vector<SourcedNumber> numbers;
  for (const auto& [name, number] : at_path(keys, "fabric.published").items())
    numbers.push_back({name, metric_value(at(number, "value")), shown_at(number, "unit"),
                       shown_at(number, "confidence"), shown_at(number, "source")});
  return numbers;
}

MetricValue metric_value(const Json& json) {
  if (json.is_boolean()) return json.get<bool>();
  if (json.is_number_integer()) return json.get<std::int64_t>();
  if (json.is_number()) return json.get<double>();
  if (json.is_string()) return json.get<std::string>();
  return json.is_null() ? MetricValue() : MetricValue(json.dump());
}

bool is_manifest(const Json& json) { return missing_in(json).empty(); }

bool has_manifest(const std::filesystem::path& folder) {
  std::error_code ignored;
  return std::filesystem::exists(std::filesystem::symlink_status(folder / "manifest.json", ignored));
}

Manifest checked_manifest(const Json& json, const std::filesystem::path& file) {
  check_manifest(json, file);
  return parsed_manifest(json);
}

Manifest read_manifest(const std::filesystem::path& file) {
  const Json json = read_json(file, "manifest of hysteron");
  if (const std::string missing = missing_in(json); !missing.empty())
    throw Error::invalid_input(file.string() + " is no manifest of hysteron: it has no " + missing);
  return checked_manifest(json, file);
}

std::optional<Manifest> manifest_or_none(const std::filesystem::path& file) {
  const Json json = json_or_none(file);
  if (!json.is_object() || !json.contains("hysteron")) return {};
  return parsed_manifest(json);
}

}  // namespace hysteron::experiments
