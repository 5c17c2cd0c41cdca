// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/fusion/feedback_tracker.hpp"

#include <algorithm>
#include <cmath>

#include "waylode/core/assert.hpp"
#include "waylode/fusion/detail/sound.hpp"

namespace waylode::fusion {
namespace {

/// A score ranks, it does not measure: far-off fixes count as Student-t of this freedom.
constexpr double kScoreFreedom = 4.0;
/// Chi-square that an empty circle counts like, in a score.
constexpr double kEmptyCircle = 6.0;
/// A hypothesis that begins later is at most this far behind the best one.
constexpr double kNewcomerLag = 4.0;

core::Vector2 position_of(const StepPositionFilter& filter) {
  return filter.filter().mean().head<2>();
}

core::Matrix2 covariance_of(const StepPositionFilter& filter) {
  return filter.filter().covariance().topLeftCorner<2, 2>();
}

/// A match of the past, walked on.
PlanarEstimate carried(const PlanarMeasurement& match, const StepPositionFilter& filter) {
  return {match.delivered, match.position_m - filter.walked_offset_m(match.measured),
          match.covariance_m2};
}

double student_log_density(const StepPositionFilter::Surprise& surprise) {
  return -0.5 * (kScoreFreedom + 2.0) * std::log1p(surprise.chi_square / kScoreFreedom) -
         0.5 * surprise.log_determinant;
}

void walk_on(PlanarEstimate& place, const observation::MotionDelta& motion) {
  const double across_m = motion.length_m * motion.heading_sigma_rad;
  place.time = std::max(place.time, motion.end);
  place.position_m += displacement_m(motion);
  place.covariance_m2 += (motion.length_sigma_m * motion.length_sigma_m + across_m * across_m) *
                         core::Matrix2::Identity();
}

}  // namespace

StepPositionFilter::Options FeedbackTracker::Options::filter_defaults() {
  StepPositionFilter::Options options;
  options.heading_offset_sigma_rad = 0.08;
  options.log_scale_sigma = 0.08;
  options.heading_offset_walk_rad_per_sqrt_step = 0.01;
  options.log_scale_walk_per_sqrt_step = 0.003;
  options.position_walk_m_per_sqrt_s = 0.2;
  options.radio_bias_sigma_m = 2.0;
  options.radio_bias_tau_s = 15.0;
  options.radio_sigma_scale = 1.5;
  options.radio_floor_sigma_m = 2.0;
  options.gate = 6.0;
  options.lost_failures = 0;  // The guard finds the lost.
  return options;
}

core::Result<void> FeedbackTracker::Options::validate() const {
  constexpr int kMostHypotheses = 16;
  constexpr int kLongestWindow = 100;
  const auto is_size = [](double value) { return std::isfinite(value) && value >= 0.0; };
  const bool sound = blend_ratio >= 0.0 && blend_ratio <= 1.0 && guard_gate > 0.0 &&
                     guard_failures >= 1 && guard_window >= guard_failures &&
                     guard_window <= kLongestWindow && std::isfinite(circle_sigma_scale) &&
                     circle_sigma_scale > 0.0 && is_size(circle_floor_sigma_m) && hypotheses >= 1 &&
                     hypotheses <= kMostHypotheses && is_size(whole_map_score) &&
                     is_size(circle_score) && score_kept_ratio >= 0.0 && score_kept_ratio <= 1.0 &&
                     is_size(merge_within_m);
  if (!sound) {
    return core::fail(
        core::ErrorCode::kInvalidOptions,
        "ratios must be 0 to 1, guard_window at least guard_failures, hypotheses 1 to "
        "16, the gate and the sigma scale positive, the others not negative",
        "feedback_tracker");
  }
  return filter.validate();
}

FeedbackTracker::FeedbackTracker(const Options& options) : options_(options) {}

void FeedbackTracker::start(std::span<const PlanarEstimate> places) {
  WAYLODE_ASSERT(!places.empty());
  tracks_.clear();
  const auto count = std::min(places.size(), static_cast<std::size_t>(options_.hypotheses));
  for (const PlanarEstimate& place : places.first(count)) {
    Track track{StepPositionFilter(options_.filter), std::nullopt, 0.0, {}};
    track.filter.start(place);
    tracks_.push_back(track);
  }
  last_radio_ = places.front().time;
  rank();
}

bool FeedbackTracker::add(const observation::MotionDelta& motion) {
  if (!started()) return false;
  std::vector<Track> moved = tracks_;
  for (Track& track : moved) {
    if (!track.filter.add(motion)) return false;
    if (track.answer) walk_on(*track.answer, motion);
  }
  tracks_ = std::move(moved);
  return true;
}

bool FeedbackTracker::compare(const PlanarMeasurement& whole_map) {
  if (!detail::is_sound(whole_map)) return false;
  if (!started()) {
    start(std::vector{
        PlanarEstimate{whole_map.delivered, whole_map.position_m, whole_map.covariance_m2}});
    return true;
  }
  if (whole_map.delivered < last_radio_) return false;
  last_radio_ = whole_map.delivered;
  for (Track& track : tracks_) compare(track, whole_map);
  rank();
  if (std::ranges::count(tracks_.front().doubts, true) >= options_.guard_failures) {
    begin_anew(whole_map);
  }
  return true;
}

void FeedbackTracker::compare(Track& track, const PlanarMeasurement& whole_map) const {
  const StepPositionFilter::Surprise surprise = track.filter.surprise(whole_map);
  track.log_score *= options_.score_kept_ratio;
  track.log_score += options_.whole_map_score * student_log_density(surprise);
  track.doubts.push_back(surprise.chi_square > options_.guard_gate);
  if (track.doubts.size() > static_cast<std::size_t>(options_.guard_window)) {
    track.doubts.pop_front();
  }
  if (options_.reading == FeedbackReading::kFiltered && options_.use_whole_map) {
    track.filter.add(whole_map);
  }
}

/// The best hypothesis contradicts the map: one more begins where the map points, in place of the
/// worst when there is no room.
void FeedbackTracker::begin_anew(const PlanarMeasurement& whole_map) {
  ++restarts_;
  const PlanarEstimate place = carried(whole_map, tracks_.front().filter);
  const bool is_full = tracks_.size() >= static_cast<std::size_t>(options_.hypotheses);
  Track newcomer = tracks_.front();
  newcomer.filter.move_to(place);
  newcomer.answer.reset();
  newcomer.doubts.clear();
  newcomer.log_score = std::max(tracks_.back().log_score, tracks_.front().log_score - kNewcomerLag);
  tracks_.front().doubts.clear();
  if (is_full) tracks_.pop_back();
  tracks_.push_back(std::move(newcomer));
  rank();
}

std::vector<core::Vector2> FeedbackTracker::centres() const {
  std::vector<core::Vector2> result;
  result.reserve(tracks_.size());
  for (const Track& track : tracks_) result.push_back(position_of(track.filter));
  return result;
}

bool FeedbackTracker::correct(std::span<const std::optional<CircleMatch>> found) {
  if (!started() || found.size() != tracks_.size()) return false;
  for (const auto& match : found) {
    if (!match) continue;
    if (!detail::is_sound(match->position) || !std::isfinite(match->log_likelihood) ||
        match->position.delivered < last_radio_) {
      return false;
    }
  }
  core::DeviceTime newest = last_radio_;
  for (std::size_t i = 0; i < found.size(); ++i) {
    Track& track = tracks_[i];
    if (!found[i]) {
      track.log_score -= options_.whole_map_score * 0.5 * kEmptyCircle;
      continue;
    }
    newest = std::max(newest, found[i]->position.delivered);
    track.log_score += options_.circle_score * found[i]->log_likelihood;
    PlanarMeasurement match = found[i]->position;
    match.covariance_m2 *= std::pow(options_.circle_sigma_scale, 2);
    match.covariance_m2 += std::pow(options_.circle_floor_sigma_m, 2) * core::Matrix2::Identity();
    correct(track, match);
  }
  last_radio_ = newest;
  rank();
  return true;
}

// [Zhao2019] 2.3, what follows eq. (17).
void FeedbackTracker::correct(Track& track, const PlanarMeasurement& match) const {
  const PlanarEstimate place = carried(match, track.filter);
  switch (options_.reading) {
    case FeedbackReading::kOpenLoop:
      track.answer = place;
      break;
    case FeedbackReading::kClosedLoop:
      track.filter.move_to(place);
      break;
    case FeedbackReading::kBlended: {
      const double share = options_.blend_ratio;
      const double rest = 1.0 - share;
      track.filter.move_to(
          {place.time, rest * position_of(track.filter) + share * place.position_m,
           rest * rest * covariance_of(track.filter) + share * share * place.covariance_m2});
      break;
    }
    case FeedbackReading::kFiltered:
      track.filter.add_unbiased(match);
      break;
  }
}

/// By falling score; of hypotheses that have met, the better one stays.
void FeedbackTracker::rank() {
  std::ranges::stable_sort(tracks_, std::ranges::greater{}, &Track::log_score);
  std::vector<Track> kept;
  for (Track& track : tracks_) {
    const bool is_double = std::ranges::any_of(kept, [&](const Track& better) {
      return (position_of(better.filter) - position_of(track.filter)).norm() <=
             options_.merge_within_m;
    });
    if (!is_double) kept.push_back(std::move(track));
  }
  tracks_ = std::move(kept);
}

PlanarEstimate FeedbackTracker::at(core::DeviceTime time) const {
  WAYLODE_ASSERT(started());
  PlanarEstimate result = answer_of(tracks_.front(), time);
  // Other hypotheses are doubt about the best one.
  double weights = 1.0;
  core::Matrix2 weighted_m2 = result.covariance_m2;
  for (std::size_t i = 1; i < tracks_.size(); ++i) {
    const double weight = std::exp(tracks_[i].log_score - tracks_.front().log_score);
    const PlanarEstimate other = answer_of(tracks_[i], time);
    const core::Vector2 off_m = other.position_m - result.position_m;
    weights += weight;
    weighted_m2 += weight * (other.covariance_m2 + off_m * off_m.transpose());
  }
  result.covariance_m2 = weighted_m2 / weights;
  return result;
}

PlanarEstimate FeedbackTracker::answer_of(const Track& track, core::DeviceTime time) {
  PlanarEstimate walked = track.filter.at(time);
  if (!track.answer) return walked;
  // The steps since the match lead on from it.
  const core::Vector2 beyond_m = walked.position_m - position_of(track.filter);
  return {time, track.answer->position_m + beyond_m, track.answer->covariance_m2};
}

}  // namespace waylode::fusion
