#include "tools/session/svg_chart.h"

#include <fmt/format.h>

#include "tools/session/chart_marks.h"
#include "tools/session/chart_plane.h"

namespace sparsight {
namespace {

using Kind = ChartSeries::Kind;

std::string line(const char* ink, double x1, double y1, double x2, double y2) {
  return fmt::format(R"(<line class="{}" x1="{:.1f}" y1="{:.1f}" x2="{:.1f}" y2="{:.1f}"/>)", ink,
                     x1, y1, x2, y2);
}

std::string text(const char* place, double x, double y, const std::string& words) {
  return fmt::format(R"(<text class="{}" x="{:.1f}" y="{:.1f}">{}</text>)", place, x, y,
                     escaped(words));
}

std::string x_axis(const Chart& chart, const ChartPlane& plane) {
  std::string svg;
  const double label_y = plane.bottom() + 17.0;
  for (std::size_t i = 0; i < chart.x_names.size(); ++i) {
    const double x = plane.at({static_cast<double>(i), 0.0}).x();
    svg += text("below", x, label_y, chart.x_names[i]);
  }
  if (chart.x_names.empty()) {
    const Ticks ticks = plane.x_ticks();
    for (const double position : ticks.positions) {
      const double x = plane.at({position, 0.0}).x();
      svg += line("grid", x, plane.top(), x, plane.bottom());
      svg += text("below", x, label_y, ticks.label(position));
    }
  }
  const double middle = 0.5 * (plane.left() + plane.right());
  return svg + text("below label", middle, plane.bottom() + 37.0, chart.x_label);
}

std::string y_axis(const Chart& chart, const ChartPlane& plane) {
  std::string svg;
  const Ticks ticks = plane.y_ticks();
  for (const double position : ticks.positions) {
    const double y = plane.at({0.0, position}).y();
    svg += line("grid", plane.left(), y, plane.right(), y);
    svg += text("before", plane.left() - 7.0, y + 4.0, ticks.label(position));
  }
  const double middle = 0.5 * (plane.top() + plane.bottom());
  svg += fmt::format(
      R"svg(<text class="below label" transform="translate(13 {:.1f}) rotate(-90)">)svg", middle);
  return svg + escaped(chart.y_label) + "</text>";
}

std::string legend_of(const Chart& chart) {
  std::string legend;
  for (const ChartSeries& series : chart.series) {
    if (series.name.empty() || series.points.empty()) continue;
    const bool filled = series.kind == Kind::kDots || series.kind == Kind::kBars;
    const char* sample = filled                      ? R"(<path class="dots {0}" d="M9 6h0"/>)"
                         : series.kind == Kind::kRug ? R"(<path class="stroke {0}" d="M9 1v10"/>)"
                                                     : R"(<path class="stroke {0}" d="M0 6h18"/>)";
    legend += fmt::format(R"(<span><svg class="sample" viewBox="0 0 18 12">{}</svg>{}</span>)",
                          fmt::format(fmt::runtime(sample), series.ink), escaped(series.name));
  }
  return legend;
}

}  // namespace

std::string figure_of(const Chart& chart) {
  const ChartPlane plane(chart);
  std::string svg = x_axis(chart, plane) + y_axis(chart, plane);
  for (const ChartSeries& series : chart.series) svg += drawing_of(series, plane);
  svg += line("axis", plane.left(), plane.bottom(), plane.right(), plane.bottom());
  return fmt::format(
      "<figure><figcaption><b>{0}</b>{1}</figcaption>\n"
      R"(<svg viewBox="0 0 {2} {3}" role="img" aria-label="{0}">{4}</svg></figure>)"
      "\n",
      escaped(chart.title), legend_of(chart), chart.width_px, chart.height_px, svg);
}

std::string escaped(const std::string& words) {
  std::string html;
  for (const char c : words) {
    switch (c) {
      case '&':
        html += "&amp;";
        break;
      case '<':
        html += "&lt;";
        break;
      case '>':
        html += "&gt;";
        break;
      case '"':
        html += "&quot;";
        break;
      default:
        html += c;
    }
  }
  return html;
}

}  // namespace sparsight
