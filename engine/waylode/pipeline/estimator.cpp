// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pipeline/estimator.hpp"

#include "waylode/pipeline/paper_estimators.hpp"
#include "waylode/pipeline/particle_estimators.hpp"

namespace waylode::pipeline {
namespace {

using observation::MotionDelta;
using observation::RadioObservation;

/// Estimators that have no use for the field nor for a second match.
class RadioEstimator : public Estimator {
 public:
  using Estimator::add;
  void add(const RadioObservation& observation, const HeardAgain& /*again*/) final {
    hear(observation);
  }
  void add(const observation::MagneticObservation& /*observation*/) final {}

 private:
  virtual void hear(const RadioObservation& observation) = 0;
};

/// The newest scan alone, doubted more as it ages; the floor by the votes of all.
class WknnMethod final : public RadioEstimator {
 public:
  WknnMethod(const Model& model, const SessionOptions& options)
      : model_(&model),
        wknn_(model.matcher(), model.options().wknn),
        known_floor_(options.known_floor),
        floor_filter_(model.options().fused.floor, fusion::levels_of(*model.site())) {}

  using RadioEstimator::add;
  void add(const MotionDelta&) override {}
  void add(const observation::VerticalMotion& motion) override { floor_filter_.add(motion); }
  void hear(const RadioObservation& observation) override {
    floor_filter_.add(observation);
    newest_scan_ = fusion::HeardScan{observation.delivered, observation.known_share_ratio};
    const core::FloorId floor = known_floor_.value_or(*floor_filter_.most_likely());
    const auto* hypothesis = fusion::find_hypothesis(observation, floor);
    if (hypothesis == nullptr) return;
    const double probability = known_floor_ ? 1.0 : floor_filter_.probabilities()[floor.index];
    belief_ = core::Belief{floor, probability, hypothesis->position_m, hypothesis->covariance_m2};
    heard_at_ = observation.delivered;
  }
  void hear_unknown(core::DeviceTime delivered) override {
    newest_scan_ = fusion::HeardScan{delivered, 0.0};
  }
  std::optional<core::Belief> belief_at(core::DeviceTime time) const override {
    std::optional<core::Belief> belief = belief_;
    if (belief) {
      belief->covariance_m2 = wknn_.aged(belief->covariance_m2, core::to_seconds(time - heard_at_));
    }
    return belief;
  }
  core::FixState state_at(core::DeviceTime time, const core::Belief& belief) const override {
    return fusion::state_of(belief, time, newest_scan_, model_->options().fused.state);
  }

 private:
  const Model* model_;
  radio::WknnEstimator wknn_;
  std::optional<core::FloorId> known_floor_;
  fusion::FloorFilter floor_filter_;
  std::optional<fusion::HeardScan> newest_scan_;
  std::optional<core::Belief> belief_;  ///< When heard, at `heard_at_`.
  core::DeviceTime heard_at_;
};

/// The causal tracker; without scans, from a known start, it is plain dead reckoning.
class FusedMethod final : public RadioEstimator {
 public:
  FusedMethod(const Model& model, const SessionOptions& options, bool hears)
      : tracker_(model.site(), model.options().fused, options.known_floor), hears_(hears) {
    if (!hears && options.start) {
      tracker_.start(options.start->time, options.start->floor, options.start->position_m,
                     options.start->sigma_m);
    }
  }

  using RadioEstimator::add;
  void add(const MotionDelta& motion) override { tracker_.add(motion); }
  void add(const observation::VerticalMotion& motion) override { tracker_.add(motion); }
  void hear(const RadioObservation& observation) override {
    // Dead reckoning without a start takes it from the first scan.
    if (hears_ || !tracker_.planar().started()) tracker_.add(observation);
  }
  void hear_unknown(core::DeviceTime delivered) override {
    if (hears_) tracker_.hear_unknown(delivered);
  }
  std::optional<core::Belief> belief_at(core::DeviceTime time) const override {
    return tracker_.belief_at(time);
  }
  core::FixState state_at(core::DeviceTime time, const core::Belief& belief) const override {
    return tracker_.state_at(time, belief);
  }

 private:
  fusion::FusedTracker tracker_;
  bool hears_;
};

/// The robust tracker, forwards and back.
class RobustWholeMethod final : public RadioEstimator {
 public:
  RobustWholeMethod(const Model& model, const SessionOptions& options)
      : smoother_(model.site(), model.options().smoothing_options(), options.known_floor) {}

  using RadioEstimator::add;
  void add(const MotionDelta& motion) override { smoother_.add(motion); }
  void add(const observation::VerticalMotion& motion) override { smoother_.add(motion); }
  void hear(const RadioObservation& observation) override { smoother_.add(observation); }
  void hear_unknown(core::DeviceTime delivered) override { smoother_.hear_unknown(delivered); }
  std::optional<core::Belief> belief_at(core::DeviceTime time) const override {
    return smoother_.belief_at(time);
  }
  core::FixState state_at(core::DeviceTime time, const core::Belief& belief) const override {
    return smoother_.state_at(time, belief);
  }

 private:
  smoothing::TrackSmoother smoother_;
};

}  // namespace

std::unique_ptr<Estimator> make_estimator(const Model& model, const Method& method,
                                          const SessionOptions& options) {
  switch (method.recipe.fusion) {
    case FusionPart::kNewestScan:
      return std::make_unique<WknnMethod>(model, options);
    case FusionPart::kDeadReckoning:
      return std::make_unique<FusedMethod>(model, options, /*hears=*/false);
    case FusionPart::kRobust:
      return std::make_unique<FusedMethod>(model, options, /*hears=*/true);
    case FusionPart::kRobustWhole:
      return std::make_unique<RobustWholeMethod>(model, options);
    case FusionPart::kParticles:
    case FusionPart::kFixedLag:
    case FusionPart::kWholeTrack:
      return make_particle_estimator(model, method, options);
    default:
      return make_paper_estimator(method.recipe.fusion, model, options);
  }
}

}  // namespace waylode::pipeline
