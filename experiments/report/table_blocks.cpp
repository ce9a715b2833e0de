#include "experiments/report/table_blocks.h"

#include <algorithm>
#include <tuple>

#include "experiments/report/number_source.h"
#include "sim/base/error.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;

constexpr std::string_view kOpen = "<!-- table ", kClose = " -->", kEnd = "<!-- /table -->";

struct Row {
  std::string value, label;
};
struct Column {
  std::string head, source;
};
struct Block {
  std::string file, prefix;  // what stands behind the file
  std::string head;          // of the labels
  std::vector<Row> rows;
  std::vector<Column> columns;
};

std::vector<std::string> split_at(const std::string& text, const std::string& mark) {
  std::vector<std::string> parts;
  std::size_t from = 0;
  for (std::size_t at; (at = text.find(mark, from)) != text.npos; from = at + mark.size())
    parts.push_back(text.substr(from, at - from));
  parts.push_back(text.substr(from));
  return parts;
}

// Both halves of a text, the second "" without the mark.
std::pair<std::string, std::string> halves(const std::string& text, const std::string& mark) {
  const std::size_t at = text.find(mark);
  if (at == text.npos) return {text, ""};
  return {text.substr(0, at), text.substr(at + mark.size())};
}

std::string filled(std::string text, const std::string& value) {
  for (std::size_t at = 0; (at = text.find("{}", at)) != text.npos; at += value.size())
    text.replace(at, 2, value);
  return text;
}

// Cells of words, between strokes that stand apart.
std::vector<std::string> words_in(const std::string& label) {
  std::vector<std::string> cells = split_at(" " + label + " ", " / ");
  for (std::string& cell : cells) {
    cell.erase(0, cell.find_first_not_of(' '));
    cell.erase(cell.find_last_not_of(' ') + 1);
  }
  return cells;
}

std::string linked(const std::string& label, const std::string& file) {
  return label.empty() || label.find("](") != label.npos ? label : "[" + label + "](" + file + ")";
}

std::vector<Row> block_rows_text(const std::string& words, const Block& block, const fs::path& folder) {
  std::vector<Row> rows;
  if (words.starts_with("each ")) {
    for (const std::string& value : values_of_column(block.file, words.substr(5), folder))
      rows.push_back({value, value});
    return rows;
  }
  for (const std::string& row : split_at(words, "; ")) {
    const auto [value, label] = halves(row, " as ");
    rows.push_back({value, label.empty() ? value : label});
  }
  return rows;
}

Block parsed_block(std::string words, const fs::path& folder) {
  std::replace(words.begin(), words.end(), '\n', ' ');
  const std::vector<std::string> parts = split_at(words, " | ");
  if (parts.size() < 3)
    throw Error::invalid_input("a table needs a file, its rows and a column, with | between them");
  Block block;
  std::tie(block.file, block.prefix) = halves(parts[0], " ");
  for (std::size_t i = 1; i < parts.size(); ++i) {
    const auto [head, source] = halves(parts[i], " = ");
    if (source.empty())
      throw Error::invalid_input("\"" + parts[i] + "\" must be HEAD = what stands below it");
    if (i > 1)
      block.columns.push_back({head, source});
    else
      block.head = head, block.rows = block_rows_text(source, block, folder);
  }
  return block;
}

std::string cell(const Block& block, const Row& row, const Column& column, const fs::path& folder) {
  const auto [first, remainder] = halves(column.source, " ");
  const bool own = names_a_file(first);
  const std::string file = own ? first : block.file,
                    prefix = own || block.prefix.empty() ? "" : block.prefix + " ";
  try {
    return number_from(
        {filled(file, row.value), filled(prefix + (own ? remainder : column.source), row.value)}, folder);
  } catch (const Error& error) {
    throw Error::invalid_input(row.value + ", " + column.head + ": " + error.what());
  }
}

// Letters of UTF-8 text.
std::size_t width(const std::string& text) {
  return std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; });
}

// Columns padded to one width, so that the source reads as a table, too: words to the left, numbers to the
// right.
std::string markdown(const std::vector<std::vector<std::string>>& cells, const std::vector<bool>& is_words) {
  std::string text;
  for (std::size_t r = 0; r <= cells.size(); ++r) {
    for (std::size_t c = 0; c < cells[0].size(); ++c) {
      std::size_t widest = 3;
      for (const auto& row : cells) widest = std::max(widest, width(row[c]));
      if (r == 1) {
        text += "|" + std::string(widest + 1, '-') + (is_words[c] ? "-" : ":");
        continue;
      }
      const std::string& cell = cells[r == 0 ? 0 : r - 1][c];
      const std::string blanks(widest - width(cell), ' ');
      text += is_words[c] ? "| " + cell + blanks + " " : "| " + blanks + cell + " ";
    }
    text += "|\n";
  }
  return text;
}

std::string table(const Block& block, const fs::path& folder) {
  const bool by_row = block.file.find("{}") != std::string::npos;
  std::vector<std::vector<std::string>> cells = {words_in(block.head)};
  const std::size_t words = cells[0].size();
  std::vector<bool> is_words(words, true);
  if (!by_row && !cells[0][0].empty()) cells[0][0] = linked(cells[0][0], block.file);
  for (const Column& column : block.columns) {
    cells[0].push_back(column.head);
    is_words.push_back(column.source.ends_with(" text"));
  }
  for (const Row& row : block.rows) {
    std::vector<std::string> line = words_in(row.label);
    line.resize(words);
    if (by_row) line[0] = linked(line[0], filled(block.file, row.value));
    for (const Column& column : block.columns) line.push_back(cell(block, row, column, folder));
    cells.push_back(line);
  }
  return markdown(cells, is_words);
}

}  // namespace

void write_tables(Page& page) {
  const std::string before = page.text;
  std::string after;
  std::size_t from = 0;
  // At the start of a line: elsewhere it is quoted.
  for (std::size_t at; (at = before.find(std::string("\n").append(kOpen), from)) != before.npos;) {
    ++at;
    const int line = line_at(before, at);
    const std::size_t words = at + kOpen.size(), close = before.find(kClose, words),
                      first = close + kClose.size() + 1, end = before.find(kEnd, words);
    if (close == before.npos || end == before.npos || end < first) {
      page.faults.push_back({line, "a table must end with <!-- /table --> below it"});
      break;
    }
    std::string now = before.substr(first, end - first);
    try {
      const fs::path folder = page.file.parent_path();
      const std::string expected = table(parsed_block(before.substr(words, close - words), folder), folder);
      if (now != expected) page.faults.push_back({line, "this table is not what its files say", true});
      now = expected;
    } catch (const Error& error) {
      page.faults.push_back({line, error.what()});
    }
    after += before.substr(from, first - from) + now;
    from = end;
  }
  page.text = after + before.substr(from);
}

}  // namespace hysteron::experiments
