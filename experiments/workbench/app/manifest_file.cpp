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

// Returns an object with these entries, or null without any.
template <class T>
Json to_json(const std::vector<std::pair<std::string, T>>& entries) {
  Json object;
  for (const auto& [name, value] : entries) object[name] = value;
  return object;
}

// Returns a list for one law, else lists by law.
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

Json to_json(const std::vector<InputRecord>& inputs) {
  Json object = Json::object();
  for (const InputRecord& input : inputs) object[input.file] = input.hash;
  return object;
}

Json to_json(const Curve& curve) {
  Json json = {{"plot", curve.plot},
               {"file", curve.file},
               {"x", curve.x},
               {"y", curve.y},
               {"logarithmic", curve.logarithmic},
               {"caption", curve.caption}};
  if (curve.logarithmic_x) json["logarithmic_x"] = true;
  if (!curve.knee.empty()) json["knee"] = curve.knee;
  return json;
}

Json to_json(const std::vector<Curve>& curves) {
  Json list;
  for (const Curve& curve : curves) list.push_back(to_json(curve));
  return list;
}

Json to_json(const std::vector<std::string>& texts) { return texts; }
Json to_json(const std::string& text) { return text; }
Json to_json(bool truth) { return truth; }
Json to_json(const std::shared_ptr<const Json>& keys) { return *keys; }
Json to_json(const RunSpec& spec) { return {{"names", spec.positionals}, {"flags", spec.flags}}; }

template <class T>
Json to_json(const std::optional<T>& known) {
  if constexpr (std::is_arithmetic_v<T>)
    return known ? Json(*known) : Json();
  else
    return known ? to_json(*known) : Json();
}

template <class T>
bool is_there(const T& value) {
  if constexpr (requires { value.empty(); })
    return !value.empty();
  else
    return static_cast<bool>(value);
}

enum class Where { always, if_there };  // whether a field is always in the file

// Visits the fields of a manifest, and those under its "hysteron", in the order in which they are written.
template <class M, class Visit>
void visit_program(M& m, const Visit& visit) {
  visit("version", m.version, Where::always);
  visit("commit", m.commit, Where::always);
  visit("dirty", m.dirty, Where::always);
  visit("instructions", m.isa, Where::if_there);
  visit("compiler", m.compiler, Where::if_there);
  visit("build", m.build, Where::if_there);
}

template <class M, class Visit, class VisitOwn>
void visit_fields(M& m, const Visit& visit, const VisitOwn& visit_own) {
  visit("experiment", m.experiment, Where::always);
  visit("command", m.command, Where::always);
  visit("spec", m.spec, Where::if_there);
  visit("started", m.started, Where::always);
  visit("scene", m.keys, Where::always);
  visit("options", m.options, Where::if_there);
  visit("asked", m.requested, Where::if_there);
  visit("meshes", m.meshes, Where::if_there);
  visit("inputs", m.inputs, Where::if_there);
  visit("device", m.device, Where::always);
  visit("renderer", m.renderer, Where::always);
  visit("positions", m.positions, Where::always);
  visit("precision", m.precision, Where::always);
  visit("element", m.element, Where::always);
  visit("law", m.law, Where::always);
  visit("triangles", m.triangles, Where::always);
  visit("hinges", m.hinges, Where::always);
  visit("steps", m.steps, Where::always);
  visit("seconds_simulated", m.seconds_simulated, Where::always);
  visit("wall_seconds", m.wall_seconds, Where::always);
  visit("bytes_device", m.bytes_device, Where::always);
  visit("energy", m.energy, Where::always);
  visit("state_hash", m.state_hash, Where::always);
  visit("batch", m.batch, Where::if_there);
  visit("substeps", m.substeps, Where::if_there);
  visit("linear_solver", m.linear_solver, Where::if_there);
  visit_own(m.own);
  visit("statements", m.statements, Where::if_there);
  visit("series", m.series, Where::if_there);
  visit("frames", m.frames, Where::if_there);
  visit("curves", m.curves, Where::if_there);
  visit("film_missing", m.film_missing, Where::if_there);
  visit("warnings", m.warnings, Where::if_there);
  visit("plots_missing", m.plots_missing, Where::if_there);
  visit("errors_missing", m.errors_missing, Where::if_there);
  visit("asked_metrics", m.requested_metrics, Where::if_there);
  visit("metrics", m.metrics, Where::always);
  visit("files", m.files, Where::always);
  visit("tables", m.tables, Where::if_there);
  visit("complete", m.complete, Where::always);
}

// Returns the value, or null if there is none.
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
std::optional<T> known_in(const Json& value) {
  const bool fits = std::is_same_v<T, std::string> ? value.is_string()
                    : std::is_integral_v<T>        ? value.is_number_integer()
                                                   : value.is_number();
  return fits ? std::optional<T>(value.get<T>()) : std::nullopt;
}
template <class T>
std::optional<T> known_at(const Json& json, const char* key) {
  return known_in<T>(at(json, key));
}

// Returns the value as text, a list as JSON.
std::string shown(const Json& value) { return value.is_string() ? value.get<std::string>() : value.dump(); }
std::string shown_at(const Json& json, const char* key) {
  const Json& value = at(json, key);
  return value.is_null() ? "–" : shown(value);
}

// Returns the value at "fabric.b2" in `keys`; null if there is none.
const Json& at_path(const std::shared_ptr<const Json>& keys, const std::string& path) {
  static const Json kNothing;
  return keys ? json_at(*keys, path) : kNothing;
}

std::vector<std::string> texts_in(const Json& list) {
  std::vector<std::string> texts;
  for (const Json& text : list)
    if (text.is_string()) texts.push_back(text.get<std::string>());
  return texts;
}
std::vector<std::string> texts_at(const Json& json, const char* key) { return texts_in(at(json, key)); }

// Converts a JSON value; a list or an object becomes its text.
MetricValue metric_value(const Json& json) {
  if (json.is_boolean()) return json.get<bool>();
  if (json.is_number_integer()) return json.get<std::int64_t>();
  if (json.is_number()) return json.get<double>();
  if (json.is_string()) return json.get<std::string>();
  return json.is_null() ? MetricValue() : MetricValue(json.dump());
}

std::array<double, 4> cloth_box(const Json& instant) {
  const Json& box = at(instant, "cloth");
  std::array<double, 4> cloth{};
  if (box.is_array() && box.size() == cloth.size())
    for (std::size_t k = 0; k < cloth.size(); ++k)
      if (box[k].is_number()) cloth[k] = box[k].get<double>();
  return cloth;
}

// Each take() sets the member if the value is of its type; otherwise it leaves the member unchanged.
void take(const Json& json, bool& truth) { truth = json == Json(true); }
void take(const Json& json, std::string& text) {
  if (!json.is_null()) text = shown(json);
}
void take(const Json& json, std::vector<std::string>& texts) { texts = texts_in(json); }
void take(const Json& json, std::shared_ptr<const Json>& keys) {
  if (json.is_object()) keys = std::make_shared<const Json>(json);
}
void take(const Json& json, std::vector<std::pair<std::string, double>>& numbers) {
  for (const auto& [name, number] : json.items())
    if (number.is_number()) numbers.emplace_back(name, number.get<double>());
}
void take(const Json& json, Metrics& metrics) {
  for (const auto& [name, value] : json.items()) metrics.set(name, metric_value(value));
}
template <class T>
void take(const Json& json, std::optional<T>& value) {
  value = known_in<T>(json);
}
void take(const Json& json, std::optional<std::vector<std::string>>& texts) {
  if (json.is_array()) texts = texts_in(json);
}

void take(const Json& json, std::optional<RunSpec>& spec) {
  if (!json.is_object()) return;
  spec = RunSpec{texts_at(json, "names")};
  for (const Json& flag : at(json, "flags"))
    if (flag.is_array() && flag.size() == 2 && flag[0].is_string() && flag[1].is_string())
      spec->flags.emplace_back(flag[0], flag[1]);
}

void take(const Json& json, std::vector<MeshRecord>& meshes) {
  if (!json.is_object()) return;
  for (const auto& [key, mesh] : json.items())
    meshes.push_back({key, text_at(mesh, "file"), text_at(mesh, "hash")});
}

void take(const Json& json, std::vector<InputRecord>& inputs) {
  if (!json.is_object()) return;
  for (const auto& [file, hash] : json.items())
    if (hash.is_string()) inputs.push_back({file, hash.get<std::string>()});
}

void take(const Json& json, std::vector<Statements>& statements) {
  if (json.is_array()) statements = {{"", texts_in(json)}};
  if (json.is_object())
    for (const auto& [law, sentences] : json.items()) statements.push_back({law, texts_in(sentences)});
}

void take(const Json& json, std::optional<Frames>& frames) {
  if (!json.is_object()) return;
  frames.emplace();
  for (const auto& [name, bar] : at(json, "looks").items()) {
    frames->looks.push_back({name});
    if (bar.is_object())
      frames->looks.back().bar = {text_at(bar, "label"), text_at(bar, "unit"), number_at(bar, "low"),
                                  number_at(bar, "high")};
  }
  frames->metres_per_pixel = number_at(json, "m_per_pixel");
  for (const Json& instant : at(json, "moments"))
    frames->instants.push_back({number_at(instant, "s"), text_at(instant, "phase"),
                                known_at<double>(instant, "difference_rms_per_m"), cloth_box(instant),
                                known_at<double>(instant, "moved_m").value_or(0)});
}

void take(const Json& json, std::vector<Curve>& curves) {
  for (const Json& curve : json)
    curves.push_back({text_at(curve, "plot"), text_at(curve, "file"), text_at(curve, "x"),
                      text_at(curve, "y"), is_true_at(curve, "logarithmic"), text_at(curve, "caption"),
                      is_true_at(curve, "logarithmic_x"), text_at(curve, "knee")});
}

// Returns the first required key that a manifest's JSON lacks; "" if it has all.
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

// The required type of a value, if there is one that is not null.
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

// A list of objects that must have these keys.
struct Entries {
  const char* path;
  std::vector<std::string> keys;
};

const Entries kEntries[] = {{"frames.moments", {"s"}},
                            {"scene.fabric.provenance", {"confidence", "source"}},
                            {"scene.fabric.published", {"value", "unit", "confidence", "source"}}};

// Throws unless the manifest's keys have the right types.
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
  const auto writes_to = [](Json& json) {
    return [&json](const char* key, const auto& value, Where where) {
      if (where == Where::always || is_there(value)) json[key] = to_json(value);
    };
  };
  Json json;
  visit_program(m, writes_to(json["hysteron"]));
  visit_fields(m, writes_to(json), [&](const auto& own) {
    for (const auto& [key, value] : own) json[key] = *value;
  });
  return json;
}

Manifest parsed_manifest(const Json& json) {
  Manifest m;
  m.version = m.commit = "–";
  m.experiment = "run";  // for manifests of the first programs
  m.keys = std::make_shared<const Json>();
  const auto reads_from = [](const Json& object) {
    return [&object](const char* key, auto& value, Where) { take(at(object, key), value); };
  };
  visit_program(m, reads_from(at(json, "hysteron")));
  visit_fields(m, reads_from(json), [](const auto&) {});
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
  for (const auto& [name, number] : at_path(keys, "fabric.published").items()) {
    const std::string tester = number.contains("tester") ? ", tester " + shown_at(number, "tester") : "";
    numbers.push_back({name, metric_value(at(number, "value")), shown_at(number, "unit"),
                       shown_at(number, "confidence"), shown_at(number, "source") + tester});
  }
  return numbers;
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
