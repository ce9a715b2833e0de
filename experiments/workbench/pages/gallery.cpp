#include "experiments/workbench/pages/gallery.h"

#include <algorithm>
#include <set>
#include <thread>

#include "experiments/workbench/app/experiment.h"
#include "experiments/workbench/app/manifest_file.h"
#include "experiments/workbench/app/set_aside.h"
#include "experiments/workbench/pages/gallery_exhibit.h"
#include "experiments/workbench/pages/gallery_questions.h"
#include "experiments/workbench/pages/manifest.h"
#include "experiments/workbench/pages/pictures.h"
#include "experiments/workbench/pages/report.h"
#include "sim/base/atomic_file.h"
#include "sim/base/error.h"
#include "sim/base/parallel.h"
#include "sim/base/whole_file.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;

// Returns "cpu: CPU", without the number of threads.
std::string without_threads(const std::string& device) {
  const std::size_t comma = device.rfind(", ");
  return comma != device.npos && device.ends_with("threads") ? device.substr(0, comma) : device;
}

void gather(const Exhibit& exhibit, std::set<std::string>& devices, std::set<std::string>& dates) {
  if (exhibit.manifest) {
    if (exhibit.manifest->device) devices.insert(without_threads(*exhibit.manifest->device));
    dates.insert(exhibit.manifest->started.substr(0, 10));
  }
  for (const Exhibit& part : exhibit.parts) gather(part, devices, dates);
}

std::string gallery_facts(const std::vector<ExhibitGroup>& groups) {
  std::set<std::string> devices, dates;
  std::size_t folders = 0;
  for (const ExhibitGroup& group : groups) {
    folders += group.exhibits.size();
    for (const Exhibit& exhibit : group.exhibits) gather(exhibit, devices, dates);
  }
  dates.erase("");
  std::string facts = counted(folders, "folder") + " of results";
  if (!dates.empty()) facts += ", " + *dates.begin() + (dates.size() > 1 ? " to " + *dates.rbegin() : "");
  if (!devices.empty()) facts += ". Devices: " + join({devices.begin(), devices.end()}, "; ");
  return facts;
}

// Says where the page's numbers come from.
std::string data_origin(PageForm form) {
  return form == PageForm::linked
             ? "Every number and picture is read from the folders beside this page; a picture "
               "leads to its full size."
             : "Every number and picture was read from these folders; this page needs no other "
               "file.";
}

// Returns "drape" as "Drape"; names of instruments stay as they are.
std::string experiment_title(std::string experiment) {
  if (experiment == "kes") return "KES";
  return first_upper(experiment);
}

// Returns the picture that the README above the gallery shows first, if it is one of the gallery's: readers
// who come from there have seen it.
std::string gallery_teaser(const fs::path& folder, PageForm form) {
  constexpr int kWidth = 1200;  // width of an embedded picture [pixels]
  const fs::path above = fs::absolute(folder).lexically_normal(), readme = above.parent_path() / "README.md";
  const std::string name = above.filename().string() + "/";
  if (!is_there(readme)) return "";
  const std::string text = whole_file(readme);
  const std::size_t image = text.find("!["), open = text.find("](", image), close = text.find(')', open);
  if (close == text.npos || text.compare(open + 2, name.size(), name) != 0) return "";
  const std::string path = text.substr(open + 2 + name.size(), close - open - 2 - name.size()),
                    words = text.substr(image + 2, open - image - 2);
  if (!path.ends_with(".png") || !is_there(folder / path)) return "";
  return filled("teaser.html", {{"link", form == PageForm::linked ? relative_url(path) : ""},
                                {"image", image_element({folder / path, path, words, kWidth}, form)},
                                {"words", words}});
}

// Pictures that are embedded take seconds to shrink: exhibits are made at the same time.
std::vector<std::string> all_html(const std::vector<ExhibitGroup>& groups, PageForm form) {
  std::vector<const Exhibit*> all;
  for (const ExhibitGroup& group : groups) {
    for (const Exhibit& exhibit : group.exhibits) all.push_back(&exhibit);
  }
  std::vector<std::string> html(all.size());
  in_parallel(all.size(), static_cast<int>(std::thread::hardware_concurrency()),
              [&](std::size_t i) { html[i] = exhibit_html(*all[i], form); });
  return html;
}

// Returns the folders below this one that have a report.html, by name.
std::vector<fs::path> reports_below(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code failure;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder, failure)) {
    const fs::path inner = entry.path().parent_path();
    if (entry.path().filename() == "report.html" && inner != folder && !is_set_aside(inner))
      found.push_back(entry.path().parent_path());
  }
  if (failure) throw unreadable(folder, failure);
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace

std::string gallery_page(const std::filesystem::path& folder, PageForm form) {
  const std::vector<ExhibitGroup> groups = exhibits_in(folder);
  const std::vector<std::string> html = all_html(groups, form);
  std::vector<Fields> sections;
  std::size_t next = 0;
  for (const ExhibitGroup& group : groups) {
    std::vector<Fields> exhibits;
    for (const Exhibit& exhibit : group.exhibits)
      exhibits.push_back({{"anchor", page_anchor(exhibit)}, {"name", exhibit.name}, {"html", html[next++]}});
    sections.push_back({{"experiment", group.experiment},
                        {"title", experiment_title(group.experiment)},
                        {"question", first_upper(experiment_named(group.experiment).question)},
                        {"exhibits", exhibits}});
  }
  const std::string questions = questions_html(folder, form);
  const std::string body =
      filled("gallery.html", {{"facts", gallery_facts(groups)},
                              {"from", data_origin(form)},
                              {"teaser", questions.empty() ? gallery_teaser(folder, form) : ""},
                              {"questions", questions},
                              {"groups", sections}});
  return html_page("hysteron: results", body, "gallery");
}

std::filesystem::path write_gallery(const std::filesystem::path& folder, PageForm form) {
  write_text(folder / "index.html", gallery_page(folder, form));
  return folder / "index.html";
}

std::vector<StalePage> stale_pages(const fs::path& folder) {
  std::vector<StalePage> stale;
  const auto check = [&](const fs::path& of, const char* name, const std::string& page) {
    const fs::path file = of / name;
    const bool missing = !is_there(file);
    if (missing || whole_file(file) != page) stale.push_back({file, of, missing});
  };
  if (has_manifest(folder)) {
    check(folder, "report.html", report_page(folder));
  } else {
    check(folder, "index.html", gallery_page(folder));
  }
  for (const fs::path& run : reports_below(folder)) check(run, "report.html", report_page(run));
  return stale;
}

}  // namespace hysteron::experiments
