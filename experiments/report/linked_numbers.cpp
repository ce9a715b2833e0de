#include "experiments/report/linked_numbers.h"

#include <algorithm>
#include <map>
#include <regex>

#include "experiments/report/number_source.h"
#include "sim/base/error.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;

struct Definition {
  NumberSource source;  // without a title: a link to a page or a file
  int line = 0;
  bool used = false;
  std::string number;  // "" if there is none
};

// A link `[text][label]`: the places in the page of what its brackets hold.
struct Reference {
  std::size_t text = 0, text_length = 0;
  std::string label;
};

using Definitions = std::map<std::string, Definition>;

// Whether a link leads out of the checkout or stays in its page.
bool is_elsewhere(const std::string& target) {
  return target.starts_with('#') || target.find("://") != target.npos || target.starts_with("mailto:");
}

void check_file(const std::string& target, int line, Page& page) {
  if (is_elsewhere(target)) return;
  const std::string file = target.substr(0, target.find('#'));
  std::error_code ignored;
  if (!fs::exists(page.file.parent_path() / file, ignored)) page.faults.push_back({line, "no file " + file});
}

Definitions definitions_in(const std::string& prose, Page& page) {
  static const std::regex kDefinition("(^|\n)\\[([^\\]\n]+)\\]: +(\\S+)(?: +\"([^\n]*)\")?(?=\n|$)");
  Definitions all;
  for (std::sregex_iterator found(prose.begin(), prose.end(), kDefinition), end; found != end; ++found) {
    Definition definition{{(*found)[3], (*found)[4]}, line_at(prose, found->position(2)), false, ""};
    const std::string label = (*found)[2];
    if (all.count(label)) page.faults.push_back({definition.line, "[" + label + "] is defined twice"});
    check_file(definition.source.target, definition.line, page);
    try {
      if (!definition.source.title.empty())
        definition.number = number_from(definition.source, page.file.parent_path());
    } catch (const Error& error) {
      page.faults.push_back({definition.line, "[" + label + "]: " + error.what()});
    }
    all[label] = definition;
  }
  return all;
}

// The bracket that the one at `close` closes.
std::size_t opening(const std::string& prose, std::size_t close) {
  int depth = 0;
  for (std::size_t at = close + 1; at-- > 0;) {
    depth += (prose[at] == ']') - (prose[at] == '[');
    if (depth == 0) return at;
  }
  return prose.npos;
}

// A paragraph may be broken at any blank.
std::string in_one_line(const std::string& text) {
  std::string line;
  for (const char c : text) {
    const bool blank = c == '\n' || c == ' ';
    if (!blank || !line.ends_with(' ')) line += blank ? ' ' : c;
  }
  return line;
}

std::vector<Reference> references_in(const std::string& prose) {
  std::vector<Reference> all;
  for (std::size_t at = 0; (at = prose.find("][", at)) != prose.npos; ++at) {
    const std::size_t open = opening(prose, at), close = prose.find(']', at + 2);
    if (open == prose.npos || close == prose.npos) continue;
    all.push_back({open + 1, at - open - 1, in_one_line(prose.substr(at + 2, close - at - 2))});
  }
  return all;
}

void check_inline_links(const std::string& prose, Page& page) {
  static const std::regex kTarget("\\]\\(([^)\\s]+)\\)");
  for (std::sregex_iterator found(prose.begin(), prose.end(), kTarget), end; found != end; ++found)
    check_file((*found)[1], line_at(prose, found->position()), page);
}

}  // namespace

void write_numbers(Page& page) {
  const std::string prose = without_code(page.text);
  Definitions definitions = definitions_in(prose, page);
  check_inline_links(prose, page);
  std::vector<Reference> references = references_in(prose);
  std::reverse(references.begin(), references.end());  // so that places stay while texts change their length
  for (const Reference& link : references) {
    const int line = line_at(prose, link.text);
    const auto definition = definitions.find(link.label);
    if (definition == definitions.end()) {
      page.faults.push_back({line, "[" + link.label + "] is not defined"});
      continue;
    }
    definition->second.used = true;
    const std::string found = in_one_line(page.text.substr(link.text, link.text_length)),
                      &number = definition->second.number;
    if (number.empty() || number == found) continue;
    page.faults.push_back({line, "\"" + found + "\" must be \"" + number + "\"", true});
    page.text.replace(link.text, link.text_length, number);
  }
  for (const auto& [label, definition] : definitions)
    if (!definition.used)
      page.faults.push_back({definition.line, "[" + label + "] is defined and never used"});
}

}  // namespace hysteron::experiments
