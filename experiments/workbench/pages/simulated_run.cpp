#include "experiments/workbench/pages/simulated_run.h"

#include <algorithm>
#include <cstdio>

#include "experiments/workbench/pages/manifest.h"

namespace hysteron::experiments {
namespace {

std::string text_of(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

double number_of(const Json& json, const char* key) {
  const Json value = json.value(key, Json());
  return value.is_number() ? value.get<double>() : 0;
}

struct Fact {
  const char* name;
  std::string (*words)(const Json& manifest);
};
constexpr Fact kFacts[] = {
    {"Cloth", cloth_words}, {"Fabric", fabric_words}, {"Damping of bending", damping_words},
    {"Law", law_words},     {"Solver", solver_words}, {"Device", device_words}};

// What is said, with those who say it, in the order in which it is first said.
using Said = std::vector<std::pair<std::string, std::vector<std::string>>>;

Said said_by(const Fact& fact, const std::vector<std::string>& names,
             const std::vector<const Json*>& manifests) {
  Said said;
  for (std::size_t i = 0; i < manifests.size(); ++i) {
    const std::string words = fact.words(*manifests[i]);
    auto found = std::find_if(said.begin(), said.end(), [&](const auto& s) { return s.first == words; });
    if (found == said.end()) found = said.insert(said.end(), {words, {}});
    found->second.push_back(names[i]);
  }
  return said;
}

}  // namespace

std::string grouped(long count) {
  std::string text = std::to_string(count);
  for (int at = static_cast<int>(text.size()) - 3; at > (count < 0); at -= 3) text.insert(at, ",");
  return text;
}

std::string cloth_words(const Json& manifest) {
  const Json& scene = manifest.at("scene");
  const Json cloth = scene.value("cloth", Json::object());
  const std::string shape = cloth.value("shape", "");
  std::string words = shape.empty() ? "" : shape;
  const double length = 1e3 * number_of(cloth, "length"), width = 1e3 * number_of(cloth, "width"),
               radius = 1e3 * number_of(cloth, "radius");
  if (shape == "strip") words += text_of(" of %.4g by ", length) + text_of("%.4g mm", width);
  if (shape == "square") words += text_of(" of %.4g mm", length);
  if (shape == "disc") words += text_of(" of %.4g mm radius", radius);
  if (shape == "tube") words += text_of(" of %.4g mm", length) + text_of(" and %.4g mm radius", radius);
  words += ", mesh " + scene.value("mesh", "");
  const Json triangles = manifest.value("triangles", Json());
  return words + (triangles.is_number() ? ", " + grouped(triangles.get<long>()) + " triangles" : "");
}

std::string fabric_words(const Json& manifest) {
  const Json fabric = manifest.at("scene").value("fabric", Json::object());
  return fabric.value("name", "") + text_of(" (b1 %.4g N m", number_of(fabric, "b1")) +
         text_of(", b2 %.4g N m", number_of(fabric, "b2")) +
         text_of(", k0 %.4g 1/m", number_of(fabric, "k0")) +
         text_of(", %.4g g/m²", 1e3 * number_of(fabric, "density")) + ")";
}

std::string damping_words(const Json& manifest) {
  return text_of("%.4g s", number_of(manifest.at("scene").value("fabric", Json::object()), "damping"));
}

std::string law_words(const Json& manifest) {
  const Json& scene = manifest.at("scene");
  std::vector<std::string> parameters;
  const Json given = scene.value("param", Json::object());
  for (const auto& [key, value] : given.items())
    parameters.push_back(key + "=" + (value.is_string() ? value.get<std::string>() : value.dump()));
  return scene.value("law", "") + (parameters.empty() ? "" : " (" + join(parameters, ", ") + ")");
}

std::string solver_words(const Json& manifest) {
  const Json& scene = manifest.at("scene");
  return scene.value("integrator", "") + text_of(", step %.4g ms", 1e3 * number_of(scene, "step")) +
         ", element " + scene.value("element", "") + ", " + scene.value("precision", "") + " precision" +
         (scene.value("self-contact", false) ? ", self-contact" : "");
}

std::string device_words(const Json& manifest) {
  const Json device = manifest.value("device", Json());
  return device.is_string() ? device.get<std::string>() : "not known";
}

std::string facts_of(const std::vector<std::string>& names, const std::vector<const Json*>& manifests) {
  std::string text;
  for (const Fact& fact : kFacts) {
    Said said = said_by(fact, names, manifests);
    std::stable_sort(said.begin(), said.end(),
                     [](const auto& a, const auto& b) { return a.second.size() > b.second.size(); });
    const bool each = said.size() > 1 && said.front().second.size() == 1;  // all differ
    std::string words;
    if (each &&
        std::all_of(said.begin(), said.end(), [](const auto& s) { return s.first == s.second.front(); }))
      continue;  // the names say it already
    for (const auto& [what, who] : said) {
      if (each && who.front() == what) {
        words += (words.empty() ? "" : "; ") + what;
      } else {
        const bool named = each || !words.empty();
        words += (words.empty() ? "" : "; ") + (named ? join(who, ", ") + ": " : "") + what;
      }
    }
    if (!words.empty()) text += (text.empty() ? "" : " ") + std::string(fact.name) + ": " + words + ".";
  }
  return text;
}

void write_run_captions(const std::filesystem::path& folder, std::vector<FigureCaption> figures) {
  const Json manifest = read_manifest(folder / "manifest.json");
  std::erase_if(figures, [&](const FigureCaption& f) { return !std::filesystem::exists(folder / f.file); });
  if (figures.empty()) return;  // without gnuplot
  for (std::size_t i = 1; i < figures.size(); ++i)
    figures[i].text += " The run is that of " + figures[0].file + ".";
  figures[0].text +=
      " " + facts_of({""}, {&manifest}) + " " + origin_words(manifest.value("command", ""), manifest);
  write_captions(folder / "README.md", figures[0].title,
                 "What the figures of this folder show, in words from the run's manifest.", figures);
}

std::string origin_words(const std::string& command, const Json& manifest) {
  return "Written by `" + command + "`" + (manifest.is_object() ? ", " + program_of(manifest) : "") + ".";
}

}  // namespace hysteron::experiments
