// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/survey/floors_from_marks.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "waylode/site/plan_geojson.hpp"
#include "waylode/site/tangent_plane.hpp"

namespace waylode::survey {
namespace {

constexpr double kMargin_m = 10.0;

std::vector<const sample::WaypointSample*> marks_with_floor(
    std::span<const SurveyedRecording> recordings) {
  std::vector<const sample::WaypointSample*> marks;
  for (const SurveyedRecording& recording : recordings) {
    for (const sample::Sample& sample : recording.samples) {
      const auto* mark = std::get_if<sample::WaypointSample>(&sample);
      if (mark != nullptr && !mark->floor.empty()) marks.push_back(mark);
    }
  }
  return marks;
}

core::Vector2 position_of(const sample::WaypointSample& mark,
                          const std::optional<core::GeoPoint>& origin) {
  return origin ? site::enu_from_geo(*origin, *mark.geo_position) : *mark.position_m;
}

core::Bounds2 widened(const core::Bounds2& box) {
  const core::Vector2 margin_m = core::Vector2::Constant(kMargin_m);
  return {box.min_m - margin_m, box.max_m + margin_m};
}

}  // namespace

core::Result<site::SiteParts> floors_from_marks(std::string name,
                                                std::span<const SurveyedRecording> recordings) {
  const auto marks = marks_with_floor(recordings);
  if (marks.empty()) {
    return core::fail(core::ErrorCode::kSurveyInsufficient,
                      "no mark names its floor; name the floor of the logs or give a plan", name);
  }
  site::SiteParts parts;
  parts.name = std::move(name);
  parts.origin = marks.front()->geo_position;
  std::map<std::string, core::Bounds2> boxes;
  for (const sample::WaypointSample* mark : marks) {
    if (mark->geo_position.has_value() != parts.origin.has_value()) {
      return core::fail(core::ErrorCode::kSurveyInsufficient,
                        "some marks are georeferenced and others in floor metres; give a plan",
                        parts.name);
    }
    const core::Vector2 position_m = position_of(*mark, parts.origin);
    core::Bounds2& box =
        boxes.try_emplace(mark->floor, core::Bounds2{position_m, position_m}).first->second;
    box.min_m = box.min_m.cwiseMin(position_m);
    box.max_m = box.max_m.cwiseMax(position_m);
  }
  for (const auto& [floor_name, box] : boxes) {
    parts.floors.push_back(site::bare_floor(floor_name, widened(box)).floor);
  }
  std::ranges::stable_sort(parts.floors, {}, &site::Floor::level);
  return parts;
}

}  // namespace waylode::survey
