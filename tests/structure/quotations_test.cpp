// What docs/ quotes of the sources is what they say: the examples that newcomers follow are run by tests.
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <string>
#include <vector>

#include "sim/base/whole_file.h"

namespace hysteron {
namespace {
namespace fs = std::filesystem;

struct Quotation {
  std::string file, text;
};

// <!-- FILE:begin -->, a fenced block, <!-- FILE:end -->
std::vector<Quotation> page_quotations(const std::string& page) {
  static const std::regex kBegin("<!-- (tests/\\S+):begin -->\n```[a-z]*\n");
  std::vector<Quotation> all;
  for (std::sregex_iterator match(page.begin(), page.end(), kBegin), end; match != end; ++match) {
    const std::string file = (*match)[1];
    const std::size_t from = match->position() + match->length(),
                      to = page.find("```\n<!-- " + file + ":end -->", from);
    all.push_back({file, to == page.npos ? "no end of the quotation" : page.substr(from, to - from)});
  }
  return all;
}

TEST(Quotations, InTheDocumentationAreTheFilesTheyName) {
  const fs::path root = HYSTERON_SOURCE_FOLDER;
  int quotations = 0;
  for (const auto& page : fs::directory_iterator(root / "docs")) {
    if (page.path().extension() != ".md") continue;
    for (const Quotation& quotation :
         page_quotations(whole_file(page.path().string(), "reading quotations"))) {
      EXPECT_EQ(quotation.text, whole_file((root / quotation.file).string(), "reading what is quoted"))
          << quotation.file << " in " << page.path();
      ++quotations;
    }
  }
  EXPECT_EQ(quotations, 1) << "a script of Python";
}

TEST(Quotations, WithoutAnEndOrWithOtherTextAreFound) {
  const auto found = page_quotations(
      "<!-- tests/a.h:begin -->\n```cpp\nint a;\n```\n<!-- tests/a.h:end -->\n"
      "<!-- tests/b.h:begin -->\n```cpp\nint b;\n```\n");
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].text, "int a;\n");
  EXPECT_EQ(found[1].text, "no end of the quotation");
}

}  // namespace
}  // namespace hysteron
