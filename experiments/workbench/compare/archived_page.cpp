#include "experiments/workbench/compare/archived_page.h"

#include <algorithm>

#include "experiments/workbench/app/json_file.h"
#include "experiments/workbench/app/manifest_file.h"
#include "experiments/workbench/pictures/archived_frames.h"
#include "sim/base/whole_file.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;

// Returns the part of a column's manifest that a page reads; the scene is kept beside it, pictures are
// recorded anew.
Json page_manifest(const Manifest& manifest) {
  Json json = to_json(manifest);
  for (const char* key : {"spec", "scene", "options", "asked", "meshes", "frames", "files"}) json.erase(key);
  return json;
}

ArchivedRecord with_column(ArchivedRecord record, const ChildRun& column, std::size_t mesh) {
  Json setup = parsed_json(inflated(record.blocks.at(0), record.head.at("setup_bytes")));
  setup["manifest"] = page_manifest(*column.manifest);
  setup["stopped"] = column.stopped;
  std::error_code ignored;
  if (const fs::path probes = column.folder / "probes.csv"; fs::exists(probes, ignored))
    setup["probes"] = whole_file(probes);  // for the loops
  const std::string text = setup.dump();
  record.head["name"] = column.name;
  record.head["mesh"] = mesh;
  record.head["setup_bytes"] = text.size();
  record.blocks[0] = deflated(text);
  return record;
}

// Returns the index of the mesh among those already written; a new one is appended.
std::size_t mesh_index(const ArchivedRecord& mesh, std::vector<ArchivedRecord>& known,
                       std::vector<ArchivedRecord>& all) {
  for (std::size_t i = 0; i < known.size(); ++i)
    if (known[i].head == mesh.head && known[i].blocks == mesh.blocks) return i;
  known.push_back(mesh);
  all.push_back(mesh);
  return known.size() - 1;
}

Json page_json(const ComparisonPage& page) {
  return {{"title", page.title}, {"notes", page.notes},         {"rows", page.rows},
          {"times", page.times}, {"metrics", page.metrics},     {"look", page.look},
          {"to", page.to},       {"curvature", page.curvature}, {"outlines", page.outlines},
          {"onion", page.onion}, {"names", page.names}};
}

}  // namespace

void keep_page(Run& run, const ComparisonPage& page, const std::vector<ChildRun>& columns,
               const std::vector<std::vector<int>>& frames) {
  std::vector<ArchivedRecord> meshes, all;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    std::error_code ignored;
    if (frames[c].empty() || !fs::exists(columns[c].folder / kArchivedFrames, ignored)) continue;
    std::size_t mesh = 0;
    for (const ArchivedRecord& record : chosen_records(columns[c].folder / kArchivedFrames, frames[c])) {
      if (record.kind() == "mesh")
        mesh = mesh_index(record, meshes, all);
      else
        all.push_back(record.kind() == "cloth" ? with_column(record, columns[c], mesh) : record);
    }
  }
  if (all.empty()) return;
  all.push_back({{{"record", "sheet"}, {"page", page_json(page)}}, {}});
  write_records(run.path(kArchivedSheet), all);
}

bool is_page(const Json& sheet) { return sheet.is_object() && sheet.contains("page"); }

ComparisonPage archived_comparison_page(const Json& sheet) {
  const Json& json = sheet.at("page");
  ComparisonPage page;
  page.title = json.at("title");
  page.notes = json.at("notes");
  page.rows = json.at("rows");
  page.times = json.at("times").get<std::vector<double>>();
  page.metrics = json.at("metrics");
  page.look = json.at("look");
  page.to = json.at("to");
  page.curvature = json.at("curvature");
  page.outlines = json.at("outlines");
  page.onion = json.at("onion");
  page.names = json.value("names", std::vector<std::string>{});  // earlier pages have none
  return page;
}

ChildRun redrawn_column(const ArchivedCloth& cloth, const fs::path& folder,
                        const std::optional<Frames>& frames) {
  ChildRun column{cloth.name, {}, folder};
  column.stopped = cloth.setup.at("stopped");
  Json json = cloth.setup.at("manifest");
  json["scene"] = cloth.setup.at("scene");
  column.manifest = parsed_manifest(json);
  column.manifest->frames = frames;
  return column;
}

}  // namespace hysteron::experiments
