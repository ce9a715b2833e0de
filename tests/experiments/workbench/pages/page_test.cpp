#include "experiments/workbench/pages/page.h"

#include <gtest/gtest.h>

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
  EXPECT_NE(still.find("<title>A &amp; B</title>\n<style>\n:root"), std::string::npos);
  EXPECT_NE(still.find("</style></head>\n<body>\n<p>still</p>\n</body></html>\n"), std::string::npos);
  EXPECT_EQ(still.find("<script>"), std::string::npos);
  EXPECT_NE(moving.find("<body class=\"gallery\">\n<div class=\"player\"></div>\n<script>\n"),
            std::string::npos);
}

}  // namespace
}  // namespace hysteron::experiments
