// Tables on disk: what is read, what is refused, what is written.
#include "sim/base/csv.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/base/error.h"
#include "sim/base/plain_text.h"
#include "tests/sim/base/folder.h"
#include "tests/sim/base/refusal.h"

namespace hysteron::experiments {
namespace {

using test::says;
class Csv : public ::testing::Test {
 protected:
  std::string file(const std::string& text) { return folder_.write("in.csv", text); }
  std::string refusal(const std::string& text) {
    return test::refusal([&] { read_csv(file(text), {"curvature [1/m]"}, {"time [s]"}, "law"); });
  }
  const test::Folder folder_;
};

TEST_F(Csv, FindsColumnsByNameInAnyOrderAndIgnoresOthers) {
  const Table table =
      read_csv(file("\xEF\xBB\xBFnote, time [s] ,curvature [1/m]\r\n7,0,+1.5e1\r\n\r\n8,1,-2\r\n"),
               {"curvature [1/m]"}, {"time [s]", "edit"}, "law");
  EXPECT_EQ(table.numbers("curvature [1/m]"), (std::vector<double>{15, -2}));
  EXPECT_EQ(table.numbers("time [s]"), (std::vector<double>{0, 1}));
  EXPECT_FALSE(table.find("edit"));
  EXPECT_EQ(table.lines, (std::vector<int>{2, 4}));
}

TEST_F(Csv, ReadsTInSecondsAsTimeAndALengthOfThatNameAsNone) {
  const auto read = [&](const char* text) {
    return read_csv(file(text), {"curvature [1/m]"}, {"time [s]"}, "law");
  };
  EXPECT_EQ(read("curvature [1/m],t [s]\n1,5\n2,7\n").numbers("time [s]"), (std::vector<double>{5, 7}));
  EXPECT_FALSE(read("curvature [1/m],t [mm]\n1,5\n2,7\n").find("time [s]"));
  EXPECT_TRUE(says(refusal("curvature [1/m],t\n1,5\n"), "names no unit; its numbers must be in s"));
  EXPECT_TRUE(says(refusal("curvature [1/m],t [min]\n1,5\n"), "is in min and must be in s"));
  EXPECT_TRUE(says(refusal("curvature [1/m],t [s],time [s]\n1,5,5\n"), "column 'time [s]' stands twice"));
}

TEST_F(Csv, RefusesBadInputWithFileAndLine) {
  EXPECT_TRUE(says(refusal(""), "in.csv:1: column 'curvature [1/m]' is missing"));
  EXPECT_TRUE(says(refusal("curvature [1/cm]\n1\n"), "column 'curvature' is in 1/cm and must be in 1/m"));
  EXPECT_TRUE(
      says(refusal("curvature\n1\n"), "column 'curvature' names no unit; its numbers must be in 1/m"));
  EXPECT_TRUE(says(refusal("curvature [1/m],curvature [1/m]\n1,2\n"), "stands twice"));
  EXPECT_TRUE(says(refusal("curvature [1/m]\n1\ntwo\n"), "in.csv:3: curvature [1/m] = 'two'"));
  EXPECT_TRUE(says(refusal("curvature [1/m]\nnan\n"), "must be a finite number"));
  EXPECT_TRUE(says(refusal("curvature [1/m],time [s]\n1\n"), "in.csv:2: 1 fields, must be 2"));
  EXPECT_TRUE(says(refusal("curvature [1/m],time [s]\n\"0,5\",1\n"), "'0,5' must be a finite number"));
  EXPECT_TRUE(says(refusal("curvature [1/m]\n"), "no rows"));
}

// Semicolons and tabs leave the comma to the decimals; only the head tells what separates.
TEST_F(Csv, TellsSemicolonsAndTabsFromCommasByTheHead) {
  for (const char* text : {"note;curvature [1/m]\n\"a;b\";-1,5\n1,2,3;2,5e1\n",
                           "note\tcurvature [1/m]\na;b\t-1.5\n1,2,3\t2,5e1\n",
                           "\xEF\xBB\xBF\nnote,curvature [1/m]\na;b,-1.5\n\"1,2,3\",2.5e1\n"}) {
    EXPECT_EQ(read_csv(file(text), {"curvature [1/m]"}, {}, "law").numbers("curvature [1/m]"),
              (std::vector<double>{-1.5, 25}))
        << text;
    const Table words = read_table(file(text));
    EXPECT_EQ(words.rows[0][0], "a;b") << text;
    EXPECT_EQ(words.rows[1][0], "1,2,3") << text;
  }
}

// A mark before three digits may stand before decimals or between thousands; other numbers of the table tell
// it, or nothing does.
TEST_F(Csv, RefusesNumbersThatMayHaveThousands) {
  EXPECT_TRUE(
      says(refusal("curvature [1/m];time [s]\n0;0,0\n1.000;2,5\n"),
           "in.csv:3: curvature [1/m] = '1.000' may have a point before decimals or thousands: write 1000, "
           "or 1.0000 if these are decimals"));
  EXPECT_TRUE(
      says(refusal("curvature [1/m]\ttime [s]\n500.5\t1\n-1,000\t2\n"),
           "in.csv:3: curvature [1/m] = '-1,000' may have a comma before decimals or thousands: write -1000, "
           "or -1,0000 if these are decimals"));
  EXPECT_TRUE(says(refusal("curvature [1/m];time [s]\n1,000;0\n1,500;1\n"), "'1,000' may have"));
  const auto read = [&](const std::string& rows) {
    return read_csv(file("curvature [1/m];time [s]\n" + rows), {"curvature [1/m]"}, {}, "law")
        .numbers("curvature [1/m]");
  };
  EXPECT_EQ(read("1,125;0,5\n"), std::vector<double>{1.125});  // the time shows the comma
  EXPECT_EQ(read("1,1250;0\n"), std::vector<double>{1.125});   // four digits are decimals
  EXPECT_EQ(read("0,125;0\n1,125;0\n"), (std::vector<double>{0.125, 1.125}));
  EXPECT_EQ(read("1.125;0\n"), std::vector<double>{1.125});  // no comma anywhere
  // Columns that are not asked for may have such numbers.
  EXPECT_EQ(read_csv(file("note;curvature [1/m]\n1,000;2\n"), {"curvature [1/m]"}, {}, "law").rows[0][0],
            "1,000");
}

TEST_F(Csv, ReadsWhatSpreadsheetsAndTestersWrite) {
  const std::string rows = "curvature [1/m]\n1.5\n-2\n";
  const auto utf16 = [](const std::string& text, bool big_endian) {
    std::string bytes = big_endian ? "\xFE\xFF" : "\xFF\xFE";
    for (const char c : text) bytes += big_endian ? std::string{'\0', c} : std::string{c, '\0'};
    return bytes;
  };
  for (const std::string& text :
       {utf16(rows, false), utf16(rows, true), std::string("curvature [1/m]\r1.5\r-2\r"),
        std::string("Curvature (1/m)\n1.5\n-2\n"),
        std::string("CURVATURE\xC2\xA0[m^-1]\n\xC2\xA0"
                    "1.5\n-2\xC2\xA0\n"),
        std::string("# a tester\ncurvature [1/m]\n1.5\n # between rows\n-2\n"),
        std::string("# a tester\n# curvature [1/m]\n1.5\n-2\n"),  // numpy.savetxt
        std::string("curvature [1/m],note\n1.5,\xB7\n-2,Latin-1\n")})
    EXPECT_EQ(read_csv(file(text), {"curvature [1/m]"}, {}, "law").numbers("curvature [1/m]"),
              (std::vector<double>{1.5, -2}))
        << text;
  EXPECT_TRUE(says(refusal("# \"\ncurvature [1/m]\n# a\n\ntwo\n"), "in.csv:5: curvature [1/m] = 'two'"));
  // Words that begin like a comment are written in quotes.
  Table("name").write(folder_.file("words.csv"));
  EXPECT_EQ(csv_row({"#1", "a"}), "\"#1\",a\n");
}

TEST(PlainUnit, IsTheProgramsSpellingOfTheSameUnit) {
  for (const char* unit : {"gf cm/cm",
                           "gf\xC2\xB7"
                           "cm/cm",
                           "gf.cm/cm", "gf*cm / cm", " gf  cm/cm "})
    EXPECT_EQ(plain_unit(unit), "gf cm/cm") << unit;
  EXPECT_EQ(plain_unit("gf cm\xC2\xB2/cm"), plain_unit("gf cm^2/cm"));
  for (const char* unit : {"1/m", "m^-1", "m-1", "m\xE2\x81\xBB\xC2\xB9"})
    EXPECT_EQ(plain_unit(unit), "1/m") << unit;
  for (const char* unit : {"N", "N m/m", "N\xC2\xB7m/m"}) EXPECT_EQ(plain_unit(unit), "N") << unit;
  for (const char* unit : {"", "1", "-"}) EXPECT_EQ(plain_unit(unit), "") << unit;
  EXPECT_EQ(plain_unit("mm"), "mm");
  EXPECT_EQ(plain_unit("0.1 N"), "0.1 N");
}

TEST_F(Csv, RefusesAFileThatIsNotThereAsAFailureOfTheMachine) {
  for (const std::string& path : {folder_.file("missing.csv"), folder_.file("")})
    EXPECT_NE(test::refusal([&] { read_csv(path, {"curvature [1/m]"}, {}, "law"); }, 1), test::kAccepted);
}

TEST_F(Csv, NamesTheReaderTheFileAndTheLineOfARow) {
  const Table table = read_csv(file("curvature [1/m]\n1\n\n2\n"), {"curvature [1/m]"}, {}, "law");
  const Error error = table.refusal(1, "too sharp");
  EXPECT_EQ(error.what(), "law: " + folder_.file("in.csv") + ":4: too sharp");
  EXPECT_EQ(error.experiment(), "law");
}

TEST_F(Csv, WritesWordsAndNumbersAndReadsThemBack) {
  Table written("name,count,size [m],known");
  written.row({"a, \"b\"", 12, 1. / 3, true});
  written.row({"", std::size_t{0}, NAN, false});
  written.write(folder_.file("words.csv"));
  const Table table = read_table(folder_.file("words.csv"));
  EXPECT_EQ(table.head, (std::vector<std::string>{"name", "count", "size [m]", "known"}));
  EXPECT_EQ(table.rows,
            (std::vector<std::vector<std::string>>{{"a, \"b\"", "12", "0.333333", "1"}, {"", "0", "", "0"}}));
  EXPECT_EQ(table.lines, (std::vector<int>{2, 3}));
}

TEST_F(Csv, FindsRowsByWordsAndByNumbersAndColumnsByName) {
  const Table table = read_table(file("law,k,x\nwong,4.0,1\ndahl,4,\nwong,5,3\n"));
  EXPECT_EQ(table.where("law", "wong").only({"x", "y", "k"}).rows,
            (std::vector<std::vector<std::string>>{{"1", "4.0"}, {"3", "5"}}));
  EXPECT_EQ(table.where("k", "4").lines, (std::vector<int>{2, 3}));
  EXPECT_TRUE(std::isnan(table.number(1, "x")));
  EXPECT_TRUE(says(test::refusal([&] { table.numbers("x"); }), "in.csv:3: x = '' must be a finite"));
  EXPECT_TRUE(says(test::refusal([&] { table.at("y"); }), "in.csv has no column y"));
}

TEST_F(Csv, AlignsCellsInTheirWidths) {
  EXPECT_EQ(aligned({"law", "B", "", "x"}, {-5, 3, 4, -6}), "law     B      x");
  EXPECT_EQ(aligned({"a", "b", ""}, {1, -3}), "a b");
}

TEST_F(Csv, ReadsBackTheSameDoublesThatWereWritten) {
  const std::vector<double> values = {1. / 3, -2e-300, 6.02214076e23, 0};
  Table(std::vector<Column>{{"curvature [1/m]", values}}).write(folder_.file("out.csv"));
  EXPECT_EQ(read_csv(folder_.file("out.csv"), {"curvature [1/m]"}, {}, "law").numbers("curvature [1/m]"),
            values);
}

}  // namespace
}  // namespace hysteron::experiments
