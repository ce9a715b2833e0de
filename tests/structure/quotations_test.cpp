// What docs/ quotes of the sources is what they say: the examples that newcomers follow are compiled and
// tested.
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
std::vector<Quotation> quotations_of(const std::string& page) {
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
  int laws = 0, experiments = 0, obstacles = 0, others = 0;
  for (const auto& page : fs::directory_iterator(root / "docs")) {
    if (page.path().extension() != ".md") continue;
    for (const Quotation& quotation : quotations_of(whole_file(page.path().string(), "reading quotations"))) {
      EXPECT_EQ(quotation.text, whole_file((root / quotation.file).string(), "reading what is quoted"))
          << quotation.file << " in " << page.path();
      laws += quotation.file.starts_with("tests/examples/law/");
      experiments += quotation.file.starts_with("tests/examples/experiment/");
      obstacles += quotation.file.starts_with("tests/examples/obstacle/");
      others +=
          std::regex_search(quotation.file, std::regex("^tests/examples/(hinge|consumer|paraview|python)/"));
    }
  }
  EXPECT_EQ(laws, 2) << "header, test";
  EXPECT_EQ(experiments, 2) << "source, test";
  EXPECT_EQ(obstacles, 2) << "row, distance";
  EXPECT_EQ(others, 6)
      << "hinge loop, program of a simulation, its CMakeLists.txt, scripts of Python and ParaView";
}

TEST(Quotations, WithoutAnEndOrWithOtherTextAreFound) {
  const auto found = quotations_of(
      "<!-- tests/a.h:begin -->\n```cpp\nint a;\n```\n<!-- tests/a.h:end -->\n"
      "<!-- tests/b.h:begin -->\n```cpp\nint b;\n```\n");
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].text, "int a;\n");
  EXPECT_EQ(found[1].text, "no end of the quotation");
}

}  // namespace
}  // namespace hysteron
