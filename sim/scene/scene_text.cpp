#include "sim/scene/scene_text.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "sim/scene/assets.h"
#include "sim/scene/shown_key.h"

namespace hysteron {
namespace {

constexpr const char* kOwn = "the experiment's own";

// Writes a number of TOML that is an integer only where the key takes one.
std::string toml_number(double x) {
  const std::string text = number_text(x);
  const bool is_real = text.find_first_of(".en") != text.npos;  // "1e-05", "inf"
  return is_real ? text : text + ".0";
}

std::string in_quotes(const std::string& text) {
  std::string inner;
  for (const char c : text) inner += c == '"' || c == '\\' ? std::string{'\\', c} : std::string(1, c);
  return '"' + inner + '"';
}

template <class Numbers>
std::string number_list(const Numbers& numbers) {
  std::vector<std::string> words;
  for (const double x : numbers) words.push_back(toml_number(x));
  return "[" + join(words, ", ") + "]";
}

std::string field_text(const Field& field) {
  if (const auto* x = std::get_if<bool*>(&field)) return **x ? "true" : "false";
  if (const auto* x = std::get_if<int*>(&field)) return std::to_string(**x);
  if (const auto* x = std::get_if<unsigned*>(&field)) return std::to_string(**x);
  if (const auto* x = std::get_if<double*>(&field)) return toml_number(**x);
  if (const auto* x = std::get_if<Eigen::Vector3d*>(&field)) return number_list(**x);
  if (const auto* x = std::get_if<Numbers*>(&field)) return number_list(**x);
  if (const auto* x = std::get_if<NamedValue>(&field)) return in_quotes(x->name());
  return in_quotes(*std::get<std::string*>(field));
}

class TomlWriter {
 public:
  TomlWriter(const Scene& scene, const std::set<std::string>& own) : scene_(scene), own_(own) {}

  std::string whole(const std::vector<FurtherKey>& others) {
    Scene copy = scene_;
    text_ << kResolvedSceneMark << " every key, its unit, and where its value comes from.\n";
    keys(bind_scene(copy));
    parameters();
    if (!others.empty()) text_ << "\n";
    for (const FurtherKey& key : others) line(key.path, key.value, "", "");
    tables("phase", scene_.phase, bind_phase);
    tables("pin", scene_.pin, bind_pin);
    tables("obstacle", scene_.obstacle, bind_obstacle);
    tables("command", scene_.command, bind_command);
    return text_.str();
  }

 private:
  // Writes a line such as "fabric.k0 = 50.0 # [1/m] --fabric.k0".
  void line(const std::string& path, const std::string& value, const std::string& unit,
            const std::string& origin) {
    text_ << prefix_ << path << " = " << value;
    const std::string comment = (unit.empty() ? "" : "[" + unit + "] ") + origin;
    text_ << (comment.empty() ? "" : "  # " + comment) << "\n";
  }

  void keys(const Keys& keys) {
    for (const BoundKey& key : keys) {
      const std::string& path = key.description.path;
      if (std::holds_alternative<Parameters*>(key.field)) continue;
      const std::string value =
          path == "fabric.name" ? in_quotes(fabric_to_read(scene_)) : field_text(key.field);
      if (path == "mesh" && has_triangles_of_cloth_file()) {
        line("# " + path, value, "", "the triangles are those of cloth.file");
        continue;
      }
      line(path, value, key.description.unit, own_.contains(path) ? kOwn : key_origin(scene_, path));
    }
  }

  bool has_triangles_of_cloth_file() const { return scene_.cloth.is_of_file() && !scene_.cloth.file.empty(); }

  void parameters() {
    for (const auto& [name, value] : scene_.param)
      line("param." + in_quotes(name), in_quotes(value), "", key_origin(scene_, "param." + name));
  }

  template <class Item>
  void tables(const char* name, std::vector<Item> items, Keys (*bind_one)(Item&)) {
    for (std::size_t i = 0; i < items.size(); ++i) {
      const std::string path = std::string(name) + "[" + std::to_string(i) + "]";
      prefix_ = is_given(scene_, path) ? "" : "# ";
      text_ << "\n" << prefix_ << "[[" << name << "]]  # " << key_origin(scene_, path, kOwn) << "\n";
      for (const BoundKey& key : bind_one(items[i]))
        line(key.description.path, field_text(key.field), key.description.unit,
             key_origin(scene_, path + "." + key.description.path, ""));
      if constexpr (requires { items[i].motion; }) keyframes(items[i].motion);
    }
    prefix_.clear();
  }

  void keyframes(const Motion& motion) {
    if (motion.keys.empty()) return;
    text_ << prefix_ << "keys = [\n";
    for (Keyframe frame : motion.keys) {
      std::vector<std::string> entries;
      for (const BoundKey& key : bind_keyframe(frame))
        entries.push_back(key.description.path + " = " + field_text(key.field));
      text_ << prefix_ << "  {" << join(entries, ", ") << "},\n";
    }
    text_ << prefix_ << "]\n";
  }

  const Scene& scene_;
  const std::set<std::string>& own_;
  std::ostringstream text_;
  std::string prefix_;
};

}  // namespace

std::string fabric_to_read(const Scene& scene) {
  const std::vector<std::string> known = list_assets("fabrics");
  if (std::count(known.begin(), known.end(), scene.fabric.name)) return scene.fabric.name;
  for (const auto& [key, place] : scene.origin) {
    const std::size_t end = place.find(".toml:");
    if (key.starts_with("fabric.") && key != "fabric.name" && end != place.npos)
      return place.substr(0, end) + ".toml";
  }
  return scene.fabric.name;
}

std::string scene_toml(const Scene& scene, const std::set<std::string>& own,
                       const std::vector<FurtherKey>& others) {
  return TomlWriter(scene, own).whole(others);
}

}  // namespace hysteron
