// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/eval/svg_file.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "waylode/eval/html.hpp"

namespace waylode::eval {
namespace {

constexpr double kTitle_px = 30.0;
constexpr double kLegendLine_px = 20.0;
constexpr double kMargin_px = 8.0;

/// Literal colours, for viewers that do not know custom properties; those of the report's page in
/// light ([OkabeIto2008]).
constexpr const char* kStyle = R"css(
text { fill: #5d6878; font: 12px system-ui, "Noto Sans", "DejaVu Sans", sans-serif; }
.title { fill: #1b2330; font-size: 15px; font-weight: 600; }
.legendtext { fill: #1b2330; font-size: 13px; }
.mid { text-anchor: middle; } .end { text-anchor: end; }
.label { font-size: 12.5px; } .guidelabel { font-size: 11px; }
.grid { stroke: #edf0f4; } .axis { stroke: #8a94a3; }
.guide { stroke: #8a94a3; stroke-dasharray: 4 4; } .cursor { stroke: none; }
.c0 { color: #0072b2; } .c1 { color: #d55e00; } .c2 { color: #009e73; } .c3 { color: #b5579a; }
.c4 { color: #b98000; } .c5 { color: #3a9fd8; } .c6 { color: #7a5230; } .c7 { color: #5b6470; }
.k1 .line { stroke-dasharray: 7 3; } .k2 .line { stroke-dasharray: 2 3; }
.line, .fixline { fill: none; stroke: currentColor; stroke-width: 2; stroke-linejoin: round; }
.dots { fill: none; stroke: currentColor; stroke-width: 6.5; stroke-linecap: round; }
.ellipse { fill: currentColor; fill-opacity: 0.08; stroke: currentColor; stroke-opacity: 0.6; }
.errorline { fill: none; stroke: currentColor; stroke-dasharray: 1.5 3; }
.cross { fill: none; stroke: currentColor; stroke-width: 2; }
.scans { fill: none; stroke: #d55e00; stroke-width: 4; stroke-linecap: round; opacity: 0.55; }
.survey { fill: none; stroke: #c4c9d1; stroke-width: 3; stroke-linecap: round; }
.floor path { vector-effect: non-scaling-stroke; fill-rule: evenodd; }
.walkable { fill: #fbfcfd; stroke: #c9ced7; } .obstacle { fill: #e2e5ea; stroke: #c9ced7; }
.room { fill: none; stroke: #c9ced7; } .wall { fill: none; stroke: #98a1ae; stroke-width: 1.4; }
.truthline { fill: none; stroke: #1b2330; stroke-width: 1.6; opacity: 0.75; }
.waypoint { fill: none; stroke: #1b2330; stroke-width: 5; stroke-linecap: round; }
.waypoint.before { opacity: 0.4; }
.startring { stroke: #1b2330; stroke-width: 13; stroke-linecap: round; }
.startdisc { stroke: #fbfcfd; stroke-width: 9.5; stroke-linecap: round; }
.scalebar { fill: none; stroke: #1b2330; stroke-width: 1.5; }
.halo { paint-order: stroke; stroke: #ffffff; stroke-width: 3px; }
)css";

/// The drawing's own <svg> put into a box of the file.
std::string placed(const SvgDrawing& drawing, double x_px) {
  const std::string box = fmt::format("<svg x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" ",
                                      coordinate(x_px), coordinate(kTitle_px),
                                      coordinate(drawing.width_px), coordinate(drawing.height_px));
  constexpr std::string_view kTag = "<svg ";
  return box + drawing.svg.substr(std::min(drawing.svg.size(), kTag.size()));
}

}  // namespace

std::string svg_file(const std::vector<SvgDrawing>& drawings, const std::string& title,
                     const std::vector<LegendEntry>& legend, const std::string& definitions) {
  std::string body;
  double width_px = kMargin_px;
  double height_px = 0.0;
  for (const SvgDrawing& drawing : drawings) {
    body += placed(drawing, width_px);
    width_px += drawing.width_px + kMargin_px;
    height_px = std::max(height_px, drawing.height_px);
  }
  double y_px = kTitle_px + height_px + kLegendLine_px;
  for (const LegendEntry& entry : legend) {
    body += fmt::format(
        "<g class=\"{}\"><path class=\"line\" d=\"M{} {}h22\"/></g><text class=\"legendtext\" "
        "x=\"{}\" y=\"{}\">{}</text>\n",
        entry.classes, coordinate(2.0 * kMargin_px), coordinate(y_px - 4.0),
        coordinate(2.0 * kMargin_px + 30.0), coordinate(y_px), escape_html(entry.text));
    y_px += kLegendLine_px;
  }
  return fmt::format(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" "
             "height=\"{1}\">\n<style>{2}</style>\n<rect width=\"100%\" height=\"100%\" "
             "fill=\"#ffffff\"/>\n",
             coordinate(width_px), coordinate(y_px), kStyle) +
         definitions +
         fmt::format("<text class=\"title\" x=\"{}\" y=\"20\">{}</text>\n", coordinate(kMargin_px),
                     escape_html(title)) +
         body + "</svg>\n";
}

}  // namespace waylode::eval
