// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <vector>

#include "waylode/core/fix.hpp"
#include "waylode/core/result.hpp"
#include "waylode/core/time.hpp"
#include "waylode/magnetic/features.hpp"
#include "waylode/magnetic/field_grid.hpp"
#include "waylode/observation/observation.hpp"

namespace waylode::magnetic {

namespace detail {
struct PathField;
}

/// Where the last seconds of walking fit the magnetic map: the path's shape is dead reckoning's, it
/// is shifted about until the field along it differs least from the map's ([Zhou2016] eq. (10)).
/// One phone's.
class SequenceMatcher {
 public:
  struct Options {
    double window_s =
        6.0;  ///< Of walking matched at once. 2 s is too short where the field repeats.
    double spacing_m = 0.3;        ///< Field readings are averaged over this much of the path.
    double shortest_path_m = 2.0;  ///< A window walked less than this is not matched.
    double least_known_ratio =
        0.8;                     ///< Share of the window that must have a field and lie on the map.
    double step_m = 0.2;         ///< Between the shifts that are tried.
    double search_sigmas = 3.0;  ///< Of the prior: how far around it is searched ...
    double narrowest_search_m = 1.5;  ///< ... no less than this ...
    double widest_search_m = 8.0;     ///< ... and no more. Cost goes with the square.
    double largest_turn_rad = 0.2;    ///< The path is tried turned by up to this; 0: as it is.
    double turn_step_rad = 0.1;
    /// The phone's own constant part of the field, per part: 0 trusts the phone (the literal
    /// equation), large takes the mean difference away entirely. See the README.
    double bias_sigma_ut = 20.0;
    double field_sigma_ut = 3.0;   ///< Of the phone, per part, beside the map's own scatter.
    double correlation_m = 3.0;    ///< Differences closer together on the path are one.
    double map_sigma_m = 0.5;      ///< Of the map's own places, per axis.
    double widest_sigma_m = 20.0;  ///< A direction less certain than this is not known at all.

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  /// Where to search, at the end of the newest motion, and how the path lies on the floor.
  struct Prior {
    core::Belief belief;
    double heading_offset_rad = 0.0;  ///< Added to the motions' headings: floor frame.
    double step_scale = 1.0;          ///< Times the motions' lengths. Positive.
  };

  /// `options` must be valid.
  explicit SequenceMatcher(const Options& options) : options_(options) {}

  /// By time, interleaved as they come. What is not finite or not later than the last of its kind
  /// is passed over; motions that overlap the last one begin at its end.
  void add(core::DeviceTime time, const LevelField& field);
  void add(const observation::MotionDelta& motion);

  /// nullopt where nothing can be said: too little walked within the window before `time`, too much
  /// of it without field or off the map, no usable prior, or a field as flat as nothing. `grid` is
  /// that of the prior's floor.
  std::optional<observation::MagneticObservation> match(core::DeviceTime time, const Prior& prior,
                                                        const FieldGrid& grid) const;

 private:
  struct FieldReading {
    core::DeviceTime time;
    core::Vector2 field_ut;  ///< Horizontal, vertical.
  };
  struct PathPoint {
    core::DeviceTime time;
    core::Vector2 path_m;  ///< Sum of the motions as they were told, unturned and unscaled.
    double walked_m = 0.0;
  };

  PathPoint path_at(core::DeviceTime time) const;
  /// The pieces that have a field, newest first.
  std::vector<detail::PathField> pieces_between(core::DeviceTime begin, core::DeviceTime end,
                                                std::size_t piece_count, const Prior& prior) const;
  void forget_before(core::DeviceTime time);

  Options options_;
  std::deque<FieldReading> field_;
  std::deque<PathPoint> path_;
};

}  // namespace waylode::magnetic
