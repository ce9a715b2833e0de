#include "experiments/workbench/pages/gallery.h"

#include <cctype>
#include <set>
#include <thread>

#include "experiments/workbench/app/experiment.h"
#include "experiments/workbench/pages/gallery_about.h"
#include "experiments/workbench/pages/gallery_exhibit.h"
#include "experiments/workbench/pages/manifest.h"
#include "sim/base/atomic_file.h"
#include "sim/base/parallel.h"

namespace hysteron::experiments {
namespace {

std::string joined(const std::set<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : "; ") + word;
  return text;
}

void gather(const Exhibit& exhibit, std::set<std::string>& devices, std::set<std::string>& dates) {
  const auto take = [&](const Json& manifest) {
    if (manifest.contains("device") && manifest["device"].is_string())
      devices.insert(shown(manifest["device"]));
    dates.insert(manifest.value("started", "").substr(0, 10));
  };
  if (!exhibit.manifest.is_null()) take(exhibit.manifest);
  for (const auto& [file, json] : exhibit.lists) {
    if (is_manifest(json)) take(json);
  }
  for (const Exhibit& part : exhibit.parts) gather(part, devices, dates);
}

std::string header(const std::vector<ExhibitGroup>& groups, PageForm form) {
  std::set<std::string> devices, dates;
  std::size_t folders = 0;
  for (const ExhibitGroup& group : groups) {
    folders += group.exhibits.size();
    for (const Exhibit& exhibit : group.exhibits) gather(exhibit, devices, dates);
  }
  dates.erase("");
  std::string facts = counted(folders, "folder") + " of results";
  if (!dates.empty()) facts += ", " + *dates.begin() + (dates.size() > 1 ? " to " + *dates.rbegin() : "");
  if (!devices.empty()) facts += ". Devices: " + joined(devices);
  return "<header><h1>hysteron: results</h1>\n<p class=\"about\">" + escaped(facts) +
         (form == PageForm::linked
              ? ". Every number and picture is read from the folders beside this page; a picture leads to "
                "its "
                "full size.</p></header>\n"
              : ". Every number and picture was read from these folders; this page needs no other "
                "file.</p></header>\n");
}

// "drape" as "Drape"; names of instruments stay names.
std::string title_of(std::string experiment) {
  if (experiment == "kes") return "KES";
  if (!experiment.empty()) experiment[0] = static_cast<char>(std::toupper(experiment[0]));
  return experiment;
}

std::string contents(const std::vector<ExhibitGroup>& groups) {
  std::string html = "<nav aria-label=\"Contents\">\n";
  for (const ExhibitGroup& group : groups) {
    html += "<div><b>" + escaped(title_of(group.experiment)) + "</b>\n";
    for (const Exhibit& exhibit : group.exhibits)
      html += "<a href=\"#" + anchor_of(exhibit) + "\">" + escaped(exhibit.name) + "</a>\n";
    html += "</div>\n";
  }
  return html + "</nav>\n";
}

std::string question_of(const std::string& name) {
  for (const Experiment& experiment : experiments()) {
    if (experiment.name == name) return std::string("<p>") + escaped(experiment.question) + "</p>\n";
  }
  return "";
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

}  // namespace

std::string gallery_page(const std::filesystem::path& folder, PageForm form) {
  const std::vector<ExhibitGroup> groups = exhibits_in(folder);
  const std::vector<std::string> exhibits = all_html(groups, form);
  std::string body = header(groups, form) + contents(groups) + "<main>\n";
  std::size_t next = 0;
  for (const ExhibitGroup& group : groups) {
    body += "<section><h2>" + escaped(title_of(group.experiment)) + "</h2>\n" + question_of(group.experiment);
    for (std::size_t i = 0; i < group.exhibits.size(); ++i) body += exhibits[next++];
    body += "</section>\n";
  }
  return html_page("hysteron: results", body + "</main>\n", "gallery");
}

std::filesystem::path write_gallery(const std::filesystem::path& folder, PageForm form) {
  const std::string page = gallery_page(folder, form);
  const std::filesystem::path path = folder / "index.html";
  AtomicFile file(path.string());
  file.stream() << page;
  file.commit();
  return path;
}

}  // namespace hysteron::experiments
