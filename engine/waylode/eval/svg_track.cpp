// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "waylode/core/angle.hpp"
#include "waylode/core/covariance.hpp"
#include "waylode/eval/detail/svg_plan.hpp"
#include "waylode/eval/html.hpp"
#include "waylode/eval/svg_chart.hpp"

namespace waylode::eval::detail {
namespace {

// More ellipses and error lines than this on one drawing hide it.
constexpr std::size_t kMostEllipses = 40;

/// A scored fix as it is drawn on the truth's floor.
struct DrawnFix {
  const TruthPoint* truth = nullptr;
  core::Vector2 position_m = core::Vector2::Zero();  ///< Frame of the truth's floor.
  const core::Belief* belief = nullptr;
  bool on_right_floor = false;
};

std::vector<DrawnFix> fixes_on(const EvaluatedTrack& track, core::FloorId floor) {
  std::vector<DrawnFix> drawn;
  for (std::size_t i = 0; i < track.truths.size(); ++i) {
    const TruthPoint& truth = track.truths[i];
    const std::optional<core::Belief>& belief = track.fixes[i].belief;
    if (!truth.scored || truth.floor != floor || !belief || !belief->position_m.allFinite()) {
      continue;
    }
    const bool right = belief->floor == floor;
    const core::Vector2 position_m =
        right ? belief->position_m
              : track.site->floor_from_site(
                    floor, track.site->site_from_floor(belief->floor, belief->position_m));
    drawn.push_back({&truth, position_m, &*belief, right});
  }
  return drawn;
}

std::string ellipse_path(const DrawnFix& fix, const PlanView& view) {
  const core::Ellipse ellipse = core::confidence_ellipse(fix.belief->covariance_m2, 0.95);
  const double major_px = ellipse.semi_major_m * view.pixels_per_m;
  const double minor_px = ellipse.semi_minor_m * view.pixels_per_m;
  const double dx_px = major_px * std::cos(ellipse.major_axis_rad);
  const double dy_px = -major_px * std::sin(ellipse.major_axis_rad);
  const core::Vector2 centre_px = view.pixels(fix.position_m);
  // Two half ellipses from one end of the major axis to the other and back.
  const std::string radii =
      fmt::format("a{} {} {:.0f} 1 0 ", coordinate(major_px), coordinate(minor_px),
                  -core::degrees_from_radians(ellipse.major_axis_rad));
  return fmt::format("M{} {}{}{} {}{}{} {}", coordinate(centre_px.x() + dx_px),
                     coordinate(centre_px.y() + dy_px), radii, coordinate(-2.0 * dx_px),
                     coordinate(-2.0 * dy_px), radii, coordinate(2.0 * dx_px),
                     coordinate(2.0 * dy_px));
}

std::string path(const char* css, const std::string& d) {
  return d.empty() ? d : fmt::format("<path class=\"{}\" d=\"{}\"/>", css, d);
}

std::string fixes_svg(const MethodTrack& method, const std::string& name, core::FloorId floor,
                      const PlanView& view) {
  const std::vector<DrawnFix> fixes = fixes_on(*method.track, floor);
  if (fixes.empty()) return {};
  const std::size_t stride = (fixes.size() + kMostEllipses - 1) / kMostEllipses;
  std::string ellipses;
  std::string errors;
  std::string walk;
  std::string dots;
  std::string crosses;
  for (std::size_t i = 0; i < fixes.size(); ++i) {
    const DrawnFix& fix = fixes[i];
    const std::string at = view.at(fix.position_m);
    walk.append(i == 0 ? "M" : "L").append(at);
    if (fix.on_right_floor) {
      dots.append("M").append(at).append("h0");
    } else {
      crosses.append("M").append(at).append("m-3.5-3.5l7 7m0-7l-7 7");
    }
    if (i % stride != 0) continue;
    errors.append("M").append(view.at(fix.truth->position_m)).append("L").append(at);
    if (fix.on_right_floor && core::is_valid_covariance(fix.belief->covariance_m2)) {
      ellipses += ellipse_path(fix, view);
    }
  }
  return fmt::format("<g class=\"{}\" data-m=\"{}\"><title>{}: mean error {} m</title>",
                     method_classes(method.method), method.method, escape_html(name),
                     html_number(method.mean_m, 2)) +
         path("ellipse", ellipses) + path("errorline", errors) + path("fixline", walk) +
         path("dots", dots) + path("cross", crosses) + "</g>";
}

std::string truth_svg(const EvaluatedTrack& track, core::FloorId floor, const PlanView& view) {
  std::string walk;
  std::string scored;
  std::string before;
  std::string start;
  bool left_floor = true;
  for (const TruthPoint& truth : track.truths) {
    if (truth.floor != floor) {
      left_floor = true;
      continue;
    }
    const std::string at = view.at(truth.position_m);
    walk.append(left_floor ? "M" : "L").append(at);
    (truth.scored ? scored : before).append("M").append(at).append("h0");
    if (start.empty()) start.append("M").append(at).append("h0");
    left_floor = false;
  }
  return "<g class=\"truth\"><title>truth; the ring is its start on this floor</title>" +
         path("startring", start) + path("startdisc", start) + path("truthline", walk) +
         path("waypoint before", before) + path("waypoint", scored) + "</g>";
}

std::vector<core::FloorId> floors_walked(const EvaluatedTrack& track) {
  std::vector<core::FloorId> floors;
  for (const TruthPoint& truth : track.truths) {
    if (std::find(floors.begin(), floors.end(), truth.floor) == floors.end()) {
      floors.push_back(truth.floor);
    }
  }
  return floors;
}

std::string drawing(const Recording& recording, const std::vector<MethodErrors>& methods,
                    core::FloorId floor, FloorPlans& plans) {
  const EvaluatedTrack& first = *recording.methods.front().track;
  std::vector<core::Vector2> points_m;
  for (const TruthPoint& truth : first.truths) {
    if (truth.floor == floor) points_m.push_back(truth.position_m);
  }
  for (const MethodTrack& method : recording.methods) {
    for (const DrawnFix& fix : fixes_on(*method.track, floor)) points_m.push_back(fix.position_m);
  }
  const PlanView view = PlanView::around(points_m);
  const std::string floor_name = escape_html(first.site->floor(floor).name);
  std::string svg = fmt::format(
      "<svg class=\"plan\" viewBox=\"0 0 {:g} {:g}\" role=\"img\" aria-label=\"{} on floor {}\">",
      PlanView::kWidth_px, PlanView::kHeight_px, escape_html(first.name), floor_name);
  svg += plans.use(*first.site, floor, view);
  for (const MethodTrack& method : recording.methods) {
    svg += fixes_svg(method, methods[method.method].name, floor, view);
  }
  svg += truth_svg(first, floor, view) + scale_bar_svg(view);
  svg += fmt::format("<text class=\"tick end halo\" x=\"{:g}\" y=\"20\">floor {}</text>",
                     PlanView::kWidth_px - 12.0, floor_name);
  return svg + "</svg>";
}

/// What the drawing cannot show by position alone: "1 on a wrong floor, 2 without a position".
std::string remarks(const EvaluatedTrack& track) {
  std::size_t wrong = 0;
  std::size_t absent = 0;
  for (const PointError& error : track_errors(track)) {
    if (!error.has_belief) {
      ++absent;
    } else if (error.floors_wrong > 0) {
      ++wrong;
    }
  }
  std::string text;
  if (wrong > 0) text = fmt::format("{} on a wrong floor", wrong);
  if (absent > 0) text += fmt::format("{}{} without a position", text.empty() ? "" : ", ", absent);
  return text.empty() ? text : fmt::format(" ({})", text);
}

}  // namespace

std::string recording_figure(const Recording& recording, const std::vector<MethodErrors>& methods,
                             FloorPlans& plans) {
  const EvaluatedTrack& first = *recording.methods.front().track;
  const std::vector<core::FloorId> floors = floors_walked(first);
  std::string html = floors.size() > 1 ? "<figure class=\"track wide\"><div class=\"floors\">"
                                       : "<figure class=\"track\"><div class=\"floors\">";
  for (const core::FloorId floor : floors) html += drawing(recording, methods, floor, plans);
  html += fmt::format(
      "</div><figcaption><strong>{}</strong> <span class=\"dim\">{}, {} truths, {} s</span>",
      escape_html(first.name), escape_html(first.group), first.truths.size(),
      html_number(first.walked_s, 0));
  html += "<br/><span class=\"dim\">mean error</span>";
  for (const MethodTrack& method : recording.methods) {
    html += fmt::format(
        " <span class=\"{} pair\" data-m=\"{}\"><span class=\"swatch\"></span>{} "
        "<b>{}&#160;m</b>{}</span>",
        method_classes(method.method), method.method, escape_html(methods[method.method].name),
        html_number(method.mean_m, 2), remarks(*method.track));
  }
  return html + "</figcaption></figure>\n";
}

}  // namespace waylode::eval::detail
