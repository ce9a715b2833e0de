#include "experiments/workbench/pages/text_table.h"

#include "sim/base/csv.h"
#include "tests/experiments/folder.h"

namespace hysteron::experiments {
namespace {

Table parsed_table(const std::string& text) { return read_table(Folder().write("table.csv", text)); }

TEST(TextTable, ReadsWhatRowsAreWrittenAs) {
  const std::vector<std::vector<std::string>> rows = {
      {"law", "note"}, {"wong", "a, b"}, {"\"quoted\"", "two\nlines"}, {"", ""}};
  std::string text;
  for (const auto& row : rows) text += csv_row(row);
  const Table table = parsed_table(text);
  EXPECT_EQ(table.head, rows[0]);
  EXPECT_EQ(table.rows, std::vector(rows.begin() + 1, rows.end()));
}

TEST(TextTable, ToleratesCarriageReturnsAndAMissingLastEnd) {
  const Table table = parsed_table("a,b\r\n1,2\r\n\r\n3,4");
  EXPECT_EQ(table.rows, (std::vector<std::vector<std::string>>{{"1", "2"}, {"3", "4"}}));
  EXPECT_TRUE(parsed_table("").head.empty());
}

TEST(TextTable, NamesTheLineOfABrokenRow) {
  for (const auto& [text, where] : {std::pair{"a,b\n\"x\ny\",2\n1,2,3\n", ":4: 3 fields, must be 2"},
                                    std::pair{"a,b\n1,2\n3,\"4\n5\n", ":3: a quote is not closed"}})
    EXPECT_TRUE(says(test::refusal([&, &broken = text] { parsed_table(broken); }), where));
}

TEST(TextTable, SaysOnceWhatEveryRowSays) {
  Table table = parsed_table("law,step_ms,failed,device\nwong,2.5,,cpu\ndahl,2.5,,cpu\n");
  EXPECT_EQ(take_common(table), "step [ms]: 2.5, device: cpu");
  EXPECT_EQ(table.head, (std::vector<std::string>{"law"}));
  Table single = parsed_table("law,device\nwong,cpu\n");
  EXPECT_EQ(take_common(single), "");
  EXPECT_EQ(single.head.size(), 2u);
}

TEST(TextTable, SetsNumbersToTheRightWithSixDigits) {
  const std::string html =
      text_table_html(parsed_table("law,2HB_N,count\nwong,0.00012345678,1170\ndahl,1e-8,\n"));
  for (const char* part : {"<th>law<th>2HB [N]", "<td>0.000123457<", "<td>1e-8<", "<td>1170\n", "<td>wong<"})
    EXPECT_TRUE(says(html, part));
}

// All but the first column are numbers unless a class says otherwise.
TEST(TextTable, MarksTextsBesideTheFirstColumnAndNumbersInIt) {
  const std::string html = text_table_html(parsed_table("count,note\n12,\"cut, twice\"\n7,\n"));
  for (const char* part : {"<th class=\"n\">count", "<td class=\"n\">12<", "<th class=\"t\">note",
                           "<td class=\"t\">cut, twice\n"})
    EXPECT_TRUE(says(html, part));
}

}  // namespace
}  // namespace hysteron::experiments
