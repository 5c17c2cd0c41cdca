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

/// What was found among the surveyed places near a centre.
struct CircleMatch {
  PlanarMeasurement position;
  /// Of what was heard, at the place that fits best; up to a constant common to all centres. Scores
  /// the hypotheses; leave 0 where unknown.
  double log_likelihood = 0.0;
};

/// Positioning by feedback [Zhao2019] 2.3: steps predict where the walker is, the caller matches
/// the scan among the surveyed places near there, and the outcome corrects the steps. A start that
/// is off by more than the circle would never be found out; so fixes from the whole map guard it,
/// and several starts may be followed side by side.
///
/// In turn: add() the step; compare() where the scan was matched with the whole map; centres();
/// correct() with what was found around each.
class FeedbackTracker {
 public:
  struct Options {
    FeedbackReading reading = FeedbackReading::kClosedLoop;
    double blend_ratio = 0.4;  ///< kBlended: share of the radio position; 0 to 1.
    /// A whole-map fix disagrees when its chi-square distance (two degrees of freedom) exceeds
    /// this; > 0, infinite for no guard.
    double guard_gate = 5.99;
    int guard_failures = 3;     ///< Disagreements among the newest `guard_window` that start anew.
    int guard_window = 5;       ///< >= guard_failures >= 1, at most 100.
    bool use_whole_map = true;  ///< kFiltered: whole-map fixes are measurements too.
    double circle_sigma_scale = 1.0;    ///< On a circle match's own sigma; > 0.
    double circle_floor_sigma_m = 0.5;  ///< What that sigma does not know of; >= 0.
    // Several hypotheses.
    int hypotheses = 1;              ///< Starts followed side by side; 1 to 16.
    double whole_map_score = 0.5;    ///< Power of the whole-map fixes' likelihood; >= 0.
    double circle_score = 0.2;       ///< Power of the circle matches' likelihood; >= 0.
    double score_kept_ratio = 0.97;  ///< Of a score, from scan to scan; 0 to 1.
    double merge_within_m = 0.7;     ///< Hypotheses this near are one; >= 0.
    /// Wide for radio errors, which persist over many of these scans.
    StepPositionFilter::Options filter = filter_defaults();

    static StepPositionFilter::Options filter_defaults();
    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  /// `options` are valid.
  explicit FeedbackTracker(const Options& options);

  /// Begins anew at the first `hypotheses` of `places`, likeliest first; at least one. Finite,
  /// covariances valid, of one time.
  void start(std::span<const PlanarEstimate> places);
  bool started() const { return !tracks_.empty(); }

  /// False, and nothing changes: not sound, ended before the last step did, or nothing started.
  bool add(const observation::MotionDelta& motion);
  /// A fix from the whole map: guards, scores the hypotheses, and begins where nothing has. False,
  /// and nothing changes: not sound, or delivered before the last one or the last correction.
  bool compare(const PlanarMeasurement& whole_map);
  /// Where to match, one place per hypothesis, the best first. Empty before the start.
  std::vector<core::Vector2> centres() const;
  /// What was found around each of centres(), in their order; nullopt where no place was near.
  /// False, and nothing changes: another number of entries, or one not sound or too old.
  bool correct(std::span<const std::optional<CircleMatch>> found);

  /// The best hypothesis, carried to `time`; the others widen its covariance by their scores.
  /// Something has started.
  PlanarEstimate at(core::DeviceTime time) const;
  /// How often the guard has begun anew.
  int restarts() const { return restarts_; }

 private:
  struct Track {
    StepPositionFilter filter;
    std::optional<PlanarEstimate> answer;  ///< kOpenLoop: the newest match, walked on.
    double log_score = 0.0;
    std::deque<bool> doubts;  ///< Of the newest whole-map fixes.
  };

  static PlanarEstimate answer_of(const Track& track, core::DeviceTime time);
  void correct(Track& track, const PlanarMeasurement& match) const;
  void compare(Track& track, const PlanarMeasurement& whole_map) const;
  void begin_anew(const PlanarMeasurement& whole_map);
  void rank();

  Options options_;
  core::DeviceTime last_radio_;
  std::vector<Track> tracks_;  ///< By falling score.
  int restarts_ = 0;
};

}  // namespace waylode::fusion
