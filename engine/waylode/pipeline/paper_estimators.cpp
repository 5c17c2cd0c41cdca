// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pipeline/paper_estimators.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include "waylode/core/covariance.hpp"
#include "waylode/fusion/decision_flow.hpp"
#include "waylode/fusion/feedback_tracker.hpp"
#include "waylode/fusion/path_memory.hpp"
#include "waylode/fusion/zhou_tracker.hpp"
#include "waylode/pipeline/plane_estimator.hpp"

namespace waylode::pipeline {
namespace {

using fusion::PlanarEstimate;
using fusion::PlanarMeasurement;

bool is_sound(const observation::MotionDelta& motion) {
  return motion.begin <= motion.end && std::isfinite(motion.length_m) &&
         std::isfinite(motion.heading_rad) && std::isfinite(motion.length_sigma_m) &&
         std::isfinite(motion.heading_sigma_rad) && motion.length_m >= 0.0 &&
         motion.length_sigma_m >= 0.0 && motion.heading_sigma_rad >= 0.0;
}

bool is_sound(const core::Vector2& position_m, const core::Matrix2& covariance_m2) {
  return position_m.allFinite() && core::is_valid_covariance(covariance_m2);
}

class DecisionMethod final : public PlaneEstimator {
 public:
  DecisionMethod(const Model& model, const SessionOptions& options,
                 const fusion::DecisionFlow::Options& flow)
      : PlaneEstimator(model, options), flow_(flow) {
    begin();
  }

 private:
  void start(const PlanarEstimate& place) override { flow_.start(place); }
  void step(const observation::MotionDelta& motion) override { flow_.add(motion); }
  void hear(const PlanarMeasurement& whole_map, const Again&) override { flow_.add(whole_map); }
  std::optional<PlanarEstimate> place_at(core::DeviceTime time) const override {
    if (!flow_.started()) return std::nullopt;
    return flow_.at(time);
  }

  fusion::DecisionFlow flow_;
};

/// The magnetic place as it comes, moved on by the steps since; begins like the others.
class MagneticMethod final : public PlaneEstimator {
 public:
  MagneticMethod(const Model& model, const SessionOptions& options)
      : PlaneEstimator(model, options) {
    begin();
  }

 private:
  void start(const PlanarEstimate& place) override { place_ = place; }
  void step(const observation::MotionDelta& motion) override {
    if (!is_sound(motion) || !path_.is_in_order(motion.end)) return;
    path_.add(motion);
    if (!place_) return;
    place_->position_m += fusion::displacement_m(motion);
    // What a step adds to the doubt, along and across.
    const double across_m = motion.length_m * motion.heading_sigma_rad;
    const double variance_m2 = motion.length_sigma_m * motion.length_sigma_m + across_m * across_m;
    place_->covariance_m2 += variance_m2 * core::Matrix2::Identity();
    place_->time = motion.end;
  }
  void hear(const PlanarMeasurement& whole_map, const Again&) override {
    if (place_ || !is_sound(whole_map.position_m, whole_map.covariance_m2)) return;
    place_ = {whole_map.delivered, whole_map.position_m, whole_map.covariance_m2};
  }
  void feel(const PlanarEstimate& place) override {
    if (!is_sound(place.position_m, place.covariance_m2)) return;
    place_ = place;
    place_->position_m -= path_.offset_m(place.time);
  }
  std::optional<PlanarEstimate> place_at(core::DeviceTime time) const override {
    std::optional<PlanarEstimate> place = place_;
    if (!place) return place;
    place->time = time;
    place->position_m += path_.offset_m(time);
    return place;
  }

  fusion::PathMemory path_;
  std::optional<PlanarEstimate> place_;
};

class IntervalMethod final : public PlaneEstimator {
 public:
  IntervalMethod(const Model& model, const SessionOptions& options,
                 const fusion::ZhouTracker::Options& tracker)
      : PlaneEstimator(model, options), tracker_(tracker) {
    begin();
  }

 private:
  void start(const PlanarEstimate& place) override { tracker_.start(place); }
  void step(const observation::MotionDelta& motion) override { tracker_.add(motion); }
  void hear(const PlanarMeasurement& whole_map, const Again&) override {
    tracker_.add_radio(whole_map);
  }
  void feel(const PlanarEstimate& place) override { tracker_.add_magnetic(place); }
  std::optional<PlanarEstimate> place_at(core::DeviceTime time) const override {
    if (!tracker_.started()) return std::nullopt;
    return tracker_.at(time);
  }

  fusion::ZhouTracker tracker_;
};

class FeedbackMethod final : public PlaneEstimator {
 public:
  FeedbackMethod(const Model& model, const SessionOptions& options,
                 const fusion::FeedbackTracker::Options& tracker)
      : PlaneEstimator(model, options), options_(tracker), tracker_(tracker) {
    begin();
  }

 private:
  void start(const PlanarEstimate& place) override {
    tracker_.start({&place, 1});
    settled_ = true;
  }
  void step(const observation::MotionDelta& motion) override {
    tracker_.add(motion);
    settled_ = settled_ || tracker_.started();
  }
  void hear(const PlanarMeasurement& whole_map, const Again& again) override {
    // While nobody has moved, all that was heard so far tells of the start.
    if (!settled_) return start_anywhere(whole_map, again);
    tracker_.compare(whole_map);
    std::vector<std::optional<fusion::CircleMatch>> found;
    for (const core::Vector2& centre : tracker_.centres()) found.push_back(again.near(centre));
    tracker_.correct(found);
  }
  std::optional<PlanarEstimate> place_at(core::DeviceTime time) const override {
    if (!tracker_.started()) return std::nullopt;
    return tracker_.at(time);
  }

  void start_anywhere(const PlanarMeasurement& whole_map, const Again& again) {
    if (!is_sound(whole_map.position_m, whole_map.covariance_m2)) return;
    std::vector<PlanarEstimate> places;
    if (options_.hypotheses > 1) {
      constexpr double kApart_m = 3.0;
      for (const core::Vector2& place_m :
           again.alternatives(static_cast<std::size_t>(options_.hypotheses), kApart_m)) {
        places.push_back({whole_map.delivered, place_m, core::Matrix2::Identity()});
      }
    }
    if (places.empty()) {
      places.push_back({whole_map.delivered, whole_map.position_m, whole_map.covariance_m2});
    }
    tracker_.start(places);
  }

  fusion::FeedbackTracker::Options options_;
  fusion::FeedbackTracker tracker_;
  bool settled_ = false;
};

}  // namespace

std::unique_ptr<Estimator> make_paper_estimator(FusionPart part, const Model& model,
                                                const SessionOptions& options) {
  fusion::DecisionFlow::Options decision = model.options().decision;
  fusion::ZhouTracker::Options interval = model.options().interval;
  fusion::FeedbackTracker::Options feedback = model.options().feedback;
  switch (part) {
    case FusionPart::kUnscented:
      decision.mode = fusion::DecisionMode::kEveryFix;
      return std::make_unique<DecisionMethod>(model, options, decision);
    case FusionPart::kUnscentedWhenLarge:
      decision.mode = fusion::DecisionMode::kOnlyWhenLarge;
      return std::make_unique<DecisionMethod>(model, options, decision);
    case FusionPart::kPairs:
      decision.mode = fusion::DecisionMode::kWuLiteral;
      return std::make_unique<DecisionMethod>(model, options, decision);
    case FusionPart::kMagnetic:
      return std::make_unique<MagneticMethod>(model, options);
    case FusionPart::kIntervals:
    case FusionPart::kIntervalsUnfiltered:
      interval.robust_filter = false;
      interval.filter_blend = part == FusionPart::kIntervals;
      return std::make_unique<IntervalMethod>(model, options, interval);
    case FusionPart::kRawTerms:
      interval.robust_filter = true;
      return std::make_unique<IntervalMethod>(model, options, interval);
    case FusionPart::kFeedback:
      return std::make_unique<FeedbackMethod>(model, options, feedback);
    case FusionPart::kFeedbackLiteral:
      feedback.reading = fusion::FeedbackReading::kClosedLoop;
      feedback.guard_gate = std::numeric_limits<double>::infinity();
      feedback.hypotheses = 1;
      return std::make_unique<FeedbackMethod>(model, options, feedback);
    default:
      return nullptr;
  }
}

}  // namespace waylode::pipeline
