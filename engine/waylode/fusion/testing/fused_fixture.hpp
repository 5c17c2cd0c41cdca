// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <vector>

#include "waylode/fusion/fused_tracker.hpp"
#include "waylode/fusion/testing/planar_model.hpp"

namespace waylode::fusion::testing {

/// Three floors: 0 lies as the site does, 1 is turned by +90 degrees and then moved by (10, 0), 2
/// is turned by -30 degrees and then moved by (-5, 8).
inline std::shared_ptr<const site::Site> three_floor_site() {
  site::SiteParts parts;
  parts.name = "house";
  parts.floors.resize(3);
  for (std::size_t i = 0; i < 3; ++i) {
    parts.floors[i].name = std::string("F").append(std::to_string(i + 1));
    parts.floors[i].level = static_cast<int>(i);
    parts.floors[i].bounds.max_m = {60.0, 40.0};
  }
  parts.floors[1].site_from_floor.linear << 0.0, -1.0, 1.0, 0.0;
  parts.floors[1].site_from_floor.translation_m = {10.0, 0.0};
  parts.floors[2].site_from_floor.linear = rotation(-std::acos(-1.0) / 6.0);
  parts.floors[2].site_from_floor.translation_m = {-5.0, 8.0};
  return std::make_shared<const site::Site>(std::move(parts));
}

/// Every option set; Gaussian, never lost.
inline FusedTracker::Options fused_options() {
  FusedTracker::Options options;
  options.planar = gaussian_options();
  options.floor.change_probability = 0.02;
  options.floor.vote_weight = 0.5;
  options.state.ok_radius_m = 15.0;
  options.state.show_radius_m = 40.0;
  options.state.floor_probability = 0.8;
  options.state.known_share_ratio = 0.35;
  return options;
}

/// What one floor makes of a scan; 4 m of error per axis.
struct Heard {
  std::uint16_t floor = 0;
  double log_likelihood = 0.0;
  core::Vector2 position_m = core::Vector2::Zero();  ///< Floor frame.
};

/// A scan delivered at a time and measured `delay_s` before.
inline observation::RadioObservation heard(double delivered_s, std::vector<Heard> floors,
                                           double known_share_ratio = 1.0, double delay_s = 0.0) {
  std::ranges::stable_sort(floors, std::greater{}, &Heard::log_likelihood);
  observation::RadioObservation scan;
  scan.measured = at_s(delivered_s - delay_s);
  scan.delivered = at_s(delivered_s);
  scan.known_share_ratio = known_share_ratio;
  for (const Heard& one : floors) {
    observation::FloorHypothesis hypothesis;
    hypothesis.floor.index = one.floor;
    hypothesis.log_likelihood = one.log_likelihood;
    hypothesis.position_m = one.position_m;
    hypothesis.covariance_m2 = 16.0 * core::Matrix2::Identity();
    scan.floors.push_back(hypothesis);
  }
  return scan;
}

}  // namespace waylode::fusion::testing
