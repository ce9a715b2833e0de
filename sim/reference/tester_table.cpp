#include "sim/reference/tester_table.h"

#include <algorithm>

#include "sim/base/plain_text.h"
#include "sim/base/whole_file.h"

namespace hysteron {
namespace {

// Returns the text without blanks and quotes at either end.
std::string bare(std::string text) {
  const auto is_blank = [](unsigned char c) { return std::isspace(c) || c == '"'; };
  while (!text.empty() && is_blank(text.back())) text.pop_back();
  while (!text.empty() && is_blank(text.front())) text.erase(text.begin());
  return text;
}

bool is_comment(const std::string& text, std::size_t at) {
  const std::size_t first = text.find_first_not_of(" \t", at);
  return first != text.npos && text[first] == '#';
}

// Returns the beginning of the line that names columns, among the comments or among the other lines; npos if
// there is none.
std::size_t begin_of_head(const std::string& text, bool comments,
                          const std::function<bool(const std::string& field)>& is_of_head) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const bool comment = is_comment(text, at);
    std::size_t field = comment ? text.find_first_not_of("# \t", at) : at;
    while (comment == comments && field <= end) {
      const std::size_t next = std::min(text.find_first_of(",;\t", field), end);
      if (is_of_head(bare(text.substr(field, next - field)))) return at;
      field = next + 1;
    }
    at = end + 1;
  }
  return text.npos;
}

}  // namespace

Table read_tester_table(const std::filesystem::path& file,
                        const std::function<bool(const std::string& field)>& is_of_head,
                        const std::string& wanted, const std::string& reader) {
  const std::string text = plain_text(whole_file(file));
  const std::string name = file.filename().string();
  std::size_t head = begin_of_head(text, false, is_of_head);
  if (head == text.npos) head = begin_of_head(text, true, is_of_head);
  if (head == text.npos)
    throw Error::invalid_input(name + " has no line that names " + wanted).with_experiment(reader);
  // Blank lines replace those before the head, so that the rows keep their numbers.
  const std::size_t names = is_comment(text, head) ? text.find_first_not_of("# \t", head) : head;
  const auto before = static_cast<std::size_t>(std::count(text.begin(), text.begin() + head, '\n'));
  Table table;
  try {
    table = table_in(std::string(before, '\n') + text.substr(names), name);
  } catch (const Error& error) {
    throw error.with_experiment(reader);
  }
  for (std::string& field : table.head) field = bare(field);
  for (std::vector<std::string>& row : table.rows)
    for (std::string& field : row) field = bare(field);
  table.reader = reader;
  if (table.rows.empty()) throw Error::invalid_input(name + " has no rows").with_experiment(reader);
  return table;
}

}  // namespace hysteron
