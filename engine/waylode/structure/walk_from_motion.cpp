// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/structure/walk_from_motion.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "waylode/core/angle.hpp"
#include "waylode/pdr/displacement_segmenter.hpp"

namespace waylode::structure {
namespace {

using core::Result;
using observation::MotionDelta;

tl::unexpected<core::Error> invalid(std::string message, std::size_t index) {
  return core::fail(core::ErrorCode::kInvalidArgument, std::move(message),
                    "motion " + std::to_string(index));
}

/// The steps that move the person.
Result<std::vector<MotionDelta>> steps_of(std::span<const MotionDelta> motion) {
  std::vector<MotionDelta> steps;
  for (std::size_t i = 0; i < motion.size(); ++i) {
    const MotionDelta& delta = motion[i];
    const bool usable = std::isfinite(delta.length_m) && delta.length_m >= 0.0 &&
                        std::isfinite(delta.heading_rad) && std::isfinite(delta.length_sigma_m) &&
                        std::isfinite(delta.heading_sigma_rad);
    if (!usable) return invalid("a step is no usable number; check the recording", i);
    const bool in_order =
        delta.begin <= delta.end &&
        (i == 0 || (motion[i - 1].begin <= delta.begin && motion[i - 1].end <= delta.end));
    if (!in_order) return invalid("steps are not in order of time; sort them", i);
    if (delta.length_m > 0.0) steps.push_back(delta);
  }
  return steps;
}

/// Steps [first, last) in about one direction.
struct Piece {
  std::size_t first = 0;
  std::size_t last = 0;
  double direction_rad = 0.0;

  std::size_t size() const { return last - first; }
};

std::vector<Piece> pieces_of(const std::vector<MotionDelta>& steps, double tolerance_rad) {
  pdr::DisplacementSegmenter segmenter({tolerance_rad});
  std::vector<Piece> pieces;
  const auto take = [&](const std::optional<pdr::Displacement>& displacement) {
    if (!displacement) return;
    const std::size_t first = pieces.empty() ? 0 : pieces.back().last;
    pieces.push_back({first, first + displacement->step_count, displacement->direction_rad});
  };
  for (const MotionDelta& step : steps) take(segmenter.add(step));
  take(segmenter.finish());
  return pieces;
}

/// The pieces long enough to be corridors; two that a dodge has parted are one again. All pieces
/// when none is long.
std::vector<Piece> straights_of(const std::vector<Piece>& pieces,
                                const SegmentationOptions& options) {
  std::vector<Piece> straights;
  for (const Piece& piece : pieces) {
    if (piece.size() < options.least_steps) continue;
    const bool goes_on =
        !straights.empty() &&
        std::abs(core::wrap_angle(piece.direction_rad - straights.back().direction_rad)) <=
            options.largest_deviation_rad;
    if (goes_on) {
      straights.back().last = piece.last;
    } else {
      straights.push_back(piece);
    }
  }
  return straights.empty() ? pieces : straights;
}

/// Where one segment ends and the next begins: before step `step`, at a place of the walk's frame.
struct Break {
  std::size_t step = 0;
  core::Vector2 place_m = core::Vector2::Zero();
  std::string landmark;
};

core::Vector2 unit(double direction_rad) {
  return {std::cos(direction_rad), std::sin(direction_rad)};
}

/// Before each step, and at the end; the walk begins in the origin.
std::vector<core::Vector2> places_of(const std::vector<MotionDelta>& steps) {
  std::vector<core::Vector2> places_m{core::Vector2::Zero()};
  for (const MotionDelta& step : steps) {
    places_m.push_back(places_m.back() + step.length_m * unit(step.heading_rad));
  }
  return places_m;
}

/// A straight as a line: through the middle of its places, along its direction.
struct Line {
  core::Vector2 middle_m;
  core::Vector2 along;
};

Line line_of(const Piece& piece, const std::vector<core::Vector2>& places_m) {
  core::Vector2 sum_m = core::Vector2::Zero();
  for (std::size_t i = piece.first; i <= piece.last; ++i) sum_m += places_m[i];
  return {sum_m / static_cast<double>(piece.size() + 1), unit(piece.direction_rad)};
}

/// Where the corridors meet that a corner was cut between; nullopt where they hardly turn.
std::optional<core::Vector2> crossing(const Line& before, const Line& after) {
  const auto cross = [](const core::Vector2& a, const core::Vector2& b) {
    return a.x() * b.y() - a.y() * b.x();
  };
  const double turn = cross(before.along, after.along);
  constexpr double kLeastTurn = 0.34;  // Sine of 20 degrees.
  if (std::abs(turn) < kLeastTurn) return std::nullopt;
  const double way_m = cross(after.middle_m - before.middle_m, after.along) / turn;
  return before.middle_m + way_m * before.along;
}

/// The walk's ends and its corners.
std::vector<Break> breaks_of(const std::vector<Piece>& straights,
                             const std::vector<core::Vector2>& places_m) {
  std::vector<Break> breaks{{0, places_m.front(), ""}};
  for (std::size_t i = 1; i < straights.size(); ++i) {
    const std::size_t middle = (straights[i - 1].last + straights[i].first + 1) / 2;
    const auto corner_m =
        crossing(line_of(straights[i - 1], places_m), line_of(straights[i], places_m));
    breaks.push_back({middle, corner_m.value_or(places_m[middle]), ""});
  }
  breaks.push_back({places_m.size() - 1, places_m.back(), ""});
  return breaks;
}

/// Walked until before each step, and in all.
std::vector<double> distances_m(const std::vector<MotionDelta>& steps) {
  std::vector<double> walked_m{0.0};
  for (const MotionDelta& step : steps) walked_m.push_back(walked_m.back() + step.length_m);
  return walked_m;
}

/// Names the nearest break in reach, or breaks the walk where the mark was set.
Result<void> put(const LandmarkMark& mark, const std::vector<MotionDelta>& steps,
                 const std::vector<double>& walked_m, const std::vector<core::Vector2>& places_m,
                 double reach_m, std::vector<Break>& breaks) {
  const auto next =
      std::ranges::find_if(steps, [&](const MotionDelta& step) { return step.end > mark.time; });
  const auto step = static_cast<std::size_t>(next - steps.begin());
  const auto off_m = [&](const Break& each) {
    return std::abs(walked_m[each.step] - walked_m[step]);
  };
  const auto nearest = std::ranges::min_element(breaks, {}, off_m);
  const bool is_free = nearest->landmark.empty() || nearest->landmark == mark.name;
  if (is_free && off_m(*nearest) <= reach_m) {
    nearest->landmark = mark.name;
    return {};
  }
  if (nearest->step == step) {
    return core::fail(core::ErrorCode::kInvalidArgument,
                      "two landmarks are marked at one step; keep one of them",
                      nearest->landmark + ", " + mark.name);
  }
  const auto behind =
      std::ranges::find_if(breaks, [&](const Break& each) { return each.step > step; });
  breaks.insert(behind, {step, places_m[step], mark.name});
  return {};
}

bool in_straight(const std::vector<Piece>& straights, std::size_t step) {
  return std::ranges::any_of(
      straights, [&](const Piece& piece) { return piece.first <= step && step < piece.last; });
}

/// Direction by the steps outside turns, length from break to break along it.
WalkedSegment segment_of(const std::vector<MotionDelta>& steps, const std::vector<Piece>& straights,
                         const Break& begin, const Break& end, const SegmentationOptions& options) {
  std::vector<std::size_t> straight;
  std::vector<double> headings_rad;
  for (std::size_t i = begin.step; i < end.step; ++i) {
    if (in_straight(straights, i)) straight.push_back(i);
  }
  const bool all_turning = straight.empty();
  for (std::size_t i = begin.step; all_turning && i < end.step; ++i) straight.push_back(i);
  double heading_variance = 0.0;
  for (const std::size_t i : straight) {
    headings_rad.push_back(steps[i].heading_rad);
    heading_variance += steps[i].heading_sigma_rad * steps[i].heading_sigma_rad;
  }
  WalkedSegment segment;
  const auto mean = core::circular_mean(headings_rad);
  segment.direction_rad = mean ? mean->mean_rad : headings_rad.front();
  double length_variance_m2 = 0.0;
  for (std::size_t i = begin.step; i < end.step; ++i) {
    length_variance_m2 += steps[i].length_sigma_m * steps[i].length_sigma_m;
  }
  segment.length_m = std::max(0.0, (end.place_m - begin.place_m).dot(unit(segment.direction_rad)));
  constexpr double kLeastSigma_m = 0.01;
  segment.length_sigma_m = std::max(
      kLeastSigma_m,
      std::hypot(std::sqrt(length_variance_m2), options.length_sigma_ratio * segment.length_m));
  segment.direction_sigma_rad =
      std::hypot(options.direction_sigma_rad,
                 std::sqrt(heading_variance) / static_cast<double>(headings_rad.size()));
  segment.begin = steps[begin.step].begin;
  segment.end = steps[end.step - 1].end;
  segment.begin_landmark = begin.landmark;
  segment.end_landmark = end.landmark;
  return segment;
}

}  // namespace

Result<void> SegmentationOptions::validate() const {
  const bool in_range = largest_deviation_rad >= 0.05 && largest_deviation_rad <= 1.0 &&
                        least_steps >= 1 && mark_reach_m >= 0.0 && mark_reach_m <= 20.0 &&
                        length_sigma_ratio >= 0.001 && length_sigma_ratio <= 0.5 &&
                        direction_sigma_rad >= 0.001 && direction_sigma_rad <= 1.0;
  if (in_range) return {};
  return core::fail(core::ErrorCode::kInvalidOptions, "an option is out of its range",
                    "segmentation");
}

Result<Walk> walk_from_motion(std::span<const MotionDelta> motion,
                              std::span<const LandmarkMark> marks,
                              const SegmentationOptions& options) {
  if (auto checked = options.validate(); !checked) return tl::unexpected(checked.error());
  const auto steps = steps_of(motion);
  if (!steps) return tl::unexpected(steps.error());
  Walk walk;
  if (steps->empty()) return walk;
  const auto straights = straights_of(pieces_of(*steps, options.largest_deviation_rad), options);
  const std::vector<core::Vector2> places_m = places_of(*steps);
  std::vector<Break> breaks = breaks_of(straights, places_m);
  const std::vector<double> walked_m = distances_m(*steps);
  for (const LandmarkMark& mark : marks) {
    if (mark.name.empty()) continue;
    if (auto done = put(mark, *steps, walked_m, places_m, options.mark_reach_m, breaks); !done) {
      return tl::unexpected(done.error());
    }
  }
  for (std::size_t i = 1; i < breaks.size(); ++i) {
    walk.segments.push_back(segment_of(*steps, straights, breaks[i - 1], breaks[i], options));
    if (i == 1) continue;
    // Steps of one recording may overlap by a little; segments do not.
    WalkedSegment& segment = walk.segments.back();
    segment.begin = std::max(segment.begin, walk.segments[i - 2].end);
  }
  return walk;
}

}  // namespace waylode::structure
