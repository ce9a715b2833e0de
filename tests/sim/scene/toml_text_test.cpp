// These faults of a TOML file are found before its parser runs, which would not survive them.
#include <array>
#include <random>

#include "sim/scene/toml_file.h"
#include "tests/sim/base/folder.h"
#include "tests/sim/base/refusal.h"

namespace hysteron {
namespace {

int faulty_line(std::string_view text) {
  const std::optional<TomlFault> fault = fault_before_parsing(text);
  return fault ? fault->line : 0;
}

TEST(TomlText, HasNoFaultWhereItIsToml) {
  for (const char* text :
       {"", "a = 1\n", "[a]\nb = [\n  1,\n  [2],\n]\n", "[[pin]] # one [ of many\nlow = [0, 0, 0]\r\n",
        "[a . \"b.c\" . 'd']\n", "x = {a = [1, 2], b.'c' = \"}\"}\n", "s = '''\n[\xC3\xA9'''\n",
        "s = \"\"\"five quotation marks end it\"\"\"\"\"\nt = 1\n",
        "\xEF\xBB\xBF"
        "a = \"\xC3\xA9\" # \xC3\xA9\n"})
    EXPECT_EQ(faulty_line(text), 0) << text;
}

TEST(TomlText, NamesTheFirstLineThatTheParserWouldNotSurvive) {
  const std::pair<const char*, int> texts[] = {{"[]", 1},
                                               {"a = 1\n[\\]\n", 2},
                                               {"\n\n[a]b", 3},
                                               {"[a\n]", 1},
                                               {"a = [\n1\n\n", 1},
                                               {"\n\xC3\xA9 = 1", 2},
                                               {"a = 1'\xC3\xA9'", 1},
                                               {"a = \"\\\xC3\xA9\"", 1},
                                               {"a = [[}", 1},
                                               {"a = 1\rb = 2", 1},
                                               {"a = b = \"\xC3\xA9\"", 1}};
  for (const auto& [text, line] : texts) EXPECT_EQ(faulty_line(text), line) << text;
}

// A text of these pieces is read or refused: the parser's assertions, which end the process, are not reached.
TEST(TomlText, OfAnyPiecesIsReadOrRefused) {
  constexpr std::array kPieces = {"[", "]", "{",    "}", "=",        ",",      ".",  "\"",
                                  "'", "#", "\n",   "a", "1",        " ",      "\\", "-",
                                  "+", "t", "\r\n", "_", "\xC3\xA9", "\"\"\"", "a=", "[a]"};
  const test::Folder folder;
  std::mt19937 random(1);
  int read = 0, refused = 0;
  for (int i = 0; i < 4000; ++i) {
    std::string text;
    for (int length = 1 + static_cast<int>(random() % 9); length > 0; --length)
      text += kPieces[random() % kPieces.size()];
    const std::string file = folder.write("any.toml", text);
    const bool accepted = test::refusal([&] { read_toml(file); }) == test::kAccepted;
    ++(accepted ? read : refused);
  }
  EXPECT_GT(read, 100);
  EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace hysteron
