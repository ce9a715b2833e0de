#include "sim/reference/tester_table.h"

#include <algorithm>

#include "sim/base/whole_file.h"

namespace hysteron {
namespace {

std::string trimmed(std::string text) {
  const auto is_blank = [](unsigned char c) { return std::isspace(c) || c == '"'; };
  while (!text.empty() && is_blank(text.back())) text.pop_back();
  while (!text.empty() && is_blank(text.front())) text.erase(text.begin());
  return text;
}

// Where the line begins that names columns; npos if none does.
std::size_t begin_of_head(const std::string& text,
                          const std::function<bool(const std::string& field)>& is_of_head) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    for (std::size_t field = at; field <= end;) {
      const std::size_t next = std::min(text.find_first_of(",;\t", field), end);
      if (is_of_head(trimmed(text.substr(field, next - field)))) return at;
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
  std::string text = whole_file(file, "cannot read " + file.string());
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
  const std::string name = file.filename().string();
  const std::size_t head = begin_of_head(text, is_of_head);
  if (head == text.npos)
    throw Error::invalid_input(name + " has no line that names " + wanted).with_experiment(reader);
  // Blank lines in place of those before the head: the rows keep their numbers.
  const auto before = static_cast<std::size_t>(std::count(text.begin(), text.begin() + head, '\n'));
  Table table;
  try {
    table = table_in(std::string(before, '\n') + text.substr(head), name);
  } catch (const Error& error) {
    throw error.with_experiment(reader);
  }
  for (std::string& field : table.head) field = trimmed(field);
  for (std::vector<std::string>& row : table.rows)
    for (std::string& field : row) field = trimmed(field);
  table.reader = reader;
  if (table.rows.empty()) throw Error::invalid_input(name + " has no rows").with_experiment(reader);
  return table;
}

}  // namespace hysteron
