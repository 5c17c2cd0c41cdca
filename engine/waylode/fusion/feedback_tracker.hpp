// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "waylode/core/result.hpp"
#include "waylode/fusion/path_memory.hpp"
#include "waylode/fusion/planar_estimate.hpp"
#include "waylode/fusion/step_position_filter.hpp"

namespace waylode::fusion {

/// What the radio position found near the walked one does to it.
enum class FeedbackReading : std::uint8_t {
  kClosedLoop,  ///< The next step starts at the radio position.
  kOpenLoop,    ///< The steps run on by themselves; the radio position is only the answer.
  kBlended,     ///< The next step starts between the two.
  kFiltered,    ///< The radio position is a measurement of a filter with heading offset and scale.
};

/// Positioning by feedback [Zhao2019] 2.3: steps predict where the walker is, the caller matches
/// the scan among the surveyed places near there, and the outcome corrects the steps. A start that
/// is off by more than the circle would never be found out; so fixes from the whole map guard it,
/// and several starts may be followed side by side.
///
/// In turn: add(step); centres(); correct() with what was found around each; where the whole map
/// was matched too, compare().
class FeedbackTracker {
 public:
  struct Options {
    FeedbackReading reading = FeedbackReading::kClosedLoop;
    double blend_ratio = 0.4;  ///< kBlended: share of the radio position; 0 to 1.
    /// A whole-map fix disagrees when its chi-square distance (two degrees of freedom) exceeds
    /// this; > 0, infinite: no guard.
    double guard_gate = 9.21;
    int guard_failures =
        3;                 ///< Disagreements among the newest `guard_window` that start anew; >= 1.
    int guard_window = 5;  ///< >= guard_failures.
    /// kFiltered: whole-map fixes are measurements too, not only a guard.
    bool use_whole_map = true;
    /// kFiltered: on the sigma of radio positions near a centre, which repeat one another; > 0.
    double circle_sigma_scale = 1.0;
    int hypotheses = 1;  ///< Starts followed side by side; 1 to 16.
    StepPositionFilter::Options filter;

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  /// `options` are valid.
  explicit FeedbackTracker(const Options& options);

  /// Begins anew at up to `hypotheses` places, likeliest first; at least one. Covariances are
  /// valid.
  void start(std::span<const PlanarEstimate> places);
  bool started() const { return !tracks_.empty(); }

  /// False, and nothing changes: not sound, before the last event, or nothing started.
  bool add(const observation::MotionDelta& motion);
  /// Where to match, one place per hypothesis, the best first. Empty before the start.
  std::vector<core::Vector2> centres() const;
  /// What was found around each of centres(), in their order; nullopt where no place was near.
  /// False, and nothing changes: another number of entries, or one not sound.
  bool correct(std::span<const std::optional<PlanarMeasurement>> found);
  /// A fix from the whole map: guards, scores the hypotheses, and begins where nothing has. False,
  /// and nothing changes: not sound, or before the last event.
  bool compare(const PlanarMeasurement& whole_map);

  /// Of the best hypothesis, carried to `time` (not before the last event). Something has started.
  PlanarEstimate at(core::DeviceTime time) const;
  /// How often the guard has begun anew.
  int restarts() const { return restarts_; }

 private:
  struct Track {
    StepPositionFilter filter;
    std::optional<PlanarEstimate> answer;  ///< kOpenLoop: the newest radio position, walked on.
    double log_score = 0.0;                ///< Of the whole-map fixes, old ones fading.
    std::deque<bool> disagreements;
  };

  Options options_;
  std::vector<Track> tracks_;  ///< By falling score.
  int restarts_ = 0;
};

}  // namespace waylode::fusion
