// The letters are the chapter's: o is rest; a, b are elastic limits (+-K0, +-Ma); c, d reversals at +-Km; a',
// b' ends of the quadratic branches that begin there; g a reversal between Ma and 2 Ma; h, f residual
// curvatures.
#include "experiments/figures/figures.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/base/error.h"
#include "sim/bending/laws/law_run.h"
#include "sim/bending/laws/recovery.h"

namespace hysteron::experiments {
namespace {

using render::Mark;
using render::Plot;
using render::Series;

constexpr int kSteps = 200;     // points between two reversals
constexpr double kMilli = 1e3;  // mN in 1 N: moments are drawn in mN
constexpr const char* kBlue = "#0072B2";
constexpr const char* kOrange = "#D55E00";
constexpr const char* kGreen = "#007A55";
constexpr const char* kRed = "#C00000";
constexpr const char* kGrey = "#999999";

struct Trace {
  std::vector<double> curvature, moment;  // curvature [1/m], moment [N]
};

// Returns the path from rest to each reversal in order; legs before the first `drawn` are not kept.
Trace trace(const std::string& law, const VirginCurve& curve, const std::vector<double>& turns,
            const LawParameters& parameters = {}, std::size_t drawn = 0) {
  std::vector<LawRow> rows = {{0, 1, false}};
  double from = 0;
  for (double turn : turns) {
    for (int i = 1; i <= kSteps; ++i) rows.push_back({from + (turn - from) * i / kSteps, 1, false});
    from = turn;
  }
  const LawRun run = run_law({law, curve, parameters}, rows);
  Trace result;
  for (std::size_t i = drawn * kSteps; i < rows.size(); ++i) {
    result.curvature.push_back(rows[i].curvature);
    result.moment.push_back(run.moment[i]);
  }
  return result;
}

Series drawn(const Trace& trace, const std::string& label, const std::string& color, double width = 2.4) {
  Series series{.label = label, .x = trace.curvature, .y = {}, .color = color, .line_width = width};
  for (double moment : trace.moment) series.y.push_back(kMilli * moment);
  return series;
}

Series guide(std::vector<double> curvature, std::vector<double> moment) {
  Series series{.label = "",
                .x = std::move(curvature),
                .y = {},
                .style = Series::Style::dashed,
                .color = kGrey,
                .line_width = 1.2};
  for (double m : moment) series.y.push_back(kMilli * m);
  return series;
}

// Places a letter above and left of a rising curve, or below and right of it.
Mark above(const std::string& text, double curvature, double moment) {
  return {text, curvature, kMilli * moment, -0.8, 0.7};
}
Mark below(const std::string& text, double curvature, double moment) {
  return {text, curvature, kMilli * moment, 0.9, -0.7};
}
Mark beside(const std::string& text, double curvature, double moment, double dx) {
  return {text, curvature, kMilli * moment, dx, -0.4 * dx};
}
Mark words(const std::string& text, double curvature, double moment, double dx, double dy,
           const std::string& color = "#555555") {
  return {text, curvature, kMilli * moment, dx, dy, color, false};
}

Plot empty_plot(const std::string& title, double low_k, double high_k, double low_m, double high_m) {
  Plot plot{.title = title, .x = {}, .y = {}, .series = {}};
  plot.x = {"curvature K [1/m]", false, low_k, high_k};
  plot.y = {"moment per width M [mN]", false, kMilli * low_m, kMilli * high_m};
  plot.width = 1100;
  plot.height = 760;
  plot.axes_at_zero = plot.key_inside = true;
  return plot;
}

// The values that all figures of one fabric share.
struct Chapter {
  std::string fabric;
  VirginCurve curve;
  double m0, ma;  // friction moment, moment at the elastic limit [N]
  double full;    // a reversal from which recovery ends on the straight line, |M| > 2 Ma [1/m]

  // Moment on the upper straight line [N].
  double line(double curvature) const { return m0 + curve.b2 * curvature; }
  double curvature_at(double moment) const { return (moment - m0) / curve.b2; }
  double residual(const std::string& law, double curvature, double moment) const {
    return residual_by_formula(choose_law(law, curve, {}, LawUse::alone), curvature, moment);
  }
};

// Finds the same root on the computed branch, to compare with the closed form [1/m].
double residual_by_root(const Trace& branch) {
  for (std::size_t i = 1; i < branch.moment.size(); ++i) {
    const double a = branch.moment[i - 1], b = branch.moment[i];
    if (a > 0 && b <= 0)
      return branch.curvature[i - 1] + (branch.curvature[i] - branch.curvature[i - 1]) * a / (a - b);
  }
  return NAN;
}

Figure figure_4_2b(const Chapter& c) {
  const double k0 = c.curve.k0, end = 2.2 * k0, top = 1.12 * c.line(end);
  Plot plot =
      empty_plot("Figure 4.2(b): curvature and moment, " + c.fabric, -1.1 * end, 1.1 * end, -top, top);
  Trace both = trace("pabst", c.curve, {-end}), up = trace("pabst", c.curve, {end});
  std::reverse(both.curvature.begin(), both.curvature.end());
  std::reverse(both.moment.begin(), both.moment.end());
  both.curvature.insert(both.curvature.end(), up.curvature.begin(), up.curvature.end());
  both.moment.insert(both.moment.end(), up.moment.begin(), up.moment.end());
  plot.series = {drawn(both, "M(K), Eq. 4.2", kBlue)};
  for (double s : {1.0, -1.0}) {
    plot.series.push_back(guide({0, s * k0}, {s * c.m0, s * c.ma}));
    plot.series.push_back(guide({0, s * k0, s * k0}, {s * c.ma, s * c.ma, 0}));
    plot.series.push_back(guide({0, s * k0}, {0, s * c.curve.b1 * k0}));
    const std::string color = s > 0 ? kGreen : kRed;
    const auto axis_mark = [&](const std::string& name, double k, double m, double dx, double dy) {
      plot.marks.push_back({name, k, kMilli * m, dx, dy, color});
    };
    axis_mark("K₀", s * k0, 0, 0.7 * s, -0.8 * s);
    axis_mark("M₀", 0, s * c.m0, -0.8 * s, -0.1 * s);
    axis_mark("Mₐ", 0, s * c.ma, -0.8 * s, 0.2 * s);
  }
  plot.marks.push_back(above("a", k0, c.ma));
  plot.marks.push_back(below("b", -k0, -c.ma));
  plot.marks.push_back(words("slope b₁", k0, c.curve.b1 * k0, 0.8, 0));
  plot.marks.push_back(words("slope b₂", 1.6 * k0, c.line(1.6 * k0), 0.9, -1.2));
  plot.marks.push_back(words("o", 0, 0, 0.6, -0.7));
  return {"figure-4-2b",
          "The virgin curve, Eq. 4.2, by the law `pabst`: M = b1 K + c1 K² up to the transition curvature K0 "
          "(point a), M0 + b2 K beyond, odd in K; quantities of positive curvature green, of negative red. " +
              fmt::format("b1 = {:.4g} N m, b2 = {:.4g} N m, K0 = {:.4g}/m. ", c.curve.b1, c.curve.b2, k0) +
              "The chapter prints b1 ≤ b2. With its own c1 < 0, K0 = (b2 − b1)/(2 c1) would then be "
              "negative, and stiffness, which it says falls to b2, would grow: it must be b1 ≥ b2, as drawn.",
          plot};
}

// Draws a bending element in its own plane: the triangles (p2, p3, p0) and (p3, p2, p1), the wing of p1
// rotated by theta about the edge, seen at a slant so that the dihedral angle shows.  Lengths are in cm.
Figure figure_4_2a(const Chapter& c) {
  constexpr double kTurn = 50, kDegree = 3.14159265358979323846 / 180, kSlant = 0.45;
  const double s = std::sin(kTurn * kDegree), cosine = std::cos(kTurn * kDegree);
  struct Point {
    double x, y, z;
  };
  const auto seen = [&](const Point& p) { return std::array{p.x + kSlant * p.y, 0.6 * kSlant * p.y + p.z}; };
  const Point p0{-1.0, 0.9, 0}, p1{1.1 * cosine, 1.3, 1.1 * s}, p2{0, 0, 0}, p3{0, 2.4, 0};
  const Point flat{1.1, 1.3, 0}, foot0{0, 0.9, 0}, foot1{0, 1.3, 0};
  Plot plot{.title = "Figure 4.2(a): a bending element",
            .x = {"[cm]", false, -1.2, 2.4},
            .y = {"[cm]", false, -1, 1.5}};
  plot.width = 1100;
  plot.height = 760;
  plot.equal_scales = plot.key_inside = true;
  const auto line = [&](const std::string& label, const std::vector<Point>& points, const std::string& color,
                        Series::Style style = Series::Style::line) {
    Series series{.label = label, .x = {}, .y = {}, .style = style, .color = color};
    for (const Point& p : points) series.add(seen(p)[0], seen(p)[1]);
    plot.series.push_back(std::move(series));
  };
  line("triangle of p0", {p2, p3, p0, p2}, kBlue);
  line("triangle of p1", {p3, p2, p1, p3}, kOrange);
  line("the same, flat", {p2, flat, p3}, kGrey, Series::Style::dashed);
  line("", {flat, foot1}, kGrey, Series::Style::dashed);
  line("heights h0, h1", {p0, foot0}, kGreen, Series::Style::dashed);
  line("", {p1, foot1}, kGreen, Series::Style::dashed);
  line("common edge e", {p2, p3}, "#222222");
  const auto name = [&](const std::string& text, const Point& p, double dx, double dy) {
    plot.marks.push_back({text, seen(p)[0], seen(p)[1], dx, dy});
  };
  name("p₀", p0, -0.8, 0.4);
  name("p₁", p1, 0.8, 0.4);
  name("p₂", p2, 0.6, -0.8);
  name("p₃", p3, -0.8, 0.7);
  const Point between{0.3 * flat.x + 0.15 * p1.x, foot1.y, 0.15 * p1.z};  // heights of p1, flat and rotated
  plot.marks.push_back({"θ", seen(between)[0], seen(between)[1], 0, 0, "#555555", false});
  return {
      "figure-4-2a",
      "A bending element: two triangles with the common edge e = p3 − p2, turned against each other by the "
      "dihedral angle θ about it; h0 and h1 are their heights over the edge. Its curvature is K = (θ − θ0)/h "
      "with h the mean of the heights at rest (Eq. 4.1). The element does not depend on the fabric (" +
          c.fabric + " in the other figures).",
      plot, "x [cm],y [cm]"};
}

// Draws Eq. 4.3 by difference quotients of the law's own moments.
Figure stiffness_figure(const Chapter& c) {
  const double end = 2.2 * c.curve.k0;
  const Trace up = trace("pabst", c.curve, {end});
  constexpr double kMicro = 1e6;
  Plot plot = empty_plot("Eq. 4.3: bending stiffness B(K), " + c.fabric, -1.1 * end, 1.1 * end, 0, 1);
  plot.y = {"bending stiffness B = dM/dK [µN m]", false, 0, 1.15 * kMicro * c.curve.b1};
  Series b{.label = "B(K) of the law pabst", .x = {}, .y = {}, .color = kBlue};
  const auto add = [&](double sign, std::size_t i) {
    const double dk = up.curvature[i] - up.curvature[i - 1], dm = up.moment[i] - up.moment[i - 1];
    b.add(sign * (up.curvature[i] + up.curvature[i - 1]) / 2, kMicro * dm / dk);
  };
  for (std::size_t i = up.moment.size() - 1; i >= 1; --i) add(-1, i);
  for (std::size_t i = 1; i < up.moment.size(); ++i) add(1, i);
  plot.series = {b};
  for (const double sign : {1.0, -1.0}) {
    Series limit{
        .label = "", .x = {}, .y = {}, .style = Series::Style::dashed, .color = kGrey, .line_width = 1.2};
    limit.add(sign * c.curve.k0, 0);
    limit.add(sign * c.curve.k0, kMicro * c.curve.b2);
    plot.series.push_back(limit);
    plot.marks.push_back({sign > 0 ? "K₀" : "−K₀", sign * c.curve.k0, kMicro * c.curve.b2 / 2, 0.6 * sign, 0,
                          sign > 0 ? kGreen : kRed, false});
  }
  plot.marks.push_back({"b₁", 0, kMicro * c.curve.b1, 0.8, 0.4});
  plot.marks.push_back({"b₂", c.curve.k0, kMicro * c.curve.b2, 0.8, 0.7});
  return {"equation-4-3",
          "The bending stiffness of Eq. 4.3, B(K) = dM/dK of the virgin curve: b1 + 2 c1 |K| up to K0, b2 "
          "beyond. "
          "It falls from b1 to b2, which is why b1 ≥ b2 must hold where the chapter prints b1 ≤ b2.",
          plot, "curvature [1/m],bending stiffness [µN m]"};
}

Figure figure_4_3(const Chapter& c) {
  const double k0 = c.curve.k0, km = c.full, mm = c.line(km), inner = km - 2 * k0;
  const double m_inner = mm - 2 * c.ma, f = c.residual("prandtl", km, mm);
  Plot plot = empty_plot("Figure 4.3: the hysteresis loop, " + c.fabric, -1.15 * km, 1.15 * km, -1.18 * mm,
                         1.18 * mm);
  plot.series = {drawn(trace("prandtl", c.curve, {km, -km, km}, {}, 1), "loop", kBlue),
                 drawn(trace("prandtl", c.curve, {km}), "first bending, oac", kOrange, 2),
                 drawn(trace("prandtl", c.curve, {-km}), "the other way, obd", kGreen, 2),
                 guide({inner, inner}, {0, m_inner}), guide({km, km}, {0, mm})};
  plot.marks = {above("a", k0, c.ma),
                above("c", km, mm),
                beside("a′", inner, m_inner, 0.9),
                below("b", -k0, -c.ma),
                below("d", -km, -mm),
                beside("b′", -inner, -m_inner, -0.9),
                {"f", f, 0, 0.4, -0.9},
                words("o", 0, 0, 0.6, -0.7),
                words("Kₘ", km, 0, 0, -0.9),
                words("K₀′", inner, 0, 0.2, -0.9)};
  const double root = residual_by_root(trace("prandtl", c.curve, {km, -km}, {}, 1));
  return {
      "figure-4-3",
      "The loop by the law `prandtl`: first bending o-a-c, then c-a′ and d-b′ on the quadratic curves of "
      "Eqs. 4.4 and 4.5, each over 2 K0 and 2 Ma, C1 at a, a′, b and b′; b is the elastic limit of first "
      "bending the other way. " +
          fmt::format("Km = {:.4g}/m, K0′ = Km − 2 K0 = {:.4g}/m. ", km, inner) +
          fmt::format("f, where the moment is zero: {:.6g}/m = M0/b2 in closed form, {:.6g}/m on the "
                      "computed branch. ",
                      f, root) +
          "The law `wong` gives the same loop. The chapter promises the coefficients for partial reversals "
          "and does not give them; this full loop needs none.",
      plot};
}

Figure figure_4_4a(const Chapter& c) {
  const double k0 = c.curve.k0, km = c.full, mm = c.line(km), inner = km - 2 * k0;
  const double m_inner = mm - 2 * c.ma, f = c.residual("bilinear", km, mm);
  const double kg = c.curvature_at(1.5 * c.ma), h = c.residual("bilinear", kg, 1.5 * c.ma);
  Plot plot = empty_plot("Figure 4.4(a): the bilinear loop, " + c.fabric, -1.15 * km, 1.15 * km, -1.18 * mm,
                         1.18 * mm);
  plot.series = {drawn(trace("bilinear", c.curve, {km, inner, -km, -inner, km}, {}, 1), "loop", kBlue),
                 drawn(trace("bilinear", c.curve, {k0, km}), "first bending, oac", kOrange, 2),
                 drawn(trace("bilinear", c.curve, {-k0, -km}), "the other way, obd", kGreen, 2),
                 drawn(trace("bilinear", c.curve, {kg, h}, {}, 1), "recovery gh", "#CC79A7", 2)};
  plot.marks = {above("a", k0, c.ma),       above("c", km, mm),         beside("a′", inner, m_inner, 0.9),
                below("b", -k0, -c.ma),     below("d", -km, -mm),       beside("b′", -inner, -m_inner, -0.9),
                {"f", f, 0, 0.5, -0.9},     above("g", kg, 1.5 * c.ma), {"h", h, 0, -0.4, -0.9},
                words("o", 0, 0, -0.6, 0.7)};
  return {"figure-4-4a",
          "The bilinear model of Anandjiwala and Leaf 1991 by the law `bilinear`: slope Ma/K0 along o-a, b2 "
          "along a-c and a′-f, and Ma/K0 over 2 K0 after each reversal, along c-a′, d-b′ and g-h. " +
              fmt::format("Ma/K0 = {:.4g} N m, b2 = {:.4g} N m.", c.ma / k0, c.curve.b2),
          plot};
}

// Draws the levels Ma and 2 Ma, with their names at the left edge.
void draw_levels(const Chapter& c, double right, Plot& plot) {
  for (int i = 1; i <= 2; ++i) {
    if (kMilli * i * c.ma > plot.y.high) continue;
    plot.series.push_back(guide({0, right}, {i * c.ma, i * c.ma}));
    plot.marks.push_back(words(i == 1 ? "Mₐ" : "2Mₐ", 0, i * c.ma, -0.5, 0, kGreen));
  }
}

// Plots bending to `km` [1/m] and recovery to zero moment, bilinear and with the quadratic branch.
Plot recovery_plot(const Chapter& c, const std::string& title, double km, double residual) {
  const double mm = km > c.curve.k0 ? c.line(km) : c.curve.b1 * km + c.curve.c1() * km * km;
  const double right = 1.15 * std::max(km, c.curve.k0), level = mm > c.ma ? 2 * c.ma : c.ma;
  const double top = std::max(1.15 * mm, 1.1 * level);
  Plot plot = empty_plot(title + ", " + c.fabric, -0.1 * right, right, -0.26 * top, top);
  std::vector<double> corners = {std::min(km, c.curve.k0), km, std::max(residual, km - 2 * c.curve.k0),
                                 residual};
  const Trace quadratic = trace("prandtl", c.curve, {km, c.residual("prandtl", km, mm)});
  plot.series = {drawn(quadratic, "quadratic (prandtl)", "#E69F00", 2),
                 drawn(trace("bilinear", c.curve, corners), "bilinear (the chapter)", kBlue)};
  draw_levels(c, right, plot);
  plot.marks.push_back(words("o", 0, 0, -0.6, -0.7));
  return plot;
}

std::string residuals(const Chapter& c, double km) {
  std::string sentence;
  for (const char* law : {"bilinear", "prandtl"}) {
    const Trace whole = trace(law, c.curve, {km, -km});
    const double root = residual_by_root(trace(law, c.curve, {km, -km}, {}, 1));
    const double formula = c.residual(law, km, whole.moment[kSteps]);
    sentence += std::string(law) + fmt::format(": {:.6g}/m by formula, {:.6g}/m on the computed branch; ",
                                               formula, std::abs(root) < 1e-9 * km ? 0 : root);
  }
  sentence.resize(sentence.size() - 2);
  return "Residual curvature, " + sentence + ". ";
}

Figure figure_4_4b(const Chapter& c) {
  const double k0 = c.curve.k0, km = 0.8 * k0, slope = c.ma / k0;
  Plot plot = recovery_plot(c, "Figure 4.4(b): recovery, |M| ≤ |Mₐ|", km, 0);
  plot.series.push_back(drawn(trace("wong", c.curve, {km, 0}, {{"recovery", "reversible"}}, 1),
                              "wong, recovery = reversible", kGreen, 2));
  plot.series.push_back(guide({km, k0}, {slope * km, c.ma}));
  const double left = c.residual("prandtl", km, c.curve.b1 * km + c.curve.c1() * km * km);
  plot.marks.push_back(above("a", k0, c.ma));
  plot.marks.push_back(below("reversal", km, slope * km));
  plot.marks.push_back({"residual curvature", left, 0, 0.3, -0.8, "#B07800"});
  return {
      "figure-4-4b",
      fmt::format("Recovery from K = {:.4g}/m < K0. ", km) +
          "The chapter, arguing with the bilinear model, has the moment come back along o-a and nothing "
          "remain. Its quadratic branch (4.3.2) does not do that. " +
          residuals(c, km) +
          "So sections 4.3.2 and 4.3.3 disagree for small bends. The program keeps the branch "
          "(`recovery = masing`); `wong` with `recovery = reversible` goes back to o as 4.3.3 has it, on a "
          "path that is ours and loses |c1| K³/3, of which the chapter says nothing.",
      plot};
}

Figure figure_4_4c(const Chapter& c) {
  const double mg = 1.6 * c.ma, kg = c.curvature_at(mg), h = c.residual("bilinear", kg, mg);
  Plot plot = recovery_plot(c, "Figure 4.4(c): recovery, |Mₐ| < |M| ≤ 2|Mₐ|", kg, h);
  plot.marks.push_back(above("a", c.curve.k0, c.ma));
  plot.marks.push_back(above("g", kg, mg));
  plot.marks.push_back({"h", h, 0, 0.2, -0.8});
  return {
      "figure-4-4c",
      fmt::format("Recovery from g, K = {:.4g}/m, M = {:.3g} Ma: along g-h, parallel to o-a, to the residual "
                  "curvature at h. ",
                  kg, mg / c.ma) +
          residuals(c, kg) +
          "The chapter speaks of a residual bending moment: where the external forces are gone the moment "
          "is zero, and what remains is curvature.",
      plot};
}

Figure figure_4_4d(const Chapter& c) {
  const double km = c.full, mm = c.line(km), inner = km - 2 * c.curve.k0, f = c.residual("bilinear", km, mm);
  Plot plot = recovery_plot(c, "Figure 4.4(d): recovery, |M| > 2|Mₐ|", km, f);
  plot.marks.push_back(above("a", c.curve.k0, c.ma));
  plot.marks.push_back(above("c", km, mm));
  plot.marks.push_back(beside("a′", inner, mm - 2 * c.ma, 0.9));
  plot.marks.push_back({"f", f, 0, 0.7, -0.8});
  return {
      "figure-4-4d",
      fmt::format(
          "Recovery from c, K = {:.4g}/m, M = {:.3g} Ma: along c-a′, parallel to o-a, over 2 K0, then along "
          "a′-f with slope b2. ",
          km, mm / c.ma) +
          residuals(c, km) + "In this case both models leave M0/b2, the fabric's HB/B.",
      plot};
}

}  // namespace

std::vector<Figure> chapter_figures(const Fabric& fabric) {
  const VirginCurve curve = fabric.virgin_curve();
  if (!(curve.b1 > curve.b2 && curve.b2 > 0 && curve.k0 > 0)) {
    throw Error::invalid_input(fabric.name + " has no hysteresis loop to draw; it needs b1 > b2 > 0 " +
                               "and k0 > 0")
        .with_experiment("figures");
  }
  const double m0 = curve.friction_moment();
  const Chapter c{fabric.name, curve, m0, curve.elastic_limit_moment(), 2.5 * curve.k0 + m0 / curve.b2};
  return {figure_4_2a(c), figure_4_2b(c), stiffness_figure(c), figure_4_3(c),
          figure_4_4a(c), figure_4_4b(c), figure_4_4c(c),      figure_4_4d(c)};
}

}  // namespace hysteron::experiments
