#include "experiments/workbench/pages/gallery_exhibit.h"

#include <algorithm>
#include <map>
#include <sstream>
#include <string_view>
#include <tuple>

#include "experiments/workbench/app/experiment.h"
#include "experiments/workbench/app/manifest_file.h"
#include "experiments/workbench/pages/error_notes.h"
#include "experiments/workbench/pages/manifest.h"
#include "experiments/workbench/pages/metrics.h"
#include "experiments/workbench/pages/pictures.h"
#include "sim/base/atomic_file.h"
#include "sim/base/error.h"
#include "sim/base/whole_file.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;

constexpr int kWidth = 900;                        // width of an embedded picture [pixels]
constexpr std::uintmax_t kLargestDrawing = 60000;  // larger SVG files are linked, and shown as PNG [bytes]
constexpr int kExhibitFrames = 12;

// Returns the index in the order of --help; others follow by name.
std::ptrdiff_t catalogue_index(const std::string& name) {
  const auto& all = experiments();
  return std::find_if(all.begin(), all.end(), [&](const Experiment& e) { return name == e.name; }) -
         all.begin();
}

// Throws for a link back to a folder through which it was reached.
void throw_if_loop(const fs::path& folder) {
  std::error_code ignored;
  if (!fs::is_symlink(folder, ignored)) return;
  const fs::path target = fs::canonical(folder, ignored);
  for (fs::path above = folder.parent_path(); !above.empty(); above = above.parent_path()) {
    if (fs::canonical(above, ignored) == target)
      throw Error::invalid_input(folder.string() + " is a link back to " + above.string() + ": remove it");
    if (above == above.parent_path()) return;
  }
}

std::vector<fs::path> subfolders(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code failure, ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, failure)) {
    const std::string name = entry.path().filename().string();
    const bool sequence = name == "frames" || name.starts_with("frames-") || name == "film" || name == "mesh";
    if (!entry.is_directory(ignored) || name.starts_with('.') || sequence) continue;
    throw_if_loop(entry.path());
    found.push_back(entry.path());
  }
  if (failure) throw unreadable(folder, failure);
  std::sort(found.begin(), found.end());
  return found;
}

bool holds_anything(const Exhibit& exhibit) {
  const auto any = [&](const char* ending) { return !files_ending(exhibit.folder, ending).empty(); };
  return exhibit.manifest || any(".json") || any(".png") || any(".svg") || any(".csv") ||
         !files_ending(exhibit.folder / "frames", ".png").empty();
}

// `beside` receives the subfolders of a folder that is no run.
void collect(const fs::path& folder, const std::string& name, std::vector<Exhibit>& beside) {
  Exhibit exhibit{name, folder, {}, {}};
  if (const fs::path file = folder / "manifest.json"; is_there(file)) exhibit.manifest = read_manifest(file);
  for (const fs::path& sub : subfolders(folder))
    collect(sub, name + "/" + sub.filename().string(), exhibit.manifest ? exhibit.parts : beside);
  if (holds_anything(exhibit)) beside.push_back(std::move(exhibit));
}

// Explains the names of files, see Options::look and Options::light.
std::string stem_text(std::string stem) {
  static const std::map<std::string, std::string> kWords = {
      {"sheet", "contact sheet"},
      {"shadow", "shadow, from above"},
      {"curvature", "curvature, drawn in colours"},
      {"friction", "bending friction, drawn in colours"},
      {"residual", "residual curvature, drawn in colours"},
      {"raking", "in raking light, as wrinkles are photographed"}};
  if (const auto known = kWords.find(stem); known != kWords.end()) return known->second;
  if (stem.starts_with("plot_")) stem = "plot: " + split_unit(stem.substr(5)).text();
  std::replace(stem.begin(), stem.end(), '_', ' ');
  std::replace(stem.begin(), stem.end(), '-', ' ');
  return stem;
}

// Returns the caption of a plot from the run, or one of its columns; "" if there is none.
std::string curve_caption(const Exhibit& exhibit, const std::string& plot) {
  if (exhibit.manifest)
    for (const Curve& curve : exhibit.manifest->curves)
      if (curve.plot == plot) return ". " + curve.caption;
  for (const Exhibit& part : exhibit.parts)
    if (const std::string caption = curve_caption(part, plot); !caption.empty()) return caption;
  return "";
}

// Reads the captions that write_captions() left in README.md: "![title](NAME.png)", then "**title** text".
std::map<std::string, std::string> written_captions(const fs::path& folder) {
  std::map<std::string, std::string> captions;
  const fs::path readme = folder / "README.md";
  if (!is_there(readme)) return captions;
  std::istringstream stream(whole_file(readme));
  std::string file;
  for (std::string line; std::getline(stream, line);) {
    const std::size_t open = line.find("]("), close = line.rfind(')');
    if (line.starts_with("![") && open != line.npos && close != line.npos && close > open) {
      file = line.substr(open + 2, close - open - 2);
    } else if (line.starts_with("**") && !file.empty()) {
      for (std::size_t stars; (stars = line.find("**")) != line.npos;) line.erase(stars, 2);
      line.erase(std::remove(line.begin(), line.end(), '`'), line.end());
      captions[file] = line;
      file.clear();
    }
  }
  return captions;
}

// Returns the first sentences of a caption; README.md has the others.
std::string first_sentences(const std::string& caption) {
  constexpr std::size_t kEnough = 100;  // least number of characters
  const std::size_t end = caption.find(". ", kEnough);
  return caption.substr(0, end == caption.npos ? end : end + 1);
}

// Returns ": cotton-broad, law prandtl, 0 to 3.67 s".
std::string subject_text(const Manifest& manifest) {
  std::string words = scene_subject(manifest);
  if (const auto& seconds = manifest.seconds_simulated)
    words += (words.empty() ? "" : ", ") + ("0 to " + seconds_text(*seconds));
  return words.empty() ? "" : ": " + words;
}

// True for plots, which are written as PNG and SVG.
bool is_drawn(const fs::path& file) {
  return is_plot(file) || is_there(fs::path(file).replace_extension(".svg"));
}

struct Picture {
  fs::path file;        // PNG, or SVG if there is no PNG
  std::string link;     // relative to the gallery
  std::string caption;  // text
};

// Returns the pictures of the exhibit and its parts, the contact sheet first and plots last.
std::vector<Picture> exhibit_pictures(const Exhibit& exhibit, const std::string& prefix) {
  std::vector<fs::path> files = files_ending(exhibit.folder, ".png");
  for (const fs::path& file : files_ending(exhibit.folder, ".svg")) {
    if (!is_there(fs::path(file).replace_extension(".png"))) files.push_back(file);
  }
  std::stable_sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    const auto rank = [](const fs::path& f) { return f.stem() == "sheet" ? 0 : is_drawn(f) ? 2 : 1; };
    return rank(a) < rank(b);
  });
  std::map<std::string, std::string> captions = written_captions(exhibit.folder);
  std::vector<Picture> pictures;
  for (const fs::path& file : files) {
    const std::string name = file.filename().string(), written = captions[name];
    std::string caption = written;
    if (written.empty()) {
      const std::string stem = file.stem().string();
      caption = first_upper(prefix + stem_text(stem)) + curve_caption(exhibit, stem);
      if (file.stem() == "sheet" && exhibit.manifest) caption += subject_text(*exhibit.manifest);
    }
    pictures.push_back({file, exhibit.name + "/" + name, caption});
  }
  for (const Exhibit& part : exhibit.parts) {
    const std::string name = fs::path(part.name).filename().string();
    for (const Picture& picture : exhibit_pictures(part, prefix + name + ": ")) pictures.push_back(picture);
  }
  return pictures;
}

std::string figure(const Exhibit& exhibit, const Picture& picture, PageForm form) {
  const fs::path drawing = fs::path(picture.file).replace_extension(".svg");
  const bool drawn = is_there(drawing);
  const bool as_drawing = drawn && (drawing == picture.file || fs::file_size(drawing) <= kLargestDrawing);
  const std::string words = exhibit.name + ": " + picture.caption.substr(0, picture.caption.find(". "));
  const std::string svg = fs::path(picture.link).replace_extension(".svg").string();
  const std::string shown = as_drawing ? svg : picture.link;
  const bool linked = form == PageForm::linked;
  return filled("picture.html",
                {{"link", linked ? relative_url(shown) : ""},
                 {"image", image_element({as_drawing ? drawing : picture.file, shown, words, kWidth}, form)},
                 {"caption", first_sentences(picture.caption)},
                 {"drawing", linked && drawn && !as_drawing ? html_link(svg, "SVG") : ""}});
}

// Returns the contact sheet over the full width, other pictures and plots side by side, and frames to be
// played.
std::string pictures_html(const Exhibit& exhibit, PageForm form) {
  std::string large, beside, plots;
  for (const Picture& picture : exhibit_pictures(exhibit, "")) {
    const bool sheet = picture.file.stem() == "sheet" && picture.file.parent_path() == exhibit.folder;
    (sheet ? large : is_drawn(picture.file) ? plots : beside) += figure(exhibit, picture, form);
  }
  return large + player(exhibit.folder, exhibit.name + "/", kExhibitFrames, form) +
         html_group("grid", beside) + html_group("grid wide", plots);
}

constexpr std::size_t kMaxCards = 4;

// Returns the experiment's headlines, else its first results; the manifest has all.
std::string metrics_html(const Manifest& manifest) {
  if (const std::string answers = answer_cards(manifest); !answers.empty()) return answers;
  Metrics first;
  std::size_t cards = 0;
  for (const auto& [key, value] : manifest.metrics)
    if (!described_headline(manifest.metrics, key).empty() || (!is_numerics(key) && cards++ < kMaxCards))
      first.set(key, value);
  return metric_cards(first);
}

// Returns a recorded warning without what is known to be wrong: earlier programs said of sharp folds what
// holds of vertices that are held on a cylinder; cloth at rest is off by some percent in either direction
// (docs/limits.md, sharp folds).
std::string corrected(std::string warning) {
  constexpr std::string_view kThen = "where bending is more than 2.5 % too soft",
                             kToday =
                                 "where triangles are coarse for the fold and bending is off by some percent";
  if (const std::size_t at = warning.find(kThen); at != std::string::npos)
    warning.replace(at, kThen.size(), kToday);
  return warning;
}

// Returns the first warning in one line.
std::string warnings_note(const std::vector<std::string>& all) {
  if (all.empty()) return "";
  return "Warning: " + corrected(all[0]) +
         (all.size() > 1 ? "; " + std::to_string(all.size() - 1) + " more in manifest.json" : "");
}

// Returns a small version of the first picture; "" if there is none.
std::string thumbnail_html(const Exhibit& exhibit, PageForm form) {
  constexpr int kThumbnail = 320;  // width of an embedded one [pixels]
  const std::vector<Picture> pictures = exhibit_pictures(exhibit, "");
  if (pictures.empty()) return "";
  return image_element({pictures[0].file, pictures[0].link, exhibit.name, kThumbnail}, form);
}

// Returns a badge for an incomplete run.
std::string warning(const Manifest& manifest) { return manifest.complete ? "" : " " + state_badge(manifest); }

// Returns links to the manifests of the runs that it summarises.
std::string parts_links(const Exhibit& exhibit, PageForm form) {
  std::string links;
  for (const Exhibit& part : exhibit.parts) {
    if (part.manifest)
      links += " · " +
               file_link(part.name + "/manifest.json", fs::path(part.name).filename().string(), form) +
               warning(*part.manifest);
  }
  return links;
}

// Returns links to files, separated by dots.
std::string exhibit_links(const Exhibit& exhibit, PageForm form) {
  std::string links;
  const auto add = [&](const std::string& name) {
    links += (links.empty() ? "" : " · ") + file_link(exhibit.name + "/" + name, name, form);
  };
  for (const char* ending : {".json", ".csv"})
    for (const fs::path& file : files_ending(exhibit.folder, ending)) add(file.filename().string());
  for (const char* page : {"report.html", "README.md"})
    if (is_there(exhibit.folder / page)) add(page);
  return links + parts_links(exhibit, form);
}

}  // namespace

std::string Exhibit::experiment() const {
  if (manifest) return manifest->experiment;
  return name.substr(0, name.find_first_of("/-"));
}

bool Exhibit::has_pictures() const {
  const auto any = [](const Exhibit& part) { return part.has_pictures(); };
  return !files_ending(folder, ".png").empty() || std::any_of(parts.begin(), parts.end(), any);
}

std::vector<ExhibitGroup> exhibits_in(const fs::path& gallery) {
  std::vector<Exhibit> all;
  for (const fs::path& folder : subfolders(gallery)) collect(folder, folder.filename().string(), all);
  if (all.empty()) {
    throw Error::invalid_input("nothing to show in " + gallery.string() +
                               ": neither it nor its subfolders hold a manifest.json, pictures or tables");
  }
  std::stable_sort(all.begin(), all.end(), [](const Exhibit& a, const Exhibit& b) {
    const auto key = [](const Exhibit& e) {
      return std::tuple(catalogue_index(e.experiment()), e.experiment(), !e.has_pictures(), e.name);
    };
    return key(a) < key(b);
  });
  std::vector<ExhibitGroup> groups;
  for (Exhibit& exhibit : all) {
    const std::string experiment = exhibit.experiment();
    if (groups.empty() || groups.back().experiment != experiment) groups.push_back({experiment, {}});
    groups.back().exhibits.push_back(std::move(exhibit));
  }
  return groups;
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

std::string page_anchor(const Exhibit& exhibit) {
  std::string anchor = exhibit.name;
  for (char& c : anchor) {
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-' && c != '_' && c != '.') c = '-';
  }
  return anchor;
}

std::string exhibit_html(const Exhibit& exhibit, PageForm form) {
  const std::optional<Manifest>& manifest = exhibit.manifest;
  const std::string metrics = manifest ? metrics_html(*manifest) + missing_errors(*manifest) : "";
  Fields fields = {{"anchor", page_anchor(exhibit)},
                   {"name", exhibit.name},
                   {"badge", manifest ? warning(*manifest) : ""},
                   {"note", manifest ? warnings_note(manifest->warnings) : ""},
                   {"links", exhibit_links(exhibit, form)}};
  if (!exhibit.has_pictures() && metrics.empty()) return filled("files.html", fields);
  fields.update({{"thumbnail", thumbnail_html(exhibit, form)},
                 {"answer", manifest ? first_answer(*manifest) : ""},
                 {"when", manifest ? manifest->started.substr(0, 10) : ""},
                 {"about", manifest ? about_html(*manifest) : ""},
                 {"pictures", pictures_html(exhibit, form)},
                 {"metrics", metrics},
                 {"has_command", manifest.has_value()},
                 {"command", manifest ? manifest->command : ""}});
  return filled("exhibit.html", fields);
}

}  // namespace hysteron::experiments
