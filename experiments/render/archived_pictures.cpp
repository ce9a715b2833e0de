#include "experiments/render/archived_pictures.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "experiments/render/part_relief.h"
#include "experiments/workbench/app/run.h"
#include "experiments/workbench/compare/archived_page.h"
#include "experiments/workbench/compare/film.h"
#include "experiments/workbench/pages/report.h"
#include "experiments/workbench/pictures/archived_frames.h"
#include "experiments/workbench/pictures/pictures.h"
#include "sim/base/atomic_file.h"
#include "sim/base/comma_list.h"
#include "sim/base/error.h"
#include "sim/base/number_in.h"
#include "sim/mesh/mesh_sequence.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;

constexpr const char* kOut = "out/render";
constexpr const char *kFilm = "render.video", *kFilmSize = "render.video-size", *kTitle = "render.title";

// Overrides the options that the run was drawn with by those of the flags.
void apply_flags(const CommandLine& line, Options& options) {
  const Keys keys = bind_options(options);
  for (const Flag& flag : line.flags) {
    const std::string path = flag.path == "render.range" ? "curvature-range" : flag.path;
    if (path == "render.part" || path == kFilm || path == kFilmSize || path == kTitle)
      continue;  // these are options of the page, not of a picture
    if (path.starts_with("render.") || path == "fps")
      throw Error::invalid_input(flag.path + " is of mesh files, not of kept geometry (" + flag.name() + ")")
          .with_key(flag.path, flag.text());
    assign(find_key(keys, path, flag.name()), flag.value, flag.name());
  }
  if (options.out.empty()) options.out = kOut;
}

// Throws if no requested picture has the colour bar that the range would change.
void require_range_is_used(const CommandLine& line, const std::vector<std::string>& looks) {
  static const std::set<std::string> kCurvatures = {"curvature", "residual", "difference"};
  const std::string range = last_text(line.flags, "render.range", "");
  if (range.empty() ||
      std::ranges::any_of(looks, [](const auto& look) { return kCurvatures.contains(look); }))
    return;
  throw Error::invalid_input("--render.range " + range +
                             " is not used: render.range needs --look curvature (look = " + join(looks, ",") +
                             ")")
      .with_key("render.range", range);
}

// Returns the probe's path up to an instant.
render::Path loop_until(const Json& sheet, std::size_t points) {
  render::Path path;
  if (!sheet.is_object() || !sheet.contains("loop")) return path;
  for (auto [values, name] : {std::pair(&path.curvature, "curvature"), std::pair(&path.moment, "moment")})
    for (const Json& value : sheet.at("loop").at(name))
      values->push_back(value.is_null() ? NAN : value.get<double>());
  path.curvature.resize(std::min(points, path.curvature.size()));
  path.moment.resize(path.curvature.size());
  return path;
}

// Draws every instant, then the sheet as its record describes it, if there is one.
void draw_instants(Run& run, const Setup& setup, const DrawnMesh& mesh, const ArchivedCloth& cloth,
                   const Json& sheet, const std::string& title) {
  auto subject = std::make_unique<ArchivedSource>(mesh, cloth.instants);
  ArchivedSource& shown = *subject;
  Pictures pictures(setup, std::move(subject), cloth.bounds, cloth.floor);
  for (std::size_t i = 0; i < cloth.instants.size(); ++i) {
    shown.go_to(i);
    pictures.frame(run, shown.positions(), loop_until(sheet, cloth.instants[i].loop));
  }
  if (sheet.is_object() && sheet.contains("cells")) pictures.show_as(sheet);
  pictures.finish(run, title);
}

Json keys_of_archived(const fs::path& file, const ArchivedCloth& cloth) {
  return {{"kept", file.string()}, {"scene", cloth.setup.at("scene")}};
}

void draw_run(const CommandLine& line, const fs::path& file, const Archived& kept) {
  if (const std::string film = last_text(line.flags, kFilm, "none"); film != "none")
    throw Error::invalid_input(std::string(kFilm) + " = " + film + " is of comparisons, and " +
                               file.string() + " is of one run (--" + kFilm + ")")
        .with_key(kFilm, film);
  const ArchivedCloth& cloth = kept.cloths.at(0);
  Setup setup = archived_setup(cloth, file.string());
  apply_flags(line, setup.options);
  require_range_is_used(line, setup.options.looks());
  Run run(line, setup.options, keys_of_archived(file, cloth));
  if (!kept.sheet.is_object())
    run.warn(file.string() + " ends after " + std::to_string(cloth.instants.size()) +
             " instants and without the sheet that a whole run writes last: what is drawn is the part of an "
             "interrupted run, or of a file that was cut off");
  draw_instants(run, setup, kept.meshes.at(cloth.mesh), cloth, kept.sheet,
                last_text(line.flags, kTitle, kept.sheet.is_object() ? kept.sheet.value("title", "") : ""));
  finish_with_report(run);
}

// Returns the requested looks and those that the page needs beside them.
std::string page_looks(const ComparisonPage& page, const std::string& requested,
                       const std::string& recorded) {
  if (requested.empty()) return recorded;
  std::string looks = requested;
  if (page.outlines) looks += ",silhouette";
  if (page.to >= 0 && page.curvature) looks += ",difference";
  return looks;
}

// Returns the looks of all columns.
std::vector<std::string> shown_looks(const CommandLine& line, const fs::path& file, const Archived& kept,
                                     const ComparisonPage& page) {
  std::vector<std::string> all;
  for (const ArchivedCloth& cloth : kept.cloths) {
    const std::string recorded = archived_setup(cloth, file.string()).options.look;
    for (const std::string& look : split(page_looks(page, last_text(line.flags, "look", ""), recorded)))
      if (!std::ranges::count(all, look)) all.push_back(look);
  }
  return all;
}

ChildRun draw_column(const CommandLine& line, const fs::path& file, const Archived& kept,
                     const ArchivedCloth& cloth, const ComparisonPage& page, const fs::path& out) {
  Setup setup = archived_setup(cloth, file.string());
  const std::string recorded = setup.options.look;
  apply_flags(line, setup.options);
  setup.options.out = (out / cloth.name).string();
  setup.options.look = page_looks(page, last_text(line.flags, "look", ""), recorded);
  setup.options.plain = true;  // the page adds the text
  setup.options.json = false;
  Run run(line, setup.options, keys_of_archived(file, cloth));
  draw_instants(run, setup, kept.meshes.at(cloth.mesh), cloth, {}, cloth.name);
  if (cloth.setup.contains("probes"))
    write_text(run.path("probes.csv"), cloth.setup.at("probes").get<std::string>());
  run.finish();
  return redrawn_column(cloth, run.folder(), run.manifest().frames);
}

// Stores the films that the line requests in the page.
void take_films(const CommandLine& line, ComparisonPage& page) {
  page.films = film_formats(kFilm, last_text(line.flags, kFilm, "none"));
  const std::string most = last_text(line.flags, kFilmSize, "");
  if (most.empty()) return;
  const double megabytes = number_in(most).value_or(0);
  if (!(megabytes > 0) || page.films.empty())
    throw Error::invalid_input(std::string(kFilmSize) + " = " + most + " must be > 0 MB, beside --" + kFilm +
                               " (--" + kFilmSize + ")")
        .with_key(kFilmSize, most);
  page.film_bytes = 1e6 * megabytes;
}

// Replaces the sheet's instants by all instants, which a film shows and the columns' own folders keep.
void take_all_instants(const fs::path& file, Archived& kept) {
  for (ArchivedCloth& cloth : kept.cloths) {
    const fs::path frames = file.parent_path() / cloth.name / kArchivedFrames;
    std::error_code ignored;
    if (!fs::exists(frames, ignored))
      throw Error::invalid_input(std::string(kFilm) + " needs all instants, and " + file.string() +
                                 " keeps those of the sheet: there is no " + frames.string() + " (--" +
                                 kFilm + ")")
          .with_key(kFilm, "");
    Archived column = read_archived(frames);
    const DrawnMesh &own = column.meshes.at(0), &shown = kept.meshes.at(cloth.mesh);
    if (own.triangles != shown.triangles || own.quantum != shown.quantum)
      throw Error::invalid_input(frames.string() + " is of another mesh than " + file.string());
    cloth.instants = std::move(column.cloths.at(0).instants);
  }
}

void draw_comparison(const CommandLine& line, const fs::path& file, Archived kept) {
  ComparisonPage page = archived_comparison_page(kept.sheet);
  page.title = last_text(line.flags, kTitle, page.title);
  take_films(line, page);
  if (!page.films.empty()) take_all_instants(file, kept);
  Options options;
  apply_flags(line, options);
  require_range_is_used(line, shown_looks(line, file, kept, page));
  page.look = last_text(line.flags, "look", page.look);
  Run run(line, options, {{"kept", file.string()}});
  std::vector<ChildRun> columns;
  for (const ArchivedCloth& cloth : kept.cloths) {
    run.progress(cloth.name + ": " + std::to_string(cloth.instants.size()) + " instants");
    columns.push_back(draw_column(line, file, kept, cloth, page, run.folder()));
  }
  draw_comparison_page(run, page, columns);
  finish_with_report(run);
}

}  // namespace

fs::path archived_geometry_file(const CommandLine& line) {
  if (line.positionals.size() != 1) return {};
  const fs::path name = line.positionals[0];
  if (name.extension() == ".hyg") return name;
  return holds_meshes(name / "mesh") ? fs::path() : archived_file_in(name);
}

void draw_archived(const CommandLine& line, const fs::path& file) {
  const Archived kept = read_archived(file);
  if (kept.cloths.empty()) throw Error::invalid_input(file.string() + " keeps no cloth");
  try {
    if (const std::string part = last_text(line.flags, "render.part", ""); !part.empty()) {
      Setup setup = archived_setup(kept.cloths.front(), file.string());
      apply_flags(line, setup.options);
      return draw_part_relief(line, file, kept, setup, part);
    }
    if (is_page(kept.sheet))
      draw_comparison(line, file, kept);
    else
      draw_run(line, file, kept);
  } catch (const Json::exception& e) {
    throw Error::invalid_input(file.string() + ": " + e.what());
  }
}

}  // namespace hysteron::experiments
