// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/structure/walk.hpp"

#include <cmath>
#include <set>
#include <string_view>
#include <utility>

#include "waylode/core/assert.hpp"

namespace waylode::structure {
namespace {

using core::Result;

tl::unexpected<core::Error> invalid(std::string message, std::string place) {
  return core::fail(core::ErrorCode::kInvalidArgument, std::move(message), std::move(place));
}

bool is_positive(double value) { return std::isfinite(value) && value > 0.0; }

Result<void> check(const WalkedSegment& segment, const std::string& place) {
  if (!std::isfinite(segment.length_m) || segment.length_m < 0.0) {
    return invalid("a segment's length is no number of zero or more; measure it again", place);
  }
  if (!std::isfinite(segment.direction_rad)) {
    return invalid("a segment's direction is no number; measure it again", place);
  }
  if (!is_positive(segment.length_sigma_m) || !is_positive(segment.direction_sigma_rad)) {
    return invalid("a segment's sigmas are not above zero; say how exact it is", place);
  }
  if (segment.end < segment.begin) return invalid("a segment ends before it begins", place);
  return {};
}

Result<void> check(const Walk& walk, const std::string& place) {
  for (std::size_t i = 0; i < walk.segments.size(); ++i) {
    const std::string here = place + " segment " + std::to_string(i);
    if (auto checked = check(walk.segments[i], here); !checked) return checked;
    if (i == 0) continue;
    const WalkedSegment& before = walk.segments[i - 1];
    if (walk.segments[i].begin < before.end) {
      return invalid("a segment begins before the last one ends; put them in order", here);
    }
    const std::string& ended_at = before.end_landmark;
    const std::string& began_at = walk.segments[i].begin_landmark;
    if (!ended_at.empty() && !began_at.empty() && ended_at != began_at) {
      return invalid("a segment begins at " + began_at + " but the last one ended at " + ended_at +
                         "; name one of them",
                     here);
    }
  }
  return {};
}

Result<void> check(const KnownDistance& known, const std::set<std::string_view>& landmarks) {
  const std::string place = "known distance " + known.from + ":" + known.to;
  if (!is_positive(known.metres) || !is_positive(known.sigma_m)) {
    return invalid("a distance or its sigma is not above zero; give metres", place);
  }
  if (known.from == known.to) return invalid("a distance needs two different landmarks", place);
  for (const std::string& name : {known.from, known.to}) {
    if (!landmarks.contains(name)) {
      return invalid("no walk has a landmark of this name; mark it on a walk", place);
    }
  }
  return {};
}

}  // namespace

const std::string& Walk::landmark_at(std::size_t visit) const {
  WAYLODE_ASSERT(visit < visit_count());
  if (visit == segments.size()) return segments.back().end_landmark;
  const std::string& began_at = segments[visit].begin_landmark;
  return visit == 0 || !began_at.empty() ? began_at : segments[visit - 1].end_landmark;
}

Result<void> Survey::validate() const {
  std::set<std::string_view> landmarks;
  for (std::size_t i = 0; i < walks.size(); ++i) {
    if (auto checked = check(walks[i], "walk " + std::to_string(i)); !checked) return checked;
    for (std::size_t visit = 0; visit < walks[i].visit_count(); ++visit) {
      landmarks.insert(walks[i].landmark_at(visit));
    }
  }
  landmarks.erase("");
  for (const KnownDistance& known : known_distances) {
    if (auto checked = check(known, landmarks); !checked) return checked;
  }
  return {};
}

}  // namespace waylode::structure
