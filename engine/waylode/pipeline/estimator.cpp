// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pipeline/estimator.hpp"

#include "waylode/core/assert.hpp"

namespace waylode::pipeline {
namespace {

using observation::MotionDelta;
using observation::RadioObservation;

/// The newest scan alone, doubted more as it ages; the floor by the votes of all.
class WknnMethod final : public Estimator {
 public:
  WknnMethod(const Model& model, const SessionOptions& options)
      : model_(&model),
        wknn_(model.matcher(), model.options().wknn),
        known_floor_(options.known_floor),
        floor_filter_(model.options().fused.floor, model.site()->floors().size()) {}

  void add(const MotionDelta&) override {}
  void add(const RadioObservation& observation) override {
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
class FusedMethod final : public Estimator {
 public:
  FusedMethod(const Model& model, const SessionOptions& options, bool hears)
      : tracker_(model.site(), model.options().fused, options.known_floor), hears_(hears) {
    if (!hears) {
      tracker_.start(options.start->time, options.start->floor, options.start->position_m,
                     options.start->sigma_m);
    }
  }

  void add(const MotionDelta& motion) override { tracker_.add(motion); }
  void add(const RadioObservation& observation) override {
    if (hears_) tracker_.add(observation);
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

class FixedLagMethod final : public Estimator {
 public:
  FixedLagMethod(const Model& model, const SessionOptions& options, core::Duration lag)
      : tracker_(model.site(), model.options().fused, options.known_floor, lag) {}

  void add(const MotionDelta& motion) override { tracker_.add(motion); }
  void add(const RadioObservation& observation) override { tracker_.add(observation); }
  void hear_unknown(core::DeviceTime delivered) override { tracker_.hear_unknown(delivered); }
  std::optional<core::Belief> belief_at(core::DeviceTime time) const override {
    return tracker_.belief_at(time);
  }
  core::FixState state_at(core::DeviceTime time, const core::Belief& belief) const override {
    return tracker_.state_at(time, belief);
  }

 private:
  smoothing::FixedLagTracker tracker_;
};

class WholeTrackMethod final : public Estimator {
 public:
  WholeTrackMethod(const Model& model, const SessionOptions& options)
      : smoother_(model.site(), model.options().smoothing_options(), options.known_floor) {}

  void add(const MotionDelta& motion) override { smoother_.add(motion); }
  void add(const RadioObservation& observation) override { smoother_.add(observation); }
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
  switch (method.kind) {
    case MethodKind::kWknn:
      return std::make_unique<WknnMethod>(model, options);
    case MethodKind::kPdr:
      WAYLODE_ASSERT(options.start.has_value());
      return std::make_unique<FusedMethod>(model, options, /*hears=*/false);
    case MethodKind::kFused:
      return std::make_unique<FusedMethod>(model, options, /*hears=*/true);
    case MethodKind::kFixedLag:
      return std::make_unique<FixedLagMethod>(model, options, method.lag);
    case MethodKind::kWholeTrack:
      break;
  }
  return std::make_unique<WholeTrackMethod>(model, options);
}

}  // namespace waylode::pipeline
