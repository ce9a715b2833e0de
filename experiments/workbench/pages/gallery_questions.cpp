#include "experiments/workbench/pages/gallery_questions.h"

#include "experiments/workbench/app/json_file.h"
#include "experiments/workbench/app/manifest_file.h"
#include "experiments/workbench/pages/metrics.h"
#include "experiments/workbench/pages/pictures.h"
#include "sim/base/error.h"
#include "sim/base/number_in.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;

constexpr int kQuestionWidth = 900;  // width of an embedded picture [pixels]

std::string text_of(const Json& entry, const char* key, const fs::path& file) {
  if (!entry.is_object() || !entry.contains(key) || !entry[key].is_string())
    throw Error::invalid_input(file.string() + ": each question needs a text \"" + key + "\"");
  return entry[key];
}

// Formats a metric with its errors, or in three digits if it has none.
ShownQuantity printed_number(const fs::path& folder, const std::string& metric, const fs::path& file) {
  const fs::path manifest = folder / "manifest.json";
  if (!is_there(manifest))
    throw Error::invalid_input(file.string() + ": there is no run in " + folder.string());
  const Metrics metrics = read_manifest(manifest).metrics;
  if (!metrics.contains(metric))
    throw Error::invalid_input(file.string() + ": " + manifest.string() + " has no metric " + metric);
  ShownQuantity words = metric_text(metrics, metric);
  if (words.errors.empty() && metrics[metric].is_number())
    words.value = number_text(metrics[metric].number(), 3);
  return words;
}

}  // namespace

std::string questions_html(const fs::path& folder, PageForm form) {
  const fs::path file = folder / "questions.json";
  if (!is_there(file)) return "";
  const Json list = read_json(file, "list of questions");
  if (!list.is_array()) throw Error::invalid_input(file.string() + ": it must be a list of questions");
  std::vector<Fields> questions;
  for (const Json& entry : list) {
    const std::string question = text_of(entry, "question", file), path = text_of(entry, "picture", file),
                      run = text_of(entry, "run", file);
    if (!is_there(folder / path)) throw Error::invalid_input(file.string() + ": there is no picture " + path);
    const ShownQuantity number = printed_number(folder / run, text_of(entry, "metric", file), file);
    const std::string image = image_element({folder / path, path, question, kQuestionWidth}, form);
    questions.push_back(
        {{"question", question},
         {"value", joined({number.value, number.unit}, " ")},
         {"errors", number.errors},
         {"words", text_of(entry, "words", file)},
         {"anchor", run.substr(0, run.find('/'))},
         {"picture", filled("picture.html", {{"link", form == PageForm::linked ? relative_url(path) : ""},
                                             {"image", image},
                                             {"caption", ""},
                                             {"drawing", ""}})}});
  }
  return filled("questions.html", {{"questions", questions}});
}

}  // namespace hysteron::experiments
