// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/survey/quality.hpp"

#include <algorithm>
#include <cmath>

#include "waylode/core/angle.hpp"
#include "waylode/site/floor_geometry.hpp"

namespace waylode::survey {
namespace {

constexpr double kTellingLength_m = 3.0;

template <typename T>
double median(std::vector<T> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return static_cast<double>(*middle);
}

bool is_telling(const LabelledPath::Stretch& stretch) {
  return stretch.marked_m >= kTellingLength_m && stretch.reckoned_m >= kTellingLength_m;
}

double step_scale(std::span<const LabelledPath::Stretch> stretches) {
  std::vector<double> scales;
  for (const LabelledPath::Stretch& stretch : stretches) {
    if (is_telling(stretch)) scales.push_back(stretch.marked_m / stretch.reckoned_m);
  }
  return scales.empty() ? 1.0 : median(std::move(scales));
}

}  // namespace

std::optional<double> heading_offset(std::span<const LabelledPath::Stretch> stretches) {
  constexpr std::size_t kFewestStretches = 10;
  std::vector<double> turns_rad;
  std::vector<double> weights;
  for (const LabelledPath::Stretch& stretch : stretches) {
    if (!is_telling(stretch)) continue;
    turns_rad.push_back(stretch.turn_rad);
    weights.push_back(stretch.marked_m);
  }
  if (turns_rad.size() < kFewestStretches) return std::nullopt;
  std::optional<core::CircularMean> centre = core::circular_mean(turns_rad, weights);
  // Reweighted rounds: walks with the phone held askew count less.
  constexpr int kRounds = 5;
  constexpr double kCommonSpread_rad = 0.2;
  for (int round = 0; round < kRounds && centre; ++round) {
    for (std::size_t i = 0; i < turns_rad.size(); ++i) {
      const double deviation =
          core::wrap_angle(turns_rad[i] - centre->mean_rad) / kCommonSpread_rad;
      weights[i] = 1.0 / (1.0 + deviation * deviation);
    }
    centre = core::circular_mean(turns_rad, weights);
  }
  return centre ? std::optional(centre->mean_rad) : std::nullopt;
}

double covered_ratio(const site::Floor& floor,
                     std::span<const site::FingerprintRecord> fingerprints, double reach_m) {
  if (fingerprints.empty()) return 0.0;
  core::Bounds2 box{{1e30, 1e30}, {-1e30, -1e30}};
  for (const site::FingerprintRecord& record : fingerprints) {
    const core::Vector2 place(static_cast<double>(record.x_m), static_cast<double>(record.y_m));
    box.min_m = box.min_m.cwiseMin(place);
    box.max_m = box.max_m.cwiseMax(place);
  }
  if (!floor.plan.walkable.empty()) box = floor.bounds;
  const auto columns = static_cast<int>(std::ceil(box.size_m().x())) + 1;
  const auto rows = static_cast<int>(std::ceil(box.size_m().y())) + 1;
  std::vector<char> near(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), 0);
  const auto cell = [&](int column, int row) -> char& {
    return near[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                static_cast<std::size_t>(column)];
  };
  const int reach = static_cast<int>(std::ceil(reach_m));
  for (const site::FingerprintRecord& record : fingerprints) {
    const core::Vector2 place(static_cast<double>(record.x_m), static_cast<double>(record.y_m));
    const core::Vector2 offset = place - box.min_m;
    const int column = static_cast<int>(std::lround(offset.x()));
    const int row = static_cast<int>(std::lround(offset.y()));
    for (int r = std::max(0, row - reach); r <= std::min(rows - 1, row + reach); ++r) {
      for (int q = std::max(0, column - reach); q <= std::min(columns - 1, column + reach); ++q) {
        if ((core::Vector2(q, r) - offset).norm() <= reach_m) cell(q, r) = 1;
      }
    }
  }
  const site::FloorGeometry geometry(floor.plan);
  std::size_t walkable = 0;
  std::size_t covered = 0;
  for (int r = 0; r < rows; ++r) {
    for (int q = 0; q < columns; ++q) {
      const core::Vector2 point = box.min_m + core::Vector2(q, r);
      if (!floor.plan.walkable.empty() && !geometry.is_walkable(point)) continue;
      ++walkable;
      if (cell(q, r) != 0) ++covered;
    }
  }
  return walkable == 0 ? 0.0 : static_cast<double>(covered) / static_cast<double>(walkable);
}

std::vector<FloorQuality> floor_quality(
    const site::SiteParts& parts, const std::vector<std::vector<LabelledPath::Stretch>>& stretches,
    const std::vector<std::set<std::uint32_t>>& recordings) {
  std::vector<std::vector<site::FingerprintRecord>> by_floor(parts.floors.size());
  for (const site::FingerprintRecord& record : parts.radio_map.fingerprints) {
    by_floor[record.floor].push_back(record);
  }
  std::vector<std::uint64_t> transmitters(parts.floors.size(), 0);
  for (std::size_t i = 0; i + 1 < parts.radio_map.posting_begin.size(); ++i) {
    std::set<std::uint16_t> floors;
    for (std::uint32_t p = parts.radio_map.posting_begin[i];
         p < parts.radio_map.posting_begin[i + 1]; ++p) {
      floors.insert(parts.radio_map.fingerprints[parts.radio_map.postings[p].fingerprint].floor);
    }
    for (const std::uint16_t floor : floors) ++transmitters[floor];
  }

  std::vector<FloorQuality> result;
  for (std::size_t i = 0; i < parts.floors.size(); ++i) {
    constexpr double kCoverReach_m = 3.0;
    FloorQuality quality;
    quality.floor = parts.floors[i].name;
    quality.recordings = recordings[i].size();
    quality.fingerprints = by_floor[i].size();
    quality.transmitters = transmitters[i];
    std::vector<std::uint16_t> counts;
    for (const auto& record : by_floor[i]) counts.push_back(record.reading_count);
    quality.median_transmitters_per_fingerprint = median(std::move(counts));
    for (const auto& stretch : stretches[i]) quality.surveyed_m += stretch.marked_m;
    quality.covered_ratio = covered_ratio(parts.floors[i], by_floor[i], kCoverReach_m);
    quality.heading_offset_rad = parts.floors[i].heading_offset_rad;
    quality.step_scale = step_scale(stretches[i]);
    result.push_back(std::move(quality));
  }
  return result;
}

}  // namespace waylode::survey
