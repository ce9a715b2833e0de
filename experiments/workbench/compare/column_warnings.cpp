#include "experiments/workbench/compare/column_warnings.h"

#include <algorithm>

#include "sim/scene/key_table.h"

namespace hysteron::experiments {
namespace {

constexpr std::size_t kMaxTexts = 20, kMaxNames = 4;

// "linear, dahl, kim, wong and 3 others"
std::string listed_names(const std::vector<std::string>& names) {
  if (names.size() <= kMaxNames) return join(names, ", ");
  const std::vector<std::string> first(names.begin(), names.begin() + kMaxNames);
  const std::size_t others = names.size() - kMaxNames;
  return join(first, ", ") + " and " + std::to_string(others) + (others == 1 ? " other" : " others");
}

}  // namespace

void ColumnWarnings::hear(const ChildRun& column) {
  if (column.manifest) hear(column.name, column.manifest->warnings);
  if (!column.stopped.empty()) hear(column.name, {column.stopped});
}

void ColumnWarnings::hear(const std::string& name, const std::vector<std::string>& texts) {
  for (const std::string& text : texts) {
    auto known = std::find_if(heard_.begin(), heard_.end(), [&](const Heard& h) { return h.text == text; });
    if (known == heard_.end()) known = heard_.insert(heard_.end(), {text, {}});
    known->names.push_back(name);
  }
}

void ColumnWarnings::say(Run& run) const {
  for (std::size_t i = 0; i < std::min(heard_.size(), kMaxTexts); ++i)
    run.warn(listed_names(heard_[i].names) + ": " + heard_[i].text);
  if (heard_.size() > kMaxTexts)
    run.warn("the runs give " + std::to_string(heard_.size() - kMaxTexts) +
             " more warnings, each in the manifest of its run");
}

}  // namespace hysteron::experiments
