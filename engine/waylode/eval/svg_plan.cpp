// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/eval/detail/svg_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "waylode/core/assert.hpp"
#include "waylode/eval/html.hpp"
#include "waylode/eval/svg_chart.hpp"

namespace waylode::eval::detail {
namespace {

constexpr double kMargin_px = 28.0;
constexpr double kSmallestExtent_m = 12.0;
constexpr double kUnitsPerM = 10.0;  // Plans are drawn in whole decimetres: short paths.

struct Decimetres {
  long x;
  long y;
};

Decimetres decimetres(const core::Vector2& point_m) {
  return {std::lround(kUnitsPerM * point_m.x()), std::lround(kUnitsPerM * point_m.y())};
}

std::string ring_path(const site::Ring& ring) {
  std::string path;
  Decimetres last{0, 0};
  for (const core::Vector2& vertex : ring) {
    const Decimetres point = decimetres(vertex);
    if (path.empty()) {
      path = fmt::format("M{} {}l", point.x, point.y);
    } else if (point.x != last.x || point.y != last.y) {
      path += fmt::format("{} {} ", point.x - last.x, point.y - last.y);
    }
    last = point;
  }
  if (!path.empty() && path.back() == 'l') return {};
  return path.empty() ? path : path + "z";
}

std::string polygon_path(const site::Polygon& polygon) {
  std::string path = ring_path(polygon.outer);
  if (path.empty()) return {};
  for (const site::Ring& hole : polygon.holes) path += ring_path(hole);
  return "<path d=\"" + path + "\"/>";
}

std::string layer(const char* css, const std::string& content) {
  if (content.empty()) return {};
  return fmt::format("<g class=\"{}\">{}</g>", css, content);
}

std::string plan_svg(const site::Plan& plan) {
  std::string walkable;
  std::string obstacles;
  std::string rooms;
  std::string walls;
  for (const site::Polygon& polygon : plan.walkable) walkable += polygon_path(polygon);
  for (const site::Polygon& polygon : plan.obstacles) obstacles += polygon_path(polygon);
  for (const site::Room& room : plan.rooms) rooms += polygon_path(room.outline);
  for (const site::Wall& wall : plan.walls) {
    const Decimetres from = decimetres(wall.from_m);
    const Decimetres to = decimetres(wall.to_m);
    walls += fmt::format("M{} {}l{} {}", from.x, from.y, to.x - from.x, to.y - from.y);
  }
  if (!walls.empty()) walls = "<path d=\"" + walls + "\"/>";
  return layer("walkable", walkable) + layer("obstacle", obstacles) + layer("room", rooms) +
         layer("wall", walls);
}

}  // namespace

PlanView PlanView::around(const std::vector<core::Vector2>& points_m) {
  WAYLODE_ASSERT(!points_m.empty());
  core::Vector2 min_m = points_m.front();
  core::Vector2 max_m = points_m.front();
  for (const core::Vector2& point : points_m) {
    min_m = min_m.cwiseMin(point);
    max_m = max_m.cwiseMax(point);
  }
  const core::Vector2 extent_m = (max_m - min_m).cwiseMax(kSmallestExtent_m);
  return {0.5 * (min_m + max_m), std::min((kWidth_px - 2.0 * kMargin_px) / extent_m.x(),
                                          (kHeight_px - 2.0 * kMargin_px) / extent_m.y())};
}

core::Vector2 PlanView::pixels(const core::Vector2& point_m) const {
  const core::Vector2 offset_px = pixels_per_m * (point_m - centre_m);
  return {0.5 * kWidth_px + offset_px.x(), 0.5 * kHeight_px - offset_px.y()};
}

std::string PlanView::at(const core::Vector2& point_m) const {
  const core::Vector2 point_px = pixels(point_m);
  return coordinate(point_px.x()) + " " + coordinate(point_px.y());
}

std::string FloorPlans::use(const site::Site& site, core::FloorId floor, const PlanView& view) {
  const auto [entry, is_new] = numbers_.try_emplace({&site, floor.index}, drawings_.size());
  if (is_new) drawings_.push_back(plan_svg(site.floor(floor).plan));
  if (drawings_[entry->second].empty()) return {};
  const core::Vector2 origin_px = view.pixels(core::Vector2::Zero());
  const double scale = view.pixels_per_m / kUnitsPerM;
  return fmt::format(
      "<use href=\"#floor-{}\" transform=\"translate({} {}) scale({:.5g} -{:.5g})\"/>",
      entry->second, coordinate(origin_px.x()), coordinate(origin_px.y()), scale, scale);
}

std::string FloorPlans::definitions() const {
  std::string svg = "<svg class=\"definitions\" aria-hidden=\"true\"><defs>";
  for (std::size_t i = 0; i < drawings_.size(); ++i) {
    if (drawings_[i].empty()) continue;
    svg += fmt::format("<g id=\"floor-{}\" class=\"floor\">{}</g>\n", i, drawings_[i]);
  }
  return svg + "</defs></svg>\n";
}

std::string scale_bar_svg(const PlanView& view) {
  constexpr double kLeft_px = 14.0;
  constexpr double kBottom_px = PlanView::kHeight_px - 14.0;
  const double length_m = nice_step(PlanView::kWidth_px / view.pixels_per_m, 6);
  const double length_px = length_m * view.pixels_per_m;
  return fmt::format(
      "<path class=\"scalebar\" d=\"M{0} {1}v6h{2}v-6\"/><text class=\"tick\" x=\"{3}\" "
      "y=\"{4}\">{5:g} m</text>",
      kLeft_px, kBottom_px - 6.0, coordinate(length_px), coordinate(kLeft_px + length_px + 6.0),
      kBottom_px + 1.0, length_m);
}

}  // namespace waylode::eval::detail
