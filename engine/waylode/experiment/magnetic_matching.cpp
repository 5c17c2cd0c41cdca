// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/experiment/magnetic_matching.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "waylode/core/angle.hpp"
#include "waylode/core/covariance.hpp"
#include "waylode/core/rng.hpp"
#include "waylode/magnetic/features.hpp"

namespace waylode::experiment {
namespace {

using core::Vector2;
using magnetic::SequenceMatcher;

constexpr core::FloorId kFloor{0};
constexpr auto kMotion = std::chrono::milliseconds(500);
constexpr auto kBetweenMatches = std::chrono::seconds(1);

core::Bounds2 bounds_of(const site::MagneticMap& map) {
  core::Bounds2 bounds;
  for (std::size_t i = 0; i < map.points.size(); ++i) {
    const Vector2 place_m(static_cast<double>(map.points[i].x_m),
                          static_cast<double>(map.points[i].y_m));
    bounds.min_m = i == 0 ? place_m : bounds.min_m.cwiseMin(place_m);
    bounds.max_m = i == 0 ? place_m : bounds.max_m.cwiseMax(place_m);
  }
  return bounds;
}

/// A whole map within the search's reach.
SequenceMatcher::Options wide_enough(SequenceMatcher::Options options, double radius_m) {
  options.narrowest_search_m = radius_m;
  options.widest_search_m = radius_m;
  return options;
}

/// Half a second at a time, the compass averaged over it.
class EvenWalk {
 public:
  explicit EvenWalk(double speed_mps) : speed_mps_(speed_mps) {}

  std::optional<observation::MotionDelta> add(const FieldWalk::Reading& reading) {
    if (!begun_) begin_ = reading.time;
    begun_ = true;
    headings_rad_.push_back(reading.heading_rad);
    if (reading.time - begin_ < kMotion) return std::nullopt;
    observation::MotionDelta motion;
    motion.begin = begin_;
    motion.end = reading.time;
    motion.length_m = speed_mps_ * core::to_seconds(motion.end - motion.begin);
    const auto mean = core::circular_mean(headings_rad_);
    motion.heading_rad = mean ? mean->mean_rad : reading.heading_rad;
    begin_ = reading.time;
    headings_rad_.clear();
    return motion;
  }

 private:
  double speed_mps_;
  bool begun_ = false;
  core::DeviceTime begin_;
  std::vector<double> headings_rad_;
};

Vector2 shift_of(const observation::MotionDelta& motion) {
  return motion.length_m * Vector2(std::cos(motion.heading_rad), std::sin(motion.heading_rad));
}

std::vector<sample::Sample> samples_of(const FieldWalk& walk) {
  std::vector<sample::Sample> samples;
  for (const FieldWalk::Reading& reading : walk.readings) {
    samples.push_back(sample::AccelerometerSample{
        reading.time, pdr::kStandardGravity_mps2 * reading.up_in_device});
    samples.push_back(sample::MagnetometerSample{reading.time, reading.field_ut, -1});
  }
  return samples;
}

std::vector<survey::PlacedWaypoint> marks_of(const FieldWalk& walk) {
  std::vector<survey::PlacedWaypoint> marks;
  for (const FieldWalk::Stretch& stretch : walk.stretches) {
    marks.push_back({walk.readings[stretch.first].time, kFloor, stretch.from_m});
    marks.push_back({walk.readings[stretch.last].time, kFloor, stretch.to_m});
  }
  return marks;
}

/// Replays one walk after the other.
class Replay {
 public:
  Replay(const site::MagneticMap& map, const MagneticMatchingOptions& options)
      : options_(options),
        grid_(map.on_floor(kFloor), options.grid),
        bounds_(bounds_of(map)),
        rng_(options.seed) {
    if (options_.global) {
      options_.matcher = wide_enough(options_.matcher, 0.5 * bounds_.diagonal_m() + 1.0);
    }
  }

  void add(const FieldWalk& walk) {
    SequenceMatcher matcher(options_.matcher);
    EvenWalk even(options_.speed_mps);
    result_.errors_m.emplace_back();
    chain_m_.reset();
    core::DeviceTime next =
        walk.readings.front().time + core::from_seconds(options_.matcher.window_s);
    for (std::size_t i = 0; i < walk.readings.size(); ++i) {
      const FieldWalk::Reading& reading = walk.readings[i];
      const auto level = magnetic::level_field(reading.field_ut, reading.up_in_device);
      if (level) matcher.add(reading.time, *level);
      const auto motion = even.add(reading);
      if (!motion) continue;
      matcher.add(*motion);
      if (chain_m_) *chain_m_ += shift_of(*motion);
      const auto truth_m = walk.truth_m(i);
      if (reading.time < next || !truth_m) continue;
      next = reading.time + kBetweenMatches;
      judge(matcher, reading.time, *truth_m);
    }
  }

  MagneticMatching result() && { return std::move(result_); }

 private:
  SequenceMatcher::Prior start(const Vector2& truth_m) {
    SequenceMatcher::Prior prior;
    prior.belief.floor = kFloor;
    prior.belief.floor_probability = 1.0;
    const double sigma_m = options_.start_sigma_m;
    const double x_m = rng_.normal(0.0, sigma_m);
    const double y_m = rng_.normal(0.0, sigma_m);
    prior.belief.position_m = truth_m + Vector2(x_m, y_m);
    if (chain_m_) prior.belief.position_m = *chain_m_;
    if (options_.global) prior.belief.position_m = 0.5 * (bounds_.min_m + bounds_.max_m);
    prior.belief.covariance_m2 = sigma_m * sigma_m * core::Matrix2::Identity();
    return prior;
  }

  void judge(const SequenceMatcher& matcher, core::DeviceTime time, const Vector2& truth_m) {
    ++result_.tried;
    const auto found = matcher.match(time, start(truth_m), grid_);
    if (!found) return;
    const Vector2 error_m = found->position_m - truth_m;
    result_.errors_m.back().push_back(error_m.norm());
    result_.squared_mahalanobis.push_back(core::squared_mahalanobis(error_m, found->covariance_m2));
    if (options_.chained) chain_m_ = found->position_m;
  }

  MagneticMatchingOptions options_;
  magnetic::FieldGrid grid_;
  core::Bounds2 bounds_;
  core::Rng rng_;
  std::optional<Vector2> chain_m_;
  MagneticMatching result_;
};

}  // namespace

std::optional<Vector2> FieldWalk::truth_m(std::size_t reading) const {
  for (const Stretch& stretch : stretches) {
    if (reading < stretch.first || reading > stretch.last) continue;
    const double share = static_cast<double>(reading - stretch.first) /
                         static_cast<double>(stretch.last - stretch.first);
    return Vector2(stretch.from_m + share * (stretch.to_m - stretch.from_m));
  }
  return std::nullopt;
}

double mean_speed_mps(const std::vector<FieldWalk>& walks) {
  double walked_m = 0.0;
  double time_s = 0.0;
  for (const FieldWalk& walk : walks) {
    for (const FieldWalk::Stretch& stretch : walk.stretches) {
      walked_m += (stretch.to_m - stretch.from_m).norm();
      time_s +=
          core::to_seconds(walk.readings[stretch.last].time - walk.readings[stretch.first].time);
    }
  }
  return time_s > 0.0 ? walked_m / time_s : 0.0;
}

site::MagneticMapStorage map_of(const std::vector<FieldWalk>& walks,
                                const survey::MagneticSurvey::Options& options) {
  survey::MagneticSurvey survey(options);
  for (const FieldWalk& walk : walks) {
    survey.add(samples_of(walk), survey::LabelledPath({}, marks_of(walk), {}));
  }
  return survey.build();
}

MagneticMatching match_walks(const std::vector<FieldWalk>& walks, const site::MagneticMap& map,
                             const MagneticMatchingOptions& options) {
  Replay replay(map, options);
  for (const FieldWalk& walk : walks) {
    if (!walk.readings.empty()) replay.add(walk);
  }
  return std::move(replay).result();
}

core::Result<Outcome> magnetic_matching_outcome(const std::vector<FieldWalk>& training,
                                                const std::vector<FieldWalk>& tests) {
  if (training.empty() || tests.empty()) {
    return core::fail(core::ErrorCode::kLogLacksRecords,
                      "training walks and tests are needed to match the field",
                      "magnetic matching");
  }
  const site::MagneticMapStorage map = map_of(training, {});
  Outcome outcome;
  outcome.paper = "zhou2016";
  outcome.title = "Magnetic matching on real walks";
  outcome.data = std::to_string(training.size()) + " training and " + std::to_string(tests.size()) +
                 " test walks along corridors, the official split; no steps, one constant speed";
  struct Window {
    const char* label;
    double window_s;
    bool literal;
  };
  constexpr std::array<Window, 4> kWindows = {{{"2 s, literal", 2.0, true},
                                               {"6 s, literal", 6.0, true},
                                               {"6 s", 6.0, false},
                                               {"10 s", 10.0, false}}};
  for (const Window& window : kWindows) {
    MagneticMatchingOptions options;
    options.speed_mps = mean_speed_mps(training);
    options.matcher.window_s = window.window_s;
    if (window.literal) options.matcher.bias_sigma_ut = options.matcher.largest_turn_rad = 0.0;
    const MagneticMatching matching = match_walks(tests, map.view(), options);
    Figure mean;
    mean.id = std::string("Z-X2");
    mean.what = std::string("mean error, window of ") + window.label;
    mean.unit = std::string("m");
    mean.paper = "1.64";
    mean.ours = bootstrap(matching.errors_m, mean_of);
    outcome.figures.push_back(mean);
    Figure within = mean;
    within.what = std::string("within 3 m, window of ") + window.label;
    within.unit = std::string("%");
    within.paper = "91";
    within.ours = bootstrap(matching.errors_m, [](std::span<const double> values) {
      return percent_within(values, 3.0);
    });
    outcome.figures.push_back(within);
  }
  outcome.notes.emplace_back(
      "The start is known to 2 m per axis; matches that say nothing are not counted.");
  return outcome;
}

}  // namespace waylode::experiment
