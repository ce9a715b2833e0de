#include "experiments/workbench/pages/page.h"

#include "tests/experiments/folder.h"

namespace hysteron::experiments {
namespace {

TEST(Template, RepeatsAListAndLeavesOutWhatIsEmpty) {
  EXPECT_EQ(html_table({"law", "2HB [N]"}, {{"wong", "0.5"}, {"<b>", ""}}, {1}),
            "<div class=\"scroll\"><table>\n<thead><tr><th>law<th>2HB [N]\n</thead>\n"
            "<tbody><tr><td>wong<td>0.5\n<tr><td>&lt;b&gt;<td>\n"
            "</tbody></table></div>\n");
  EXPECT_EQ(html_table({}, {}, {}),
            "<div class=\"scroll\"><table>\n<thead><tr>\n</thead>\n<tbody></tbody></table></div>\n");
}

TEST(Template, OfADocumentHasItsScriptWhereSomethingMoves) {
  const std::string still = html_page("A & B", "<p>still</p>\n"),
                    moving = html_page("t", "<div class=\"player\"></div>\n", "gallery");
  EXPECT_TRUE(still.starts_with("<!doctype html>\n<html lang=\"en\">"));
  EXPECT_TRUE(says(still, "<title>A &amp; B</title>\n<style>\n:root"));
  EXPECT_TRUE(says(still, "</style></head>\n<body>\n<p>still</p>\n</body></html>\n"));
  EXPECT_FALSE(says(still, "<script>"));
  EXPECT_TRUE(says(moving, "<body class=\"gallery\">\n<div class=\"player\"></div>\n<script>\n"));
}

}  // namespace
}  // namespace hysteron::experiments
