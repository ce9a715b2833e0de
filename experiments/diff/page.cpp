// The table of two folders of pictures and the pictures that differ most, as files.
#include <algorithm>
#include <cmath>

#include "experiments/diff/diff.h"
#include "experiments/workbench/pages/page.h"
#include "sim/base/atomic_file.h"
#include "sim/base/csv.h"
#include "sim/scene/key_table.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;

constexpr int kThumbnailWidth = 480;       // [pixels]
constexpr std::size_t kMostPictures = 12;  // more would make a page of many megabytes

// "∞" where a CSV has nothing.
std::string shown(double value) { return std::isinf(value) ? "∞" : number_field(value); }

std::vector<std::string> cells(const std::string& name, const Measures& measures) {
  std::vector<std::string> row = {name};
  for (const Measure& m : all_measures()) row.push_back(shown(measures.*m.value));
  return row;
}

std::string heading(const FolderDiff& diff, const DiffFlags& flags, const std::string& command) {
  const auto broken = std::count_if(diff.rows.begin(), diff.rows.end(),
                                    [](const FolderDiff::Row& row) { return !row.broken.empty(); });
  std::string limits;
  PictureLimits of_all = flags.from_file.all;
  of_all.set({flags.limits});
  for (const Measure& m : all_measures()) {
    const double limit = of_all.values.*m.value;
    if (!std::isinf(limit))
      limits += std::string(limits.empty() ? "" : ", ") + m.name + (m.least ? " ≥ " : " ≤ ") + shown(limit);
  }
  if (!flags.from_file.pictures.empty())
    limits +=
        std::string(limits.empty() ? "" : ", ") + "of some pictures as " + flags.limits_file + " has it";
  const std::ptrdiff_t missed = std::ssize(diff.rows) - diff.compared();
  const std::string not_compared =
      missed > 0 ? " <span class=\"state bad\">" + std::to_string(missed) + " not compared</span>" : "";
  const std::string state =
      limits.empty() ? ""
      : broken       ? "<span class=\"state bad\">" + std::to_string(broken) + " beyond limits</span>"
                     : "<span class=\"state\">within limits</span>";
  return "<h1>" + escaped(diff.a.string() + " against " + diff.b.string()) + " " + state + not_compared +
         "</h1>\n<p class=\"about\">" +
         escaped(std::to_string(diff.rows.size()) + (diff.rows.size() == 1 ? " picture" : " pictures") +
                 (limits.empty() ? ", no limits" : " · " + limits)) +
         "</p>\n<pre>" + escaped(command) + "</pre>\n";
}

std::string cards(const Measures& worst) {
  std::vector<Card> cards;
  for (const Measure& m : all_measures()) cards.push_back({shown(worst.*m.value), {}, m.column});
  return html_cards(cards);
}

std::string meanings(const DiffFlags& flags) {
  return "<p class=\"about\">Steps are of 8-bit channels. ssim: structural similarity of luma (Wang et al. "
         "2004), 1 for equal pictures. flip: difference that an eye sees at " +
         number_field(std::round(flags.pixels_per_degree)) +
         " pixels per degree (LDR-FLIP, Andersson et al. 2020), 0 for equal pictures. pixels_over_8: with a "
         "channel that differs by more than 8 steps.</p>\n";
}

std::string table(const FolderDiff& diff) {
  std::vector<std::string> head = {"picture"};
  std::vector<std::size_t> numeric;
  for (const Measure& m : all_measures()) {
    numeric.push_back(head.size());
    head.push_back(m.column);
  }
  head.push_back("beyond limits");
  std::vector<std::vector<std::string>> rows;
  for (const FolderDiff::Row& row : diff.rows) {
    const bool compared = row.error.empty();
    rows.push_back(cells(row.name, row.measures));
    if (!compared) std::fill(rows.back().begin() + 1, rows.back().end(), "");
    rows.back().push_back(compared ? join(row.broken, "; ") : "not compared: " + row.error);
  }
  return html_table(head, rows, numeric);
}

std::string thumbnail(const fs::path& file, const std::string& caption) {
  const render::Image image = render::read_png(file);
  const int width = std::min(kThumbnailWidth, image.width());
  const int height = std::max(1, image.height() * width / image.width());
  return embedded_picture(encode_png(shrink(image, width, height), render::PngEffort::best), "image/png",
                          caption);
}

std::string most_different(const FolderDiff& diff, const DiffFlags& flags) {
  std::vector<const FolderDiff::Row*> rows;
  for (const FolderDiff::Row& row : diff.rows) {
    if (row.error.empty() && row.measures.mean_abs > 0) rows.push_back(&row);
  }
  std::stable_sort(rows.begin(), rows.end(),
                   [](const auto* x, const auto* y) { return x->measures.flip > y->measures.flip; });
  rows.resize(std::min(kMostPictures, rows.size()));
  const std::string scale =
      flags.map == "flip" ? "flip: dark 0, pale 1" : "difference: dark 0, pale 64 steps or more";
  std::string html;
  for (const FolderDiff::Row* row : rows)
    html +=
        "<div class=\"charts\">\n" +
        thumbnail(diff.a / row->name, (diff.a / row->name).string() + ", flip " + shown(row->measures.flip)) +
        thumbnail(diff.b / row->name, (diff.b / row->name).string()) +
        thumbnail(fs::path(flags.out) / kHeatFolder / row->name, scale) + "</div>\n";
  return html;
}

}  // namespace

void write_folder_diff(const FolderDiff& diff, const DiffFlags& flags, const std::string& command) {
  const fs::path out = flags.out;
  std::vector<CsvField> head = {"picture"};
  for (const Measure& m : all_measures()) head.push_back(m.column);
  head.push_back("error");
  CsvFile file(out / "diff.csv", head);
  for (const FolderDiff::Row& row : diff.rows) {
    std::vector<CsvField> fields = {row.name};
    for (const Measure& m : all_measures())
      fields.push_back(row.error.empty() ? CsvField(row.measures.*m.value) : CsvField(""));
    fields.push_back(row.error);
    file.row(fields);
  }
  file.commit();
  const std::string differing = "Most different, by FLIP";
  write_text(out / "diff.html",
             html_page(diff.a.string() + " against " + diff.b.string(),
                       heading(diff, flags, command) +
                           (diff.compared() > 0 ? html_section("Worst of each", cards(diff.worst)) : "") +
                           html_section("Pictures", table(diff) + meanings(flags)) +
                           html_section(differing, most_different(diff, flags))));
}

}  // namespace hysteron::experiments
