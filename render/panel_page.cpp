#include "render/panel_page.h"

#include "render/gnuplot.h"

namespace hysteron::render::gnuplot {

std::string PanelPage::point(double x, double y) const {
  return "screen " + number(across(x)) + "," + number(up(y));
}

std::string PanelPage::margins(int index) const {
  const int x = left + index % columns * (panel_width + gap_x),
            y = top + index / columns * (panel_height + gap_y);
  const auto margin = [](const char* side, double at) {
    return std::string("set ") + side + "margin at screen " + number(at) + "\n";
  };
  return margin("l", across(x)) + margin("r", across(x + panel_width)) + margin("t", up(y)) +
         margin("b", up(y + panel_height));
}

std::string text_at(const std::string& text, const std::string& place, const std::string& style) {
  return "set label " + label_text(text) + " at " + place + " " + style + "\n";
}

std::string page_texts(const PanelPage& page, const std::string& title, const std::string& subtitle,
                       const std::string& x_label, const std::string& y_label) {
  const double middle = page.left + (page.width() - page.left - page.right) / 2.0;
  const double beside = page.top + (page.height() - page.top - page.bottom) / 2.0;
  return text_at(title, page.point(page.left, 28), "left font ',19'") +
         text_at(subtitle, page.point(page.left, 56), "left font ',13' textcolor rgb '#555555'") +
         text_at(x_label, page.point(middle, page.height() - 16), "center font ',15'") +
         text_at(y_label, page.point(22, beside), "center rotate by 90 font ',15'");
}

}  // namespace hysteron::render::gnuplot
