#include "experiments/workbench/pages/simulated_run.h"

#include <fmt/core.h>

#include <algorithm>

#include "experiments/workbench/pages/manifest.h"
#include "sim/base/atomic_file.h"
#include "sim/scene/key_table.h"

namespace hysteron::experiments {
namespace {

struct Fact {
  const char* name;
  std::string (*words)(const Manifest& manifest);
};
constexpr Fact kFacts[] = {
    {"Cloth", cloth_words}, {"Fabric", fabric_words}, {"Damping of bending", damping_words},
    {"Law", law_words},     {"Solver", solver_words}, {"Device", device_words}};

// What is said, with those who say it, in the order in which it is first said.
using Said = std::vector<std::pair<std::string, std::vector<std::string>>>;

Said said_by(const Fact& fact, const std::vector<std::string>& names,
             const std::vector<const Manifest*>& manifests) {
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
  for (int at = static_cast<int>(text.size()) - 3; at > (count < 0); at -= 3) text.insert(at, 1, ',');
  return text;
}

std::string cloth_words(const Manifest& manifest) {
  const auto millimetres = [&](const char* key) { return 1e3 * manifest.number(key); };
  const double length = millimetres("cloth.length"), radius = millimetres("cloth.radius");
  const std::string shape = manifest.text("cloth.shape");
  std::string words = shape;
  if (shape == "strip") words += fmt::format(" of {:.4g} by {:.4g} mm", length, millimetres("cloth.width"));
  if (shape == "square") words += fmt::format(" of {:.4g} mm", length);
  if (shape == "disc") words += fmt::format(" of {:.4g} mm radius", radius);
  if (shape == "tube") words += fmt::format(" of {:.4g} mm and {:.4g} mm radius", length, radius);
  words += ", mesh " + manifest.text("mesh");
  return words + (manifest.triangles ? ", " + grouped(*manifest.triangles) + " triangles" : "");
}

std::string fabric_words(const Manifest& manifest) {
  return fmt::format("{} (b1 {:.4g} N m, b2 {:.4g} N m, k0 {:.4g} 1/m, {:.4g} g/m²)",
                     manifest.text("fabric.name"), manifest.number("fabric.b1"), manifest.number("fabric.b2"),
                     manifest.number("fabric.k0"), 1e3 * manifest.number("fabric.density"));
}

std::string damping_words(const Manifest& manifest) {
  return fmt::format("{:.4g} s", manifest.number("fabric.damping"));
}

std::string law_words(const Manifest& manifest) {
  const std::vector<std::string> parameters = manifest.law_parameters();
  return manifest.text("law") + (parameters.empty() ? "" : " (" + join(parameters, ", ") + ")");
}

std::string solver_words(const Manifest& manifest) {
  return fmt::format("{}, step {:.4g} ms, element {}, {} precision{}", manifest.text("integrator"),
                     1e3 * manifest.number("step"), manifest.text("element"), manifest.text("precision"),
                     manifest.text("self-contact") == "true" ? ", self-contact" : "");
}

std::string device_words(const Manifest& manifest) { return manifest.device.value_or("not known"); }

std::string run_facts(const std::vector<std::string>& names, const std::vector<const Manifest*>& manifests) {
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

void write_captions(const std::filesystem::path& path, const std::string& heading,
                    const std::string& introduction, const std::vector<FigureCaption>& figures) {
  AtomicFile file(path.string());
  file.stream() << "# " << heading << "\n\n" << introduction << "\n";
  for (const FigureCaption& figure : figures)
    file.stream() << "\n![" << figure.title << "](" << figure.file << ")\n\n**" << figure.title << ".** "
                  << figure.text << "\n";
  file.commit();
}

void write_run_captions(const std::filesystem::path& folder, const Manifest& manifest,
                        std::vector<FigureCaption> figures) {
  std::erase_if(figures, [&](const FigureCaption& f) { return !std::filesystem::exists(folder / f.file); });
  if (figures.empty()) return;  // without gnuplot
  for (std::size_t i = 1; i < figures.size(); ++i)
    figures[i].text += " The run is that of " + figures[0].file + ".";
  figures[0].text += " " + run_facts({""}, {&manifest}) + " " + origin_words(manifest.command, &manifest);
  write_captions(folder / "README.md", figures[0].title,
                 "What the figures of this folder show, in words from the run's manifest.", figures);
}

std::string origin_words(const std::string& command, const Manifest* manifest) {
  return "Written by `" + command + "`" + (manifest ? ", " + program_description(*manifest) : "") + ".";
}

}  // namespace hysteron::experiments
