#include "render/plot.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <optional>

#include "render/image.h"
#include "tests/render/test_scene.h"
#include "tests/sim/base/small_disk.h"

namespace hysteron::render {
namespace {

Plot parabola() {
  Plot plot{.title = "don't mix_up ^this^",
            .x = {.label = "curvature [1/m]"},
            .y = {.label = "energy [J/m²]"},
            .series = {},
            .width = 600,
            .height = 400};
  Series series{.label = "it's quoted", .x = {}, .y = {}};
  for (int i = -10; i <= 10; ++i) series.x.push_back(i), series.y.push_back(i * i);
  plot.series.push_back(series);
  return plot;
}

bool is_blue(const std::uint8_t* pixel) { return pixel[2] > pixel[0] + 100; }

using PlotTest = test::GnuplotTest;

// The key stays at the lower right where corners are alike.
TEST(KeyCorner, IsWhereAKeyCoversTheLeastOfTheData) {
  Plot plot = parabola();
  Series& points = plot.series[0];
  points.style = Series::Style::points;
  points.x = {0, 5, 10};
  points.y = {50, 0, 50};
  plot.y.high = 100;
  EXPECT_EQ(key_corner(plot), "right bottom");
  points.y = {50, 0, 2};
  EXPECT_EQ(key_corner(plot), "right top");
  points.y = {0, 98, 50};
  EXPECT_EQ(key_corner(plot), "right bottom");
  plot.series.push_back({"a line through it", {5, 10}, {50, -40}});
  plot.y.low = -40;
  EXPECT_EQ(key_corner(plot), "right top") << "lines are data between their points, too";
}

// Labels are text, not markup; two files of one plot are equal, though they are written at different times.
TEST_F(PlotTest, IsAPngAnSvgAndAPdfThatDoesNotSayWhenItWasWritten) {
  write_plot(folder_.file("p"), parabola());
  EXPECT_EQ(folder_.names(), (std::vector<std::string>{"p.pdf", "p.png", "p.svg"}));
  const Image image = read_png(folder_.file("p.png"));
  EXPECT_EQ(image.width(), 600);
  EXPECT_EQ(image.height(), 400);
  EXPECT_GT(test::count_pixels(image, is_blue), 300) << "the curve is drawn in the palette's first colour";
  const std::string svg = file_content(folder_.file("p.svg"));
  EXPECT_TRUE(says(svg, "mix_up ^this^"));
  EXPECT_TRUE(says(svg, "curvature [1/m]"));
  const std::string pdf = file_content(folder_.file("p.pdf"));
  EXPECT_TRUE(pdf.starts_with("%PDF-"));
  const std::size_t date = pdf.find("/CreationDate (D:");
  if (date != std::string::npos) {
    EXPECT_EQ(pdf.substr(date + 17, 8), "00000000");
  }
}

TEST_F(PlotTest, LineEndsAtAGap) {
  Plot plot = parabola();
  plot.series[0].color = "#123456";
  const auto lines = [&] {
    write_plot(folder_.file("p"), plot);
    const std::string svg = file_content(folder_.file("p.svg")),
                      path = "<path stroke='rgb( 18,  52,  86)'  d='";
    std::size_t begun = 0;
    for (std::size_t at = svg.rfind(path); at < svg.size() && svg[at] != '>'; ++at) begun += svg[at] == 'M';
    return begun;
  };
  const std::size_t whole = lines();  // the key's is one of them
  EXPECT_GE(whole, 1u);
  plot.series[0].y[10] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(lines(), whole + 1);
}

// The height of a text in an SVG [pixels from above]; -1 where it is not there once.
double text_height(const std::string& svg, const std::string& text) {
  const std::string drawn = ">" + text + "</tspan>";
  const std::size_t at = svg.find(drawn);
  if (at == std::string::npos || svg.find(drawn, at + 1) != std::string::npos) return -1;
  const std::size_t place = svg.rfind("translate(", at), comma = svg.find(',', place);
  return std::stod(svg.substr(comma + 1));
}

// Three lines, two of which end close to each other: labels stand in the order of their ends, apart.
TEST_F(PlotTest, LinesHaveTheirLabelsAtTheirEndsAndApart) {
  Plot plot = parabola();
  plot.series = {{"low", {0, 1}, {0, 0}}, {"high", {0, 1}, {0, 10}}, {"higher", {0, 1}, {0, 10.1}}};
  write_plot(folder_.file("p"), plot);
  const std::string svg = file_content(folder_.file("p.svg"));
  const double low = text_height(svg, "low"), high = text_height(svg, "high"),
               higher = text_height(svg, "higher");
  EXPECT_GT(higher, 0);
  EXPECT_GT(low, high + 100);
  EXPECT_GT(high, higher + 14) << "the letters are 14 pixels";
}

// A red and a green that are one colour for deuteranopes: the second line is dashed.
TEST_F(PlotTest, LinesThatColourDoesNotTellApartForEveryoneAreDashed) {
  Plot plot = parabola();
  plot.series = {{"narain", {0, 1}, {0, 0}, Series::Style::line, "#973023"},
                 {"prandtl", {0, 1}, {0, 10}, Series::Style::line, "#366700"}};
  const auto dashes = [&] {
    write_plot(folder_.file("p"), plot);
    const std::string svg = file_content(folder_.file("p.svg"));
    int count = 0;
    for (std::size_t at = 0; (at = svg.find("stroke-dasharray", at)) != svg.npos; ++at) ++count;
    return count;
  };
  const int with_green = dashes();
  plot.series[1].color = "#0072B2";
  EXPECT_GT(with_green, dashes()) << "blue and dark red are apart for all";
}

TEST_F(PlotTest, SmallNumbersTakeThePrefixOfTheirUnit) {
  Plot plot = parabola();
  for (double& y : plot.series[0].y) y *= 1e-5;  // 1 mJ/m² at most
  plot.note = "zero throughout: linear";
  write_plot(folder_.file("p"), plot);
  const std::string svg = file_content(folder_.file("p.svg"));
  EXPECT_TRUE(says(svg, "energy [mJ/m²]"));
  EXPECT_TRUE(says(svg, "curvature [1/m]")) << "of which there are no prefixes";
  EXPECT_TRUE(says(svg, "zero throughout: linear"));
  EXPECT_FALSE(says(svg, ">0.001<"));
}

TEST(SiPrefix, LeavesOneTo999) {
  for (const auto& [value, prefix] : {std::pair{0.00094, "µ"},
                                      {0.0013, "m"},
                                      {0.5, "m"},
                                      {1.0, ""},
                                      {999.7, "k"},
                                      {4.2e4, "k"},
                                      {-3e-8, "n"},
                                      {0.0, ""}})
    EXPECT_STREQ(si_prefix(value).prefix, prefix) << value;
}

TEST(BarErrors, ReachAsFarUpAsDownAndLeaveOutWhatIsNotKnown) {
  const Series lines = bar_errors({1, 2, 3}, {0.1, NAN, 0.3});
  ASSERT_EQ(lines.x.size(), 6u);
  EXPECT_EQ(lines.y[0], 0.9);
  EXPECT_EQ(lines.y[1], 1.1);
  EXPECT_TRUE(std::isnan(lines.y[2])) << "lines of two bars are not joined";
  EXPECT_EQ(lines.x[3], 2);
}

TEST(GroupedBars, StandSideBySideAroundTheirCategory) {
  const auto bars = grouped_bars({"a", "b"}, {{1, 2, 3}, {4, 5, 6}}, 0.4);
  ASSERT_EQ(bars.size(), 2u);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(bars[0].x[i], i - 0.2, 1e-15);
    EXPECT_NEAR(bars[1].x[i], i + 0.2, 1e-15);
    EXPECT_EQ(bars[1].y[i], 4 + i);
  }
}

TEST_F(PlotTest, BarsHaveTheirCategoriesBelowAndTheirHeights) {
  Plot plot{.title = "bars",
            .x = {.label = ""},
            .y = {.label = "height"},
            .series = {},
            .width = 600,
            .height = 400};
  plot.x.categories = {"short_one", "tall_one (71 %)"};
  plot.y.high = 4;
  plot.series = grouped_bars({""}, {{1, 4}}, plot.bar_width);
  write_plot(folder_.file("p"), plot);
  const std::string svg = file_content(folder_.file("p.svg"));
  for (const std::string& name : plot.x.categories) EXPECT_TRUE(says(svg, name));
  const Image image = read_png(folder_.file("p.png"));
  std::vector<int> blue(image.width());  // pixels of the bars in each column
  for (int x = 0; x < image.width(); ++x) blue[x] = test::count_pixels(image, is_blue, x, 0, x + 1);
  const int tallest = *std::max_element(blue.begin(), blue.end());
  const auto low = std::count_if(blue.begin(), blue.end(), [&](int n) { return n > 0 && n < tallest / 2; });
  const auto high = std::count_if(blue.begin(), blue.end(), [&](int n) { return n >= tallest - 2; });
  EXPECT_NEAR(low, high, 3) << "equally wide";
  EXPECT_GT(high, 100);
  EXPECT_EQ(std::count_if(blue.begin(), blue.end(), [&](int n) { return std::abs(n - tallest / 4.0) < 3; }),
            low);
}

TEST_F(PlotTest, WhatGnuplotCannotDrawFailsInOneLineAndLeavesNothing) {
  Plot plot = parabola();
  plot.series[0].y.assign(plot.series[0].y.size(), std::numeric_limits<double>::quiet_NaN());
  const Error error = thrown_error([&] { write_plot(folder_.file("p"), plot); });
  EXPECT_EQ(error.exit_code(), 1);
  EXPECT_TRUE(folder_.names().empty());
}

// Sets an environment variable until its end.
class Setting {
 public:
  Setting(const char* name, const std::string& value) : name_(name) {
    if (const char* before = std::getenv(name)) before_ = before;
    setenv(name, value.c_str(), 1);
  }
  ~Setting() { before_ ? setenv(name_, before_->c_str(), 1) : unsetenv(name_); }
  Setting(const Setting&) = delete;
  Setting& operator=(const Setting&) = delete;

 private:
  const char* name_;
  std::optional<std::string> before_{};
};

// A configuration that lists no folder of fonts and includes no other one, so that nothing of this machine or
// user is found.  gnuplot then draws a picture without a letter and ends well.
TEST_F(PlotTest, WithoutFontsIsRefused) {
  const Folder own;
  std::ofstream(own.file("fonts.conf"))
      << "<fontconfig><cachedir>" << own.file("cache") << "</cachedir></fontconfig>\n";
  const Setting file("FONTCONFIG_FILE", own.file("fonts.conf"));
  const Error error = thrown_error([&] { write_plot(folder_.file("p"), parabola()); });
  EXPECT_EQ(error.exit_code(), 1);
  EXPECT_TRUE(says(error.what(), "fonts-dejavu-core"));
  EXPECT_TRUE(folder_.names().empty());
}

TEST(Plot, MissingGnuplotNamesThePackage) {
  const Folder folder;
  const Setting path("PATH", folder.file("empty"));
  const Error error = thrown_error([&] { write_plot(folder.file("p"), parabola()); });
  EXPECT_EQ(error.exit_code(), 1);
  EXPECT_TRUE(says(error.what(), "gnuplot-nox"));
  EXPECT_TRUE(folder.names().empty());
}

// gnuplot ends well where a file could not be written to its end.
TEST_F(PlotTest, OnAFullDiskLeavesNoHalfOfAFile) {
  Error error = Error::system("");
  {
    const hysteron::test::SmallDisk disk(8192);
    error = thrown_error([&] { write_plot(folder_.file("plot"), parabola()); });
  }
  EXPECT_EQ(error.exit_code(), 1);
  EXPECT_TRUE(says(error.what(), "gnuplot did not write all of plot.", "is the disk full?"));
  EXPECT_TRUE(folder_.names().empty());
}

TEST(Plot, NothingToDrawIsRefused) {
  const Folder folder;
  EXPECT_EQ(thrown_error([&] { write_plot(folder.file("p"), Plot{}); }).exit_code(), 2);
  Plot uneven = parabola();
  uneven.series[0].x.pop_back();
  EXPECT_EQ(thrown_error([&] { write_plot(folder.file("p"), uneven); }).exit_code(), 2);
}

TEST(SeriesFromCsv, ReadsColumnsByNameWithOrWithoutUnit) {
  const Folder folder;
  std::ofstream(folder.file("m.csv")) << "time [s],angle [degree],count\n0,10,1\n0.5,,2\r\n1,-3e1,3\n";
  const Series series = series_from_csv(folder.file("m.csv"), "time", "angle [degree]", "angle");
  EXPECT_EQ(series.x, (std::vector<double>{0, 0.5, 1}));
  ASSERT_EQ(series.y.size(), 3u);
  EXPECT_EQ(series.y[0], 10);
  EXPECT_TRUE(std::isnan(series.y[1])) << "an empty cell is a gap";
  EXPECT_EQ(series.y[2], -30);
}

TEST(SeriesFromCsv, BadFilesAreRefusedWithTheirPlace) {
  const Folder folder;
  std::ofstream(folder.file("m.csv")) << "t,y\n0,1\n1,oops\n";
  EXPECT_EQ(thrown_error([&] { series_from_csv(folder.file("none.csv"), "t", "y", ""); }).exit_code(), 2);
  EXPECT_TRUE(
      says(thrown_error([&] { series_from_csv(folder.file("m.csv"), "t", "z", ""); }).what(), "t, y"));
  EXPECT_TRUE(
      says(thrown_error([&] { series_from_csv(folder.file("m.csv"), "t", "y", ""); }).what(), "m.csv:3"));
}

}  // namespace
}  // namespace hysteron::render
