#include "sim/scene/scene_reader.h"

#include <algorithm>
#include <filesystem>
#include <optional>

#include "sim/base/error.h"
#include "sim/mesh/mesh_sequence.h"
#include "sim/scene/assets.h"
#include "sim/scene/cycles.h"
#include "sim/scene/key_table.h"
#include "sim/scene/toml_file.h"

namespace hysteron {

namespace {
namespace fs = std::filesystem;

// A value of the file with its full path: [cloth] length has the path "cloth.length".
struct FileKey {
  std::string path;
  const ValueTree* node;
};

// Flattens a tree into settings.  Names in `lists` have to be arrays of tables; a plain table of that name is
// not taken apart.
void flatten(const std::string& prefix, const ValueTree& table, const std::vector<std::string>& lists,
             std::vector<FileKey>& settings) {
  for (const ValueTree& child : table.children) {
    const std::string path = prefix.empty() ? child.key : prefix + "." + child.key;
    if (child.kind == ValueTree::Kind::table && !std::count(lists.begin(), lists.end(), path)) {
      flatten(path, child, lists, settings);
    } else {
      settings.push_back({key_of_flag(path), &child});
    }
  }
}

// Sets the keys of a scene, and `extra` ones.
class SceneKeys {
 public:
  SceneKeys(Scene& scene, std::string file, bool recorded, const Keys& extra,
            const std::vector<std::string>& left)
      : scene_(scene),
        file_(std::move(file)),
        recorded_(recorded),
        extra_(extra),
        left_out_(left),
        known_(bind_scene(scene)) {
    known_.insert(known_.end(), extra.begin(), extra.end());
  }

  void apply(const ValueTree& root) {
    std::vector<std::string> lists = {"pin", "obstacle", "command", "phase"};
    lists.insert(lists.end(), left_out_.begin(), left_out_.end());
    std::vector<FileKey> settings;
    flatten("", root, lists, settings);
    const auto come_first = [](const FileKey& s) { return s.path == "fabric.name" || s.path == "phase"; };
    std::stable_partition(settings.begin(), settings.end(), come_first);
    for (const FileKey& setting : settings) apply(setting);
    repeat_motions(scene_);
  }

  void apply(std::vector<Flag> flags) {
    std::stable_partition(flags.begin(), flags.end(),
                          [](const Flag& flag) { return key_of_flag(flag.path) == "fabric.name"; });
    for (const Flag& flag : flags) {
      const std::string origin = flag.name();
      const BoundKey& key = find_key(known_, key_of_flag(flag.path), origin);
      set(key, flag.value, origin);
      if (flag.path == "param") note_parameter(flag.text(), origin);
    }
    repeat_motions(scene_);
  }

 private:
  void apply(const FileKey& setting) {
    const ValueTree& node = *setting.node;
    const std::string origin = place(file_, node);
    if (setting.path == "pin") return read_tables(node, scene_.pin, bind_pin);
    if (setting.path == "phase") return read_phases(node);
    if (setting.path == "command") return read_tables(node, scene_.command, bind_command);
    if (setting.path == "obstacle") return read_tables(node, scene_.obstacle, bind_obstacle);
    if (setting.path.starts_with("param.")) return set_parameter(setting.path.substr(6), node, origin);
    if (std::count(left_out_.begin(), left_out_.end(), setting.path)) {
      tables(node, file_);  // which the experiment reads; here its form alone is checked
      return;
    }
    if (node.kind == ValueTree::Kind::array && is_table(setting.path))
      throw Error::invalid_input(setting.path + " must be one table, [" + setting.path + "] (" + origin +
                                 ")");
    const BoundKey& key = find_key(known_, setting.path, origin);
    if (node.kind == ValueTree::Kind::array && node.children.empty() && key.description.type == "numbers")
      return set(key, Numbers(), origin);
    if (node.kind == ValueTree::Kind::array) {
      throw Error::invalid_input(setting.path + " must be one value, not an array of tables (" + origin +
                                 ")");
    }
    set(key, node.value, origin);
  }

  void note_parameter(const std::string& name_and_value, const std::string& origin) {
    scene_.origin["param." + name_and_value.substr(0, name_and_value.find('='))] = origin;
  }

  void set(const BoundKey& key, const Value& value, const std::string& origin) {
    const std::string& path = key.description.path;
    if (recorded_ || is_extra(path)) return assign(key, value, origin);
    set_key(scene_, key, located(key.description, value), origin);
  }

  // Reads the phases; the scene lasts as long as they do, unless it says otherwise.
  void read_phases(const ValueTree& node) {
    read_tables(node, scene_.phase, bind_phase);
    scene_.seconds = phases_end(scene_);
  }

  // Resolves a time that names a phase.
  Value timed(const BoundKey& key, const Value& value, const std::string& origin) const {
    const auto* text = std::get_if<std::string>(&value);
    if (!text || key.description.unit != "s") return value;
    return phase_time(scene_.phase, *text, key.description.path + ", " + origin);
  }

  bool is_extra(const std::string& path) const {
    return std::any_of(extra_.begin(), extra_.end(),
                       [&](const BoundKey& k) { return k.description.path == path; });
  }

  // Resolves the path of a file that may be a shipped one, or stand beside the scene file.
  Value located(const KeyDescription& key, const Value& value) const {
    if (key.traits.file == NamesFile::no) return value;
    const auto* name = std::get_if<std::string>(&value);
    if (!name || name->empty()) return value;
    const auto is_there = [&](const fs::path& path) {
      std::error_code ignored;
      return key.traits.file == NamesFile::pattern ? !files_like(path.string()).empty()
                                                   : fs::is_regular_file(path, ignored);
    };
    for (const fs::path& path : {fs::path(*name), asset_place(*name), fs::path(file_).parent_path() / *name})
      if (is_there(path)) return path.string();
    return value;
  }

  void set_parameter(const std::string& name, const ValueTree& node, const std::string& origin) {
    std::string text;
    if (const auto* x = std::get_if<std::string>(&node.value)) text = *x;
    if (const auto* x = std::get_if<std::int64_t>(&node.value)) text = std::to_string(*x);
    if (const auto* x = std::get_if<double>(&node.value)) text = number_text(*x);
    if (text.empty())
      throw Error::invalid_input("param." + name + " must be a text or a number (" + origin + ")");
    scene_.param[name] = text;
    scene_.origin["param." + name] = origin;
  }

  // Is this the name of a table of keys, such as "cloth"?
  bool is_table(const std::string& path) const {
    return std::any_of(known_.begin(), known_.end(),
                       [&](const BoundKey& key) { return key.description.path.starts_with(path + "."); });
  }

  template <class Item>
  void read_tables(const ValueTree& node, std::vector<Item>& items, Keys (*bind_one)(Item&)) {
    const std::vector<ValueTree>& all = tables(node, file_);
    items.assign(all.size(), Item{});
    for (std::size_t i = 0; i < items.size(); ++i) {
      const std::string path = node.key + "[" + std::to_string(i) + "]";
      scene_.origin[path] = place(file_, all[i]);
      Motion* motion = nullptr;
      if constexpr (requires { items[i].motion; }) motion = &items[i].motion;
      read_table(all[i], path, bind_one(items[i]), motion);
    }
  }

  void read_table(const ValueTree& table, const std::string& path, Keys keys, Motion* motion) {
    for (BoundKey& key : keys) key.description.path = path + "." + key.description.path;
    for (const ValueTree& child : table.children) {
      const std::string origin = place(file_, child);
      if (motion && child.key == "keys" && child.kind == ValueTree::Kind::array) {
        read_keyframes(child, path, *motion);
        continue;
      }
      const BoundKey& key = find_key(keys, path + "." + child.key, origin);
      if (child.kind != ValueTree::Kind::value)
        throw Error::invalid_input(path + "." + child.key + " must be one value (" + origin + ")");
      const Value value = recorded_ ? child.value : located(key.description, child.value);
      assign(key, timed(key, value, origin), origin);
      scene_.origin[path + "." + child.key] = origin;
    }
  }

  void read_keyframes(const ValueTree& node, const std::string& path, Motion& motion) {
    for (std::size_t i = 0; i < node.children.size(); ++i) {
      Keyframe frame;
      Keys keys = bind_keyframe(frame);
      const std::string name = path + ".keys[" + std::to_string(i) + "]";
      for (BoundKey& key : keys) key.description.path = name + "." + key.description.path;
      for (const ValueTree& child : node.children[i].children) {
        const std::string origin = place(file_, child);
        const BoundKey& key = find_key(keys, name + "." + child.key, origin);
        assign(key, timed(key, child.value, origin), origin);
      }
      motion.keys.push_back(frame);
      scene_.origin[name] = place(file_, node.children[i]);
    }
  }

  Scene& scene_;
  std::string file_;
  bool recorded_;
  const Keys& extra_;
  const std::vector<std::string> left_out_;
  Keys known_;
};

}  // namespace

Scene default_scene(const std::string& fabric) {
  Scene scene;
  // The default is stable at any step; experiments on what damps a motion choose a method that damps less.
  scene.integrator = Integrator::implicit;
  scene.step = 1.0 / 60;
  set_key(scene, "fabric", fabric, "default");
  return scene;
}

void apply_scene_file(Scene& scene, const std::string& name_or_file, const Keys& extra,
                      const std::vector<std::string>& left) {
  const std::string file = find_asset("scenes", name_or_file, "--scene").string();
  apply_scene_tree(scene, read_toml(file), file, extra, left);
}

void apply_scene_tree(Scene& scene, const ValueTree& root, const std::string& source, const Keys& extra,
                      const std::vector<std::string>& left, bool recorded) {
  SceneKeys(scene, source, recorded, extra, left).apply(root);
}

void apply_flags(Scene& scene, const std::vector<Flag>& flags, const Keys& extra) {
  SceneKeys(scene, "", false, extra, {}).apply(flags);
}

double phase_start(const std::vector<Phase>& phases, const std::string& name) {
  double start = 0;
  for (const Phase& phase : phases) {
    if (phase.name == name) return start;
    start += phase.seconds;
  }
  return -1;
}

double phase_time(const std::vector<Phase>& phases, const std::string& text, const std::string& origin) {
  const std::size_t sign = text.find_first_of("+-");
  const std::string name = text.substr(0, text.find_last_not_of(" +-", sign) + 1);
  const double start = phase_start(phases, name);
  if (start < 0) {
    std::vector<std::string> names;
    for (const Phase& phase : phases) names.push_back(phase.name);
    throw Error::invalid_input("\"" + text + "\" must be a number of seconds or begin with a phase, " +
                               (names.empty() ? "of which there are none" : join(names, " | ")) + " (" +
                               origin + ")");
  }
  if (sign == std::string::npos) return start;
  const std::size_t digit = std::min(text.find_first_not_of(' ', sign + 1), text.size());
  const std::optional<double> more = number_in(std::string_view(text).substr(digit));
  if (!more)
    throw Error::invalid_input(
        "\"" + text + "\": after the phase, + or - and a number of seconds are expected (" + origin + ")");
  return text[sign] == '-' ? start - *more : start + *more;
}

std::string Scene::phase_at(double time) const {
  const double said = scene_cycles(*this).said(time);
  std::string name;
  double start = 0;
  for (const Phase& p : phase) {
    if (said < start) break;
    name = p.name;
    start += p.seconds;
  }
  const int cycle = cycles > 1 ? cycle_at(*this, time) : 0;
  return cycle > 0 ? name + ", cycle " + std::to_string(cycle) : name;
}

}  // namespace hysteron
